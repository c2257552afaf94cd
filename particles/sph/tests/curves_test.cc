// Properties that depend on temperature, and melting over a range.

#include <cases/error.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::particles::testing
{
  namespace
  {
    const auto method = make_sph();

    std::shared_ptr<const cases::PropertyCurve> line(double from, double at_from,
                                                     double to, double at_to)
    {
      return std::make_shared<cases::PropertyCurve>(
          std::vector<double>{from, to}, std::vector<double>{at_from, at_to}, "line");
    }

    /** A front s = e sqrt(t). */
    class SimilarFront : public cases::ExactSolution
    {
    public:
      explicit SimilarFront(double coefficient)
        : coefficient(coefficient)
      {
      }

      std::string description() const override
      {
        return "similar front";
      }

      cases::Symmetry symmetry() const override
      {
        return cases::Symmetry::planar;
      }

      double temperature(double, double) const override
      {
        return std::nan("");
      }

      double front(double time) const override
      {
        return coefficient * std::sqrt(time);
      }

      double heat_content(double, double, double) const override
      {
        return std::nan("");
      }

    private:
      double coefficient;
    };

    /** Liquid freezes on a wall at -1, so deep that the far wall is not felt. */
    Problem cold_wall(cases::Material material, double liquid, double front)
    {
      material.update_curves();
      Problem problem{
          slab(material, 1.6, liquid, 0.04, fixed_wall(-1), fixed_wall(liquid)),
          std::make_shared<SimilarFront>(front)};
      return problem;
    }

    /** k_s = 1 - T/2, k_l = 1 + T/2. */
    cases::Material data_a()
    {
      cases::Material material = unit_material(0);
      material.solid.conductivity_curve = line(-1, 1.5, 0, 1);
      material.liquid.conductivity_curve = line(0, 1, 0.5, 1.25);
      return material;
    }

    /** k_s = 2 (1 - T/4), k_l = 1 - 0.4 T, rho c = 1 and 2, L = 3. */
    cases::Material data_b()
    {
      cases::Material material = unit_material(0);
      material.latent_heat = 3;
      material.solid.conductivity = 2;
      material.solid.conductivity_curve = line(-1, 2.5, 0, 2);
      material.liquid.specific_heat_capacity = 2;
      material.liquid.conductivity_curve = line(0, 1, 1, 0.6);
      return material;
    }

    double temperature_at(const Outcome &outcome, double x)
    {
      std::size_t i = 0;
      while(outcome.position_x[i + 1] < x)
        ++i;
      const double share = (x - outcome.position_x[i])
                           / (outcome.position_x[i + 1] - outcome.position_x[i]);
      return outcome.temperature[i]
             + share * (outcome.temperature[i + 1] - outcome.temperature[i]);
    }

    // Coefficients of the fronts and temperatures of the similarity solution, a boundary
    // value problem in x/sqrt(t) solved to 13 digits.
    TEST(Curves, FreezingWithVariableConductivity)
    {
      const Problem a = cold_wall(data_a(), 0.5, 1.0512308810404);
      const Convergence of_a = converge(*method, a, {80, 160, 320, 640});
      EXPECT_GE(of_a.order, 1.5);
      EXPECT_LE(of_a.errors.back(), 1e-4);
      const Outcome outcome = run(*method, a, 640);
      EXPECT_LE(outcome.largest_defect, 1e-12);
      const double front = 1.0512308810404 * 0.2;
      EXPECT_NEAR(temperature_at(outcome, 0.25 * front), -0.768180888811, 1e-3);
      EXPECT_NEAR(temperature_at(outcome, 0.5 * front), -0.521716069712, 1e-3);
      EXPECT_NEAR(temperature_at(outcome, 0.75 * front), -0.263911069911, 1e-3);
      EXPECT_NEAR(temperature_at(outcome, front + 0.1), 0.198712011826, 1e-3);
      EXPECT_NEAR(temperature_at(outcome, front + 0.2), 0.328577629905, 1e-3);

      const Problem b = cold_wall(data_b(), 1, 0.8294117644344);
      const Convergence of_b = converge(*method, b, {80, 160, 320, 640});
      EXPECT_GE(of_b.order, 1.5);
      EXPECT_LE(of_b.errors.back(), 1e-4);
    }

    // Curves that are constant are the constants.
    TEST(Curves, ConstantCurvesChangeNothingButRoundOff)
    {
      cases::Material material = water();
      Problem plain{slab(material, 0.5, 10, 86400, fixed_wall(-10), fixed_wall(10)), {}};
      Problem with_curve = plain;
      cases::PhaseProperties &solid = with_curve.scene.material.solid;
      solid.conductivity_curve = line(-10, solid.conductivity, 0, solid.conductivity);
      with_curve.scene.material.update_curves();
      const Outcome first = run(*method, plain, 40),
                    second = run(*method, with_curve, 40);
      EXPECT_NEAR(first.front_end, second.front_end, 1e-9);
      for(std::size_t i = 0; i < first.temperature.size(); ++i)
        EXPECT_NEAR(first.temperature[i], second.temperature[i], 1e-7);
    }

    cases::Material with_range(double solidus, double liquidus, double at_solidus)
    {
      cases::Material material = unit_material(solidus);
      material.melting_range = std::make_shared<cases::MeltingRange>(cases::MeltingRange{
          solidus, liquidus, line(solidus, at_solidus, liquidus, 0), "linear"});
      return material;
    }

    /** All properties 1, L = 1: isotherms e1 sqrt(t) of the solidus, e2 sqrt(t) of the
     * liquidus; the fraction is linear in between, so that every zone is a + b erf. */
    struct Range
    {
      double solidus, liquidus, far, jump, e1, e2;

      double temperature(double x, double time) const
      {
        const double eta = x / std::sqrt(time);
        const double capacity = 1 + (1 - jump) / (liquidus - solidus);
        const auto in_mush
            = [capacity](double e) { return std::erf(e / 2 * std::sqrt(capacity)); };
        if(eta < e1)
          return -1 + (solidus + 1) * std::erf(eta / 2) / std::erf(e1 / 2);
        if(eta < e2)
          return solidus
                 + (liquidus - solidus) * (in_mush(eta) - in_mush(e1))
                       / (in_mush(e2) - in_mush(e1));
        return far + (liquidus - far) * std::erfc(eta / 2) / std::erfc(e2 / 2);
      }
    };

    double temperature_error(const Outcome &outcome, const Range &range)
    {
      double sum = 0;
      for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
        sum += outcome.weights[i]
               * std::pow(outcome.temperature[i]
                              - range.temperature(outcome.position_x[i], 0.04),
                          2);
      return std::sqrt(sum);
    }

    TEST(Curves, MeltingOverARange)
    {
      const Range smooth{-0.1, 0.1, 0.5, 0, 0.8303550783159416, 1.138860439728383};
      const Range jumping{0, 0.4, 0.8, 0.4, 0.802938041720104, 1.390423072992443};
      for(const Range &range : {smooth, jumping})
      {
        const Problem problem
            = cold_wall(with_range(range.solidus, range.liquidus, 1 - range.jump),
                        range.far, range.e1);
        std::vector<double> spacing, errors;
        for(const int n : {80, 160, 320, 640})
        {
          const Outcome outcome = run(*method, problem, n);
          EXPECT_LE(outcome.largest_defect, 1e-12);
          EXPECT_GE(outcome.lowest, -1 - 1e-9);
          EXPECT_LE(outcome.highest, range.far + 1e-9);
          spacing.push_back(1. / n);
          errors.push_back(temperature_error(outcome, range));
        }
        EXPECT_GE(fitted_order(spacing, errors), range.jump > 0 ? 1.3 : 1.6);
        EXPECT_LE(errors.back(), 1e-3);
      }
    }

    TEST(Curves, ImplicitStepsAgree)
    {
      for(const cases::Material &material :
          {data_a(), with_range(-0.1, 0.1, 1), with_range(-0.1, 0.1, 0.7)})
      {
        const Problem problem = cold_wall(material, 0.5, 1);
        const Outcome explicit_steps = run(*method, problem, 160);
        const Outcome implicit
            = run(*method, problem, 160,
                  {{"time_scheme", "crank-nicolson"}, {"step_factor", "8"}});
        EXPECT_LE(implicit.largest_defect, 1e-12);
        EXPECT_NEAR(implicit.front_end, explicit_steps.front_end, 2e-3);
        EXPECT_LE(implicit.cost.capped_steps, implicit.cost.steps / 20);
      }
    }

    // Both sides of a slab come to one temperature: the mean enthalpy tells which.
    TEST(Curves, WallsThatExchangeHeat)
    {
      for(const double jump : {0., 0.4})
      {
        cases::Material material = with_range(0, 0.4, 1 - jump);
        material.solid.conductivity_curve = line(-1, 3, 0.4, 1);
        material.liquid.heat_capacity_curve = line(0, 1, 2, 3);
        material.update_curves();
        Problem problem;
        cases::Boundary surroundings = fixed_wall(-1);
        surroundings.kind = cases::BoundaryKind::heat_transfer;
        surroundings.heat_transfer_coefficient = 3;
        problem.scene = slab(material, 1, 1, 6, surroundings, cases::Boundary());
        const Outcome outcome = run(*method, problem, 40);
        EXPECT_LE(outcome.largest_defect, 1e-12);
        EXPECT_NEAR(outcome.heat.boundary,
                    material.curves->at_temperature(-1).enthalpy
                        - material.curves->at_temperature(1).enthalpy,
                    2e-2);
        EXPECT_GE(outcome.lowest, -1);
        EXPECT_LE(outcome.highest, 1 + 1e-12);
      }
    }

    TEST(Curves, OtherRulesAtFrontsAreRefused)
    {
      const Problem problem = cold_wall(data_a(), 0.5, 1);
      for(const char *rule : {"partner", "liquid"})
        EXPECT_THROW(run(*method, problem, 40, {{"front", rule}}), cases::Refusal);
      EXPECT_THROW(run(*make_sph_2005(), problem, 41), cases::Refusal);
    }
  } // namespace
} // namespace meltfront::particles::testing
