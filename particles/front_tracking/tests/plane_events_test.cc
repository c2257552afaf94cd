#include "plane_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace meltfront;
using namespace meltfront::particles::front_tracking;

namespace
{
  /** Distance of a round body from an origin. */
  double around(const cases::Position &p)
  {
    return std::hypot(p[0], p[1]);
  }

  double warmth(double distance)
  {
    return distance < 0 ? 0. : 1.5 * (1 - std::exp(-4 * distance));
  }

  void expect_all_molten(const PlaneRecord &record, double defect)
  {
    for(std::size_t i = 1; i < record.frames.size(); ++i)
    {
      EXPECT_LE(record.frames[i].solid_area, record.frames[i - 1].solid_area + 1e-12);
      EXPECT_LT(record.frames[i].defect, defect) << record.frames[i].time;
    }
    const PlaneRecord::Frame &end = record.frames.back();
    EXPECT_EQ(end.solid_area, 0);
    EXPECT_EQ(end.front_points, 0u);
    EXPECT_GT(end.coldest, 0);
  }

  TEST(PlaneEvents, DiskMeltsToNothingWithItsHeat)
  {
    const cases::Scene scene = insulated_box(
        {1, 1, 0}, [](const auto &p) { return around(p) - 0.5; },
        [](const auto &p) { return warmth(around(p) - 0.5); }, 0.3);
    const PlaneRecord record = run_plane(scene, 20);
    expect_all_molten(record, 1.5e-3);
    ASSERT_EQ(record.notes.size(), 1u);
    EXPECT_NE(record.notes[0].find("vanished"), std::string::npos);
  }

  TEST(PlaneEvents, RingMeltsFromBothSides)
  {
    const auto front
        = [](const auto &p) { return std::max(around(p) - 0.6, 0.35 - around(p)); };
    const cases::Scene scene = insulated_box(
        {1, 1, 0}, front, [=](const auto &p) { return warmth(front(p)); }, 0.3);
    const PlaneRecord record = run_plane(scene, 24);
    expect_all_molten(record, 2e-3);
    EXPECT_GE(record.notes.size(), 1u);
  }

  TEST(PlaneEvents, DisksOfIceMerge)
  {
    const PlaneRecord record = run_plane(merging_disks(0.25), 40);
    for(std::size_t i = 1; i < record.frames.size(); ++i)
      EXPECT_GE(record.frames[i].solid_area,
                record.frames[i - 1].solid_area * (1 - 1e-9));
    const auto area_at = [&](double time)
    {
      for(std::size_t i = 1; i < record.frames.size(); ++i)
        if(record.frames[i].time >= time)
        {
          const auto &a = record.frames[i - 1], &b = record.frames[i];
          return a.solid_area
                 + (b.solid_area - a.solid_area) * (time - a.time) / (b.time - a.time);
        }
      return 0.;
    };
    // fem-cut, n = 64, before and after the fronts meet.
    EXPECT_NEAR(area_at(0.1), 0.39540, 0.01 * 0.39540);
    EXPECT_NEAR(area_at(0.2), 0.70917, 0.01 * 0.70917);
    EXPECT_NEAR(record.frames.back().solid_area, 0.87184, 0.01 * 0.87184);
    EXPECT_FALSE(record.notes.empty());
  }
} // namespace
