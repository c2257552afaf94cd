#ifndef meltfront_particles_sph_tests_scenes_h
#define meltfront_particles_sph_tests_scenes_h

#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <particles/sph/sph.h>

#include <memory>
#include <vector>

/** Scenes and observers that the tests of SPH share. */
namespace meltfront::particles::testing
{
  using namespace test_support;

  /** A unit square or cube centred on the origin, insulated. */
  cases::Scene unit_box(int dimension, const cases::Material &material,
                        double temperature, double end_time);

  /** A scene and what is known of it. */
  struct Problem
  {
    cases::Scene scene;
    std::shared_ptr<const cases::ExactSolution> exact;
  };

  /** Freezing of a slab whose far wall has the exact temperature. */
  Problem freezing_slab(const cases::Material &material, double wall_temperature,
                        double initial_temperature, double length, double end_time);

  /** N1, N2 and N5 of the exact solutions' table. */
  Problem plane_freezing();
  Problem plane_freezing_water();
  Problem plane_contrast();

  /** A line sink in the insulated unit square, front constant 0.15. */
  Problem line_sink(double end_time = 475000);

  /** The same in a disk of radius 0.5 with the exact temperature on its rim. */
  Problem line_sink_in_disk();

  /** A line sink whose surroundings are cut out of an annulus with exact rims, from the
   * exact state on: the front goes from 0.4 to 0.6 m. */
  Problem line_sink_in_annulus();

  /** A point sink with Q ~ sqrt(t) in a ball of radius 0.5, exact temperature outside. */
  Problem point_sink_in_ball();

  /** What a run showed. */
  struct Outcome
  {
    double front_rms = 0;           ///< by latent heat, over all steps (m)
    double front_end = 0;           ///< front found at the end (m)
    double ice_radius_rms = 0;      ///< Error-1 of the 2005 paper's table 1
    double heat_loss_rms = 0;       ///< Error-2
    double largest_defect = 0;      ///< of the heat budget
    double steepest_retreat = 0;    ///< of the front between two steps (m)
    double lowest = 0, highest = 0; ///< temperature, over all steps
    std::vector<double> distance;   ///< of the particles from the origin (m)
    std::vector<double> position_x, weights, temperature, solid_fraction; ///< at the end
    std::vector<double> fronts; ///< after each step
    cases::HeatBudget heat;     ///< at the end
    cases::RunDescription description;
    cases::Cost cost;
  };

  /** Run a method, looking at every step. */
  Outcome run(const cases::Method &method, const Problem &problem, int n,
              const OptionTexts &options = {}, std::uint64_t seed = 1, int threads = 1);

  /** Front errors over several n, and the exponent of the spacing fitted to them. */
  struct Convergence
  {
    std::vector<double> errors;
    double order;
  };

  Convergence converge(const cases::Method &method, const Problem &problem,
                       const std::vector<int> &n, const OptionTexts &options = {});
} // namespace meltfront::particles::testing

#endif
