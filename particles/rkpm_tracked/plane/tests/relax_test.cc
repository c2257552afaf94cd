#include "cases.h"

#include <particles/rkpm_tracked/plane/relax.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace meltfront;
using namespace meltfront::particles::rkpm_tracked;

namespace
{
  constexpr double radius = 0.437;

  /** A disk of solid in a box of liquid; its front moves with one speed. */
  struct Disk
  {
    explicit Disk(int n, double jitter = 0)
      : scene(insulated_box(
          {1, 1, 0}, [](const auto &p) { return std::hypot(p[0], p[1]) - radius; },
          [](const auto &) { return 0.; }, 1))
      , nodes(scene, n, {jitter, 1})
      , heat(scene, nodes, {})
    {
      heat.settings.solid_beyond = false;
    }

    PlaneState state(double at, double speed, int points = 0)
    {
      PlaneState result;
      const double apart = 1.15 * nodes.spacing;
      result.front
          = circle(at, points > 0 ? points : static_cast<int>(2 * M_PI * at / apart));
      std::ranges::fill(result.front.speed, speed);
      heat.set_front(result);
      return result;
    }

    cases::Scene scene;
    PlaneNodes nodes;
    PlaneHeat heat;
  };

  double least_distance(const std::vector<PlanePoint> &points)
  {
    double least = 1e300;
    for(std::size_t i = 0; i < points.size(); ++i)
      for(std::size_t j = 0; j < i; ++j)
        least = std::min(least, (points[i] - points[j]).norm());
    return least;
  }

  TEST(PlaneRelaxation, NodesKeepPhaseAndDistanceAsAFrontPasses)
  {
    for(const double way : {0.06, -0.06, 0.25})
    {
      Disk disk(30, 0.2);
      PlaneNodes &nodes = disk.nodes;
      const double h = nodes.spacing;
      PlaneRelaxation relaxation(nodes, RelaxRule::springs, 1);
      double at = radius;
      std::vector<double> near_share;
      for(int step = 0; step < 12; ++step, at -= way * h)
      {
        const PlaneState state = disk.state(at, way * h);
        const std::vector<PlanePoint> places = relaxation.places(state, false, 1.);
        const FrontIndex index(state.front, false, h);
        long near = 0, about = 0;
        for(std::size_t i = 0; i < nodes.size(); ++i)
        {
          EXPECT_EQ(index.solid(places[i]), index.solid(nodes.position[i]));
          EXPECT_LT((places[i] - nodes.position[i]).norm(), h);
          if(nodes.wall_of_node[i] >= 0)
          {
            EXPECT_EQ(places[i], nodes.position[i]);
          }
          near += std::abs(index.signed_distance(places[i], h)) < 0.35 * h;
          about += std::abs(index.signed_distance(places[i], 2 * h)) < h;
        }
        // Those that wait to be passed; at rest it would be a third.
        EXPECT_LE(static_cast<double>(near),
                  (1.5 * std::abs(way) + 0.02) * static_cast<double>(about));
        EXPECT_GT(least_distance(places), 0.29 * h);
        nodes.move(places);
      }
    }
  }

  TEST(PlaneRelaxation, SameBitsForAnyNumberOfThreads)
  {
    std::vector<std::vector<PlanePoint>> found;
    std::vector<std::vector<double>> values;
    for(const int threads : {1, 2, 3})
    {
      Disk disk(24, 0.2);
      PlaneState state = disk.state(radius, 0.3 * disk.nodes.spacing);
      for(const PlanePoint &place : disk.nodes.position)
        state.unknown.push_back(place.norm() - radius);
      PlaneRelaxation relaxation(disk.nodes, RelaxRule::springs, threads);
      found.push_back(relaxation.places(state, false, 1.));
      relaxation.resample(found.back(), disk.heat, state);
      values.push_back(state.unknown);
    }
    for(std::size_t k = 1; k < found.size(); ++k)
    {
      EXPECT_EQ(found[k], found[0]);
      EXPECT_EQ(values[k], values[0]);
    }
  }

  /** Largest error of relaxed nodes' temperatures, of those that moved. */
  double resampling_error(int n, const std::function<double(double)> &solid,
                          const std::function<double(double)> &liquid)
  {
    Disk disk(n);
    PlaneState state = disk.state(radius, 0);
    const auto exact = [&](const PlanePoint &place)
    { return (place.norm() < radius ? solid : liquid)(place.squaredNorm()); };
    for(const PlanePoint &place : disk.nodes.position)
      state.unknown.push_back(exact(place));
    PlaneRelaxation relaxation(disk.nodes, RelaxRule::springs, 1);
    const std::vector<PlanePoint> places = relaxation.places(state, false, 1.);
    relaxation.resample(places, disk.heat, state);
    double error = 0;
    std::size_t moved = 0;
    for(std::size_t i = 0; i < places.size(); ++i)
      if(places[i] != disk.nodes.position[i])
      {
        ++moved;
        error = std::max(error, std::abs(state.unknown[i] - exact(places[i])));
      }
    EXPECT_GT(moved, disk.nodes.size() / 40);
    return error;
  }

  TEST(PlaneRelaxation, TemperaturesMoveWithinTheirPhase)
  {
    const double melted = radius * radius;
    // Parabolas on either side with a kink between them: exact.
    EXPECT_LT(resampling_error(
                  24, [=](double r2) { return 3 * (r2 - melted); },
                  [=](double r2) { return 20 * (r2 - melted); }),
              1e-11);
    std::vector<double> errors;
    for(const int n : {16, 24, 36, 54})
      errors.push_back(resampling_error(
          n, [=](double r2) { return std::sin(3 * (r2 - melted)); },
          [=](double r2) { return std::exp(r2 - melted) - 1; }));
    EXPECT_GT(test_support::fitted_order(std::vector<int>{16, 24, 36, 54}, errors), 2.8);
    EXPECT_LT(errors.back(), 2e-5);
  }

  TEST(PlaneRelaxation, RowsAndAreasAreThoseOfNodesLaidThere)
  {
    const auto solve = [](bool move_after)
    {
      Disk disk(24);
      const auto begin = [&](PlaneHeat &heat)
      {
        PlaneState state = disk.state(radius, 0);
        heat.settings.solid_beyond = false;
        heat.set_front(state);
        for(const PlanePoint &place : disk.nodes.position)
          state.unknown.push_back(3 * (place.squaredNorm() - radius * radius));
        heat.expand(state);
        return state;
      };
      begin(disk.heat); // makes rows
      PlaneRelaxation relaxation(disk.nodes, RelaxRule::springs, 1);
      const std::vector<PlanePoint> before = disk.nodes.position;
      disk.nodes.move(relaxation.places(disk.state(radius, 0), false, 1.));
      EXPECT_NE(before, disk.nodes.position);
      disk.heat.nodes_moved(before);
      PlaneHeat restarted(disk.scene, disk.nodes, {});
      PlaneHeat &heat = move_after ? disk.heat : restarted;
      const PlaneState last = begin(heat);
      PlaneState next = begin(heat);
      next.unknown.clear(); // as in the first pass of a step
      const PlaneStep step(last, nullptr, 0.01);
      const auto solution = heat.solve(step, next);
      heat.apply(step, solution.value(), 0, next);
      return next.unknown;
    };
    EXPECT_EQ(solve(true), solve(false));
  }

  TEST(PlaneRelaxation, AreasFollow)
  {
    Disk disk(24);
    PlaneNodes &nodes = disk.nodes;
    PlaneRelaxation relaxation(nodes, RelaxRule::springs, 1);
    nodes.move(relaxation.places(disk.state(radius, 0), false, 1.));
    double sum = 0;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      sum += nodes.weight[i];
      for(std::size_t s = nodes.sample_offsets[i]; s < nodes.sample_offsets[i + 1]; ++s)
      {
        const double own = (nodes.samples[s] - nodes.position[i]).norm();
        const long nearest = nodes.bins.nearest(nodes.samples[s]);
        EXPECT_LE(own, (nodes.samples[s] - nodes.position[nearest]).norm()
                           + 1e-6 * nodes.spacing);
      }
    }
    EXPECT_NEAR(sum, nodes.area, 1e-12);
  }

  TEST(PlaneRelaxation, LineSinkConvergesAndIsRounder)
  {
    const cases::Scene scene = line_sink_annulus();
    std::vector<double> errors;
    const std::vector<int> levels{14, 20, 28, 40};
    for(const int n : levels)
    {
      const PlaneRecord record = run_plane(scene, n, {{"relax", "1"}});
      const PlaneRecord::Frame &end = record.frames.back();
      EXPECT_EQ(end.time, scene.end_time);
      errors.push_back(std::abs(end.mean_radius - 0.6));
      if(n == 40)
      {
        EXPECT_LE(errors.back(), 2e-3);
        EXPECT_LE(end.roundness, 7e-4);
      }
    }
    EXPECT_GT(test_support::fitted_order(levels, errors), 1.7);
  }

  TEST(PlaneRelaxation, BodiesThatVanishAreSurvived)
  {
    const cases::Scene scene = insulated_box(
        {1, 1, 0}, [](const auto &p) { return std::hypot(p[0], p[1]) - 0.3; },
        [](const auto &p)
        {
          const double distance = std::hypot(p[0], p[1]) - 0.3;
          return distance < 0 ? 0. : 1.5 * (1 - std::exp(-4 * distance));
        },
        0.4);
    const PlaneRecord record = run_plane(scene, 20, {{"relax", "1"}});
    EXPECT_EQ(record.frames.back().solid_area, 0);
    EXPECT_LT(record.frames.back().defect, 1e-10);
    EXPECT_FALSE(record.notes.empty());
  }
} // namespace
