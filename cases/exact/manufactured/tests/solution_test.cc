// Temperature, source and the conditions on the front.

#include <cases/error.h>
#include <cases/exact/manufactured/tests/fifty_digits.h>
#include <cases/exact/tests/materials.h>

#include <gtest/gtest.h>

namespace meltfront::cases::manufactured
{
  namespace
  {
    struct Value
    {
      Position place;
      double level_set, temperature, source;
    };
    struct Row
    {
      const char *name;
      int dimension;
      std::array<Value, 2> values;
    };

    /** Computed with fifty digits: time 0.3 periods; all one but the liquid's k = 0.1 and
     * rho c = 2. */
    const std::vector<Row> table{
        {"plane",
         2,
         {{{{0.3, 0, 0}, -0.39021130325903071, -0.53828729309866085, 1.4298372014156591},
           {{0.9, 0, 0}, 0.20978869674096929, 3.5362360782193849, 30.090512857361533}}}},
        {"disk",
         2,
         {{{{0.21, 0.13, 0},
            -0.35200991863099119,
            -0.49259549478608948,
            -4.4588181389426315},
           {{0.7, 0.55, 0},
            0.37949008136900881,
            5.8499039550592903,
            11.713322392399916}}}},
        {"disk",
         3,
         {{{{0.21, 0.13, 0.11},
            -0.33990991863099119,
            -0.47566300177540269,
            -7.2787125134123821},
           {{0.7, 0.55, 0.3},
            0.46949008136900881,
            7.2104582685986749,
            9.0116470983621319}}}},
        {"star-3",
         2,
         {{{{0.21, 0.13, 0},
            -0.27985733898186402,
            -0.42429511470433254,
            -6.4128332683306001},
           {{0.7, 0.55, 0},
            0.50595951437792259,
            7.2835772676928109,
            -41.182934528963479}}}},
        {"star-5",
         2,
         {{{{0.21, 0.13, 0},
            -0.29558959680094517,
            -0.41828292657316736,
            -4.2456002209104579},
           {{0.7, 0.55, 0},
            0.41097146518063693,
            6.2142586811669859,
            23.507289368297856}}}},
        {"ellipse",
         2,
         {{{{0.21, 0.13, 0},
            -0.019008614852240188,
            -0.035684370641464822,
            -15.40262102641575},
           {{0.7, 0.55, 0},
            1.3074320343405437,
            18.622113408019352,
            -90.364323198940197}}}},
        {"ellipse",
         3,
         {{{{0.21, 0.13, 0.11},
            0.0049224005348093752,
            0.063836235875825912,
            -34.701974649980365},
           {{0.7, 0.55, 0.3},
            1.4854313223433917,
            21.259478486715956,
            -98.23206657358076}}}},
        {"two-disks",
         2,
         {{{{0.45, 0.13, 0},
            -0.091171561074217107,
            -0.14537058232016111,
            -11.66341024691743},
           {{0.1, 0.5, 0},
            0.37335571892578289,
            5.5653510807591661,
            -18.227863549930237}}}},
        {"two-disks",
         3,
         {{{{0.45, 0.13, 0.11},
            -0.068159781074217107,
            -0.10778197229784886,
            -17.989955021275967},
           {{0.1, 0.5, 0.2},
            0.45815571892578289,
            6.8396672892547742,
            -26.593399662566938}}}},
        {"finger",
         2,
         {{{{-0.3, 0.1, 0},
            -0.11429179606750063,
            -0.17008871360878181,
            1.6871876732591663},
           {{0.3, 0.5, 0},
            0.45570820393249937,
            6.8516944916049326,
            -5.0837385127386958}}}},
        {"finger",
         3,
         {{{{-0.3, 0.1, 0.07},
            -0.10449179606750063,
            -0.15553154465949857,
            -4.256684795044622},
           {{0.3, 0.5, 0.2},
            0.53570820393249937,
            8.0518427031090135,
            -11.074706049235698}}}}};

    /** The largest relative difference of flux, temperature and source from fifty digits
     * at random places. */
    template <typename Formula, int dim>
    std::array<double, 3> worst_difference(const char *name, const Formula &formula,
                                           const Material &material, int places)
    {
      const double g = 1.5, d = 0.8, step = 1e-12;
      const auto family = make_front_family({name, dim, period, length_scale, 3});
      const ManufacturedSolution solution(material, family, g, d);
      const Differences<Formula, dim> oracle(formula);
      RandomPlace random(*family);
      std::array<double, 3> worst{};
      const auto note = [&](int which, double value, const Real &exact)
      {
        const double difference = static_cast<double>(abs(value - exact));
        worst[which] = std::max(worst[which], difference / (1 + std::abs(value)));
      };
      for(int n = 0; n < places; ++n)
      {
        const Position p = random();
        const double time = period * random.share();
        const auto x = in_fifty_digits<dim>(p);
        const auto excess = [&](const std::array<Real, dim> &y)
        { return oracle.excess_temperature(material, g, d, y, time); };
        note(1, solution.temperature(p, time) - material.melting_temperature, excess(x));
        note(2, solution.volumetric_source(p, time),
             oracle.source(material, g, d, x, time));
        const double conductivity = solution.level_set(p, time) < 0
                                        ? material.solid.conductivity
                                        : material.liquid.conductivity;
        for(int i = 0; i < dim; ++i)
        {
          auto ahead = x, behind = x;
          ahead[i] += step;
          behind[i] -= step;
          note(0, solution.heat_flux(p, time)[i],
               conductivity * (excess(ahead) - excess(behind)) / (2 * step));
        }
      }
      return worst;
    }

    /** k grad T on one side of a place on the front, extrapolated to it. */
    std::array<double, 3> flux_at_front(const ManufacturedSolution &solution,
                                        const Position &p, double time, int side)
    {
      const FrontDerivatives f = solution.family().derivatives(p, time);
      const double aside = side * 1e-10 * solution.family().parameters().length_scale
                           / std::sqrt(f.square_of_gradient());
      Position near = p, far = p;
      for(int d = 0; d < 3; ++d)
      {
        near[d] += aside * f.gradient[d];
        far[d] += 2 * aside * f.gradient[d];
      }
      EXPECT_GT(side * solution.level_set(near, time), 0);
      const auto first = solution.heat_flux(near, time),
                 second = solution.heat_flux(far, time);
      return {2 * first[0] - second[0], 2 * first[1] - second[1],
              2 * first[2] - second[2]};
    }

    /** The largest residual of the front condition over rho_s L max |V|, and the largest
     * difference of T from the melting temperature on the front. */
    std::pair<double, double> front_residuals(const ManufacturedSolution &solution,
                                              const Material &material)
    {
      const FrontFamily &family = solution.family();
      RandomPlace random(family);
      const double latent = material.solid.density * material.latent_heat;
      double worst = 0, fastest = 0, off = 0;
      for(int n = 0; n < 200; ++n)
      {
        // Away from the moments of contact, at which the front has no normal.
        const double phase = 0.27 + 0.46 * random.share() + (n % 2 == 0 ? 0 : 0.5);
        const double time = family.period() * phase;
        const Position p = random_front_place(family, random, time);
        const FrontDerivatives f = family.derivatives(p, time);
        const double slope = std::sqrt(f.square_of_gradient());
        const double speed = -f.rate / slope;
        double jump = 0;
        for(int d = 0; d < 3; ++d)
          jump += f.gradient[d] / slope
                  * (flux_at_front(solution, p, time, -1)[d]
                     - flux_at_front(solution, p, time, 1)[d]);
        worst = std::max(worst, std::abs(jump - latent * speed));
        fastest = std::max(fastest, std::abs(speed));
        const double melting
            = material.melting_temperature
              - (material.gibbs_thomson_coefficient == 0
                     ? 0
                     : material.gibbs_thomson_coefficient * f.curvature());
        off = std::max(off, std::abs(solution.temperature(p, time) - melting));
      }
      return {worst / (latent * fastest), off};
    }
  } // namespace

  TEST(ManufacturedSolution, AgreesWithValuesOfSeventeenDigits)
  {
    const Material material{{1, 1, 1}, {0.1, 2, 1}, 1, 0};
    const double length = 0.25, duration = 7;
    for(const Row &row : table)
    {
      const ManufacturedSolution solution(
          material, make_front_family({row.name, row.dimension, 1, 1, 3}), 1);
      // The same in other units: with q rho c unchanged, x^2/(k t) and L k t/x^2 too.
      Material other = material;
      for(PhaseProperties *phase : {&other.solid, &other.liquid})
        phase->conductivity *= length * length / duration;
      const ManufacturedSolution scaled(
          other, make_front_family({row.name, row.dimension, duration, length, 3}),
          length / duration);
      const double tolerance = row.name[0] == 's' ? 1e-10 : 1e-12;
      for(const Value &value : row.values)
      {
        SCOPED_TRACE(solution.description());
        expect_relative(solution.level_set(value.place, 0.3), value.level_set, tolerance);
        expect_relative(solution.temperature(value.place, 0.3), value.temperature,
                        tolerance);
        expect_relative(solution.volumetric_source(value.place, 0.3), value.source,
                        tolerance);
        Position place = value.place;
        for(double &x : place)
          x *= length;
        expect_relative(scaled.temperature(place, 0.3 * duration), value.temperature,
                        tolerance);
        expect_relative(scaled.volumetric_source(place, 0.3 * duration) * duration,
                        value.source, tolerance);
      }
    }
  }

  TEST(ManufacturedSolution, AgreesWithDifferencesInFiftyDigits)
  {
    for(const Material &material : materials())
      for_each_family(
          [&](const char *name, const auto &formula, auto dim)
          {
            using Formula = std::decay_t<decltype(formula)>;
            const auto worst
                = worst_difference<Formula, dim>(name, formula, material, 12);
            EXPECT_LT(worst[0], 1e-11) << name << " " << dim << ", flux";
            EXPECT_LT(worst[1], 1e-12) << name << " " << dim << ", temperature";
            EXPECT_LT(worst[2], 1e-9) << name << " " << dim << ", source";
          });
  }

  /** Contrasts in k too, for the heat that flows along with the front's temperature. */
  TEST(ManufacturedSolution, AgreesWithFiftyDigitsWhereTheCurvatureCounts)
  {
    for(Material material : materials())
    {
      material.gibbs_thomson_coefficient = 0.02;
      for_each_family(
          [&](const char *name, const auto &formula, auto dim)
          {
            using Formula = std::decay_t<decltype(formula)>;
            if(make_front_family({name, dim, 1, 1, 3})->uniform_curvature(0)
               || make_front_family({name, dim, 1, 1, 3})->merges())
              return;
            const auto worst = worst_difference<Formula, dim>(name, formula, material,
                                                              dim == 2 ? 6 : 2);
            EXPECT_LT(worst[0], 1e-11) << name << " " << dim << ", flux";
            EXPECT_LT(worst[1], 1e-12) << name << " " << dim << ", temperature";
            EXPECT_LT(worst[2], 1e-9) << name << " " << dim << ", source";
          });
    }
  }

  TEST(ManufacturedSolution, FulfilsTheConditionsOnTheFront)
  {
    for(const double coefficient : {0., 0.02})
      for(Material material : materials())
        for(const auto &family : all_families(period, length_scale))
        {
          if(coefficient != 0 && family->merges())
            continue;
          material.gibbs_thomson_coefficient = coefficient;
          const ManufacturedSolution solution(material, family, 1.5, 0.8);
          const auto [jump, off] = front_residuals(solution, material);
          EXPECT_LT(jump, coefficient == 0 ? 1e-11 : 1e-10) << solution.description();
          EXPECT_LT(off, 1e-13) << solution.description();
        }
  }

  TEST(ManufacturedSolution, TemperatureFallsAwayFromTheFrontFasterThanTheBaseFlux)
  {
    for(const Material &material : materials())
      for(const double latent_heat : {150., 1.5, 0.15})
        for(const auto &family : all_families(1, 1))
        {
          Material latent = material;
          latent.latent_heat = latent_heat;
          const ManufacturedSolution solution(latent, family, 1);
          RandomPlace random(*family);
          for(int n = 0; n < 1000; ++n)
          {
            const Position p = random();
            const double time = random.share();
            const double f = solution.level_set(p, time);
            const PhaseProperties &phase = f < 0 ? latent.solid : latent.liquid;
            ASSERT_GT(solution.temperature(p, time) / f * phase.conductivity, 1)
                << solution.description();
          }
        }
  }

  /** With kappa f^2 for kappa |f| in its denominator it would be 30 at the saddle. */
  TEST(ManufacturedSolution, TemperatureOfAMergeIsBounded)
  {
    for(const int dimension : {2, 3})
    {
      const ManufacturedSolution solution(
          unit_material(), make_front_family({"two-disks", dimension, 1, 1, 3}), 1);
      for(const double s : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
        for(int i = -50; i <= 50; ++i)
          for(int j = -50; j <= 50; ++j)
          {
            const Position p{0.002 * i, 0.002 * j, 0};
            ASSERT_NEAR(solution.temperature(p, 0.25 - s), 1, 0.25);
            ASSERT_NEAR(solution.temperature(p, 0.25 + s), 1, 0.25);
          }
    }
  }

  /** The source is unbounded only as one over the time to contact, at the tips before it
   * and at the saddle after it. */
  TEST(ManufacturedSolution, SourceOfAMergeGrowsAsTheInverseOfTheTime)
  {
    const ManufacturedSolution solution(unit_material(),
                                        make_front_family({"two-disks", 2, 1, 1, 3}), 1);
    for(const double s : {-1e-3, -1e-4, -1e-5, -1e-6, 1e-3, 1e-4, 1e-5, 1e-6})
    {
      const double neck = std::sqrt(std::abs(s * s * s));
      double largest = 0;
      for(int i = 0; i < 400; ++i)
        for(int j = 0; j <= 40; ++j)
        {
          const double r = neck * std::pow(10., -1 + 0.0075 * i);
          const double angle = std::numbers::pi / 80 * j;
          const double q = solution.volumetric_source(
              {r * std::cos(angle), r * std::sin(angle), 0}, 0.25 + s);
          largest = std::max(largest, std::abs(q));
        }
      // The grid does not meet the tips themselves, where it jumps.
      const double tip = s < 0 ? solution.signed_distance({0, 0, 0}, 0.25 + s) : 0;
      const double there = std::max(
          std::abs(solution.volumetric_source({tip * (1 + 1e-6), 0, 0}, 0.25 + s)),
          std::abs(solution.volumetric_source({tip * (1 - 1e-6), 0, 0}, 0.25 + s)));
      expect_relative(there * std::abs(s), s < 0 ? 12 : 3, 0.01);
      EXPECT_LT(largest, 1.001 * there);
    }
    const double at_contact = 0.25;
    EXPECT_EQ(solution.temperature({0, 0, 0}, at_contact), 1);
    EXPECT_TRUE(std::isfinite(solution.volumetric_source({0, 0, 0}, at_contact)));
    EXPECT_TRUE(std::isfinite(solution.volumetric_source({1e-12, 0, 0}, at_contact)));
  }

  TEST(ManufacturedSolution, WhatTakesACoordinateIsNotANumber)
  {
    const ManufacturedSolution solution(unit_material(),
                                        make_front_family({"star-3", 2, 1, 1, 3}), 1);
    EXPECT_TRUE(solution.has_front());
    EXPECT_FALSE(solution.depends_on_one_coordinate());
    EXPECT_TRUE(solution.solid_at_origin());
    EXPECT_TRUE(std::isnan(solution.temperature(0.3, 0)));
    EXPECT_TRUE(std::isnan(solution.front(0)));
    EXPECT_TRUE(std::isnan(solution.heat_content(0, 1, 0)));
    EXPECT_TRUE(std::isnan(solution.solid_fraction(0.3, 0)));
    EXPECT_TRUE(std::isnan(solution.solid_volume(0, 1, 0)));
    expect_relative(solution.solid_volume(0), 0.7896650880425246, 1e-14);
  }

  TEST(ManufacturedSolution, RefusesWhatIsNotPositiveOrUnknown)
  {
    const auto disk = make_front_family({"disk", 2, 1, 1, 3});
    const auto finger = make_front_family({"finger", 2, 1, 1, 3});
    Material material = unit_material();
    EXPECT_THROW(ManufacturedSolution(material, disk, 0), InputError);
    EXPECT_THROW(ManufacturedSolution(material, disk, -1, 1), InputError);
    EXPECT_THROW(ManufacturedSolution(material, disk, 1, 0), InputError);
    EXPECT_THROW(ManufacturedSolution(material, disk, 1, NAN), InputError);
    material.gibbs_thomson_coefficient = 0.1;
    EXPECT_THROW(ManufacturedSolution(material, finger, 1), InputError);
    EXPECT_NO_THROW(ManufacturedSolution(material, disk, 1));
    material.liquid.conductivity = 0;
    EXPECT_THROW(ManufacturedSolution(material, disk, 1), InputError);
  }
} // namespace meltfront::cases::manufactured
