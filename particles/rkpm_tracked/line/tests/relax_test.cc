#include <particles/rkpm_tracked/line/relax.h>
#include <particles/rkpm_tracked/line/tests/cases.h>
#include <particles/rkpm_tracked/rkpm_tracked.h>

#include <cases/effects.h>
#include <cases/exact/planar_neumann.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    LineProblem slab(int n, double jitter = 0)
    {
      return unit_slab(
          bar_material(), n, [](double) { return hot; }, [](double) { return cold; },
          jitter);
    }

    LineState fronts_at(const LineProblem &problem, std::vector<double> fronts,
                        std::vector<double> speed)
    {
      LineState state;
      state.solid_first = false;
      state.fronts = std::move(fronts);
      state.speed = std::move(speed);
      state.temperature.assign(problem.nodes.size(), 0.);
      return state;
    }

    double distance_to_front(const std::vector<double> &nodes, double front)
    {
      double least = 1;
      for(const double x : nodes)
        least = std::min(least, std::abs(x - front));
      return least;
    }

    TEST(NodeRelaxation, LatticeIsAtRestAndCloseNodesPart)
    {
      ParticleStorage moving, homes, fixed;
      moving.dimension = homes.dimension = fixed.dimension = 2;
      for(int i = 1; i < 8; ++i)
        for(int j = 1; j < 8; ++j)
          moving.add({i * 0.1, j * 0.1, 0});
      homes = moving;
      CoordinateBox box;
      box.dimension = 2;
      box.upper = {0.8, 0.8, 0};
      fixed.add({0.4, 0, 0});
      const ParticleStorage lattice = moving;
      relax_phase(moving, homes, fixed, box, {RelaxRule::springs, 0.1, 1});
      for(std::size_t i = 0; i < moving.size(); ++i)
        for(int d = 0; d < 2; ++d)
          EXPECT_NEAR(moving.position[d][i], lattice.position[d][i], 1e-12);
      fixed.add({0.42, 0.41, 0});
      const Descent descent
          = relax_phase(moving, homes, fixed, box, {RelaxRule::springs, 0.1, 1});
      EXPECT_LT(descent.energy, descent.energy_before);
      for(std::size_t i = 0; i < moving.size(); ++i)
        EXPECT_GT(std::hypot(moving.position[0][i] - 0.42, moving.position[1][i] - 0.41),
                  0.065);
    }

    TEST(LineRelaxation, NodesKeepPhaseOrderAndDistanceAsAFrontPasses)
    {
      for(const double jitter : {0., 0.2})
        for(const double way : {0.06, -0.06, 0.3})
        {
          LineProblem problem = slab(40, jitter);
          const double h = problem.spacing;
          LineRelaxation relaxation(problem, RelaxRule::springs);
          double front = way > 0 ? 0.303 : 0.703;
          int near = 0, steps = 0;
          for(; std::abs(front - 0.503) > 0.01; ++steps)
          {
            const LineState state = fronts_at(problem, {front}, {way * h});
            const std::vector<double> places = relaxation.places(problem, state, 1.);
            EXPECT_TRUE(std::ranges::is_sorted(places));
            EXPECT_EQ(places.front(), 0);
            EXPECT_EQ(places.back(), 1);
            for(std::size_t i = 0; i < places.size(); ++i)
              EXPECT_EQ(places[i] < front, problem.nodes[i] < front);
            near += distance_to_front(places, front) < 0.4 * h;
            problem.nodes = places;
            front += way * h;
          }
          // One node is near while it waits to be passed, once in each spacing.
          EXPECT_GT(near, 0);
          EXPECT_LE(near, 1.3 * steps * std::abs(way) + 1);
        }
    }

    TEST(LineRelaxation, NodesGoHomeBehindTheFront)
    {
      LineProblem problem = slab(40);
      const std::vector<double> laid = problem.nodes;
      const auto farthest = [&](double upto)
      {
        double result = 0;
        for(std::size_t i = 0; i < laid.size(); ++i)
          if(laid[i] < upto)
            result = std::max(result, std::abs(problem.nodes[i] - laid[i]));
        return result / problem.spacing;
      };
      LineRelaxation relaxation(problem, RelaxRule::springs);
      double ever = 0;
      for(double front = 0.303; front < 0.6; front += 0.002)
      {
        problem.nodes
            = relaxation.places(problem, fronts_at(problem, {front}, {0.002}), 1.);
        ever = std::max(ever, farthest(1));
      }
      EXPECT_GT(ever, 0.3);
      EXPECT_LT(ever, 1);
      EXPECT_LT(farthest(0.38), 0.02);
    }

    TEST(LineRelaxation, PublishedPotentialLetsNoNodePass)
    {
      LineProblem problem = slab(40);
      LineRelaxation relaxation(problem, RelaxRule::lennard_jones);
      double front = 0.303;
      const auto passed = [&] {
        return std::ranges::count_if(problem.nodes, [&](double x) { return x < front; });
      };
      const auto before = passed();
      for(; front < 0.4; front += 0.002)
        problem.nodes
            = relaxation.places(problem, fronts_at(problem, {front}, {0.002}), 1.);
      EXPECT_EQ(passed(), before);
    }

    TEST(LineResample, PolynomialsAreExactAcrossAKink)
    {
      const auto below = [](double x) { return 430 - 90 * (x - 0.43) * (1 + x * x); };
      const auto above = [](double x) { return 430 + 40 * (x - 0.43) * (x - 2) * x; };
      LineProblem problem = slab(20, 0.3);
      LineState state = fronts_at(problem, {0.43}, {0});
      for(std::size_t i = 0; i < problem.nodes.size(); ++i)
        state.temperature[i]
            = (problem.nodes[i] < 0.43 ? below : above)(problem.nodes[i]);
      std::vector<double> places = problem.nodes;
      for(std::size_t i = 1; i + 1 < places.size(); ++i)
        places[i] += (i % 2 == 0 ? 0.3 : -0.25) * problem.spacing;
      const LineState kept = state;
      resample(problem, problem.nodes, 3, state);
      EXPECT_EQ(state.temperature, kept.temperature);
      resample(problem, places, 3, state);
      for(std::size_t i = 0; i < places.size(); ++i)
        EXPECT_NEAR(state.temperature[i], (places[i] < 0.43 ? below : above)(places[i]),
                    1e-9);
    }

    TEST(LineResample, ErrorIsOfOneOrderMoreThanTheDegree)
    {
      const auto field = [](double x) { return 430 + 50 * std::atan(4 * (0.51 - x)); };
      for(const std::size_t degree : {3, 5})
      {
        std::vector<double> errors;
        for(const int n : {20, 40, 80, 160})
        {
          LineProblem problem = slab(n);
          LineState state = fronts_at(problem, {0.51}, {0});
          for(std::size_t i = 0; i < problem.nodes.size(); ++i)
            state.temperature[i] = field(problem.nodes[i]);
          std::vector<double> places = problem.nodes;
          for(std::size_t i = 1; i + 1 < places.size(); ++i)
            places[i] += 0.3 * problem.spacing;
          resample(problem, places, degree, state);
          errors.push_back(0);
          for(std::size_t i = 0; i < places.size(); ++i)
            errors.back() = std::max(errors.back(),
                                     std::abs(state.temperature[i] - field(places[i])));
        }
        EXPECT_NEAR(fitted_order(errors), static_cast<double>(degree) + 1, 0.4);
      }
    }

    /** Ends of a run: its front, its highest and lowest temperature. */
    struct End : cases::Observer
    {
      bool wants(long, double) override
      {
        return true;
      }

      void observe(const cases::Snapshot &snapshot) override
      {
        front = snapshot.front[0][0];
        volume = std::accumulate(snapshot.weights.begin(), snapshot.weights.end(), 0.);
        for(const double value : snapshot.temperature)
        {
          lowest = std::min(lowest, value);
          highest = std::max(highest, value);
        }
      }

      void note(double, const std::string &) override
      {
      }

      double front = 0, volume = 0, lowest = hot, highest = cold;
    };

    End melt_bar(int n, const std::vector<std::pair<std::string, std::string>> &options)
    {
      const auto exact
          = std::make_shared<const cases::PlanarNeumann>(bar_material(), hot, cold);
      const ExactLine line = neumann(bar_material());
      const auto temperature = [exact](const cases::Position &p, double time)
      { return exact->temperature(p, time); };
      cases::Scene scene;
      scene.name = "bar";
      scene.symmetry = cases::Symmetry::planar;
      scene.domain.upper[0] = 1;
      scene.material = bar_material();
      scene.start_time = line.time_of(0.06);
      scene.end_time = line.time_of(0.18);
      scene.initial.temperature = {"exact", temperature};
      scene.initial.exact = exact;
      for(const cases::Side side : {cases::Side::x_min, cases::Side::x_max})
        scene.boundaries[static_cast<std::size_t>(side)]
            = {cases::BoundaryKind::fixed_temperature, {"exact", temperature}, true};
      const auto method = make_rkpm_tracked();
      cases::Resolution resolution;
      resolution.n = n;
      resolution.options = cases::Options(method->option_declarations());
      resolution.options.set("relax", "1");
      for(const auto &[key, value] : options)
        resolution.options.set(key, value);
      End end;
      method->solve(scene, cases::effects_called_for(scene), resolution, end);
      return end;
    }

    TEST(LineRelaxation, RunKeepsItsOrderInSpaceAndTime)
    {
      for(const char *arrangement : {"lattice", "jittered"})
      {
        std::vector<double> errors;
        for(const int n : {40, 80, 160, 320})
        {
          const End end = melt_bar(n, {{"arrangement", arrangement}});
          errors.push_back(std::abs(end.front - 0.18));
          EXPECT_NEAR(end.volume, 1, 1e-12);
          EXPECT_GE(end.lowest, cold - 1e-3);
          EXPECT_LE(end.highest, hot + 1e-3);
        }
        EXPECT_GE(fitted_order(errors), 1.7);
        EXPECT_LE(errors.back(), 1e-5);
      }
    }

    TEST(LineRelaxation, HistoryThatMovesAlongKeepsTheOrderInTime)
    {
      // On nodes that resolve far better than the steps do; begun anew after each
      // relaxation, backward differentiation would be of first order.
      for(const auto &[scheme, least] : {std::pair{"bdf2", 1.9}, {"bdf3", 2.7}})
      {
        std::vector<double> errors;
        for(const char *steps : {"40", "80", "160", "320"})
          errors.push_back(std::abs(melt_bar(std::atoi(steps), {{"refine", "time"},
                                                                {"cells", "160"},
                                                                {"basis_order", "4"},
                                                                {"cfl", "1"},
                                                                {"clock", "t"},
                                                                {"time_scheme", scheme}})
                                        .front
                                    - 0.18));
        EXPECT_GE(fitted_order(errors), least) << scheme;
      }
    }
  } // namespace
} // namespace meltfront::particles::rkpm_tracked
