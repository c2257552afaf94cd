#ifndef meltfront_particles_alloy_tests_alloy_scenes_h
#define meltfront_particles_alloy_tests_alloy_scenes_h

#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <particles/alloy/tests/mushy_similarity.h>
#include <particles/sph_mixture/sph_mixture.h>
#include <particles/sph_two_population/sph_two_population.h>

#include <vector>

/** Scenes and observers that the tests of alloys share. */
namespace meltfront::particles::testing
{
  using namespace test_support;

  /** Aqueous sodium nitrate as in section 5 of Monaghan et al. (2005), temperatures in
   * degrees Celsius. */
  cases::Material nitrate_solvent();
  cases::Alloy nitrate();

  inline constexpr double nitrate_concentration = 0.14;
  inline constexpr double nitrate_slope = 42.28;
  inline constexpr double nitrate_density = 1097;

  /** The similarity solution of nitrate_slab() without diffusion. */
  MushyLayer nitrate_layer();

  /** Half a metre of it on a wall at -16.5, from 14.7, to the end time; the far wall has
   * the temperature of the similarity solution. */
  cases::Scene nitrate_slab(double end_time, double diffusivity = 0);

  /** What a run showed. */
  struct AlloyOutcome
  {
    std::vector<double> x, weights, temperature, solid_fraction; ///< at the end
    std::vector<std::vector<double>> concentration;
    double heat_defect = 0, mass_defect = 0, solute_defect = 0; ///< the largest of all
    double lowest = 0, highest = 0; ///< temperature, over all snapshots
    double solid = 0;               ///< sum of weights times solid fraction at the end
    cases::HeatBudget heat;         ///< at the end
    cases::RunDescription description;
    cases::Cost cost;
    std::vector<double> times, solids; ///< of all snapshots
    std::vector<double> entropies;     ///< of heat and the change of phase
    std::vector<double> mixing_entropies;
  };

  /** Run a method, looking at every `every`-th step. */
  AlloyOutcome run(const cases::Method &method, const cases::Scene &scene, int n,
                   const OptionTexts &options = {}, long every = 100, int threads = 1);

  /** Errors against the similarity solution at the end of a run. */
  struct MushErrors
  {
    double temperature, theta; ///< root mean square over the rows (K, 1)
    double largest;            ///< of the temperature (K)
    double ice;                ///< relative, of the solid's mass
  };

  MushErrors compare(const AlloyOutcome &outcome, const MushyLayer &layer, double time);
} // namespace meltfront::particles::testing

#endif
