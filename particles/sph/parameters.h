#ifndef meltfront_particles_sph_parameters_h
#define meltfront_particles_sph_parameters_h

#include <cases/method.h>
#include <particles/core/arrangement.h>
#include <particles/core/kernels.h>

#include <string>
#include <vector>

namespace meltfront::particles
{
  /** How particles exchange heat across a front. */
  enum class FrontRule
  {
    sub_particle, ///< the front lies within the melting particle, where its solid
                  ///< fraction puts it
    partner,      ///< a melting particle has the conductivity of its partner
    liquid        ///< that of the liquid until it has frozen (Monaghan et al. 2005,
                  ///< section 3)
  };

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
    crank_nicolson
  };

  /** The words for the schemes, in the order of the enumeration. */
  const std::vector<std::string> &time_scheme_names();

  /** The scheme that a word stands for. */
  TimeScheme time_scheme(const std::string &name);

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
    std::string layout;
    std::string front;
    bool moment_correction;
    double smoothing; ///< 0: as the paper, by the scene's symmetry
    std::string time_scheme;
    double step_factor; ///< 0: as the paper, 0.15 c rho h^2/k
  };

  /** The corrected method, `sph`. */
  const SphPolicy &corrected_policy();

  /** The method as Monaghan, Huppert and Worster (2005) computed, `sph-2005`. */
  const SphPolicy &published_policy();

  std::vector<cases::OptionDeclaration> sph_options(const SphPolicy &policy);

  /** The values of a run's options, resolved for a scene. */
  struct SphParameters
  {
    int dimension;
    int columns; ///< particles across the strip that stands for a slab; 0: what the
                 ///< kernel needs
    KernelShape kernel;
    double smoothing; ///< h/dp
    LatticeLayout layout;
    bool moment_correction;
    FrontRule front;
    TimeScheme time_scheme;
    int stages;         ///< most stages of a super step
    double step_factor; ///< 0: the paper's step
    double step_error;  ///< wanted of each implicit step; 0: steps of equal length
    /** Particles beside walls that bend stand for a whole cell of the lattice, as in the
     * paper: the domain has the volume of the cells. */
    bool whole_cells;
    Arrangement arrangement;
    double jitter; ///< in particle spacings
    std::uint64_t seed;
    int threads;
    int n;     ///< particles along the domain's side
    int steps; ///< of the run; 0: by step_factor or step_error
  };

  /** @throws cases::Refusal for a dimension in which the scene cannot be simulated. */
  SphParameters resolve_parameters(const SphPolicy &policy, const cases::Scene &scene,
                                   const cases::Resolution &resolution);
} // namespace meltfront::particles

#endif
