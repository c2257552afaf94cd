#include <cases/error.h>
#include <cases/exact/frank.h>
#include <cases/exact/line_sink.h>
#include <cases/exact/oracle.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/point_sink.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>

namespace meltfront::cases
{
  namespace
  {
    Material water(double ice_density = 1000)
    {
      return {{2.2, 2090, ice_density}, {0.591, 4190, 1000}, 333500, 0};
    }

    Material norm()
    {
      Material material;
      material.melting_temperature = 1;
      return material;
    }

    OracleWall exact_wall(std::shared_ptr<const ExactSolution> exact, double coordinate)
    {
      return {BoundaryKind::fixed_temperature,
              [=](double time) { return exact->temperature(coordinate, time); }};
    }

    OracleProblem between(std::shared_ptr<const ExactSolution> exact,
                          const Material &material, double inner, double outer,
                          double start_time, double end_time)
    {
      OracleProblem problem;
      problem.symmetry = exact->symmetry();
      problem.material = material;
      problem.inner = inner;
      problem.outer = outer;
      problem.inner_wall = exact_wall(exact, inner);
      problem.outer_wall = exact_wall(exact, outer);
      problem.start_time = start_time;
      problem.end_time = end_time;
      problem.start = exact;
      problem.solid_at_origin = exact->solid_at_origin();
      return problem;
    }

    void compare(const OracleProblem &problem, const ExactSolution &exact,
                 const char *name)
    {
      auto t = std::chrono::steady_clock::now();
      const SpectralOracle oracle(problem);
      double sec
          = std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
      double front = 0, temp = 0, heat = 0, range = 0;
      const int times = 101, points = 41;
      for(int i = 0; i < times; ++i)
      {
        const double time
            = std::lerp(problem.start_time, problem.end_time, i / (times - 1.));
        front = std::max(front, std::abs(oracle.front(time) / exact.front(time) - 1));
        for(int j = 0; j < points; ++j)
        {
          double r = std::lerp(problem.inner, problem.outer, j / (points - 1.));
          if(j == 0 && problem.line_sink != 0)
            r = 1e-3 * problem.outer;
          temp = std::max(
              temp, std::abs(oracle.temperature(r, time) - exact.temperature(r, time)));
          range = std::max(range, std::abs(exact.temperature(r, time)));
        }
        double h = exact.heat_content(problem.inner, problem.outer, time);
        heat = std::max(
            heat,
            std::abs(oracle.heat_content(problem.inner, problem.outer, time) / h - 1));
      }
      std::printf("%-28s N=%3d+%3d steps=%4ld defect %.1e front %.2e temp %.2e heat %.2e "
                  "%.3f s\n",
                  name, oracle.near_nodes(), oracle.far_nodes(), oracle.steps(),
                  oracle.resolution_defect(), front, temp / range, heat, sec);
    }
  } // namespace

  TEST(Oracle, Trial)
  {
    auto n1 = std::make_shared<PlanarNeumann>(norm(), 0.190602422788870409, 1.2);
    compare(between(n1, norm(), 0, 1, 0.01, 0.25), *n1, "N1 .01-.25");
    compare(between(n1, norm(), 0, 1, 0.0005, 0.0568), *n1, "N1 .0005-.0568");
    compare(between(n1, norm(), 0, 1, 0.0001, 0.0568), *n1, "N1 1e-4");
    compare(between(n1, norm(), 0, 1, 0.00001, 0.0568), *n1, "N1 1e-5");
    compare(between(n1, norm(), 0, 1, 0.000001, 0.0568), *n1, "N1 1e-6");
    auto n3 = std::make_shared<PlanarNeumann>(water(917), -10, 10);
    compare(between(n3, water(917), 0, 1, 864, 86400), *n3, "N3");
    auto n4 = std::make_shared<PlanarNeumann>(water(), -10, 0);
    auto p = between(n4, water(), 0, 1, 864, 86400);
    p.one_phase = true;
    compare(p, *n4, "N4");
    auto melt = std::make_shared<PlanarNeumann>(water(917), 10, -10);
    compare(between(melt, water(917), 0, 1, 864, 86400), *melt, "melt");
    auto line = std::make_shared<LineSink>(water(), 0.15, 10);
    p = between(line, water(), 0, 0.5, 47500, 475000);
    p.line_sink = line->strength();
    compare(p, *line, "line, split");
    compare(between(line, water(), 0.05, 0.5, 47500, 475000), *line, "line, annulus");
    auto point = std::make_shared<PointSink>(water(), 0.15, 10);
    compare(between(point, water(), 0.05, 0.5, 47500, 475000), *point, "point, shell");
    for(Symmetry s : {Symmetry::planar, Symmetry::cylindrical, Symmetry::spherical})
    {
      auto frank = std::make_shared<FrankGrowth>(Material{}, s, -0.5);
      p = between(frank, Material{}, 0, 4, 0.1, 1);
      p.metastable = true;
      compare(p, *frank, "frank");
    }
  }
} // namespace meltfront::cases
