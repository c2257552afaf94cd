#ifndef meltfront_particles_rkpm_rkpm_parameters_h
#define meltfront_particles_rkpm_rkpm_parameters_h

#include <cases/method.h>
#include <particles/rkpm/moment_engine.h>
#include <particles/rkpm/supports.h>
#include <particles/scattered/linear_problem.h>
#include <particles/scattered/node_set.h>

#include <vector>

namespace meltfront::particles::rkpm
{
  /** A named method: one form of the approximation. */
  struct RkpmPolicy
  {
    const char *name;
    const char *summary;
    Variant variant;
  };

  /** The five of them. */
  const std::vector<RkpmPolicy> &rkpm_policies();

  /** What the unknowns are. */
  enum class Unknowns
  {
    nodal,        ///< temperatures at the nodes
    reconstructed ///< coefficients u_I of T(x) = sum_I N_I(x) u_I
  };

  /** A run's options, read. */
  struct RkpmParameters
  {
    MomentSettings moments;
    SupportSettings supports; ///< alpha is that inside of a lattice
    Unknowns unknowns = Unknowns::nodal;
    bool refuse_unstable = true; ///< else the spurious mode is reported only
    bool flux_row_as_printed = false;
    NodeArrangement arrangement = NodeArrangement::lattice;
    double jitter = 0; ///< over the spacing
  };

  /** Neither reproducing kernels nor BDF2 obey the maximum principle. A slab whose wall
   * is switched from 0 to 1 overshoots most with several fixed supports: by 0.0077,
   * 0.0031, 0 at n = 10, 20, 40; beside walls that heat is drawn through by up to 0.02,
   * 0.012, 0.0072, 0.0047 at n = 12, 20, 34, 54. */
  inline constexpr cases::Overshoot overshoot{0.015, 1};

  /** Of variants that take inclusions: nodes on their surface take the fluxes of both
   * sides from slopes of second order, (4 T_1 - T_2)/3 for lack of T_0, and overshoot by
   * up to 0.025 at n = 34 where heat comes in from a wall. */
  inline constexpr cases::Overshoot overshoot_at_inclusions{0.05, 1};

  /** The options of a method. */
  struct RkpmOptions
  {
    void bind(cases::OptionBinder &options);

    RkpmPolicy policy;
    KernelShape kernel = KernelShape::wendland_c4;
    int basis_order = 2;
    SupportRule support = SupportRule::nearest_neighbours;
    int neighbours = 0;  ///< 0: by the basis
    double dilation = 0; ///< 0: by the order
    bool refuse_unstable = true;
    Unknowns unknowns = Unknowns::nodal;
    bool flux_row_as_printed = false;
    NodeArrangement arrangement = NodeArrangement::lattice;
    double jitter = 0.2;
    Origin origin = Origin::point;
    LinearOptions linear{};
  };

  /** The options of a run in some dimension, made out. */
  RkpmParameters read_parameters(const RkpmPolicy &policy, const cases::Options &options,
                                 int dimension);
} // namespace meltfront::particles::rkpm

#endif
