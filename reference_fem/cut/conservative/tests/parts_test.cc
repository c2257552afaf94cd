#include <reference_fem/cut/conservative/front_law.h>
#include <reference_fem/cut/conservative/initial_front.h>
#include <reference_fem/cut/conservative/linear_system.h>
#include <reference_fem/cut/conservative/phase_operators.h>
#include <reference_fem/cut/conservative/square_element.h>

#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    constexpr double reach = 6;

    cases::Scene square()
    {
      return test_support::box(test_support::unit_material(), 2, {-1, -1, 0}, {1, 1, 0},
                               0, 1);
    }

    double star(const Point &point)
    {
      const double angle = std::atan2(point[1], point[0]);
      return point.norm() - 0.5 - 0.08 * std::cos(3 * angle + 0.4);
    }

    Values nodal(const TriangleMesh &mesh, const std::function<double(const Point &)> &f)
    {
      Values result;
      for(const Point &node : mesh.nodes)
        result.push_back(f(node));
      return without_zeros(std::move(result), mesh.spacing);
    }

    TEST(TriangleMesh, DomainsHaveTheirAreaAndClosedRims)
    {
      cases::Domain annulus;
      annulus.shape = cases::DomainShape::shell;
      annulus.dimension = 2;
      annulus.radius = 1;
      annulus.inner_radius = 0.37;
      const TriangleMesh mesh(annulus, 23);
      double area = 0;
      for(const Triangle &triangle : mesh.triangles)
        area += triangle.part.area();
      EXPECT_NEAR(area, std::numbers::pi * (1 - 0.37 * 0.37), 1e-13);
      Gradient sum;
      for(const WallPiece &wall : mesh.walls)
        sum += wall.segment.length() * wall.normal;
      EXPECT_LE(sum.norm(), 1e-12);
    }

    TEST(Front, AreaByHatsIsThePolygons)
    {
      const TriangleMesh mesh(square().domain, 24);
      const Front front(mesh, nodal(mesh, star));
      // Of the star: pi (0.5^2 + 0.08^2/2), less what chords cut off.
      EXPECT_NEAR(front.area(Phase::solid), std::numbers::pi * 0.2532, 4e-3);
      EXPECT_NEAR(sum(front.solid_area), front.area(Phase::solid), 1e-13);
      EXPECT_NEAR(front.area(Phase::solid) + front.area(Phase::liquid), 4, 1e-13);
    }

    TEST(InitialFront, HasTheExactArea)
    {
      const double exact = std::numbers::pi * (0.25 + 0.08 * 0.08 / 2);
      const TriangleMesh mesh(square().domain, 24);
      const FrontState state = initial_front(mesh, star, reach * mesh.spacing);
      const double off
          = std::abs(exact - Front(mesh, state.level_set).area(Phase::solid)),
          chords = std::abs(exact - Front(mesh, nodal(mesh, star)).area(Phase::solid));
      // Eight divisions of a triangle: a sixty-fourth of what its chord cuts off.
      EXPECT_GE(chords, 5e-4);
      EXPECT_LE(off, chords / 50);
      EXPECT_LE(std::abs(sum(state.debt)), 1e-12);
    }

    TEST(InitialFront, ALevelSetMayBendAtItsZero)
    {
      // As a temperature whose slopes differ; straight, so that only the bend can be
      // wrong.
      const TriangleMesh mesh(square().domain, 20);
      const auto bent = [](const Point &p)
      {
        const double distance = (p[0] + 0.3 * p[1] - 0.0713) / std::hypot(1, 0.3);
        return (distance < 0 ? 1 : 0.2) * distance;
      };
      const FrontState state = initial_front(mesh, bent, reach * mesh.spacing);
      EXPECT_NEAR(Front(mesh, state.level_set).area(Phase::solid), 2 * 1.0713, 1e-9);
    }

    TEST(InitialFront, ALevelSetMayBeSteep)
    {
      // Only its zeros matter: so steep that no value at a node is below two spacings.
      const TriangleMesh mesh(square().domain, 20);
      const FrontState state
          = initial_front(mesh, star, reach * mesh.spacing),
          steep = initial_front(
              mesh, [](const Point &p) { return 1e3 * star(p) * (3 + p[0]); },
              reach * mesh.spacing);
      for(std::size_t node = 0; node < mesh.nodes.size(); ++node)
        ASSERT_NEAR(steep.level_set[node], state.level_set[node], 1e-8 * mesh.spacing);
    }

    TEST(StepFrame, FrontsThatFaceEachOtherMoveApart)
    {
      // Solid between two fronts three spacings apart: one moves by half a spacing, the
      // other stays, wherever the middle between them lies in the lattice.
      const TriangleMesh mesh(square().domain, 20);
      for(const double place : {0.013, 0.037, 0.061, 0.089})
      {
        const auto between = [&](double left)
        {
          return nodal(mesh, [&](const Point &p)
                       { return std::max(left - p[0], p[0] - place - 0.3); });
        };
        const StepFrame frame(mesh, between(place), 1);
        const Front target(mesh, between(place - 0.05));
        Values change(mesh.nodes.size());
        for(std::size_t node = 0; node < change.size(); ++node)
          change[node] = target.solid_area[node] - frame.front.solid_area[node];
        FrontMove move(mesh, frame, change, Values(mesh.nodes.size()));
        for(int i = 0; i < 20; ++i)
          move.approach(change);
        double right = 0, of_target = 0;
        for(std::size_t node = 0; node < change.size(); ++node)
          if(mesh.nodes[node][0] > place + 0.15)
          {
            right += move.front->solid_area[node];
            of_target += target.solid_area[node];
          }
        // Two thousandths of the 0.1 by which the solid grows at the left.
        EXPECT_NEAR(right, of_target, 2e-4) << place;
      }
    }

    TEST(FrontMove, FindsAFrontThatNewtonsMethodMisses)
    {
      // Two circles that nearly touch: between them the level set has a ridge.
      const TriangleMesh mesh(square().domain, 24);
      const auto disks = [](const Point &p) {
        return std::min(p.distance({-0.43, 0.01}), p.distance({0.4, 0.03})) - 0.37;
      };
      const StepFrame frame(mesh, nodal(mesh, disks), 1);
      const Front target(mesh,
                         nodal(mesh, [&](const Point &p) { return disks(p) - 0.06; }));
      Values change(mesh.nodes.size());
      for(std::size_t node = 0; node < change.size(); ++node)
        change[node] = target.solid_area[node] - frame.front.solid_area[node];
      FrontMove move(mesh, frame, change, Values(mesh.nodes.size()));
      double first = 0, last = 0;
      for(const double value : move.debt)
        first = std::max(first, std::abs(value));
      for(int i = 0; i < 20; ++i)
        move.approach(change);
      for(const double value : move.debt)
        last = std::max(last, std::abs(value));
      EXPECT_LE(last, 1e-10 * first);
      EXPECT_NEAR(sum(move.front->solid_area), sum(target.solid_area), 1e-9);
    }

    TEST(FrontLaw, DerivativeOfTheArea)
    {
      const TriangleMesh mesh(square().domain, 24);
      const StepFrame frame(mesh, nodal(mesh, star), 0);
      const Values nothing(mesh.nodes.size());
      std::vector<Eigen::Triplet<double>> entries;
      LocalVector load = LocalVector::Zero(frame.unknowns);
      add_area_law(frame, frame.front, nothing, nothing, entries, load);
      Operator derivative(mesh.nodes.size());
      std::vector<unsigned int> node_of(static_cast<std::size_t>(frame.unknowns));
      for(unsigned int node = 0; node < mesh.nodes.size(); ++node)
        if(frame.displacement[node] >= 0)
          node_of[static_cast<std::size_t>(frame.displacement[node])] = node;
      for(const Eigen::Triplet<double> &entry : entries)
        derivative.add(node_of[static_cast<std::size_t>(entry.row())], entry.col(),
                       entry.value());
      Values increment(mesh.nodes.size());
      for(std::size_t node = 0; node < increment.size(); ++node)
        increment[node] = 1e-6 * mesh.spacing * std::cos(3. * double(node));
      const Values by_derivative = derivative.apply(frame.as_unknowns(increment));
      const Front moved(mesh, frame.moved(increment, mesh.spacing));
      double largest = 0, off = 0;
      for(std::size_t node = 0; node < increment.size(); ++node)
      {
        const double difference = frame.front.solid_area[node] - moved.solid_area[node];
        largest = std::max(largest, std::abs(difference));
        off = std::max(off, std::abs(difference - by_derivative[node]));
      }
      EXPECT_GT(largest, 0);
      EXPECT_LE(off, 1e-5 * largest);
    }

    TEST(PhaseAssembly, FluxThroughAPlaneFrontIsExact)
    {
      const cases::Scene scene = square();
      const TriangleMesh mesh(scene.domain, 12);
      const LineSources sources(scene, mesh.spacing);
      PhaseAssembly assembly(scene, mesh, sources, {});
      // Oblique, through the square from side to side.
      const double slope = 0.3;
      const auto distance = [&](const Point &p)
      { return (p[0] + slope * p[1] - 0.0713) / std::hypot(1, slope); };
      const StepFrame frame(mesh, nodal(mesh, distance), 1);
      const Temperatures nothing{Values(mesh.nodes.size()), Values(mesh.nodes.size())};
      const double length = 2 * std::hypot(1, slope);
      for(const Phase phase : phases)
      {
        const PhaseOperators terms = assembly.assemble(
            phase, frame, frame.front, {0, 0, {}}, {nothing, {}, {}, {}}, false);
        LocalVector unknowns = LocalVector::Zero(frame.unknowns);
        for(std::size_t node = 0; node < mesh.nodes.size(); ++node)
          if(const int unknown = frame.temperature[index(phase)][node]; unknown >= 0)
            unknowns[unknown] = 1.7 * distance(mesh.nodes[node]);
        const double sense = phase == Phase::solid ? 1 : -1;
        EXPECT_NEAR(sum(terms.front.apply(unknowns)), sense * 1.7 * length, 1e-12);
        // Conduction and stabilisation move heat from hat to hat only.
        EXPECT_NEAR(sum(terms.interior.apply(unknowns)), 0, 1e-12);
      }
    }

    /** The flux through the front of an annulus of solid, whose inner rim is held one
     * kelvin below it, after passes that know each what the one before has found. */
    struct SteadyFlux
    {
      double error; ///< of the exact one
      /** What linear elements alone would make it too large by: a subspace's Dirichlet
       * energy is never below the minimum. */
      double missed;
    };

    SteadyFlux steady_flux(int n, const Constants &constants)
    {
      constexpr double inner = 0.4, front = 0.93;
      constexpr int passes = 8;
      cases::Scene scene
          = test_support::ball(test_support::unit_material(), 2, 1.3, 0, 1);
      scene.domain.shape = cases::DomainShape::shell;
      scene.domain.inner_radius = inner;
      test_support::set_boundary(scene, cases::Side::inner,
                                 {.kind = cases::BoundaryKind::fixed_temperature,
                                  .value = cases::Field::uniform(-1)});
      const TriangleMesh mesh(scene.domain, n);
      const LineSources sources(scene, mesh.spacing);
      PhaseAssembly assembly(scene, mesh, sources, constants);
      const StepFrame frame(
          mesh,
          initial_front(
              mesh, [](const Point &p) { return p.norm() - front; }, reach * mesh.spacing)
              .level_set,
          1);
      const std::vector<int> &rows = frame.temperature[index(Phase::solid)];
      Guess guess{{Values(mesh.nodes.size()), Values(mesh.nodes.size())},
                  frame.level_set,
                  segments_of(frame.front),
                  {}};
      double found = 0;
      for(int pass = 0; pass < passes; ++pass)
      {
        const PhaseOperators terms = assembly.assemble(Phase::solid, frame, frame.front,
                                                       {0, 0, {}}, guess, false);
        std::vector<Eigen::Triplet<double>> entries;
        LocalVector load = LocalVector::Zero(frame.unknowns);
        for(const Operator *term : {&terms.interior, &terms.wall, &terms.front})
        {
          append(*term, 1, rows, entries);
          for(std::size_t node = 0; node < rows.size(); ++node)
            if(rows[node] >= 0)
              load[rows[node]] -= term->constant[node];
        }
        for(const std::vector<int> *others :
            {&frame.temperature[index(Phase::liquid)], &frame.displacement})
          for(const int row : *others)
            if(row >= 0)
              entries.emplace_back(row, row, 1.);
        const LocalVector solution = conservative::solve(frame.unknowns, entries, load);
        for(std::size_t node = 0; node < rows.size(); ++node)
          if(rows[node] >= 0)
            guess.temperatures[index(Phase::solid)][node] = solution[rows[node]];
        found = sum(terms.front.apply(solution));
      }
      const double drop = std::log(front / inner);
      const double exact = 2 * std::numbers::pi / drop;
      // T = ln r / drop: |grad T|^2 = 1/(r drop)^2, and of its second derivatives, of
      // which an interpolant misses h^2/8 in the mean over directions, 2/(r^2 drop)^2.
      const double curvature = (1 / (inner * inner) - 1 / (front * front)) / drop;
      return {found / exact - 1, mesh.spacing * mesh.spacing / 8 * curvature};
    }

    TEST(PhaseAssembly, SteadyFluxHasAFractionOfLinearElementsErrorAndAHigherOrder)
    {
      std::vector<double> errors;
      const std::vector<int> n{24, 32, 48, 64, 96};
      for(const int cells : n)
      {
        const SteadyFlux flux = steady_flux(cells, {.nitsche = 40, .ghost = 0.04});
        EXPECT_LE(std::abs(flux.error), 0.15 * flux.missed) << cells;
        errors.push_back(std::abs(flux.error));
      }
      EXPECT_GE(test_support::fitted_order(n, errors), 3);
    }

    /** Three squares by three with other elements all around; a node's row of conduction
     * is to be what flows out of the block through its hat on the block's sides. */
    TEST(SquareElement, RowsAreOfFourthOrderInsideAndWhatOtherElementsExpectOnSides)
    {
      constexpr std::size_t n = 3;
      const Point size(0.3, 0.2);
      const auto place = [&](double i, double j)
      { return Point(i * size[0] - 0.2, j * size[1] - 0.4); };
      const auto power = [](const Point &p, int degree)
      { return std::pow(std::complex<double>(p[0], p[1]), degree); };
      for(const int degree : {1, 2, 3})
        for(const bool real : {true, false})
        {
          const auto value = [&](const Point &p)
          { return real ? power(p, degree).real() : power(p, degree).imag(); };
          const auto gradient = [&](const Point &p) -> Point
          {
            const std::complex<double> slope = double(degree) * power(p, degree - 1);
            return real ? Point(slope.real(), -slope.imag())
                        : Point(slope.imag(), slope.real());
          };
          std::array<std::array<double, n + 1>, n + 1> found{}, expected{};
          for(std::size_t i = 0; i < n; ++i)
            for(std::size_t j = 0; j < n; ++j)
            {
              const SquareElement element(size, {i == 0, i == n - 1, j == 0, j == n - 1});
              for(std::size_t a = 0; a < 4; ++a)
                for(std::size_t b = 0; b < 4; ++b)
                  found[i + a % 2][j + a / 2]
                      += element.conduction[a][b]
                         * value(place(double(i + b % 2), double(j + b / 2)));
            }
          for(std::size_t k = 0; k < n; ++k)
            for(const std::size_t end : {std::size_t(0), n})
            {
              const double sense = end == 0 ? -1 : 1;
              const auto at = double(k), beside = double(end);
              integrate(Segment{place(beside, at), place(beside, at + 1)},
                        [&](const Point &p, double weight)
                        {
                          const double flux = sense * weight * gradient(p)[0],
                                       s = (p - place(beside, at))[1] / size[1];
                          expected[end][k] += (1 - s) * flux;
                          expected[end][k + 1] += s * flux;
                        });
              integrate(Segment{place(at, beside), place(at + 1, beside)},
                        [&](const Point &p, double weight)
                        {
                          const double flux = sense * weight * gradient(p)[1],
                                       s = (p - place(at, beside))[0] / size[0];
                          expected[k][end] += (1 - s) * flux;
                          expected[k + 1][end] += s * flux;
                        });
            }
          for(std::size_t i = 0; i <= n; ++i)
            for(std::size_t j = 0; j <= n; ++j)
            {
              // There a twelfth of h^3 times the third derivatives is missing.
              const bool corner = i % n == 0 && j % n == 0;
              EXPECT_NEAR(found[i][j], expected[i][j],
                          corner && degree == 3 ? 6 * std::pow(0.3, 3) / 12 : 1e-14)
                  << degree << ' ' << real << ' ' << i << ' ' << j;
            }
        }
    }

    /** The heat of linear functions by the hats of a square's two triangles; with other
     * elements all around, and the others' half of it in a lattice. */
    TEST(SquareElement, MassHasTheMomentsOfHats)
    {
      const Point size(0.3, 0.2);
      const SquareElement element(size, {true, true, true, true});
      const double area = size[0] * size[1];
      for(std::size_t i = 0; i < 4; ++i)
      {
        const bool on_diagonal = i == 0 || i == 3;
        double volume = 0, x = 0;
        for(std::size_t j = 0; j < 4; ++j)
        {
          volume += element.mass[i][j];
          x += element.mass[i][j] * double(j % 2);
        }
        EXPECT_NEAR(volume, area * (on_diagonal ? 1. / 3 : 1. / 6), 1e-16);
        // A hat's own first moment: its centre is a third of the way from the corner.
        const double bilinear = i % 2 == 0 ? 1. / 12 : 1. / 6;
        EXPECT_NEAR(x, area * (bilinear + (on_diagonal ? 1 : -1) / 24.), 1e-16);
      }
    }

    TEST(LineSources, FluxOverAClosedLineIsThePower)
    {
      cases::Scene scene = square();
      scene.sources = {test_support::steady_sink({0.03, -0.02, 0}, 2.5)};
      const TriangleMesh mesh(scene.domain, 24);
      const LineSources sources(scene, 1e-3 * mesh.spacing);
      const Front front(mesh, nodal(mesh, star));
      double flux = 0, quadrature = 0;
      for(const CutTriangle &cut : front.cut)
      {
        flux += sources.flux(cut.segment, cut.normal, sources.powers(0));
        integrate(cut.segment,
                  [&](const Point &point, double weight) {
                    quadrature
                        += weight
                           * (sources.gradient(point, sources.powers(0)) * cut.normal);
                  });
      }
      EXPECT_NEAR(flux, 2.5, 1e-13);
      EXPECT_NEAR(quadrature, 2.5, 1e-6);
    }

    TEST(Bodies, TurningKeepsTheHeat)
    {
      const TriangleMesh mesh(square().domain, 24);
      const std::array<Point, 2> places{Point(-0.4, 0.1), Point(0.431, -0.2)};
      const auto disks = [&](const Point &p)
      { return std::min(p.distance(places[0]) - 0.3, p.distance(places[1]) - 0.1); };
      FrontState state;
      state.level_set = nodal(mesh, disks);
      const Front before(mesh, state.level_set);
      state.heat.fill(before.solid_area);
      for(double &value : state.heat[1])
        value = 0.013 - value;
      state.debt = before.solid_area;
      constexpr double latent_heat = 3;
      const auto heat = [&](const Front &front)
      {
        return sum(state.heat[0]) + sum(state.heat[1])
               - latent_heat * (front.area(Phase::solid) + sum(state.debt));
      };
      const double first = heat(before);
      std::vector<Body> found = bodies(mesh, before, state.level_set);
      ASSERT_EQ(found.size(), 3u);
      for(const Body &body : found)
        if(body.area < 0.04)
          turn(mesh, before, body, latent_heat, state);
      const Front after(mesh, state.level_set);
      EXPECT_NEAR(heat(after), first, 1e-13);
      EXPECT_EQ(bodies(mesh, after, state.level_set).size(), 2u);
    }
  } // namespace
} // namespace meltfront::reference_fem::cut::conservative
