#ifndef meltfront_particles_sph_two_population_tests_curved_scenes_h
#define meltfront_particles_sph_two_population_tests_curved_scenes_h

#include <particles/alloy/tests/alloy_scenes.h>

#include <limits>
#include <utility>
#include <vector>

/** Scenes with a liquidus that is curved, or given as a curve. */
namespace meltfront::particles::testing
{
  inline constexpr double no_eutectic = -std::numeric_limits<double>::infinity();

  /** Depression (K) by a mass fraction. */
  inline double bent(double c)
  {
    return 37 * c * (1 + 0.64 * c);
  }

  /** Brine whose liquidus is bent, known up to 0.6. */
  inline cases::Scene bent_slab(double end_time, double eutectic = no_eutectic,
                                double diffusivity = 0)
  {
    cases::Scene scene = nitrate_slab(end_time, diffusivity);
    cases::Solute &salt = scene.alloy->solutes[0];
    salt.liquidus_slope = 0;
    salt.liquidus_curve = bent;
    salt.largest_concentration = 0.6;
    scene.alloy->eutectic_temperature = eutectic;
    return scene;
  }

  /** Brine whose straight liquidus is given by a table. */
  inline cases::Scene with_table(cases::Scene scene)
  {
    std::vector<std::pair<double, double>> points;
    for(int i = 0; i <= 10; ++i)
      points.push_back({0.1 * i, -nitrate_slope * 0.1 * i});
    cases::Solute &salt = scene.alloy->solutes[0];
    salt.liquidus_slope = 0;
    salt.liquidus_curve = cases::liquidus_through(points, 0);
    salt.largest_concentration = 1;
    return scene;
  }
} // namespace meltfront::particles::testing

#endif
