#include "cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace meltfront;
using namespace meltfront::particles::rkpm_tracked;

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

  void expect_all_molten(const PlaneRecord &record)
  {
    for(std::size_t i = 1; i < record.frames.size(); ++i)
    {
      EXPECT_LE(record.frames[i].solid_area, record.frames[i - 1].solid_area + 1e-12);
      EXPECT_LT(record.frames[i].defect, 1e-10) << record.frames[i].time;
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
    expect_all_molten(record);
    // The last of it goes at once, and may be there until it had melted as it did before.
    const double disk = std::numbers::pi * std::pow(0.35 * 2 / 20, 2);
    const auto gone
        = std::ranges::find(record.frames, 0., &PlaneRecord::Frame::solid_area);
    ASSERT_NE(gone, record.frames.end());
    double largest = 0;
    for(auto frame = record.frames.begin(); frame != record.frames.end(); ++frame)
      if(frame < gone)
        EXPECT_EQ(frame->vanished, 0);
      else
        largest = std::max(largest, frame->vanished);
    EXPECT_LE(largest, disk);
    EXPECT_GT(largest, 0);
    EXPECT_EQ(record.frames.back().vanished, 0);
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
    expect_all_molten(record);
    EXPECT_GE(record.notes.size(), 1u);
  }

  /** A dumb-bell melts through at its neck, and both halves go at the same time. */
  TEST(PlaneEvents, NeckPinchesOff)
  {
    const auto front = [](const cases::Position &p)
    {
      const double x = std::abs(p[0]);
      const double ends = std::hypot(x - 0.45, p[1]) - 0.28;
      const double neck = std::max(std::abs(p[1]) - 0.08, x - 0.45);
      return std::min(ends, neck);
    };
    const cases::Scene scene = insulated_box(
        {1, 0.6, 0}, front, [=](const auto &p) { return warmth(front(p)); }, 0.15);
    const PlaneRecord record = run_plane(scene, 40);
    expect_all_molten(record);
    ASSERT_GE(record.notes.size(), 2u);
    EXPECT_NE(record.notes[0].find("fronts met"), std::string::npos);
    EXPECT_NE(record.notes[0].find("1 curves became 2"), std::string::npos);
  }

  /** Ice around a sink beside a wall reaches it, shuts liquid in and freezes all. */
  TEST(PlaneEvents, IceReachesWallsAndFreezesTheLastLiquid)
  {
    const cases::Position sink{0.31, 0.17, 0};
    const double start = 0.2;
    const auto distance = [=](const cases::Position &p)
    { return std::hypot(p[0] - sink[0], p[1] - sink[1]) - start; };
    const auto temperature = [=](const cases::Position &p)
    {
      const double d = distance(p);
      return d < 0 ? std::log(std::max(d + start, 1e-12) / start) / std::numbers::pi
                   : 0.2 * (1 - std::exp(-4 * d));
    };
    cases::Scene scene = insulated_box({0.6, 0.6, 0}, distance, temperature, 1.4);
    cases::PointSource source;
    source.position = sink;
    source.power = [](double) { return -2.; };
    source.energy = [](double time) { return -2 * time; };
    scene.sources.push_back(source);
    const PlaneRecord record = run_plane(scene, 33);
    for(std::size_t i = 1; i < record.frames.size(); ++i)
    {
      EXPECT_GE(record.frames[i].solid_area, record.frames[i - 1].solid_area - 1e-9);
      EXPECT_LT(record.frames[i].defect, 1e-10) << record.frames[i].time;
    }
    EXPECT_NEAR(record.frames.back().solid_area, 1.44, 1e-12);
    EXPECT_EQ(record.frames.back().front_points, 0u);
    EXPECT_LT(record.frames.back().hottest, 0);
  }

  /** The last front leaves through the hole, where it is a small curve. */
  TEST(PlaneEvents, FreezesUpToAHole)
  {
    cases::Scene scene = insulated_box(
        {1, 1, 0}, [](const auto &p) { return 0.43 - around(p); },
        [](const auto &p) { return 1.335 * std::max(0.43 - around(p), 0.); }, 0.25);
    scene.domain.shape = cases::DomainShape::shell;
    scene.domain.inner_radius = 0.29;
    scene.domain.radius = 1;
    scene.boundaries[static_cast<std::size_t>(cases::Side::inner)] = cases::Boundary();
    scene.boundaries[static_cast<std::size_t>(cases::Side::outer)]
        = {cases::BoundaryKind::fixed_temperature, cases::Field::uniform(-0.65)};
    const PlaneRecord record = run_plane(scene, 34);
    const PlaneRecord::Frame &end = record.frames.back();
    EXPECT_EQ(end.front_points, 0u);
    EXPECT_NEAR(end.solid_area / (std::numbers::pi * (1 - 0.29 * 0.29)), 1, 1e-12);
    EXPECT_LT(end.defect, 1e-3);
    EXPECT_LT(end.hottest, 0);
    ASSERT_FALSE(record.notes.empty());
    EXPECT_NE(record.notes.back().find("all is solid"), std::string::npos);
  }

  TEST(PlaneEvents, DisksOfIceMerge)
  {
    const PlaneRecord record = run_plane(merging_disks(0.36), 40);
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
    EXPECT_NEAR(area_at(0.25), 0.87184, 0.01 * 0.87184);
    // fem-enthalpy, n = 256.
    EXPECT_NEAR(record.frames.back().solid_area, 1.2188, 0.01 * 1.2188);
    for(const PlaneRecord::Frame &frame : record.frames)
      EXPECT_LT(frame.defect, 1e-10);
    EXPECT_FALSE(record.notes.empty());
  }
} // namespace
