// The mushy layer against what it has to obey, and against a difference scheme.

#include <cases/error.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/tests/salt_water.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <vector>

namespace meltfront::cases
{
  namespace
  {
    using similarity::DiffusingMush;
    using similarity::LeverRuleMush;
    using similarity::Mush;

    struct Problem
    {
      Material material;
      Alloy alloy;
      std::vector<double> concentration;
      double wall, far;

      MushyLayer solution() const
      {
        return {material, alloy, concentration, wall, far};
      }
    };

    /** With and without crystals of another density, with diffusion, down to the eutectic
     * temperature, two solutes, a curved liquidus. */
    std::vector<Problem> problems()
    {
      const Material water = salt_water();
      Alloy eutectic = sodium_nitrate(917), two = sodium_nitrate(917);
      eutectic.eutectic_temperature = -17.7;
      two.solutes.push_back({.name = "second", .liquidus_slope = 30});
      Alloy curved = sodium_nitrate(917);
      curved.solutes[0].liquidus_curve = [](double c) { return 30 * c + 40 * c * c; };
      curved.solutes[0].largest_concentration = 0.6;
      return {{water, sodium_nitrate(917), {0.14}, -16.5, 14.7},
              {water, sodium_nitrate(0), {0.01}, -16.5, 1},
              {water, sodium_nitrate(0, salt_diffusivity), {0.14}, -16.5, 14.7},
              {water, sodium_nitrate(0, 20 * salt_diffusivity), {0.05}, -10, 5},
              {water, eutectic, {0.14}, -30, 14.7},
              {water, two, {0.07, 0.05}, -16.5, 14.7},
              {water, curved, {0.14}, -16.5, 14.7}};
    }

    /** Adaptive quadrature, split at what may not be smooth: the front and `edges`. */
    template <typename Function>
    double integral(const Function &f, double lower, double upper,
                    std::vector<double> edges)
    {
      edges.push_back(upper);
      std::sort(edges.begin(), edges.end());
      double sum = 0, left = lower;
      for(const double edge : edges)
      {
        const double right = std::clamp(edge, left, upper);
        if(right > left)
          sum += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
              f, left, right, 5, 1e-11);
        left = right;
      }
      return sum;
    }

    /** Where all is solid, next to the wall. */
    double solid_edge(const MushyLayer &layer, double time)
    {
      double lower = 0, upper = layer.front(time);
      if(layer.solid_fraction(0, time) < 1)
        return 0;
      for(int i = 0; i < 100; ++i)
      {
        const double middle = 0.5 * (lower + upper);
        (layer.solid_fraction(middle, time) == 1 ? lower : upper) = middle;
      }
      return upper;
    }

    std::vector<double> edges(const MushyLayer &layer, double time)
    {
      const double front = layer.front(time), solid = solid_edge(layer, time);
      std::vector<double> result{front, solid};
      for(double factor = 1.0001; factor < 2; factor = 1 + 2 * (factor - 1))
        result.push_back(factor * solid);
      return result;
    }
  } // namespace

  TEST(MushyLayer, HeatComesThroughTheWall)
  {
    for(const Problem &problem : problems())
    {
      const MushyLayer layer = problem.solution();
      SCOPED_TRACE(layer.description());
      for(const double time : {1., 91800.})
      {
        // Far enough for the far temperature to be there to the last bit.
        const double end = 10 * std::sqrt(1.09e-7 * time) * 2;
        expect_relative(layer.heat_content(0, end, time) - layer.heat_content(0, end, 0),
                        layer.wall_heat(time), 1e-12);
        const double step = 1e-6 * layer.front(time);
        const double slope
            = (-3 * layer.temperature(0, time) + 4 * layer.temperature(step, time)
               - layer.temperature(2 * step, time))
              / (2 * step);
        const double conductivity = PhaseDiagram(problem.material, problem.alloy)
                                        .conductivity(layer.solid_fraction(0, time));
        expect_relative(-2 * time * conductivity * slope, layer.wall_heat(time), 1e-7);
      }
    }
  }

  TEST(MushyLayer, IntegralsAreThoseOfTheFields)
  {
    const double time = 13200;
    for(const Problem &problem : problems())
    {
      const MushyLayer layer = problem.solution();
      SCOPED_TRACE(layer.description());
      const PhaseDiagram diagram(problem.material, problem.alloy);
      const double solid = solid_edge(layer, time);
      const auto heat = [&](double y)
      {
        const double f = 1 - layer.solid_fraction(y, time);
        const double t = layer.temperature(y, time);
        return 1097 * ((1 - f) * 2006 * t + f * (4180 * t + 334400));
      };
      const auto solid_fraction = [&](double y) { return layer.solid_fraction(y, time); };
      for(const auto &[from, to] : std::vector<std::pair<double, double>>{
              {0, 0.5}, {0.2 * layer.front(time), 0.4 * layer.front(time)}})
      {
        expect_relative(integral(heat, from, to, edges(layer, time)),
                        layer.heat_content(from, to, time), 1e-10);
        expect_relative(integral(solid_fraction, from, to, edges(layer, time)),
                        layer.solid_volume(from, to, time), 3e-9);
      }
      for(const double share : {0.1, 0.5, 0.9})
      {
        const double y = solid + share * (layer.front(time) - solid);
        const double liquid = 1 - layer.solid_fraction(y, time);
        const double first = layer.concentration(0, y, time) / liquid;
        const double second = problem.concentration.size() > 1
                                  ? layer.concentration(1, y, time) / liquid
                                  : 0;
        EXPECT_NEAR(diagram.liquidus(first, second), layer.temperature(y, time), 1e-11);
      }
    }
  }

  /** Nothing in the construction integrates the solute: that it is all there shows that
   * its equation, the front and the layer at the wall are right. */
  TEST(MushyLayer, SoluteIsConserved)
  {
    const double time = 13200;
    for(const Problem &problem : problems())
    {
      const MushyLayer layer = problem.solution();
      SCOPED_TRACE(layer.description());
      const double end = 0.5;
      const double amount
          = integral([&](double y) { return layer.concentration(y, time); }, 0, end,
                     edges(layer, time));
      expect_relative(amount, problem.concentration[0] * end, 1e-10);
    }
  }

  /** Where solute diffuses fast, the mush ends at a jump, and at last there is none. */
  TEST(MushyLayer, SoluteLeavesTheSolidAtAJump)
  {
    const auto layer_of = [](double diffusivity)
    {
      Alloy alloy;
      alloy.solutes.push_back(
          {.name = "solute", .liquidus_slope = 4, .diffusivity = diffusivity});
      return MushyLayer({{1, 1, 1}, {1, 1, 1}, 5, 0}, alloy, {0.25}, -3, 0);
    };
    for(const double diffusivity : {0.03, 0.1, 0.3})
    {
      const MushyLayer layer = layer_of(diffusivity);
      SCOPED_TRACE(layer.description());
      constexpr double time = 0.06, end = 5;
      const double solid = solid_edge(layer, time);
      EXPECT_GT(solid, 0);
      EXPECT_LT(layer.solid_fraction(1.0001 * solid, time), 0.75);
      const auto heat = [&](double y)
      { return layer.temperature(y, time) + 5 * (1 - layer.solid_fraction(y, time)); };
      const auto solute = [&](double y) { return layer.concentration(y, time); };
      expect_relative(integral(solute, 0, end, edges(layer, time)), 0.25 * end, 1e-10);
      expect_relative(integral(heat, 0, end, edges(layer, time)),
                      layer.heat_content(0, end, time), 1e-10);
      expect_relative(layer.heat_content(0, end, time) - layer.heat_content(0, end, 0),
                      layer.wall_heat(time), 1e-12);
    }
    EXPECT_THROW(layer_of(0.4), InputError);
  }

  /** Both phases beside each other, and what they exchange. */
  TEST(MushyLayer, MayConductAsPublished)
  {
    Alloy alloy;
    alloy.solutes.push_back({.name = "solute", .liquidus_slope = 4});
    const MushyLayer layer({{2, 1, 1}, {1, 1, 1}, 5, 0}, alloy, {0.25}, -3, 0,
                           similarity::HeatOfFreezing::constant,
                           similarity::MushConduction::published);
    const double time = 0.1, step = 1e-5;
    const double solid = 2 * layer.solid_fraction(0, time), liquid = 1 - solid / 2;
    const double conductivity = solid + liquid + 4 * solid * liquid / (solid + liquid);
    const double slope
        = (-3 * layer.temperature(0, time) + 4 * layer.temperature(step, time)
           - layer.temperature(2 * step, time))
          / (2 * step);
    expect_relative(-2 * time * conductivity * slope, layer.wall_heat(time), 1e-7);
    expect_relative(layer.heat_content(0, 5, time) - layer.heat_content(0, 5, 0),
                    layer.wall_heat(time), 1e-12);
    similarity::Mush<double> mush;
    mush.conductivity_ratio = 3;
    mush.expansion = 1.2;
    mush.conduction = similarity::MushConduction::published;
    for(const double f : {0.1, 0.3, 0.9})
      EXPECT_NEAR(mush.conductivity_slope(f),
                  (mush.conductivity(f + 1e-5) - mush.conductivity(f - 1e-5)) / 2e-5,
                  1e-8);
  }

  TEST(MushyLayer, LiquidIsNowhereUndercooled)
  {
    const Problem problem = problems()[2];
    const MushyLayer layer = problem.solution();
    const PhaseDiagram diagram(problem.material, problem.alloy);
    const double time = 13200, front = layer.front(time);
    EXPECT_NEAR(layer.front_concentration(), 0.14553, 6e-6);
    for(double share = 1; share < 1.5; share += 0.01)
      EXPECT_GE(layer.temperature(share * front, time)
                    - diagram.liquidus(layer.concentration(share * front, time)),
                -1e-12);
    const double step = 1e-6 * front;
    const double slope = layer.temperature(front + step, time)
                         - diagram.liquidus(layer.concentration(front + step, time));
    EXPECT_LT(slope, 1e-8) << "marginal: the slopes meet";
    EXPECT_EQ(layer.concentration(1e-5, time), 0) << "the wall has lost its salt";
    EXPECT_EQ(layer.solid_fraction(1e-5, time), 1);
  }

  /** Mush so cut off at eta_1 and its temperature drawn on straight to the wall is what
   * the constants were computed from that are known to four digits. */
  TEST(MushyLayer, FourDigitsWithoutTheLayerAtTheWall)
  {
    Mush<double> mush = equations_of('A');
    mush.diffusion = salt_diffusivity / salt_water().liquid.diffusivity();
    for(const auto &[cut, lambda] : std::vector<std::pair<double, double>>{
            {0.01, 0.46002}, {0.02, 0.45996}, {0.04, 0.45977}})
    {
      const DiffusingMush<double> layer(mush, lambda, 16);
      const auto point = layer.at(cut);
      EXPECT_NEAR(point.depth + point.flux / mush.conductivity(point.liquid) * cut, 16.5,
                  5e-4);
    }
    for(const auto &[name, lambda, concentration] :
        std::vector<std::tuple<char, double, double>>{{'A', 0.4600, 0.14535},
                                                      {'B', 0.4657, 0.14531},
                                                      {'C', 0.4300, 0.14557},
                                                      {'D', 0.4352, 0.14553}})
    {
      const MushyLayer layer = data_set(name, salt_diffusivity);
      EXPECT_NEAR(layer.lambda(), lambda, 7e-4) << "with the layer at the wall";
      EXPECT_GT(layer.lambda(), lambda);
      EXPECT_NEAR(layer.front_concentration(), concentration, 6e-6);
    }
    EXPECT_NEAR(data_set('D', salt_diffusivity).lambda(), 0.435803658215, 2e-12);
    // Crystals of another density: here the mush ends at a jump. The digits are those of
    // the path that turns back, which it does by a thousandth of the layer at the wall.
    EXPECT_NEAR(data_set('A', salt_diffusivity).lambda(), 0.460407056279, 2e-12);
    EXPECT_NEAR(data_set('B', salt_diffusivity).lambda(), 0.466043019416, 2e-12);
  }

  /** With less and less solute the mush closes up to a front. */
  TEST(MushyLayer, WithoutSoluteItIsNeumanns)
  {
    for(const double far : {10., 0.})
    {
      const double sharp = PlanarNeumann(salt_water(), -16.5, far).front(1);
      double before = 0;
      for(const double concentration : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7})
      {
        const MushyLayer layer(salt_water(), sodium_nitrate(0), {concentration}, -16.5,
                               far);
        const double difference = std::abs(layer.front(1) / sharp - 1);
        if(before > 0)
        {
          EXPECT_LT(difference, 0.2 * before) << concentration;
          EXPECT_GT(difference, 0.05 * before) << concentration;
        }
        before = difference;
        EXPECT_NEAR(layer.temperature(sharp / 2, 1),
                    PlanarNeumann(salt_water(), -16.5, far).temperature(sharp / 2, 1),
                    20 * 16.5 * difference + 1e-9);
      }
      EXPECT_LT(before, 1e-5);
    }
  }

  TEST(MushyLayer, OnlyTheSumOfTwoSolutesCounts)
  {
    Alloy two = sodium_nitrate(917);
    two.solutes.push_back({.name = "second", .liquidus_slope = 59.192});
    const MushyLayer layer(salt_water(), two, {0.07, 0.05}, -16.5, 14.7);
    EXPECT_NEAR(layer.lambda(), data_set('B').lambda(), 1e-14);
    EXPECT_NEAR(layer.temperature(0.05, 91800), data_set('B').temperature(0.05, 91800),
                1e-12);
    EXPECT_EQ(layer.concentration(1, 0.02, 91800), 0.05);
  }
} // namespace meltfront::cases
