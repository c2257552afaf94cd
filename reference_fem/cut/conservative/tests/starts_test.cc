#include <cases/error.h>
#include <cases/exact/planar_neumann.h>
#include <cases/overshoot.h>
#include <cases/tests/support/scenes.h>
#include <reference_fem/cut/conservative/appearance.h>
#include <reference_fem/cut/conservative/step_frame.h>
#include <reference_fem/cut/options.h>
#include <reference_fem/cut/tests/cut_support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    constexpr double round_off = 1e-11;

    constexpr double reach_of_layers = 0.6;

    Material material_of_starts()
    {
      Material material = normalised_material();
      material.melting_temperature = 0;
      return material;
    }

    void hold(Scene &scene, Side side, double temperature)
    {
      set_boundary(scene, side,
                   {.kind = BoundaryKind::fixed_temperature,
                    .value = Field::uniform(temperature)});
    }

    Course run_from_one_phase(const Scene &scene, int n)
    {
      return run_cut(scene, n, {{"scheme", "conservative"}});
    }

    TEST(EnthalpyStart, AColdWallOfABoxFreezesAsNeumannSays)
    {
      const auto exact = std::make_shared<PlanarNeumann>(material_of_starts(), -1, 0.3);
      Scene scene = box(material_of_starts(), 2, {0, 0, 0}, {1, 0.4, 0}, 0.3, 0.05);
      hold(scene, Side::x_min, -1);
      set_boundary(scene, Side::x_max, exact_wall(exact));
      std::vector<double> errors;
      const std::vector<int> n{40, 48, 56, 80};
      for(const int cells : n)
      {
        const Course course = run_from_one_phase(scene, cells);
        EXPECT_LE(course.worst_budget_defect(), round_off);
        errors.push_back(
            std::abs(course.solid.back() / 0.4 - exact->front(scene.end_time)));
      }
      // What is left is the enthalpy method's, which goes before.
      EXPECT_LE(errors.front(), 1e-4);
      EXPECT_GE(fitted_order(n, errors), 1);
    }

    TEST(EnthalpyStart, BodiesThatTouchMeltOrFreezeAsTheyDoWithoutEnd)
    {
      constexpr double end = 0.006, at = 0.417, height = 0.25;
      for(const auto &[solid, liquid] : {std::pair(-0.9, 0.3), std::pair(-0.2, 0.8)})
      {
        const double way
            = 2 * test_support::speed_of_contact(solid, liquid) * std::sqrt(end);
        for(const int n : {28, 40, 56})
        {
          const Course course = run_from_one_phase(
              test_support::bodies_in_contact(at, height, solid, liquid, end), n);
          EXPECT_LE(course.worst_budget_defect(), round_off);
          // Measured: 1.1 % at n = 28, falling faster than that.
          EXPECT_NEAR(course.solid.back() / height, at + way,
                      0.015 * std::pow(28. / n, 2) * std::abs(way))
              << n;
        }
      }
    }

    /** The corner of Rathjen and Jiji (1971), of which the similar problem is solved by
     * collocation. */
    TEST(EnthalpyStart, ACornerOfHeldWallsFreezesAsTheSimilarProblemSays)
    {
      constexpr double solid_at_end = 0.267720;
      Material material = material_of_starts();
      material.latent_heat = 0.25;
      Scene scene = box(material, 2, {0, 0, 0}, {1, 1, 0}, 0.3, 0.01);
      hold(scene, Side::x_min, -1);
      hold(scene, Side::y_min, -1);
      for(const int n : {28, 32, 36})
      {
        const Course course = run_from_one_phase(scene, n);
        EXPECT_LE(course.worst_budget_defect(), round_off) << n;
        EXPECT_NEAR(course.solid.back(), solid_at_end, 1e-3 * solid_at_end) << n;
      }
    }

    TEST(EnthalpyStart, ABlockMeltsFromAllSidesUntilNothingIsLeft)
    {
      Scene scene
          = box(material_of_starts(), 2, {-0.5, -0.5, 0}, {0.5, 0.5, 0}, -0.5, 0.2);
      for(const Side side : scene.sides())
        hold(scene, side, 1);
      const Course course = run_from_one_phase(scene, 20);
      EXPECT_LE(course.worst_budget_defect(), round_off);
      EXPECT_EQ(course.solid.back(), 0);
    }

    TEST(EnthalpyStart, NothingThatFreezesIsRefused)
    {
      Scene scene = box(material_of_starts(), 2, {0, 0, 0}, {1, 1, 0}, 0.3, 0.01);
      set_boundary(scene, Side::x_min,
                   {.kind = BoundaryKind::flux, .value = Field::uniform(-0.1)});
      EXPECT_THROW(run_from_one_phase(scene, 12), Refusal);
    }

    TEST(EnthalpyStart, SaysThatALayerBesideTheFrontIsThinnerThanACell)
    {
      Material material = material_of_starts();
      material.liquid.conductivity = 0.0033;
      Scene scene = ball(material, 2, 2, 0.5, 0.5);
      scene.domain.shape = DomainShape::shell;
      scene.domain.inner_radius = 1;
      set_boundary(scene, Side::inner,
                   {.kind = BoundaryKind::heat_transfer,
                    .value = Field::uniform(-2),
                    .heat_transfer_coefficient = 5});
      try
      {
        run_from_one_phase(scene, 40);
        FAIL() << "ran";
      }
      catch(const Refusal &refusal)
      {
        const std::string reason = refusal.what();
        EXPECT_NE(reason.find("temperatures of the liquid change within"),
                  std::string::npos)
            << reason;
      }
    }

    TEST(EnthalpyStart, AColdRimIsFollowedFromWhereItsLayerIsResolved)
    {
      // Where the first layer is no thicker than the rim's cells the front lies along the
      // rim and mostly beyond it.
      Scene scene = ball(material_of_starts(), 2, 1.3, 0, 0.15);
      scene.domain.shape = DomainShape::shell;
      scene.domain.inner_radius = 0.4;
      hold(scene, Side::inner, -1.2);
      const Course course = run_from_one_phase(scene, 24);
      EXPECT_LE(course.worst_budget_defect(), round_off);
      EXPECT_TRUE(grows(course));
    }

    /** A pipe of liquid at its melting temperature that freezes from both walls. */
    Scene freezing_pipe(double end)
    {
      Material material = material_of_starts();
      material.latent_heat = 1.2;
      material.solid.conductivity = 2;
      material.solid.specific_heat_capacity = 0.9;
      Scene scene = ball(material, 2, 1.3, 0, end);
      scene.domain.shape = DomainShape::shell;
      scene.domain.inner_radius = 0.4;
      hold(scene, Side::inner, -1.2);
      set_boundary(scene, Side::outer,
                   {.kind = BoundaryKind::flux, .value = Field::uniform(-0.4)});
      return scene;
    }

    TEST(EnthalpyStart, TemperaturesKeepTheirBoundsAtTheHandingOver)
    {
      constexpr int n = 56;
      const Scene scene = freezing_pipe(0.0156);
      const Course course
          = run_cut(scene, n, {{"scheme", "conservative"}, {"fewest_steps", "4"}});
      const double allowed
          = allowed_overshoot(cut::overshoot, 2.6 / n, scene.domain) * 1.2;
      EXPECT_LE(std::ranges::max(course.highest), allowed);
      EXPECT_LE(course.worst_budget_defect(), round_off);
    }

    cut::conservative::AppearanceSetting
    setting(const Scene &scene, const cut::conservative::TriangleMesh &mesh)
    {
      return {mesh, scene, reach_of_layers};
    }

    TEST(Appearance, AThinLayerAppearsWhereMoreIsBeyondMeltingThanTolerated)
    {
      using namespace cut::conservative;
      constexpr double latent_heat = 2;
      Scene scene = box(material_of_starts(), 2, {0, 0, 0}, {3, 1, 0}, 0, 1);
      scene.material.latent_heat = latent_heat;
      const TriangleMesh mesh(scene.domain, 30);
      using cut::Values;
      const Values nothing(mesh.nodes.size());
      FrontState state{
          Values(mesh.nodes.size(), reach_of_layers), {nothing, nothing}, nothing};
      // A hundredth of a spacing of ice, in the row at y = 0.
      for(std::size_t node = 0; node < mesh.nodes.size(); ++node)
        if(mesh.nodes[node][1] < 0.05)
          state.heat[1][node] = -latent_heat * 0.1 * 0.001;
      const double excess
          = largest_excess(setting(scene, mesh), {1, 1}, state.level_set, state.heat);
      // Of the hat in a corner, a sixth of a square.
      EXPECT_NEAR(excess, latent_heat * 0.1 * 0.001 / (0.01 / 6), 1e-12);
      const auto appear = [&](double tolerated)
      {
        FrontState copy = state;
        return let_phases_appear(setting(scene, mesh), {tolerated, tolerated}, copy)
            .size();
      };
      EXPECT_EQ(appear(3 * excess), 0u);
      EXPECT_EQ(appear(excess), 1u);
    }

    TEST(Appearance, ALayerTakesThePlaceOfMissingHeat)
    {
      using namespace cut::conservative;
      constexpr int n = 10;
      constexpr double latent_heat = 2;
      Scene scene = box(material_of_starts(), 2, {0, 0, 0}, {1, 1, 0}, 0, 1);
      scene.material.latent_heat = latent_heat;
      const TriangleMesh mesh(scene.domain, n);
      using cut::Values;
      const Values nothing(mesh.nodes.size());
      FrontState state{
          Values(mesh.nodes.size(), reach_of_layers), {nothing, nothing}, nothing};
      // A third of a spacing of ice, by heat, in the two rows at y = 0.
      for(std::size_t node = 0; node < mesh.nodes.size(); ++node)
        if(const double y = mesh.nodes[node][1]; y < 0.15)
          state.heat[1][node] = -latent_heat * 0.1 * (y < 0.05 ? 0.02 : 0.013);
      const double before = sum(state.heat[1]);
      const auto appeared = let_phases_appear(setting(scene, mesh), {1, 1}, state);
      ASSERT_EQ(appeared.size(), 1u);
      const Front front(mesh, state.level_set);
      // As thick as the heat says but for a twentieth of a cell, which is debt.
      EXPECT_NEAR(front.area(cut::Phase::solid), -before / latent_heat, 0.05 / n);
      // Heat over latent heat of solid: nothing is lost.
      EXPECT_NEAR(sum(state.heat[0]) + sum(state.heat[1])
                      - latent_heat * (front.area(cut::Phase::solid) + sum(state.debt)),
                  before, 1e-13);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
