#include <cases/error.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/outline_mesh.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    using Corners = std::vector<Outline::Point>;

    std::shared_ptr<const Outline> cavity()
    {
      return std::make_shared<const Outline>(
          [](double phi)
          {
            return 0.42
                   * (1 + 0.18 * std::cos(2 * phi) + 0.12 * std::sin(phi)
                      - 0.08 * std::sin(3 * phi));
          },
          Outline::Point{0, 0});
    }

    std::shared_ptr<const Outline> polygon(const Corners &corners)
    {
      return std::make_shared<const Outline>(corners);
    }

    std::shared_ptr<const Outline> star()
    {
      return std::make_shared<const Outline>([](double phi)
                                             { return 0.4 + 0.1 * std::cos(5 * phi); },
                                             Outline::Point{0.013, -0.007});
    }

    const Corners square{{0.01, 0.02}, {1.01, 0.02}, {1.01, 1.02}, {0.01, 1.02}};
    const Corners angle_iron{{0, 0}, {1, 0}, {1, 0.45}, {0.45, 0.45}, {0.45, 1}, {0, 1}};
    const Corners triangle{{-0.5, -0.3}, {0.6, -0.2}, {0.05, 0.7}};

    Scene scene_of(const std::shared_ptr<const Outline> &outline, double temperature,
                   double end)
    {
      Scene scene = box(water(), 2, {}, {1, 1, 0}, temperature, end);
      scene.boundaries = {};
      scene.domain.shape = DomainShape::outline;
      scene.domain.outline = outline;
      scene.domain.reference_length = 1;
      for(int d = 0; d < 2; ++d)
      {
        scene.domain.lower[d] = outline->lower()[d];
        scene.domain.upper[d] = outline->upper()[d];
      }
      set_boundary(scene, Side::outer, Boundary());
      return scene;
    }

    double area(const Discretisation &mesh)
    {
      return std::accumulate(mesh.volume.begin(), mesh.volume.end(), 0.);
    }

    TEST(OutlineMesh, CellsAreGoodOnOutlinesOfManyKinds)
    {
      for(const auto &outline :
          {cavity(), star(), polygon(square), polygon(angle_iron), polygon(triangle)})
        for(const int n : {16, 23, 40, 64, 101})
          EXPECT_GE(mesh_outline(*outline, 1. / n).worst_corner(), 0.2) << "n = " << n;
    }

    TEST(OutlineMesh, AreaAndPerimeterConvergeWithTheSquareOfTheCellSize)
    {
      for(const auto &outline : {cavity(), star()})
      {
        const std::vector<int> n{32, 64, 128, 256};
        std::vector<double> areas, perimeters;
        for(const int cells : n)
        {
          const Discretisation mesh
              = make_mesh(scene_of(outline, 10, 1), 2, cells)->discretise();
          areas.push_back(std::abs(area(mesh) - outline->area()));
          double perimeter = 0;
          for(const WallNode &node : mesh.walls[static_cast<std::size_t>(Side::outer)])
          {
            perimeter += node.area;
            EXPECT_LE(outline->distance(node.position), 1e-9);
          }
          perimeters.push_back(std::abs(perimeter - outline->perimeter()));
        }
        EXPECT_GE(fitted_order(n, areas), 1.9);
        EXPECT_GE(fitted_order(n, perimeters), 1.9);
        EXPECT_LE(areas.back(), 1e-4 * outline->area());
      }
    }

    TEST(OutlineMesh, PolygonsWithTheirCornersAreExact)
    {
      for(const auto &outline : {polygon(square), polygon(angle_iron), polygon(triangle)})
      {
        const Discretisation mesh
            = make_mesh(scene_of(outline, 10, 1), 2, 40)->discretise();
        EXPECT_NEAR(area(mesh), outline->area(), 1e-13);
      }
    }

    // Corners on lines of the lattice, where a layer's cells were flat; a foot of a slit
    // that is narrower than a cell, for which there was no room.
    TEST(OutlineMesh, CornersFindRoomOnAShiftedLattice)
    {
      const auto unequal_legs
          = polygon({{0, 0}, {1, 0}, {1, 0.28}, {0.4, 0.28}, {0.4, 1}, {0, 1}});
      for(const int n : {40, 80, 160})
      {
        const QuadrilateralMesh mesh = mesh_outline(*unequal_legs, 1. / n);
        EXPECT_GE(mesh.worst_corner(), 0.1) << n;
      }
      int meshed = 0, tried = 0;
      for(const double turn : {0.1, 0.7, 1.3, 2.2, 3.1, 4.4})
      {
        Corners corners;
        const auto add = [&](double radius, double share)
        {
          const double angle = turn + 2 * std::numbers::pi * share;
          corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
        };
        for(int i = 1; i < 8; ++i)
          add(0.5, i / 8.);
        add(0.5, 0.985);
        add(0.05, 0.99);
        add(0.05, 1.01);
        add(0.5, 1.015);
        const auto slit = polygon(corners);
        for(const int n : {30, 60, 120})
        {
          ++tried;
          try
          {
            const Discretisation mesh
                = make_mesh(scene_of(slit, 10, 1), 2, n)->discretise();
            EXPECT_NEAR(area(mesh), slit->area(), 1e-13);
            ++meshed;
          }
          catch(const Refusal &)
          {
          }
        }
      }
      EXPECT_GE(3 * meshed, 2 * tried) << meshed << " of " << tried;
    }

    TEST(OutlineMesh, TooFewCellsAreRefused)
    {
      EXPECT_THROW(mesh_outline(*cavity(), 0.5), Refusal);
      // Two squares joined by a passage as wide as a cell, and as wide as ten.
      const auto dumb_bell = polygon({{0, 0},
                                      {1, 0},
                                      {1, 0.45},
                                      {2, 0.45},
                                      {2, 0},
                                      {3, 0},
                                      {3, 1},
                                      {2, 1},
                                      {2, 0.55},
                                      {1, 0.55},
                                      {1, 1},
                                      {0, 1}});
      EXPECT_THROW(mesh_outline(*dumb_bell, 0.1), Refusal);
      EXPECT_GE(mesh_outline(*dumb_bell, 0.01).worst_corner(), 0.2);
    }

    TEST(OutlineRun, SinksTakeTheirHeatAndNoMore)
    {
      Scene scene = scene_of(cavity(), 10, 100000);
      for(const double x : {-0.25, 0.25})
        scene.sources.push_back({{x, -0.1, 0},
                                 "constant",
                                 [](double) { return -148.449955; },
                                 [](double time) { return -148.449955 * time; }});
      const RunRecord record = run(scene, 32);
      EXPECT_LE(record.worst_budget_defect(), 1e-12);
      EXPECT_NEAR(record.heat.sources, -2 * 148.449955e5, 1e-8);
      EXPECT_EQ(record.cost.capped_steps, 0);
      const double solid
          = std::inner_product(record.weights.begin(), record.weights.end(),
                               record.solid_fraction.begin(), 0.);
      EXPECT_GT(solid, 0.03);
      EXPECT_LT(solid, 0.1);
    }

    // Conduction alone to a Dirichlet wall: the first mode of a square decays as
    // exp(-2 pi^2 a t).
    TEST(OutlineRun, HeldWallCoolsASquare)
    {
      std::vector<double> errors;
      const std::vector<int> n{8, 16, 32, 64};
      constexpr double pi = std::numbers::pi;
      for(const int cells : n)
      {
        Scene scene = scene_of(polygon(square), 0, 0.05);
        scene.material = Material();
        scene.material.latent_heat = 0;
        scene.material.melting_temperature = -1;
        scene.initial.temperature
            = {"a mode", [](const Position &p, double)
               { return std::sin(pi * (p[0] - 0.01)) * std::sin(pi * (p[1] - 0.02)); }};
        set_boundary(scene, Side::outer, fixed_wall(0));
        const RunRecord record
            = run(scene, cells, {{"steps", std::to_string(20 * cells)}});
        double worst = 0;
        for(std::size_t i = 0; i < record.temperature.size(); ++i)
          worst = std::max(
              worst, std::abs(record.temperature[i]
                              - std::exp(-2 * pi * pi * 0.05)
                                    * std::sin(pi * (record.positions[0][i] - 0.01))
                                    * std::sin(pi * (record.positions[1][i] - 0.02))));
        errors.push_back(worst);
      }
      EXPECT_GE(fitted_order(n, errors), 1.8);
      EXPECT_LE(errors.back(), 1e-3);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
