#include <cases/error.h>
#include <cases/exact/heat_quadrature.h>
#include <cases/exact/one_phase_start.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/tests/materials.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace meltfront::cases
{
  namespace
  {
    OracleWall robin(double coefficient, double ambient)
    {
      return {BoundaryKind::heat_transfer, [=](double) { return ambient; }, coefficient};
    }

    OracleWall held(double temperature)
    {
      return {BoundaryKind::fixed_temperature, [=](double) { return temperature; }};
    }

    /** Liquid at a temperature, that melts at 0. */
    OracleProblem liquid(double temperature, double end_time)
    {
      OracleProblem problem;
      problem.material = {{2, 1, 1}, {1, 1, 1}, 1, 0};
      problem.end_time = end_time;
      problem.solid_at_origin = false;
      problem.initial_temperature = [=](double) { return temperature; };
      return problem;
    }

    /** When a front leaves its wall, where the wall's temperature has a kink. */
    double onset(const LayeredSolution &solution, std::size_t front, double end)
    {
      const double at_wall = solution.fronts(0)[front];
      double before = 0, after = end;
      while(after - before > 1e-14 * end)
      {
        const double middle = (before + after) / 2;
        (solution.fronts(middle)[front] == at_wall ? before : after) = middle;
      }
      return after;
    }

    /** Heat that came through walls under heat transfer, per area: by Gauss quadrature
     * between the onsets, over the root of the time since each. */
    double heat_gained(const OracleProblem &problem, const LayeredSolution &solution)
    {
      std::vector<double> times{0, problem.end_time};
      for(std::size_t i = 0; i < solution.fronts(0).size(); ++i)
        times.push_back(onset(solution, i, problem.end_time));
      std::ranges::sort(times);
      const auto flux = [&](double time)
      {
        double sum = 0;
        for(const OracleWall *wall : {&problem.inner_wall, &problem.outer_wall})
          if(wall->kind == BoundaryKind::heat_transfer)
            sum += wall->heat_transfer_coefficient
                   * (wall->value(time)
                      - solution.temperature(wall == &problem.inner_wall ? problem.inner
                                                                         : problem.outer,
                                             time));
        return sum;
      };
      double heat = 0;
      for(std::size_t i = 0; i + 1 < times.size(); ++i)
      {
        const double last = std::sqrt(times[i + 1] - times[i]);
        heat += integrate_panels(
            Symmetry::planar, 0, last,
            [&](double tau) { return 2 * tau * flux(times[i] + tau * tau); },
            [&](double) { return last / 16; });
      }
      return heat;
    }
  } // namespace

  /** Onset and front under a constant coefficient, of values computed elsewhere: by
   * exp(tau^2) erfc(tau) = 2/3 and by finite volumes on refined meshes. */
  TEST(OnePhaseStart, HalfSpaceUnderHeatTransfer)
  {
    OracleProblem problem = liquid(0.5, 3.1656490710939501);
    problem.material = Material{};
    problem.outer = 16; // erfc(16/2/sqrt(3.2)) = 3e-10
    problem.inner_wall = robin(1, -1);
    const auto solution = solve_from_one_phase(problem);
    const double onset = 0.1656490710939378;
    EXPECT_NEAR(solution->temperature(0, onset), 0, 1e-12);
    EXPECT_EQ(solution->front(onset * (1 - 1e-9)), 0);
    EXPECT_GT(solution->front(onset * (1 + 1e-9)), 0);
    const auto front = [&](double after) { return solution->front(onset + after); };
    EXPECT_NEAR(front(1e-8) / 1e-12, 0.811923231161875, 1e-5);
    EXPECT_NEAR(front(0.01), 7.991e-4, 5e-8);
    EXPECT_NEAR(front(0.1), 0.022168, 5e-7);
    EXPECT_NEAR(front(0.3), 0.091548, 2e-6);
    EXPECT_NEAR(front(1), 0.33844, 1e-5);
    EXPECT_NEAR(front(2.9999), 0.88668, 4e-5);
  }

  /** The series at the onset may take over at any time: a longer domain and a looser
   * tolerance change where it does. */
  TEST(OnePhaseStart, TakeOverDoesNotMatter)
  {
    double fronts[2];
    for(const int i : {0, 1})
    {
      OracleProblem problem = liquid(0.5, 0.4);
      problem.material = Material{};
      problem.outer = i == 0 ? 9 : 14;
      problem.tolerance = i == 0 ? 1e-12 : 1e-13;
      problem.inner_wall = robin(1, -1);
      fronts[i] = solve_from_one_phase(problem)->front(0.4);
    }
    EXPECT_NEAR(fronts[0], fronts[1], 1e-12);
  }

  /** When a wall that radiates passes the melting temperature, of values computed
   * elsewhere by Pade approximants of a series. */
  TEST(OnePhaseStart, OnsetUnderRadiation)
  {
    OracleProblem problem = liquid(1.2, 0.1);
    problem.material = unit_material();
    problem.outer = 3;
    problem.inner_wall = {BoundaryKind::radiation, [](double) { return 0.5; }, 0, 1, 0};
    const auto solution = solve_from_one_phase(problem);
    EXPECT_NEAR(solution->temperature(0, 0.0272189375434), 1, 1e-11);
    EXPECT_GT(solution->front(0.1), 0.02);
  }

  /** The same front as by the power series in closed form, FluxFreezing. */
  TEST(OnePhaseStart, FluxFromAParabola)
  {
    OracleProblem problem = liquid(0, 0.9);
    problem.material = {{2, 0.5, 1}, {1, 1, 1}, 1, 0};
    problem.initial_temperature = [](double x) { return 0.6 - (1 - x) * (1 - x) / 2; };
    problem.inner_wall = {BoundaryKind::flux, [](double) { return -1.; }};
    EXPECT_NEAR(solve_from_one_phase(problem)->front(0.9), 0.452097059863568, 1e-12);
  }

  TEST(OnePhaseStart, JumpsAreNeumannsUntilTheyMeet)
  {
    OracleProblem problem = liquid(0.5, 0.1);
    problem.inner_wall = problem.outer_wall = held(-1);
    const auto solution = solve_from_one_phase(problem);
    const PlanarNeumann neumann(problem.material, -1, 0.5);
    EXPECT_FALSE(solution->depends_on_one_coordinate());
    for(const double time : {1e-4, 1e-3})
    {
      const std::vector<double> fronts = solution->fronts(time);
      ASSERT_EQ(fronts.size(), 2);
      EXPECT_NEAR(fronts[0], neumann.front(time), 1e-12);
      EXPECT_NEAR(1 - fronts[1], neumann.front(time), 1e-12);
      EXPECT_NEAR(solution->solid_volume(time), 2 * neumann.front(time), 2e-12);
      EXPECT_NEAR(solution->temperature(0.03, time), neumann.temperature(0.03, time),
                  1e-11);
    }
    EXPECT_NEAR(solution->fronts(0.1)[0], 1 - solution->fronts(0.1)[1], 1e-12);
    EXPECT_EQ(solution->solid_fraction(0.5, 0.05), 0);
    EXPECT_EQ(solution->solid_fraction(0.9, 0.05), 1);
    EXPECT_LT(solution->signed_distance({0.9, 0, 0}, 0.05), 0);

    problem.end_time = 1;
    try
    {
      solve_from_one_phase(problem);
      FAIL() << "the fronts met unnoticed";
    }
    catch(const NumericalError &error)
    {
      EXPECT_NEAR(error.time, 0.102038, 1e-5);
      EXPECT_EQ(error.quantity, "the liquid");
    }
  }

  /** Two fronts that appear at their own times, in all symmetries, freezing and melting:
   * what the walls gave is what there is. */
  TEST(OnePhaseStart, BudgetOfTwoFronts)
  {
    for(const double sign : {1., -1.})
    {
      OracleProblem problem = liquid(0.5 * sign, 0.12);
      problem.solid_at_origin = sign < 0;
      if(sign < 0)
        problem.material = {{1, 1, 1}, {2, 1, 1}, 1, 0};
      problem.inner_wall = robin(2, -3 * sign);
      problem.outer_wall = robin(3, -2 * sign);
      const auto solution = solve_from_one_phase(problem);
      EXPECT_NE(solution->fronts(0.12)[0], 0);
      EXPECT_NE(solution->fronts(0.12)[1], 1);
      EXPECT_NEAR(solution->heat_content(0, 1, 0.12) - solution->heat_content(0, 1, 0),
                  heat_gained(problem, *solution), 1e-9);
    }
  }

  TEST(OnePhaseStart, DiskAndBallFreezeInwards)
  {
    for(const Symmetry symmetry : {Symmetry::cylindrical, Symmetry::spherical})
    {
      OracleProblem problem = liquid(0.5, 0.12);
      problem.symmetry = symmetry;
      problem.outer_wall = robin(3, -2);
      const auto solution = solve_from_one_phase(problem);
      const double surface = symmetry == Symmetry::cylindrical ? 2 * std::numbers::pi
                                                               : 4 * std::numbers::pi;
      problem.inner_wall = {};
      EXPECT_NEAR(solution->heat_content(0, 1, 0.12) - solution->heat_content(0, 1, 0),
                  surface * heat_gained(problem, *solution), 1e-8);
      EXPECT_FALSE(solution->solid_at_origin());
      EXPECT_LT(solution->front(0.12), 0.8);
    }
  }

  TEST(OnePhaseStart, WallsThatDoNotFreezeLeaveOnePhase)
  {
    OracleProblem problem = liquid(0.5, 1);
    problem.inner_wall = robin(2, 0.1);
    const auto solution = solve_from_one_phase(problem);
    EXPECT_FALSE(solution->has_front());
    EXPECT_NEAR(solution->heat_content(0, 1, 1) - solution->heat_content(0, 1, 0),
                heat_gained(problem, *solution), 1e-9);
  }

  TEST(OnePhaseStart, RejectsWhatItDoesNotSolve)
  {
    OracleProblem problem = liquid(0.5, 1);
    problem.inner_wall = robin(2, -1);
    problem.material.solid.density = 0.9;
    EXPECT_THROW(solve_from_one_phase(problem), InputError);
    problem.material.solid.density = 1;
    problem.initial_fronts = {0.5};
    EXPECT_THROW(solve_from_one_phase(problem), InputError);
  }
} // namespace meltfront::cases
