#include <verification/run/temperature_probes.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace meltfront::verification
{
  namespace
  {
    using tests::State;
    using Field = std::function<double(const cases::Position &)>;

    /** n x n cells of a square about the origin, solid left of a front. */
    State square_state(int n, double front, const Field &temperature)
    {
      State state;
      for(int j = 0; j < n; ++j)
        for(int i = 0; i < n; ++i)
        {
          const cases::Position place{(i + 0.5) / n - 0.5, (j + 0.5) / n - 0.5, 0};
          state.positions[0].push_back(place[0]);
          state.positions[1].push_back(place[1]);
          state.weights.push_back(1. / (n * n));
          state.solid_fraction.push_back(place[0] < front ? 1 : 0);
          state.temperature.push_back(temperature(place));
        }
      return state;
    }

    TEST(TemperatureProbes, AlongALineEachSideOfTheFrontHasAPolynomialOfItsOwn)
    {
      constexpr double front = 0.42;
      const cases::Scene scene
          = tests::scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
      State state = tests::slab_state(40, front);
      // A kink at the front, quintic on either side.
      const auto exact = [&](double x)
      { return (x < front ? 3 : 1) * (x - front) + std::pow(x - front, 5); };
      for(std::size_t i = 0; i < state.temperature.size(); ++i)
        state.temperature[i] = exact(state.positions[0][i]);
      const auto probes
          = read_probes(scene, state.view(1, 1), state.positions[0], nullptr, 1. / 40);
      ASSERT_EQ(probes.size(), 20u);
      for(const TemperatureProbe &probe : probes)
      {
        EXPECT_EQ(probe.coordinate, "x");
        EXPECT_NEAR(probe.temperature, exact(probe.place.front()), 1e-12)
            << probe.place.front();
        EXPECT_TRUE(std::isnan(probe.temperature_exact));
      }
    }

    TEST(TemperatureProbes, TheExactTemperatureStandsBeside)
    {
      const cases::Case c = tests::slab_case("slab");
      State state = tests::slab_state(10, 0.5);
      for(const TemperatureProbe &probe :
          read_probes(c.scene, state.view(1, 1), state.positions[0], c.exact.get(), 0.1))
        EXPECT_EQ(probe.temperature_exact, c.exact->temperature(probe.place.front(), 1));
    }

    TEST(TemperatureProbes, InThePlaneAQuadraticOfThePhaseIsExact)
    {
      constexpr double front = 0.13;
      const cases::Scene scene
          = tests::scene_of(cases::DomainShape::box, 2, cases::Symmetry::none);
      const Field exact = [&](const cases::Position &x)
      {
        return (x[0] < front ? 4 : 1) * (x[0] - front) + 0.3 * x[0] * x[1]
               + 0.2 * x[1] * x[1];
      };
      State state = square_state(30, front, exact);
      std::vector<double> radii(state.weights.size());
      const auto probes = read_probes(scene, state.view(2, 1), radii, nullptr, 1. / 30);
      ASSERT_EQ(probes.size(), 25u);
      for(const TemperatureProbe &probe : probes)
      {
        EXPECT_TRUE(probe.coordinate.empty());
        EXPECT_NEAR(probe.temperature, exact({probe.place[0], probe.place[1], 0}), 1e-12)
            << probe.place[0] << " " << probe.place[1];
      }
    }

    TEST(TemperatureProbes, OnlyPlacesInsideADisk)
    {
      cases::Scene scene
          = tests::scene_of(cases::DomainShape::ball, 2, cases::Symmetry::none);
      State state = square_state(30, 0, [](const cases::Position &) { return 1.; });
      const double radius = scene.domain.radius;
      std::vector<double> radii(state.weights.size());
      const auto probes = read_probes(scene, state.view(2, 1), radii, nullptr, 1. / 30);
      EXPECT_EQ(probes.size(), 21u); // the corners of 5 x 5 lie outside
      for(const TemperatureProbe &probe : probes)
        EXPECT_LT(std::hypot(probe.place[0], probe.place[1]), radius);
    }

    TEST(PlaceReading, IsExactOfPolynomialsOnBothSidesOfAFront)
    {
      constexpr double front = 0.42;
      const cases::Scene slab
          = tests::scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
      State line = tests::slab_state(40, front);
      const auto quintic = [&](double x)
      { return (x < front ? 3 : 1) * (x - front) + std::pow(x - front, 5); };
      for(std::size_t i = 0; i < line.temperature.size(); ++i)
        line.temperature[i] = quintic(line.positions[0][i]);
      for(const double x : {0., 0.013, 0.3, 0.41, 0.44, 0.77, 1.})
      {
        const PlaceReading reading
            = read_places(slab, line.view(1, 1), 1. / 40, {{x, 0, 0}}).front();
        EXPECT_NEAR(reading.temperature, quintic(x), 1e-11) << x;
        EXPECT_GE(reading.solid_fraction, 0);
        EXPECT_LE(reading.solid_fraction, 1);
      }
      const cases::Scene box
          = tests::scene_of(cases::DomainShape::box, 2, cases::Symmetry::none);
      const Field quadratic = [](const cases::Position &x)
      { return 1 + x[0] - 2 * x[0] * x[1] + 0.5 * x[1] * x[1]; };
      State plane = square_state(30, 0.13, quadratic);
      for(const cases::Position &place :
          {cases::Position{0, 0, 0}, {0.3, -0.2, 0}, {-0.5, 0.5, 0}, {0.1, 0.49, 0}})
        EXPECT_NEAR(
            read_places(box, plane.view(2, 1), 1. / 30, {place}).front().temperature,
            quadratic(place), 1e-11);
    }

    TEST(PlaceReading, SolidFractionsAreThoseOfThePhaseAwayFromTheFront)
    {
      const cases::Scene box
          = tests::scene_of(cases::DomainShape::box, 2, cases::Symmetry::none);
      State plane = square_state(30, 0, [](const cases::Position &) { return 1.; });
      const auto at = [&](double x)
      {
        return read_places(box, plane.view(2, 1), 1. / 30, {{x, 0.1, 0}})
            .front()
            .solid_fraction;
      };
      EXPECT_EQ(at(-0.3), 1);
      EXPECT_EQ(at(0.3), 0);
      EXPECT_NEAR(at(0), 0.5, 1e-12);
    }
  } // namespace
} // namespace meltfront::verification
