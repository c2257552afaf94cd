#ifndef meltfront_particles_rkpm_tracked_tracking_options_h
#define meltfront_particles_rkpm_tracked_tracking_options_h

#include <cases/method.h>
#include <cases/option_binder.h>
#include <cases/overshoot.h>

#include <string>

namespace meltfront::particles::rkpm_tracked
{
  /** The word that a user types. */
  inline constexpr const char *method_name = "rkpm-tracked";

  /** Of heat released throughout: a phase that it takes beyond the melting temperature by
   * more than this share of the largest difference from it, farther than so many spacings
   * from the fronts, melts or freezes there, where no front is followed. */
  inline constexpr double beyond_by_release = 1e-2, spacings_from_fronts = 2;

  /** The same at a wall, and at one whose temperature is held: that is exact. */
  inline constexpr double beyond_at_walls = 1e-2, beyond_at_held_walls = 1e-6;

  /** Collocation keeps the maximum principle in the limit only. Slabs with walls and
   * starts that jump do not overshoot along a line at n = 10, 20, 40. In the plane a body
   * that vanishes is a few spacings wide whatever these are: about the remains of a ring
   * that melts (ring-melting) 0.012 at n = 60 and 0.009 at n = 80 were seen, where
   * bodies meet (cavity-two-sinks) 0.030 at n = 60, in thin ice about a small disk 0.05
   * at n = 12. */
  inline constexpr cases::Overshoot overshoot_along_line{0.01, 1},
      overshoot_in_plane{0.06, 0.5};

  /** How the equations are advanced in time: backward differentiation of an order. */
  enum class TimeScheme
  {
    backward_euler = 1,
    bdf2 = 2,
    bdf3 = 3
  };

  /** In what the steps of a run are equal. */
  enum class Clock
  {
    time,
    root ///< of the time
  };

  /** How a phase is begun that appears at a wall. */
  enum class Start
  {
    automatic,   ///< from the similarity solution where the data allow it
    quasi_steady ///< as a thin layer whose profile is that of steady growth
  };

  /** Which phase gives way where the densities differ. */
  enum class Displaced
  {
    liquid,
    solid
  };

  /** How inner nodes are relaxed. */
  enum class RelaxRule
  {
    springs,      ///< they repel each other and the front, springs draw them back
    lennard_jones ///< as published: the Lennard-Jones energy alone
  };

  /** What is solved for at the nodes of a line. */
  enum class Form
  {
    automatic,  ///< collocation for a basis of a higher order than 2; balances else
    balances,   ///< of cells about the nodes, which lose no heat
    collocation ///< the equations themselves
  };

  /** What n refines. */
  enum class Refine
  {
    both,
    space,
    time
  };

  /** The options of the method. */
  struct TrackingParameters
  {
    void bind(cases::OptionBinder &options);

    int dimension = 0; ///< 0: the lowest
    int cells = 80;    ///< between nodes along the domain's side
    int steps = 0;     ///< planned over the run; where fronts are fast there are more
    Refine refine = Refine::both;
    Form form = Form::automatic;
    int basis_order = 2;
    double dilation = 0; ///< radius of the kernel over the spacing
    TimeScheme time_scheme = TimeScheme::bdf2;
    std::string clock_name = "automatic";
    Clock clock = Clock::time;
    double cfl = 0.5;                    ///< of a front in a step, over the spacing
    double interpolation_distance = 0.1; ///< nodes nearer to a front are interpolated,
                                         ///< over the spacing
    bool jittered = false;
    double jitter = 0.2;        ///< of inner nodes, over the spacing
    double wall_spacing = 0.05; ///< beside walls that give heat, over that within
    Start start = Start::automatic;
    bool exact_history = true; ///< before the start, where the start is exact
    Displaced displaced = Displaced::liquid;
    double start_depth = 6;   ///< of a new phase when sph hands over in the plane (nodes)
    int start_refinement = 2; ///< its particles in a spacing of the nodes, along a side
    int relax = 0;            ///< steps between relaxations of the inner nodes; 0: none
    RelaxRule relax_rule = RelaxRule::springs;
  };

  /**
   * Dimension in which a scene is simulated: 1 for a slab and, unless asked otherwise,
   * for what depends on the distance from an axis or a centre.
   * @throws cases::Refusal if the scene cannot be simulated in the one asked for.
   */
  int simulated_dimension(const cases::Scene &scene, const cases::Options &options);

  /** The options, made out for a scene. */
  TrackingParameters read_tracking_parameters(const cases::Scene &scene,
                                              const cases::Resolution &resolution);
} // namespace meltfront::particles::rkpm_tracked

#endif
