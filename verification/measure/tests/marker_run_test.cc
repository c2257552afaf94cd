#include <cases/error.h>
#include <particles/level_set/markers/marker_run.h>
#include <particles/level_set/tests/marker_samples.h>
#include <verification/measure/tests/measured_front.h>

#include <gtest/gtest.h>

#include <numbers>

namespace meltfront::particles::level_set
{
  namespace
  {
    constexpr double pi = std::numbers::pi;

    const cases::RigidMotion at_rest({}, 0, {});
    const cases::RigidMotion rotation({}, 1, {0.5, 0.5, 0});

    struct Measured
    {
      verification::InterfaceErrors errors;
      MarkerResult result;
    };

    /** The grid's circle lies a spacing off in both directions (section 4.3.2). */
    Measured offset_circle(const MarkerParameters &markers, double offset = 1)
    {
      MarkerRunParameters parameters;
      parameters.markers = markers;
      parameters.grid_offset = {offset, offset, 0};
      MarkerResult result = run_markers(unit_grid(80), circle, at_rest, parameters);
      return {measured(result.front, disk), std::move(result)};
    }

    TEST(OffsetCircle, FitsRestoreItToTheFloorOfSampling)
    {
      for(const bool clustered : {false, true})
        for(const std::uint64_t seed : {1, 2, 3, 4, 5})
        {
          MarkerParameters markers = MarkerParameters::interpolating(2, clustered);
          markers.seed = seed;
          const Measured found = offset_circle(markers);
          EXPECT_LT(found.errors.front, 0.006);
          EXPECT_LT(std::abs(found.errors.volume), 1e-3);
          EXPECT_LT(found.errors.curvature, 0.01);
          EXPECT_LT(found.errors.normal, 0.1);
        }
    }

    TEST(OffsetCircle, EscapedMarkersLeaveItRough)
    {
      double original = 0, corrected = 0, replaced = 0;
      for(const std::uint64_t seed : {1, 2, 3})
      {
        MarkerParameters markers = MarkerParameters::original();
        markers.seed = seed;
        original += offset_circle(markers).errors.front / 3;
        markers = MarkerParameters::corrected();
        markers.seed = seed;
        corrected += offset_circle(markers).errors.front / 3;
        markers = MarkerParameters::corrected(EscapeMerge::replace);
        markers.seed = seed;
        replaced += offset_circle(markers).errors.front / 3;
      }
      EXPECT_NEAR(original, 0.155, 0.025);
      EXPECT_NEAR(corrected, 0.42, 0.12);
      EXPECT_NEAR(replaced, 0.05, 0.02);
    }

    /** No marker's sphere is crossed: nothing has escaped, the error stays. */
    TEST(OffsetCircle, ATenthOfASpacingIsNoEscape)
    {
      const Measured found = offset_circle(MarkerParameters::original(), 0.1);
      EXPECT_EQ(found.result.work.escaped, 0);
      EXPECT_NEAR(found.errors.front, 0.09, 0.01);
      EXPECT_LT(
          offset_circle(MarkerParameters::interpolating(2, false), 0.1).errors.front,
          0.006);
    }

    /** A quarter turn of Zalesak's disk on a grid coarser than usual. */
    Measured quarter_turn(const MarkerParameters &markers, double courant_number = 0.5)
    {
      MarkerRunParameters parameters;
      parameters.markers = markers;
      parameters.transport.end_time = pi / 2;
      parameters.transport.courant_number = courant_number;
      MarkerResult result
          = run_markers(unit_grid(60), distance_from(slotted_disk), rotation, parameters);
      return {measured(result.front, slotted_disk, rotation, pi / 2), std::move(result)};
    }

    double grid_alone()
    {
      TransportParameters parameters;
      parameters.end_time = pi / 2;
      const TransportResult result = run_level_set(
          unit_grid(60), distance_from(slotted_disk), rotation, parameters);
      return measured(result.front, slotted_disk, rotation, pi / 2).front;
    }

    TEST(ZalesakDisk, FitsAreSmootherThanEscapesAndBothBetterThanTheGridAlone)
    {
      const Measured fits = quarter_turn(MarkerParameters::interpolating(2, false)),
                     clusters = quarter_turn(MarkerParameters::interpolating(2)),
                     escapes = quarter_turn(MarkerParameters::original());
      EXPECT_LT(fits.errors.front, 0.02);
      EXPECT_LT(std::abs(fits.errors.volume), 0.004);
      EXPECT_LT(clusters.errors.front, 0.02);
      EXPECT_LT(fits.errors.front, 0.3 * escapes.errors.front);
      EXPECT_LT(escapes.errors.front, grid_alone());
      // d and the counts: rigid motion neither strains nor reseeds
      EXPECT_EQ(fits.result.work.born, 0);
      EXPECT_GT(fits.result.work.nodes / fits.result.work.corrections, 200);
    }

    TEST(ZalesakDisk, FitsDoNotMindLargeSteps)
    {
      const MarkerParameters fits = MarkerParameters::interpolating(2, false);
      EXPECT_NEAR(quarter_turn(fits, 0.9).errors.front, quarter_turn(fits).errors.front,
                  0.004);
    }

    /** Drawn out to the thinnest filament of the vortex of period 8, on 80 x 80 cells. */
    double mismatch_at_half(const MarkerParameters &markers)
    {
      const cases::SingleVortex velocity(8);
      MarkerRunParameters parameters;
      parameters.markers = markers;
      parameters.transport.end_time = 4;
      const MarkerResult result
          = run_markers(unit_grid(80), circle, velocity, parameters);
      return measured(result.front, disk, velocity, 4).mismatch;
    }

    TEST(CircleInVortex, ClustersHoldTheFilamentBetterThanEscapes)
    {
      const double clusters = mismatch_at_half(MarkerParameters::interpolating(2)),
                   escapes = mismatch_at_half(MarkerParameters::original());
      EXPECT_LT(clusters, 0.09);
      EXPECT_LT(clusters, escapes);
      EXPECT_NEAR(escapes, 0.105, 0.015);
    }

    /** What of the area is missing without any error of the method: of the exact distance
     * between nodes. */
    double floor_of_area(const Grid &grid)
    {
      return measured(LevelSet(grid, circle), disk).volume;
    }

    /** Drawn out and back, the period shorter and the grid coarser than usual. */
    Measured vortex(const MarkerParameters &markers, double period)
    {
      MarkerRunParameters parameters;
      parameters.markers = markers;
      parameters.transport.end_time = period;
      MarkerResult result
          = run_markers(unit_grid(48), circle, cases::SingleVortex(period), parameters);
      return {measured(result.front, disk), std::move(result)};
    }

    TEST(CircleInVortex, DrawnOutAndBackTheAreaIsKept)
    {
      const Measured found = vortex(MarkerParameters::interpolating(2), 4);
      EXPECT_LT(std::abs(found.errors.volume), 0.01);
      EXPECT_LT(found.errors.front, 0.05);
      EXPECT_GT(found.result.work.born, 0);
    }

    TEST(CircleInVortex, ThreadsDoNotChangeABit)
    {
      for(MarkerParameters markers :
          {MarkerParameters::interpolating(2), MarkerParameters::original()})
      {
        const Measured one = vortex(markers, 0.6);
        markers.threads = 2;
        const Measured two = vortex(markers, 0.6);
        EXPECT_TRUE(
            std::ranges::equal(one.result.front.values(), two.result.front.values()));
        EXPECT_EQ(one.result.markers.position, two.result.markers.position);
        EXPECT_EQ(one.result.markers.distance, two.result.markers.distance);
      }
    }

    TEST(MarkerRun, SeedsDoNotMatterMuch)
    {
      const double floor = floor_of_area(unit_grid(48));
      for(const std::uint64_t seed : {1, 2, 3, 4, 5})
      {
        MarkerParameters markers = MarkerParameters::interpolating(2);
        markers.seed = seed;
        const Measured found = vortex(markers, 1.5);
        EXPECT_NEAR(found.errors.volume, floor, 0.002) << seed;
        EXPECT_LT(found.errors.front, 0.02) << seed;
      }
    }

    TEST(MarkerRun, FrontAtTheBoundaryAndMarkersThatLeave)
    {
      // a disk that moves out of the square over its right side
      const cases::RigidMotion along({1, 0, 0}, 0, {});
      for(const MarkerParameters &markers :
          {MarkerParameters::interpolating(2), MarkerParameters::interpolating(2, false),
           MarkerParameters::original()})
      {
        MarkerRunParameters parameters;
        parameters.markers = markers;
        parameters.transport.end_time = 0.3;
        const cases::Ball start(2, {0.75, 0.5, 0}, 0.15), end(2, {1.05, 0.5, 0}, 0.15);
        const Grid grid = unit_grid(40);
        const MarkerResult result
            = run_markers(grid, distance_from(start), along, parameters);
        for(int j = 0; j <= 40; ++j)
          for(int i = 30; i <= 40; ++i)
          {
            const double exact = end.signed_distance(grid.position({i, j, 0}));
            if(std::abs(exact) < grid.spacing())
            {
              EXPECT_NEAR(result.front.values()[grid.node(i, j)], exact,
                          0.3 * grid.spacing());
            }
          }
      }
    }

    TEST(MarkerRun, WithoutAFrontARunEndsAsItBegan)
    {
      const auto nowhere = [](const Position &) { return -1.; };
      for(const MarkerParameters &markers :
          {MarkerParameters::interpolating(2), MarkerParameters::original()})
      {
        MarkerRunParameters parameters;
        parameters.markers = markers;
        parameters.transport.end_time = 0.1;
        const MarkerResult result
            = run_markers(unit_grid(20), nowhere, rotation, parameters);
        EXPECT_EQ(result.markers.size(), 0u);
        for(const double value : result.front.values())
          EXPECT_LE(value, 0);
      }
    }

    TEST(MarkerRun, InSpaceABallInTheDeformationKeepsItsVolume)
    {
      const cases::CubeDeformation velocity(0.6);
      MarkerRunParameters parameters;
      parameters.transport.end_time = 0.6;
      parameters.markers = MarkerParameters::interpolating(3);
      const Grid grid = unit_grid(24, 3);
      const MarkerResult result = run_markers(grid, sphere, velocity, parameters);
      // the period over, all is back
      const verification::InterfaceErrors errors = measured(result.front, ball),
                                          floor = measured(LevelSet(grid, sphere), ball);
      EXPECT_NEAR(errors.volume, floor.volume, 0.005);
      EXPECT_LT(errors.front, 0.06);
    }

    TEST(MarkerRun, RefusesWhatMakesNoSense)
    {
      MarkerRunParameters parameters;
      parameters.steps_at_rest = 0;
      EXPECT_THROW(run_markers(unit_grid(20), circle, at_rest, parameters),
                   cases::InputError);
      parameters = {};
      parameters.grid_offset = {NAN, 0, 0};
      EXPECT_THROW(run_markers(unit_grid(20), circle, at_rest, parameters),
                   cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles::level_set
