#include <reference_fem/enthalpy/tests/support.h>

#include <cases/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    /** k0 (1 + slope (T - T_m)) between T_m = 0 and another temperature. */
    std::shared_ptr<const PropertyCurve> straight(double k0, double slope, double end)
    {
      std::vector<double> at{std::min(0., end), std::max(0., end)}, values;
      for(const double temperature : at)
        values.push_back(k0 * (1 + slope * temperature));
      return std::make_shared<const PropertyCurve>(at, values, "straight");
    }

    /** A half space that freezes, k0 (1 + b (T - T_m)) in each phase, from t = 0. */
    struct Freezing
    {
      double solid_conductivity, solid_slope, liquid_conductivity, liquid_slope;
      double liquid_capacity, latent_heat, cold, warm;
      double constant; ///< of the front, s/sqrt(t)

      Material material() const
      {
        Material result;
        result.latent_heat = latent_heat;
        result.solid.conductivity = solid_conductivity;
        result.solid.conductivity_curve = straight(solid_conductivity, solid_slope, cold);
        result.liquid.conductivity = liquid_conductivity;
        result.liquid.conductivity_curve
            = straight(liquid_conductivity, liquid_slope, warm);
        result.liquid.specific_heat_capacity = liquid_capacity;
        result.update_curves();
        return result;
      }

      Scene scene() const
      {
        return slab(material(), 8, warm, 1, fixed_wall(cold), fixed_wall(warm));
      }
    };

    constexpr Freezing data_a{1, -0.5, 1, 0.5, 1, 1, -1, 0.5, 1.0512308810404};
    constexpr Freezing data_b{2, -0.25, 1, -0.4, 2, 3, -1, 1, 0.8294117644344};

    double temperature_at(const RunRecord &record, double x)
    {
      const std::vector<double> &places = record.positions[0];
      for(std::size_t i = 0; i + 1 < places.size(); ++i)
        if(places[i + 1] >= x)
        {
          const double share = (x - places[i]) / (places[i + 1] - places[i]);
          return (1 - share) * record.temperature[i] + share * record.temperature[i + 1];
        }
      return record.temperature.back();
    }

    double front_error(const Freezing &data, int n)
    {
      const RunRecord record = run(data.scene(), n);
      EXPECT_LE(record.worst_budget_defect(), 1e-12);
      EXPECT_EQ(record.cost.capped_steps, 0);
      double largest = 0;
      for(std::size_t i = 0; i < record.time.size(); ++i)
        if(record.time[i] > 0.5)
          largest
              = std::max(largest, std::abs(record.solid[i]
                                           - data.constant * std::sqrt(record.time[i])));
      return largest / data.constant;
    }

    TEST(VariableConductivity, FrontsConvergeToTheSimilaritySolution)
    {
      const std::vector<int> cells{128, 256, 512, 1024};
      for(const Freezing &data : {data_a, data_b})
      {
        std::vector<double> errors;
        for(const int n : cells)
          errors.push_back(front_error(data, n));
        EXPECT_LT(errors.back(), 1e-3);
        EXPECT_GT(fitted_order(cells, errors), 1.2);
      }
    }

    TEST(VariableConductivity, TemperaturesAreThoseOfTheSimilaritySolution)
    {
      const RunRecord record = run(data_a.scene(), 1024);
      const double e = data_a.constant;
      EXPECT_NEAR(temperature_at(record, e / 4), -0.768180888811, 5e-4);
      EXPECT_NEAR(temperature_at(record, e / 2), -0.521716069712, 5e-4);
      EXPECT_NEAR(temperature_at(record, 3 * e / 4), -0.263911069911, 5e-4);
      EXPECT_NEAR(temperature_at(record, e + 0.5), 0.198712011826, 5e-4);
      EXPECT_NEAR(temperature_at(record, e + 2), 0.454857543780, 5e-4);
    }

    /** Curves that do not vary are no curves. */
    TEST(VariableConductivity, ConstantCurvesRepeatConstantProperties)
    {
      Freezing data = data_b;
      data.solid_slope = data.liquid_slope = 0;
      const Scene curved = data.scene();
      Scene plain = curved;
      for(PhaseProperties *phase : {&plain.material.solid, &plain.material.liquid})
        phase->conductivity_curve.reset();
      plain.material.update_curves();
      const RunRecord of_curves = run(curved, 100), of_numbers = run(plain, 100);
      for(std::size_t i = 0; i < of_numbers.temperature.size(); ++i)
        EXPECT_NEAR(of_curves.temperature[i], of_numbers.temperature[i], 1e-9);
      EXPECT_NEAR(of_curves.solid.back(), of_numbers.solid.back(), 1e-9);
    }

    /** u obeys a linear equation where c(T)/k(T) is constant: an exact wave of u, that
     * is of T = sqrt(1 + 2 u) - 1 for k = c = 1 + T. */
    TEST(VariableHeatCapacity, AWaveOfKirchhoffsVariableIsOfSecondOrder)
    {
      constexpr double pi = std::numbers::pi;
      Material material;
      material.latent_heat = 0;
      material.melting_temperature = -10;
      const auto curve = std::make_shared<const PropertyCurve>(
          std::vector<double>{-0.5, 2}, std::vector<double>{0.5, 3}, "1 + T");
      for(PhaseProperties *phase : {&material.solid, &material.liquid})
        phase->conductivity_curve = phase->heat_capacity_curve = curve;
      material.update_curves();
      const auto exact = [](double x, double t)
      { return std::sqrt(1 + 2 * std::sin(pi * x) * std::exp(-pi * pi * t)) - 1; };
      const std::vector<int> cells{10, 20, 40, 80};
      std::vector<double> errors;
      for(const int n : cells)
      {
        Scene scene = slab(material, 1, 0, 0.1, fixed_wall(0), fixed_wall(0));
        scene.initial.temperature
            = field_of([exact](const Position &p) { return exact(p[0], 0); });
        const RunRecord record = run(scene, n, {{"steps", std::to_string(8 * n)}});
        EXPECT_LE(record.worst_budget_defect(), 1e-12);
        double largest = 0;
        for(std::size_t i = 0; i < record.temperature.size(); ++i)
          largest = std::max(largest, std::abs(record.temperature[i]
                                               - exact(record.positions[0][i], 0.1)));
        errors.push_back(largest);
      }
      EXPECT_LT(errors.back(), 1e-4);
      EXPECT_GT(fitted_order(cells, errors), 1.8);
    }

    /** The solid fraction falls linearly between solidus and liquidus; closed form. */
    struct Melting
    {
      double conductivity[3], capacity[3]; ///< solid, between, liquid
      double latent_heat, cold, solidus, liquidus, warm;
      double at_solidus, at_liquidus; ///< isotherms, x/sqrt(t)

      double diffusivity(int zone) const
      {
        const double spread = zone == 1 ? latent_heat / (liquidus - solidus) : 0;
        return conductivity[zone] / (capacity[zone] + spread);
      }

      double operator()(double x, double t) const
      {
        const double e = x / std::sqrt(t);
        const auto part = [this](int zone, double eta)
        { return eta / (2 * std::sqrt(diffusivity(zone))); };
        if(e < at_solidus)
          return cold
                 + (solidus - cold) * std::erf(part(0, e))
                       / std::erf(part(0, at_solidus));
        if(e < at_liquidus)
          return solidus
                 + (liquidus - solidus)
                       * (std::erf(part(1, e)) - std::erf(part(1, at_solidus)))
                       / (std::erf(part(1, at_liquidus)) - std::erf(part(1, at_solidus)));
        return warm
               - (warm - liquidus) * std::erfc(part(2, e))
                     / std::erfc(part(2, at_liquidus));
      }

      Scene scene() const
      {
        Material material;
        material.latent_heat = latent_heat;
        material.melting_temperature = solidus;
        material.solid = {conductivity[0], capacity[0], 1};
        material.liquid = {conductivity[2], capacity[2], 1};
        material.melting_range = std::make_shared<const MeltingRange>(MeltingRange{
            solidus, liquidus,
            std::make_shared<const PropertyCurve>(std::vector<double>{solidus, liquidus},
                                                  std::vector<double>{1, 0}, "linear"),
            "linear"});
        material.update_curves();
        return slab(material, 8, warm, 1, fixed_wall(cold), fixed_wall(warm));
      }
    };

    TEST(MeltingRange, TemperaturesConvergeToTheClosedForm)
    {
      const Melting data{{1, 1, 1},          {1, 1, 1},        1, -1, -0.1, 0.1, 0.5,
                         0.8303550783159416, 1.138860439728383};
      const std::vector<int> cells{128, 256, 512, 1024};
      std::vector<double> errors;
      for(const int n : cells)
      {
        const RunRecord record = run(data.scene(), n);
        EXPECT_LE(record.worst_budget_defect(), 1e-12);
        EXPECT_EQ(record.cost.capped_steps, 0);
        double sum = 0;
        for(std::size_t i = 0; i < record.temperature.size(); ++i)
          sum += record.weights[i]
                 * std::pow(record.temperature[i] - data(record.positions[0][i], 1), 2);
        errors.push_back(std::sqrt(sum / 8));
      }
      EXPECT_LT(errors.back(), 5e-4);
      EXPECT_GT(fitted_order(cells, errors), 1.2);
    }

    /** Ever narrower ranges tend to the sharp melting temperature. */
    TEST(MeltingRange, ANarrowOneIsASharpTemperature)
    {
      constexpr double sharp = 0.9397019994142970;
      double last = 1;
      for(const double half : {0.1, 0.01, 0.001})
      {
        Melting data{{1, 1, 1}, {1, 1, 1}, 1, -1, -half, half, 0.5, 0, 0};
        const RunRecord record = run(data.scene(), 512);
        EXPECT_LE(record.worst_budget_defect(), 1e-12);
        const double off = std::abs(record.solid.back() - sharp);
        EXPECT_LT(off, last);
        last = off;
      }
      EXPECT_LT(last, 2e-3);
    }

    TEST(MeltingRange, IsRefusedOfAlloys)
    {
      Scene scene = data_a.scene();
      Solute solute;
      solute.name = "salt";
      solute.liquidus_slope = 1;
      scene.alloy = Alloy{.solutes = {solute}};
      scene.initial.concentration = {Field::uniform(0.1)};
      EXPECT_THROW(run(scene, 20), Refusal);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
