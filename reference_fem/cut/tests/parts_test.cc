#include <cases/error.h>
#include <reference_fem/cut/heat_problem.h>
#include <reference_fem/cut/quadrature.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    using tests::fitted_order;

    const std::vector<int> levels{8, 16, 32, 64};
    constexpr double radius = 0.6;
    const Point centre{0.031, -0.017};

    cases::Scene square()
    {
      return tests::box(tests::normalised_material(), 2, {-1, -1, 0}, {1, 1, 0}, 1, 1);
    }

    double distance(const Point &point)
    {
      return point.distance(centre) - radius;
    }

    /** A circle of solid in a square. */
    struct Circle
    {
      explicit Circle(int n, int degree = 1)
        : scene(square())
        , mesh(scene, n, degree, 2)
        , level_set(signed_distance_to_zeros(mesh, distance))
        , geometry(mesh, level_set)
      {
      }

      double front_length() const
      {
        double sum = 0;
        for(const CutCell &cut : geometry.cut_cells)
          for(const SurfacePoint &point : cut.front)
            sum += point.weight;
        return sum;
      }

      cases::Scene scene;
      BackgroundMesh mesh;
      Values level_set;
      CutGeometry geometry;
    };

    TEST(CutGeometry, AreaAndLengthOfACircle)
    {
      std::vector<double> area, length;
      for(const int n : levels)
      {
        const Circle circle(n);
        area.push_back(std::abs(circle.geometry.area(Phase::solid)
                                - std::numbers::pi * radius * radius));
        length.push_back(std::abs(circle.front_length() - 2 * std::numbers::pi * radius));
        EXPECT_NEAR(circle.geometry.area(Phase::solid)
                        + circle.geometry.area(Phase::liquid),
                    4, 1e-12);
      }
      EXPECT_GE(fitted_order(levels, area), 2.7);
      EXPECT_GE(fitted_order(levels, length), 2.7);
      EXPECT_LE(area.back(), 1e-6);
    }

    TEST(CutGeometry, RimOfADisk)
    {
      std::vector<double> area;
      for(const int n : levels)
      {
        const cases::Scene scene = tests::ball(tests::water(), 2, 0.5, 10, 1);
        const BackgroundMesh mesh(scene, n, 1, 2);
        const Values liquid(mesh.level_set_positions.size(), 1.);
        const CutGeometry geometry(mesh, liquid);
        area.push_back(std::abs(geometry.area(Phase::liquid) - std::numbers::pi * 0.25));
        EXPECT_FALSE(geometry.has(Phase::solid));
      }
      EXPECT_GE(fitted_order(levels, area), 2.7);
    }

    TEST(LevelSet, RedistancingDoesNotMoveTheFront)
    {
      const Circle circle(32);
      Values distorted(circle.level_set.size());
      for(std::size_t i = 0; i < distorted.size(); ++i)
      {
        const Point &point = circle.mesh.level_set_positions[i];
        distorted[i] = distance(point) * (1.5 + point[0]);
      }
      const CutGeometry before(circle.mesh, distorted);
      redistance(circle.mesh, before, distorted);
      const CutGeometry after(circle.mesh, distorted);
      EXPECT_NEAR(before.area(Phase::solid), after.area(Phase::solid), 1e-14);
      std::vector<char> cut(distorted.size());
      for(const CutCell &cell : after.cut_cells)
        for(const unsigned int dof : circle.mesh.cells[cell.cell].level_set_dofs)
          cut[dof] = 1;
      for(std::size_t i = 0; i < distorted.size(); ++i)
      {
        const double exact = distance(circle.mesh.level_set_positions[i]);
        if(!cut[i] && std::abs(exact) < 4 * circle.mesh.spacing)
        {
          EXPECT_NEAR(distorted[i], exact, 1e-4);
        }
      }
    }

    /** A harmonic function. */
    double wave(const Point &point)
    {
      return std::exp(point[0]) * std::cos(point[1]);
    }

    double poisson_error(int n, int degree)
    {
      const Circle circle(n, degree);
      Stabilisation stabilisation;
      PhaseEquation equation;
      equation.mass = 1;
      equation.conductivity = 1;
      equation.source = wave;
      equation.front_value = wave;
      PhaseProblem problem(circle.mesh, circle.geometry, circle.level_set, Phase::solid,
                           stabilisation);
      const Values solution = problem.solve(equation);
      double error = 0;
      const auto add = [&](unsigned int number, const std::vector<VolumePoint> &points)
      {
        const Cell &cell = circle.mesh.cells[number];
        for(const VolumePoint &point : points)
          error += point.weight
                   * std::pow(field_value(circle.mesh, cell, solution, point.unit)
                                  - wave(cell.real(point.unit)),
                              2);
      };
      for(unsigned int cell = 0; cell < circle.mesh.cells.size(); ++cell)
        if(circle.geometry.location[cell] == Location::solid)
          add(cell, whole_cell(circle.mesh.cells[cell]));
      circle.geometry.visit_parts(circle.mesh, Phase::solid, add);
      return std::sqrt(error);
    }

    TEST(PhaseProblem, NitscheOnACircleOfEachDegree)
    {
      for(const int degree : {1, 2})
      {
        std::vector<double> errors;
        for(const int n : levels)
          errors.push_back(poisson_error(n, degree));
        EXPECT_GE(fitted_order(levels, errors), degree + 0.8) << "degree " << degree;
      }
    }

    TEST(PhaseProblem, AConstantIsExactHoweverTheFrontCuts)
    {
      for(const double shift : {0., 1e-9, 1e-6, 0.3})
      {
        const cases::Scene scene = square();
        const BackgroundMesh mesh(scene, 16, 1, 2);
        // A straight front on the mesh's own lines, but for the shift.
        Values level_set = signed_distance_to_zeros(
            mesh, [&](const Point &point) { return point[0] - 0.25 - shift / 8; });
        const CutGeometry geometry(mesh, level_set);
        const Stabilisation stabilisation;
        PhaseEquation equation;
        equation.mass = 1;
        equation.conductivity = 1;
        equation.source = [](const Point &) { return 3.; };
        equation.front_value = [](const Point &) { return 3.; };
        PhaseProblem problem(mesh, geometry, level_set, Phase::liquid, stabilisation);
        const Values solution = problem.solve(equation);
        for(const double value : solution)
          EXPECT_NEAR(value, 3, 1e-9) << "shift " << shift;
      }
    }

    TEST(FrontSpeed, ConstantAndWave)
    {
      std::vector<double> errors;
      for(const int n : levels)
      {
        const Circle circle(n);
        std::vector<double> constant, varying;
        const auto exact = [](const Point &point)
        {
          return 1
                 + 0.1
                       * std::cos(
                           2 * std::atan2(point[1] - centre[1], point[0] - centre[0]));
        };
        for(const CutCell &cut : circle.geometry.cut_cells)
          for(const SurfacePoint &point : cut.front)
          {
            constant.push_back(2.5);
            varying.push_back(exact(circle.mesh.cells[cut.cell].real(point.unit)));
          }
        const SpeedField flat = extend_speed(circle.mesh, circle.geometry,
                                             circle.level_set, constant, 0.25);
        const SpeedField waves
            = extend_speed(circle.mesh, circle.geometry, circle.level_set, varying, 0.25);
        double worst = 0;
        for(std::size_t i = 0; i < flat.values.size(); ++i)
        {
          if(!flat.band[i])
            continue;
          EXPECT_NEAR(flat.values[i], 2.5, 1e-10);
          const Point &point = circle.mesh.level_set_positions[i];
          if(std::abs(distance(point)) < circle.mesh.spacing / 2)
            worst = std::max(worst, std::abs(waves.values[i] - exact(point)));
        }
        errors.push_back(worst);
      }
      EXPECT_GE(fitted_order(levels, errors), 1.5);
    }

    TEST(TimeDerivative, ExactForParabolasWithUnequalSteps)
    {
      const auto value = [](double t) { return 2 - 3 * t + 5 * t * t; };
      const double now = 0.7, before = 0.4, older = 0.35;
      const TimeDerivative d = time_derivative(now - before, before - older);
      EXPECT_NEAR(d.now * value(now) + d.before * value(before) + d.older * value(older),
                  -3 + 10 * now, 1e-12);
      const TimeDerivative first = time_derivative(0.1, 0);
      EXPECT_DOUBLE_EQ(first.now, 10);
      EXPECT_DOUBLE_EQ(first.older, 0);
    }

    TEST(SinkField, DrawsItsPower)
    {
      cases::Scene scene = square();
      scene.material = tests::water();
      scene.sources.push_back({{0.1, 0.2, 0},
                               "constant",
                               [](double) { return -150.; },
                               [](double t) { return -150 * t; }});
      const SinkField field(scene, 1e-9);
      EXPECT_FALSE(field.varies());
      EXPECT_DOUBLE_EQ(field.energy(2), -300);
      double flux = 0;
      constexpr int points = 64;
      for(int i = 0; i < points; ++i)
      {
        const double angle = 2 * std::numbers::pi * i / points;
        const Gradient normal(dealii::Point<2>(std::cos(angle), std::sin(angle)));
        const Point place = Point(0.1, 0.2) + 0.3 * normal;
        flux += 0.3 * 2 * std::numbers::pi / points * 2.2
                * (field.gradient(place, 0) * normal);
        constexpr double step = 1e-6;
        EXPECT_NEAR((field.value(place + step * normal, 0)
                     - field.value(place - step * normal, 0))
                        / (2 * step),
                    field.gradient(place, 0) * normal, 1e-6);
      }
      EXPECT_NEAR(flux, 150, 1e-10);
    }
  } // namespace
} // namespace meltfront::reference_fem::cut
