#include <verification/measure/formulas/event_watch.h>
#include <verification/measure/formulas/mirror_symmetry.h>
#include <verification/measure/tests/fixtures.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using cases::TimedEvent;
    using tests::State;

    /** A row of sites of spacing 1, x = 0, 1, ..., or rows of them. */
    State lattice(int columns, int rows = 1)
    {
      State state;
      for(int j = 0; j < rows; ++j)
        for(int i = 0; i < columns; ++i)
        {
          state.positions[0].push_back(i);
          state.positions[1].push_back(j);
        }
      const std::size_t n = state.positions[0].size();
      state.weights.assign(n, 1);
      state.temperature.assign(n, 0);
      state.solid_fraction.assign(n, 0);
      return state;
    }

    cases::PointSource source(double x, double y, double power)
    {
      return {{x, y, 0},
              "constant",
              [power](double) { return power; },
              [power](double time) { return power * time; }};
    }

    cases::Scene with_sinks(const std::vector<cases::PointSource> &sources)
    {
      cases::Scene scene;
      scene.sources = sources;
      return scene;
    }

    const std::vector<TimedEvent> all_events{
        TimedEvent::first_contact, TimedEvent::half_frozen, TimedEvent::all_frozen};

    /** Two fronts in a row of nine that move from its ends by 1 per second: the site i
     * freezes while they pass from i - 1/2 to i + 1/2. */
    State two_fronts(double time)
    {
      State state = lattice(9);
      for(int i = 0; i < 9; ++i)
      {
        const double from_end = std::min(i, 8 - i);
        state.solid_fraction[i] = std::clamp(time - from_end + 0.5, 0., 1.);
        state.temperature[i] = std::min(from_end + 0.5 - time, 0.); // all properties one
      }
      return state;
    }

    TEST(EventWatch, TimesAreFinerThanTheSteps)
    {
      const cases::Scene scene = with_sinks({source(0, 0, -1), source(8, 0, -1)});
      for(const double step : {0.1, 0.37})
      {
        EventWatch watch(scene, all_events, 1);
        EXPECT_TRUE(watch.pending());
        double end = 0;
        for(int i = 0; watch.pending() && i < 100; ++i)
          watch.observe(two_fronts(end = i * step).view(2, i * step));
        EXPECT_FALSE(watch.pending());
        EXPECT_NEAR(watch.time(TimedEvent::first_contact), 4.5, 1e-14)
            << "the site in the middle is frozen";
        // 4.5 of 9 sites: after the ends' halves, 0.5 + 2 t.
        EXPECT_NEAR(watch.time(TimedEvent::half_frozen), 1.75, 1e-14);
        EXPECT_GE(watch.time(TimedEvent::all_frozen), 4.5);
        EXPECT_EQ(watch.time(TimedEvent::all_frozen), end) << "the first without liquid";
        EXPECT_LT(end, 4.5 + step);
      }
    }

    TEST(EventWatch, OnlyWhatIsWantedIsAwaited)
    {
      const cases::Scene scene = with_sinks({});
      EXPECT_FALSE(EventWatch(scene, {}, 1).pending());
      EventWatch watch(scene, {TimedEvent::half_frozen}, 1);
      watch.observe(two_fronts(0.1).view(2, 0.1));
      EXPECT_TRUE(watch.pending());
      watch.observe(two_fronts(2).view(2, 2));
      EXPECT_FALSE(watch.pending());
      EXPECT_TRUE(std::isnan(watch.time(TimedEvent::first_contact)));
      EXPECT_TRUE(std::isnan(watch.time(TimedEvent::all_frozen)));
    }

    TEST(EventWatch, WhatIsSoAtTheStartHappensThere)
    {
      const cases::Scene scene = with_sinks({source(0, 0, -1), source(8, 0, -1)});
      EventWatch watch(scene, all_events, 1);
      watch.observe(two_fronts(10).view(2, 7));
      for(const TimedEvent event : all_events)
        EXPECT_EQ(watch.time(event), 7);
    }

    TEST(EventWatch, NoLiquidMeansLessThanAShareOf1e12)
    {
      State state = lattice(4);
      state.solid_fraction = {1, 1, 1, 1 - 1e-11};
      EventWatch watch(with_sinks({}), {TimedEvent::all_frozen}, 1);
      watch.observe(state.view(2, 1));
      EXPECT_TRUE(watch.pending());
      state.solid_fraction[3] = 1 - 1e-12;
      watch.observe(state.view(2, 2));
      EXPECT_EQ(watch.time(TimedEvent::all_frozen), 2);
    }

    /** Sinks in the corners of a square of particles. */
    class Contact : public testing::Test
    {
    protected:
      bool observe(const std::vector<int> &solid, double time)
      {
        std::fill(state.solid_fraction.begin(), state.solid_fraction.end(), 0.9);
        std::fill(state.temperature.begin(), state.temperature.end(), 0);
        for(const int site : solid)
        {
          state.solid_fraction[site] = 1;
          state.temperature[site] = -0.1;
        }
        return watch.observe(state.view(2, time));
      }

      State state = lattice(4, 4);
      ContactWatch watch{
          with_sinks({source(0.2, 0.1, -1), source(3.2, 2.8, -2), source(0, 3, 1)}), 1};
    };

    TEST_F(Contact, ParticlesTouchTheirEightNeighbours)
    {
      EXPECT_FALSE(observe({0, 15}, 0));
      EXPECT_FALSE(observe({0, 5, 15}, 1));
      EXPECT_TRUE(observe({0, 5, 10, 15}, 2)) << "along the diagonal";
      EXPECT_EQ(watch.time(), 1.5);
    }

    TEST_F(Contact, OtherBodiesDoNotCount)
    {
      EXPECT_FALSE(observe({0, 12, 15}, 0));
      EXPECT_FALSE(observe({0, 4, 8, 12, 15}, 1)) << "with the ice at a source of heat";
      EXPECT_FALSE(observe({5, 10}, 2)) << "with ice that holds no sink";
    }

    TEST_F(Contact, BodiesMayComeApart)
    {
      EXPECT_FALSE(observe({0, 5, 15}, 0));
      EXPECT_FALSE(observe({0, 10, 15}, 1));
      EXPECT_FALSE(observe({0, 15, 6}, 2));
      EXPECT_TRUE(observe({0, 15, 6, 5, 10}, 3));
    }

    TEST_F(Contact, SitesThatMoveAreSortedAgain)
    {
      EXPECT_FALSE(observe({0, 3, 10, 15}, 0));
      state.positions[0][3] = 1;
      state.positions[1][3] = 1;
      EXPECT_TRUE(observe({0, 3, 10, 15}, 1));
      EXPECT_EQ(watch.time(), 1);
    }

    TEST(ContactOnAMesh, CornersOfACellTouchHoweverFar)
    {
      State state = lattice(3, 2);
      for(double &x : state.positions[0])
        x *= 100;
      const std::vector<unsigned int> cells{0, 1, 3, 4, 1, 2, 4, 5};
      ContactWatch watch(with_sinks({source(0, 0, -1), source(200, 1, -1)}), 1);
      state.solid_fraction = {1, 0, 0, 0, 0, 1};
      state.snapshot.cells = cells;
      EXPECT_FALSE(watch.observe(state.view(2, 0)));
      state.solid_fraction[4] = 0.6;
      EXPECT_FALSE(watch.observe(state.view(2, 1)));
      state.solid_fraction[4] = 1;
      state.temperature[4] = -0.1;
      EXPECT_TRUE(watch.observe(state.view(2, 2)));
      EXPECT_NEAR(watch.time(), 1.8, 1e-15);
    }

    TEST(MirrorSymmetry, ComparesEachSiteWithItsImage)
    {
      State state = lattice(4, 2);
      for(double &x : state.positions[0])
        x = 0.1 * (x - 1.5) + 1e-9 * x;
      for(std::size_t i = 0; i < 8; ++i)
        state.temperature[i] = std::abs(state.positions[0][i]) > 0.1 ? 1 : 2;
      MirrorSymmetry mirror(0, 0.1);
      EXPECT_EQ(mirror.largest_difference(state.view(2, 0)), 0);
      state.temperature[6] += 0.25;
      EXPECT_EQ(mirror.largest_difference(state.view(2, 1)), 0.25);
      EXPECT_TRUE(std::isnan(MirrorSymmetry(1, 0.1).largest_difference(state.view(2, 0))))
          << "its rows are y = 0 and 1";
    }

    TEST(MirrorSymmetry, IsNotDefinedForASiteWithoutImage)
    {
      State state = lattice(3);
      for(double &x : state.positions[0])
        x -= 1;
      MirrorSymmetry mirror(0, 1);
      EXPECT_EQ(mirror.largest_difference(state.view(2, 0)), 0);
      state.positions[0][2] += 1e-3;
      EXPECT_TRUE(std::isnan(mirror.largest_difference(state.view(2, 0))));
    }
  } // namespace
} // namespace meltfront::verification
