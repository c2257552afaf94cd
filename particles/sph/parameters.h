#ifndef meltfront_particles_sph_parameters_h
#define meltfront_particles_sph_parameters_h

#include <cases/method.h>
#include <cases/option_binder.h>
#include <particles/core/arrangement.h>
#include <particles/core/kernels.h>

#include <string>
#include <vector>

namespace meltfront::particles
{
  /** How particles exchange heat across a front. */
  enum class FrontRule
  {
    automatic,    ///< plane where FrontPlanes finds fronts, else sub_particle
    sub_particle, ///< the front lies within the melting particle, where its solid
                  ///< fraction puts it
    plane,        ///< where the solid fraction of the particles about it puts a straight
                  ///< front, on a lattice in the plane or in space
    partner,      ///< a melting particle has the conductivity of its partner
    liquid        ///< that of the liquid until it has frozen (Monaghan et al. 2005,
                  ///< section 3)
  };

  /** Whether the front lies within particles that melt, not between particles. */
  inline bool lies_within_particles(FrontRule rule)
  {
    return rule == FrontRule::sub_particle || rule == FrontRule::plane;
  }

  /** Where the particles are. */
  enum class Arrangement
  {
    lattice,
    jittered, ///< displaced from a lattice at random
    relaxed,  ///< jittered, then moved until they crowd nowhere
    random,   ///< as many as on the lattice, anywhere
    minimised ///< random, then moved to a minimum of the Lennard-Jones energy
  };

  enum class TimeScheme
  {
    euler,
    rkl2,
    backward_euler,
    crank_nicolson,
    automatic ///< steps as long as an error allows, by the cheaper scheme
  };

  /** What step_factor is a multiple of. */
  enum class StepLimit
  {
    monotone, ///< the largest explicit step that is certain to keep the maximum
              ///< principle; longer ones are refused
    stability ///< the linear stability limit of explicit Euler (StepLimits::stable), with
              ///< no guard
  };

  /** The words for the schemes that one may choose between, in the order of the
   * enumeration. */
  const std::vector<std::string> &time_scheme_names();

  /** The words for kernels that smooth, and for layouts. */
  cases::Words<KernelShape> smoothing_kernels();
  cases::Words<LatticeLayout> layouts();

  /** Whether steps of a scheme need the solution of equations. */
  inline bool is_implicit(TimeScheme scheme)
  {
    return scheme == TimeScheme::backward_euler || scheme == TimeScheme::crank_nicolson;
  }

  /**
   * What distinguishes the corrected method from the published one: the same code with
   * other defaults.
   */
  struct SphPolicy
  {
    std::string name;
    std::string summary;
    std::string corrected_form;
    bool as_published; ///< a slab is a square of n x n particles, as in the paper
    LatticeLayout layout;
    FrontRule front;
    bool moment_correction;
    double smoothing_length; ///< 0: as the paper, by the scene's symmetry
    TimeScheme time_scheme;
    double step_factor; ///< 0: as the paper, 0.15 c rho h^2/k
  };

  /** The corrected method, `sph`. */
  const SphPolicy &corrected_policy();

  /** The method as Monaghan, Huppert and Worster (2005) computed, `sph-2005`. */
  const SphPolicy &published_policy();

  /** The values of a run's options, resolved for a scene. */
  struct SphParameters
  {
    int dimension = 0; ///< 0: the lowest
    int columns = 0;   ///< particles across the strip that stands for a slab; 0: what the
                       ///< kernel needs
    KernelShape kernel = KernelShape::cubic_spline;
    double smoothing_length = 1; ///< h/dp
    LatticeLayout layout = LatticeLayout::cell_centred;
    bool moment_correction = true;
    FrontRule front = FrontRule::partner;
    TimeScheme time_scheme = TimeScheme::euler;
    int stages = 8;         ///< most stages of a super step
    double step_factor = 1; ///< 0: the paper's step
    StepLimit step_limit = StepLimit::monotone;
    double step_error = 0; ///< wanted of each implicit step; 0: steps of equal length
    /** Particles beside walls that bend stand for a whole cell of the lattice, as in the
     * paper: the domain has the volume of the cells. */
    bool whole_cells = false;
    Arrangement arrangement = Arrangement::lattice;
    double jitter = 0; ///< in particle spacings
    std::uint64_t seed = 1;
    int threads = 1;
    int n = 0;     ///< particles along the domain's side
    int steps = 0; ///< of the run; 0: by step_factor or step_error
  };

  /** The option `step_limit`. */
  void bind_step_limit(SphParameters &parameters, cases::OptionBinder &options);

  /** The options of a method. */
  struct SphOptions
  {
    explicit SphOptions(const SphPolicy &policy);

    void bind(cases::OptionBinder &options);

    SphParameters values; ///< as asked for
    bool refines_time = false;
    int cells = 80;
  };

  /** @throws cases::Refusal for a dimension in which the scene cannot be simulated. */
  SphParameters resolve_parameters(const SphPolicy &policy, const cases::Scene &scene,
                                   const cases::Resolution &resolution);
} // namespace meltfront::particles

#endif
