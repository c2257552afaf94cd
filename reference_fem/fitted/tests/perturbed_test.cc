#include <cases/error.h>
#include <reference_fem/fitted/tests/support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::fitted::tests
{
  namespace
  {
    using namespace reference_fem::tests;
    using cases::Side;

    TEST(FemFitted, PerturbedAnnulusConvergesToItself)
    {
      // Differences of successive levels of degree 2: of the order of the radial case.
      // The steps are the same on all levels.
      const OptionTexts options{{"degree", "2"}, {"steps", "50"}};
      const cases::Scene scene = perturbed_annulus(0.03);
      std::vector<double> volumes;
      for(const int n : {8, 16, 32})
      {
        const Record record = run(scene, n, options);
        EXPECT_LT(record.worst_budget_defect(), 1e-12) << n;
        volumes.push_back(record.solid.back());
      }
      const double first = std::abs(volumes[1] - volumes[0]);
      const double second = std::abs(volumes[2] - volumes[1]);
      EXPECT_GT(std::log2(first / second), 3.5);
    }

    TEST(FemFitted, WavyFrontsInBoxesKeepTheirHeat)
    {
      const OptionTexts options{{"degree", "2"}, {"steps", "10"}};
      for(const int dimension : {2, 3})
      {
        const Record record
            = run(wavy_box(dimension, 0.02), dimension == 2 ? 8 : 4, options);
        EXPECT_LT(record.worst_budget_defect(), 1e-12) << dimension;
        // Heat flows to the trough of the wave: it flattens.
        const auto &x = record.front_points[0];
        const auto [low, high] = std::minmax_element(x.begin(), x.end());
        EXPECT_LT(*high - *low, 0.9 * 0.0192 * (dimension - 1)) << dimension;
      }
    }

    TEST(FemFitted, RefusesWhatRaysCannotFollow)
    {
      cases::Scene walls = wavy_box(2, 0.1);
      set_boundary(walls, Side::y_min, fixed_wall(1));
      EXPECT_THROW(run(walls, 8), cases::Refusal);

      ExactScene aside = line_sink_disk();
      aside.scene.sources[0].position = {0.1, 0, 0};
      EXPECT_THROW(run(aside.scene, 8), cases::Refusal);

      EXPECT_THROW(run(perturbed_annulus(0.1), 8, {{"dimension", "1"}}), cases::Refusal);
    }

    TEST(FemFitted, RefusesFrontsThatARayCrossesTwice)
    {
      cases::Scene scene = wavy_box(2, 0.1);
      scene.initial.front = cases::Field{"two",
                                         [](const cases::Position &p, double)
                                         { return (p[0] - 0.3) * (p[0] - 0.7); },
                                         false};
      EXPECT_THROW(run(scene, 8), cases::Refusal);
    }
  } // namespace
} // namespace meltfront::reference_fem::fitted::tests
