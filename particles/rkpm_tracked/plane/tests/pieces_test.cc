#include "cases.h"

#include <cases/error.h>
#include <particles/rkpm_tracked/plane/contour.h>
#include <particles/rkpm_tracked/plane/measure.h>
#include <particles/rkpm_tracked/plane/topology.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

using namespace meltfront;
using namespace meltfront::particles::rkpm_tracked;

namespace
{
  constexpr double pi = std::numbers::pi;

  TEST(PlaneFront, SplineOfACircleConverges)
  {
    std::vector<double> area, curvature;
    for(const int points : {12, 24, 48, 96})
    {
      const PlaneFront front = circle(0.7, points);
      area.push_back(std::abs(signed_area(front, 0) - 0.49 * pi));
      curvature.push_back(std::abs(front.curvature[0] * 0.7 - 1));
      for(std::size_t p = 0; p < front.size(); ++p)
        EXPECT_LT((front.normal[p] + front.position[p] / 0.7).norm(), 1e-12);
    }
    for(std::size_t level = 1; level < area.size(); ++level)
    {
      EXPECT_NEAR(std::log2(area[level - 1] / area[level]), 4, 0.2);
      EXPECT_NEAR(std::log2(curvature[level - 1] / curvature[level]), 2, 0.1);
    }
  }

  TEST(PlaneFront, RedistributionKeepsTheCurveAndItsSpeeds)
  {
    PlaneFront front;
    std::vector<PlanePoint> uneven;
    for(int i = 0; i < 60; ++i)
    {
      const double phi = 2 * pi * i / 60 + 0.04 * std::sin(2 * pi * i / 20);
      uneven.emplace_back(std::cos(phi), std::sin(phi));
    }
    front.add_curve(uneven);
    for(std::size_t p = 0; p < front.size(); ++p)
      front.speed[p] = front.position[p].x();
    redistribute(front, 0, 0.1);
    EXPECT_EQ(front.size(), 63u);
    const SpacingRange range = spacing_range(front);
    EXPECT_LT(range.largest / range.least, 1.001);
    for(std::size_t p = 0; p < front.size(); ++p)
    {
      EXPECT_NEAR(front.position[p].norm(), 1, 2e-6);
      EXPECT_NEAR(front.speed[p], front.position[p].x(), 1e-5);
    }
    EXPECT_EQ(redistribute(front, 0.1, 0.7, 1.35), 0u);
  }

  TEST(PlaneFront, OverlappingBodiesAreOne)
  {
    PlaneFront front = circle(0.5, 64, {-0.4, 0});
    const PlaneFront other = circle(0.5, 64, {0.4, 0});
    front.add_curve(other.position);
    const FrontIndex index(front, false, 0.05);
    EXPECT_EQ(index.winding({0, 0}), 2);
    EXPECT_EQ(index.winding({-0.6, 0}), 1);
    EXPECT_EQ(index.winding({0, 0.6}), 0);
    EXPECT_TRUE(index.solid({0, 0}));
    for(const double r : {0.42, 0.47, 0.52, 0.58})
      EXPECT_NEAR(index.signed_distance({-0.4 - r, 0}, 0.2), r - 0.5, 1e-4);
    EXPECT_EQ(index.signed_distance({-0.4, 2}, 0.2), 0.2);
  }

  TEST(PlaneContour, BodiesOfEitherPhaseAndTheirOrientation)
  {
    const PlaneLevelSet ring
        = [](const PlanePoint &p) { return std::max(p.norm() - 0.6, 0.3 - p.norm()); };
    const ContourGrid grid = contour_grid({-1, -1}, {1, 1}, 0.1, 0.05);
    const auto sampled = [&](const PlaneLevelSet &level_set)
    {
      std::vector<double> values;
      for(long j = 0; j < grid.rows; ++j)
        for(long i = 0; i < grid.columns; ++i)
          values.push_back(level_set(grid.node(i, j)));
      return find_contours(grid, values, level_set);
    };
    const Contours contours = sampled(ring);
    EXPECT_FALSE(contours.solid_beyond);
    const PlaneFront front = front_on_zeros(contours, ring, 0.1, 0.2);
    ASSERT_EQ(front.curves(), 2u);
    EXPECT_NEAR(signed_area(front, 0) + signed_area(front, 1), 0.27 * pi, 2e-4);
    for(std::size_t p = 0; p < front.size(); ++p)
      EXPECT_NEAR(ring(front.position[p]), 0, 1e-14);
    const PlaneLevelSet hole = [](const PlanePoint &p) { return 0.5 - p.norm(); };
    const Contours inverse = sampled(hole);
    EXPECT_TRUE(inverse.solid_beyond);
    const PlaneFront liquid = front_on_zeros(inverse, hole, 0.1, 0.2);
    ASSERT_EQ(liquid.curves(), 1u);
    EXPECT_NEAR(signed_area(liquid, 0), -0.25 * pi, 2e-4);
    EXPECT_NEAR(liquid.curvature[0], -2, 0.03);
  }

  TEST(PlaneNodes, AreasAndWallsAddUp)
  {
    const cases::Scene annulus = line_sink_annulus();
    const PlaneNodes round(annulus, 40, {});
    EXPECT_NEAR(std::accumulate(round.weight.begin(), round.weight.end(), 0.), pi * 0.96,
                1e-12);
    double length = 0;
    for(const WallNode &wall : round.walls)
      length += wall.pieces[0].length;
    EXPECT_NEAR(length, 2 * pi * 1.2, 1e-12);
    const cases::Scene box = merging_disks(1);
    const PlaneNodes straight(box, 20, {0.2, 3});
    EXPECT_EQ(straight.size(), 21u * 11u);
    EXPECT_NEAR(std::accumulate(straight.weight.begin(), straight.weight.end(), 0.), 2,
                1e-12);
    EXPECT_THROW(PlaneNodes(annulus, 3, {}), cases::Refusal);
  }

  /** Nodes of the annulus about a front, ready for stencils. */
  struct Surroundings
  {
    Surroundings(const cases::Scene &scene, int n, PlaneFront given, double jitter = 0)
      : nodes(scene, n, {jitter, 5})
      , front(std::move(given))
      , index(front, false, nodes.spacing)
      , maker(nodes, 2)
    {
      for(const PlanePoint &place : nodes.position)
        phases.push_back(index.solid(place) ? NodePhase::solid : NodePhase::liquid);
      maker.set_front(front, index, phases);
    }

    PlaneNodes nodes;
    PlaneFront front;
    FrontIndex index;
    std::vector<NodePhase> phases;
    StencilMaker maker;
  };

  TEST(PlaneStencils, QuadraticsAreReproducedInEitherPhase)
  {
    const cases::Scene scene = line_sink_annulus();
    const auto quadratic = [](const PlanePoint &p)
    { return 1 + 2 * p.x() - p.y() + 3 * p.x() * p.x() - p.x() * p.y() + p.y() * p.y(); };
    for(const double jitter : {0., 0.3})
    {
      Surroundings around(scene, 40, circle(0.47, 52), jitter);
      std::vector<double> values;
      for(const PlanePoint &place : around.nodes.position)
        values.push_back(quadratic(place));
      for(const PlanePoint &place : around.front.position)
        values.push_back(quadratic(place));
      PlaneStencil stencil;
      for(std::size_t p = 0; p < around.front.size(); ++p)
        for(const NodePhase phase : {NodePhase::liquid, NodePhase::solid})
        {
          const PlanePoint &at = around.front.position[p];
          around.maker.make(at, phase, stencil);
          EXPECT_EQ(stencil.order, 2);
          EXPECT_NEAR(stencil.apply(value_of, values), quadratic(at), 1e-11);
          EXPECT_NEAR(stencil.apply(d_x, values), 2 + 6 * at.x() - at.y(), 1e-9);
          EXPECT_NEAR(stencil.apply(d_y, values), -1 - at.x() + 2 * at.y(), 1e-9);
          EXPECT_NEAR(stencil.apply(d_xx, values), 6, 1e-7);
          EXPECT_NEAR(stencil.apply(d_xy, values), -1, 1e-7);
          EXPECT_NEAR(stencil.apply(d_yy, values), 2, 1e-7);
          EXPECT_LT(around.maker.condition_number(), 1e5);
          for(const std::uint32_t column : stencil.columns)
            if(column < around.nodes.size())
            {
              EXPECT_EQ(around.phases[column], phase);
            }
        }
    }
  }

  TEST(PlaneStencils, NodesUpToOnTheFrontDoNoHarm)
  {
    const cases::Scene scene = merging_disks(1);
    for(const double beside : {0., 1e-12, 1e-6, 1e-3})
    {
      // The lattice has a node at (0.5, 0), on the front's first particle.
      Surroundings around(scene, 40, circle(0.5 + 0.05 * beside, 54));
      PlaneStencil stencil;
      for(const NodePhase phase : {NodePhase::liquid, NodePhase::solid})
      {
        around.maker.make(around.front.position[0], phase, stencil);
        EXPECT_EQ(stencil.order, 2);
        EXPECT_LT(around.maker.condition_number(), 1e5);
        for(const double weight : stencil.weights[d_x])
          EXPECT_LT(std::abs(weight), 3 / 0.05);
      }
    }
  }

  TEST(PlaneStencils, AnotherBodyBeyondAFilmIsNotSeen)
  {
    const cases::Scene scene = merging_disks(1);
    PlaneFront front = circle(0.33, 36, {-0.36, 0});
    const PlaneFront other = circle(0.33, 36, {0.36, 0});
    front.add_curve(other.position);
    Surroundings around(scene, 40, front);
    PlaneStencil stencil;
    around.maker.make(around.front.position[0], NodePhase::solid, stencil);
    for(const std::uint32_t column : stencil.columns)
    {
      const PlanePoint &place = column < around.nodes.size()
                                    ? around.nodes.position[column]
                                    : around.front.position[column - around.nodes.size()];
      EXPECT_LT(place.x(), 0);
    }
  }

  /** Largest relative error of the speeds that the exact state makes at the start. */
  double speed_error(const cases::Scene &scene, int n)
  {
    const PlaneNodes nodes(scene, n, {});
    PlaneHeatSettings settings;
    settings.solid_beyond = false;
    PlaneHeat heat(scene, nodes, settings);
    const double radius = scene.initial.exact->front(scene.start_time);
    PlaneState state;
    state.time = scene.start_time;
    state.front
        = circle(radius, static_cast<int>(2 * pi * radius / (1.15 * nodes.spacing)));
    heat.set_front(state);
    for(const PlanePoint &place : nodes.position)
      state.unknown.push_back(
          scene.initial.temperature({place.x(), place.y(), 0}, scene.start_time));
    heat.expand(state);
    const double exact = -radius / (2 * scene.start_time);
    double largest = 0;
    for(const double speed : state.front.speed)
      largest = std::max(largest, std::abs(speed / exact - 1));
    return largest;
  }

  TEST(PlaneHeat, SpeedsOfTheExactStateConverge)
  {
    const cases::Scene sink = line_sink_annulus(), frank = frank_disk(0.25);
    const double coarse = speed_error(sink, 40), fine = speed_error(sink, 80);
    EXPECT_LT(coarse, 0.036);
    EXPECT_LT(fine, 0.0085);
    EXPECT_GT(std::log2(coarse / fine), 1.7);
    const double first = speed_error(frank, 20), second = speed_error(frank, 40),
                 third = speed_error(frank, 80);
    EXPECT_GT(std::log2(first / second), 1.4);
    EXPECT_GT(std::log2(second / third), 1.6);
    EXPECT_LT(third, 0.035);
  }

  // Else the balance of the first step after an event would have to make up for heat that
  // no time brings, the more power the shorter it is.
  TEST(PlaneHeat, AnExpandedStateLosesNoHeatInNoTime)
  {
    const PlanePoint middle(0.5, 0.5);
    const PlaneFunction temperature = [&](const cases::Position &place)
    { return std::hypot(place[0] - middle.x(), place[1] - middle.y()) - 0.3; };
    const cases::Scene scene = insulated_box({1, 1}, temperature, temperature, 1);
    const PlaneNodes nodes(scene, 20, {});
    PlaneHeatSettings settings;
    settings.solid_beyond = false;
    PlaneHeat heat(scene, nodes, settings);
    PlaneState state;
    state.front = circle(0.3, 33, middle);
    heat.set_front(state);
    for(const PlanePoint &place : nodes.position)
      state.unknown.push_back(temperature({place.x(), place.y(), 0}));
    heat.expand(state);
    const auto stored = [&](const PlaneState &of)
    {
      const PlaneMeasure found = measure(scene, nodes, heat, of);
      return found.sensible + found.latent;
    };
    const auto change = [&](double duration)
    {
      PlaneState next;
      next.front = state.front;
      next.expansion = state.expansion;
      heat.set_front(next);
      const PlaneStep step(state, nullptr, duration);
      const std::vector<double> ways
          = heat.apply(step, heat.solve(step, next).value(), 0, next);
      for(std::size_t p = 0; p < ways.size(); ++p)
        next.front.position[p] += ways[p] * next.front.normal[p];
      update_geometry(next.front);
      return std::abs(stored(next) - stored(state));
    };
    const double longer = change(1e-5), shorter = change(1e-7);
    EXPECT_LT(longer, 1e-5);
    EXPECT_NEAR(shorter / longer, 0.01, 1e-3);
  }

  TEST(PlaneTopology, SmallBodiesGoAndNearOnesJoin)
  {
    const cases::Scene scene = merging_disks(1);
    const PlaneNodes nodes(scene, 40, {});
    TopologySettings settings;
    settings.spacing = nodes.spacing;
    settings.front_spacing = 1.15 * nodes.spacing;
    bool solid_beyond = false;
    MarkedFront marked(nodes, 1);
    PlaneFront speck = circle(0.3 * nodes.spacing, 8, {0.1, 0.1});
    marked.seed(speck, solid_beyond);
    const auto gone = update_topology(speck, nodes, marked, solid_beyond, settings);
    ASSERT_EQ(gone.size(), 1u);
    EXPECT_TRUE(gone[0].vanished);
    EXPECT_EQ(speck.size(), 0u);
    for(const double gap : {0.5, 0.05, -0.3}) // in spacings
    {
      const double radius = 0.36 - gap * nodes.spacing / 2;
      PlaneFront front = circle(radius, 40, {-0.36, 0});
      front.add_curve(circle(radius, 40, {0.36, 0}).position);
      const double area = signed_area(front, 0) + signed_area(front, 1);
      marked.seed(front, solid_beyond);
      const auto events = update_topology(front, nodes, marked, solid_beyond, settings);
      EXPECT_EQ(front.curves(), gap > 0.2 ? 2u : 1u) << gap;
      EXPECT_EQ(events.empty(), gap > 0.2);
      double after = 0;
      for(std::size_t c = 0; c < front.curves(); ++c)
        after += signed_area(front, c);
      if(gap > 0)
      {
        EXPECT_NEAR(after, area, nodes.spacing * nodes.spacing);
      }
      else
      {
        EXPECT_LT(after, area);
      }
    }
  }

  TEST(MarkedFront, GoesAlongWithTheParticles)
  {
    const cases::Scene scene = merging_disks(1);
    const PlaneNodes nodes(scene, 40, {});
    PlaneFront front = circle(0.2, 24);
    MarkedFront marked(nodes, 1);
    marked.seed(front, false);
    EXPECT_LT(marked.mismatch(front), 1e-3 * nodes.spacing);
    for(long step = 1; step <= 20; ++step)
    {
      std::vector<PlanePoint> ways;
      for(const PlanePoint &normal : front.normal)
        ways.push_back(-0.2 * nodes.spacing * normal);
      PlaneFront moved = front;
      for(std::size_t p = 0; p < front.size(); ++p)
        moved.position[p] += ways[p];
      update_geometry(moved);
      marked.carry(front, ways, step, 0);
      front = std::move(moved);
    }
    // From 0.2 to 0.4 in twenty steps.
    EXPECT_LT(marked.mismatch(front), 2e-3 * nodes.spacing);
    PlaneFront beside = front;
    for(std::size_t p = 0; p < beside.size(); ++p)
      beside.position[p] += 0.05 * nodes.spacing * beside.normal[p];
    marked.reproject(beside, std::vector<PlanePoint>(beside.size(), PlanePoint(1, 0)));
    for(std::size_t p = 0; p < beside.size(); ++p)
      EXPECT_NEAR(beside.position[p].norm(), 0.4, 3e-3 * nodes.spacing);
    EXPECT_EQ(marked.contours().curves.size(), 1u);
    EXPECT_FALSE(marked.contours().solid_beyond);
  }

  TEST(PlaneTopology, StepsHalveTheGapsThatClose)
  {
    TopologySettings settings;
    settings.spacing = 0.05;
    settings.front_spacing = 0.0575;
    PlaneFront front = circle(0.35, 38, {-0.36, 0});
    front.add_curve(circle(0.35, 38, {0.36, 0}).position);
    EXPECT_TRUE(std::isinf(longest_step_of_films(front, settings)));
    std::ranges::fill(front.speed, -1.); // freezing: the liquid between closes
    EXPECT_NEAR(longest_step_of_films(front, settings), 0.005, 5e-4);
    std::ranges::fill(front.speed, 1.);
    EXPECT_TRUE(std::isinf(longest_step_of_films(front, settings)));
  }

  TEST(PlaneTopology, LatentHeatGoesIntoTheNearestNodes)
  {
    cases::Scene scene = merging_disks(1);
    scene.sources.clear();
    const PlaneNodes nodes(scene, 40, {});
    PlaneHeatSettings settings;
    settings.solid_beyond = false;
    PlaneHeat heat(scene, nodes, settings);
    PlaneState state;
    heat.set_front(state);
    state.unknown.assign(nodes.size(), 0.2);
    const auto stored = [&]
    {
      const PlaneMeasure found = measure(scene, nodes, heat, state);
      return found.sensible + found.latent;
    };
    const double before = stored();
    const PlanePoint middle(0, 0);
    EXPECT_NEAR(book_heat(state, scene, nodes, heat, {middle}, before - 1e-3), 0, 1e-14);
    EXPECT_NEAR(stored() - before, -1e-3, 1e-14);
    double sum = 0;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      EXPECT_GE(state.unknown[i], 0.1 - 1e-12);
      sum += nodes.weight[i] * (state.unknown[i] - 0.2);
      if(nodes.position[i].norm() > 3 * nodes.spacing)
      {
        EXPECT_EQ(state.unknown[i], 0.2);
      }
    }
    EXPECT_NEAR(sum, -1e-3, 1e-14);
    // Nothing is below the melting temperature that could give way: all get warmer.
    const double now = stored();
    const std::vector<double> known = state.unknown;
    EXPECT_NEAR(book_heat(state, scene, nodes, heat, {middle}, now + 1e-3), 0, 1e-14);
    EXPECT_NEAR(stored() - now, 1e-3, 1e-14);
    const auto farther = [&](std::size_t i) { return state.unknown[i] - known[i]; };
    double least = 1, most = 0;
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(nodes.wall_of_node[i] < 0 && nodes.position[i].norm() > 3 * nodes.spacing)
      {
        least = std::min(least, farther(i));
        most = std::max(most, farther(i));
      }
    EXPECT_GT(least, 0);
    EXPECT_NEAR(most, least, 1e-12);
    // Nor is a place known: all come nearer, by the same share.
    EXPECT_NEAR(book_heat(state, scene, nodes, heat, {}, now), 0, 1e-14);
    EXPECT_NEAR(stored(), now, 1e-14);
  }
} // namespace
