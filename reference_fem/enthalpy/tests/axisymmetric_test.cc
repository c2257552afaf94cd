#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    constexpr double pi = std::numbers::pi;

    Material two_phases()
    {
      Material material;
      material.solid.conductivity = 2;
      material.liquid.specific_heat_capacity = 2;
      return material;
    }

    /** A cylinder of height 1/2 and radius 1 about its axis. */
    Scene cylinder(const Material &material, double temperature, double end)
    {
      Scene scene = box(material, 2, {0, 0, 0}, {1, 0.5, 0}, temperature, end);
      scene.domain.shape = DomainShape::axisymmetric;
      return scene;
    }

    /** Of the shares of the disk and of the cylinder that are solid, at one spacing. */
    double difference_from_disk(int n)
    {
      Scene turned = cylinder(two_phases(), 0.5, 0.1);
      set_boundary(turned, Side::x_max, fixed_wall(-1));
      Scene round = ball(two_phases(), 2, 1, 0.5, 0.1);
      round.symmetry = Symmetry::cylindrical;
      set_boundary(round, Side::outer, fixed_wall(-1));
      const OptionTexts steps{{"steps", "200"}};
      const RunRecord of_body = run(turned, n, steps), of_disk = run(round, 2 * n, steps);
      EXPECT_LE(of_body.worst_budget_defect(), 1e-12);
      EXPECT_TRUE(of_body.obeys_maximum_principle);
      EXPECT_NEAR(of_body.volume.back(), pi / 2, 1e-12);
      EXPECT_NEAR(of_disk.volume.back(), pi, 1e-12);
      double across = 0;
      for(std::size_t i = 0; i < of_body.temperature.size(); ++i)
        for(std::size_t j = 0; j < of_body.temperature.size(); ++j)
          if(of_body.positions[0][i] == of_body.positions[0][j])
            across = std::max(across,
                              std::abs(of_body.temperature[i] - of_body.temperature[j]));
      EXPECT_LT(across, 1e-9);
      return std::abs(2 * of_body.solid.back() - of_disk.solid.back()) / pi;
    }

    TEST(Axisymmetric, ACylinderThatFreezesIsADisk)
    {
      EXPECT_LT(difference_from_disk(10), 1e-12);
      EXPECT_LT(difference_from_disk(40), 1e-12);
    }

    /** The wall that lets heat in by a law melts a hollow cylinder as it does an annulus.
     */
    double difference_from_annulus(const Boundary &outer)
    {
      Scene turned = cylinder(two_phases(), -0.3, 0.1);
      turned.domain.lower[0] = 0.5;
      set_boundary(turned, Side::x_max, outer);
      Scene round = ball(two_phases(), 2, 1, -0.3, 0.1);
      round.domain.shape = DomainShape::shell;
      round.domain.inner_radius = 0.5;
      round.symmetry = Symmetry::cylindrical;
      set_boundary(round, Side::inner, Boundary());
      set_boundary(round, Side::outer, outer);
      const OptionTexts steps{{"steps", "200"}};
      const RunRecord of_body = run(turned, 12, steps), of_shell = run(round, 48, steps);
      EXPECT_LT(of_body.solid.back(), 0.95 * of_body.volume.back());
      return std::abs(2 * of_body.solid.back() - of_shell.solid.back());
    }

    TEST(Axisymmetric, AHollowCylinderThatMeltsIsAnAnnulus)
    {
      EXPECT_LT(difference_from_annulus(flux_wall(4)), 1e-12);
      Boundary surrounded;
      surrounded.kind = BoundaryKind::heat_transfer;
      surrounded.value = Field::uniform(2);
      surrounded.heat_transfer_coefficient = 3;
      EXPECT_LT(difference_from_annulus(surrounded), 1e-12);
    }

    /** 1 + J_0(k r) cos(2 pi z), no slope at any wall. */
    TEST(Axisymmetric, AWaveIsOfSecondOrder)
    {
      constexpr double k = 3.83170597020751232, q = 2 * pi, end = 0.02;
      Material material;
      material.latent_heat = 0;
      const auto profile = [](const Position &p)
      { return std::cyl_bessel_j(0., k * p[0]) * std::cos(q * p[1]); };
      const std::vector<int> cells{8, 16, 32, 64};
      std::vector<double> errors;
      for(const int n : cells)
      {
        Scene scene = cylinder(material, 0, end);
        scene.initial.temperature
            = field_of([profile](const Position &p) { return 1 + profile(p); });
        const RunRecord record = run(scene, n, {{"steps", std::to_string(4 * n)}});
        EXPECT_LE(record.worst_budget_defect(), 1e-12);
        const double decay = std::exp(-(k * k + q * q) * end);
        double largest = 0;
        for(std::size_t i = 0; i < record.temperature.size(); ++i)
          largest = std::max(largest, std::abs(record.temperature[i] - 1
                                               - decay * profile(record.place(i))));
        errors.push_back(largest);
      }
      EXPECT_GT(fitted_order(cells, errors), 1.8);
    }

    /** What walls let in is by their areas. */
    TEST(Axisymmetric, WallsHaveTheAreasOfTheBody)
    {
      Material material;
      material.latent_heat = 0;
      Scene scene = cylinder(material, 0, 0.1);
      set_boundary(scene, Side::x_max, flux_wall(1));
      EXPECT_NEAR(run(scene, 12).heat.boundary, 0.1 * 2 * pi * 0.5, 1e-13);
      scene = cylinder(material, 0, 0.1);
      set_boundary(scene, Side::y_min, flux_wall(1));
      EXPECT_NEAR(run(scene, 12).heat.boundary, 0.1 * pi, 1e-13);
      scene.domain.lower[0] = 0.5;
      EXPECT_NEAR(run(scene, 12).heat.boundary, 0.1 * pi * 0.75, 1e-13);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
