#include <cases/error.h>
#include <cases/exact/line_sink.h>
#include <cases/tests/support/meshes.h>
#include <reference_fem/enthalpy/mesh.h>
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
    using test_support::lattice_mesh;
    using test_support::take_mesh;

    constexpr double pi = std::numbers::pi;

    const CellKind all_kinds[] = {CellKind::triangle, CellKind::quadrilateral,
                                  CellKind::tetrahedron, CellKind::hexahedron};

    Side wall(const Scene &scene, const std::string &name)
    {
      for(const Side side : scene.sides())
        if(name_of(scene.domain, side) == name)
          return side;
      throw std::logic_error(name);
    }

    /** The unit square or cube with cells that lean; its walls are where they were. */
    Position leaning(const Position &p)
    {
      const double bulge = 0.06 * std::sin(pi * p[0]) * std::sin(pi * p[1]);
      return {p[0] + bulge, p[1] - bulge, p[2]};
    }

    Scene meshed(Scene scene, CellKind kind, int n,
                 const test_support::PlaceMap &map = {})
    {
      take_mesh(scene, lattice_mesh(kind, n, map));
      return scene;
    }

    /** Conduction alone of the lowest mode between walls at zero. */
    Scene decaying_mode(int dimension)
    {
      Scene scene = box(unit_material(-1), dimension, {},
                        {1, 1, dimension == 3 ? 1. : 0.}, 0, 0.05);
      scene.material.latent_heat = 0;
      scene.initial.temperature = field_of(
          [](const Position &p) { return std::sin(pi * p[0]) * std::sin(pi * p[1]); });
      return scene;
    }

    double error_of_mode(const RunRecord &record)
    {
      double worst = 0;
      for(std::size_t i = 0; i < record.temperature.size(); ++i)
        worst = std::max(worst, std::abs(record.temperature[i]
                                         - std::exp(-2 * pi * pi * 0.05)
                                               * std::sin(pi * record.positions[0][i])
                                               * std::sin(pi * record.positions[1][i])));
      return worst;
    }

    TEST(MeshFile, MeasuresStayThoseOfTheBodyWhenCellsAreHalved)
    {
      for(const CellKind kind : all_kinds)
      {
        Scene scene = box(unit_material(), dimension_of(kind), {}, {1, 1, 1}, 0, 1);
        scene = meshed(scene, kind, 3, leaning);
        for(const int n : {1, 2, 4})
        {
          const Discretisation mesh
              = make_mesh(scene, scene.domain.dimension, n)->discretise();
          EXPECT_NEAR(std::accumulate(mesh.volume.begin(), mesh.volume.end(), 0.), 1,
                      1e-13);
          for(const double volume : mesh.volume)
            EXPECT_GT(volume, 0);
          EXPECT_NEAR(mesh.spacing * n * 3, 1, 1e-12) << to_string(kind);
          for(const Side side : scene.sides())
          {
            double area = 0;
            for(const WallNode &node : mesh.walls[static_cast<std::size_t>(side)])
              area += node.area;
            EXPECT_NEAR(area, 1, 1e-13) << name_of(scene.domain, side);
          }
        }
      }
    }

    TEST(MeshFile, PointsShareTheirLoadExactly)
    {
      for(const CellKind kind : all_kinds)
      {
        Scene scene = box(unit_material(), dimension_of(kind), {}, {1, 1, 1}, 0, 1);
        scene = meshed(scene, kind, 3, leaning);
        const auto mesh = make_mesh(scene, scene.domain.dimension, 4);
        const Discretisation nodes = mesh->discretise();
        for(const Position &p : {Position{0.31, 0.47, 0.62}, Position{0.9, 0.05, 0.5},
                                 Position{0, 0, 0}, Position{0.5, 1, 0.25}})
        {
          const double z = dimension_of(kind) == 3 ? p[2] : 0;
          Position middle{};
          double sum = 0;
          for(const auto &[node, share] : mesh->shares({p[0], p[1], z}))
          {
            sum += share;
            for(int d = 0; d < 3; ++d)
              middle[d] += share * nodes.positions[node][d];
          }
          EXPECT_NEAR(sum, 1, 1e-14);
          EXPECT_NEAR(middle[0], p[0], 1e-9) << to_string(kind);
          EXPECT_NEAR(middle[1], p[1], 1e-9);
          EXPECT_NEAR(middle[2], z, 1e-9);
        }
        EXPECT_THROW(mesh->shares({1.1, 0.5, 0}), InputError);
      }
    }

    TEST(MeshFile, OnlyHalvingsAreTaken)
    {
      const Scene scene
          = meshed(box(unit_material(), 2, {}, {1, 1, 0}, 0, 1), CellKind::triangle, 2);
      EXPECT_THROW(make_mesh(scene, 2, 3), Refusal);
      EXPECT_NO_THROW(make_mesh(scene, 2, 2));
    }

    TEST(MeshFile, ConductionIsOfSecondOrderOnAllKindsOfCells)
    {
      for(const CellKind kind :
          {CellKind::triangle, CellKind::quadrilateral, CellKind::hexahedron})
      {
        Scene scene = meshed(decaying_mode(dimension_of(kind)), kind, 4, leaning);
        for(const char *name : {"x_min", "x_max", "y_min", "y_max"})
          set_boundary(scene, wall(scene, name), fixed_wall(0));
        std::vector<int> levels{1, 2, 4};
        if(dimension_of(kind) == 2)
          levels.push_back(8);
        std::vector<double> errors;
        for(const int n : levels)
        {
          const RunRecord record = run(scene, n, {{"steps", std::to_string(40 * n)}});
          EXPECT_LE(record.worst_budget_defect(), 1e-12);
          errors.push_back(error_of_mode(record));
        }
        EXPECT_GE(fitted_order(levels, errors), 1.7) << to_string(kind);
        EXPECT_LE(errors.back(), dimension_of(kind) == 2 ? 2e-3 : 1e-2)
            << to_string(kind);
      }
    }

    /** Ice grows around a line sink in a square whose walls are exact. */
    Scene line_sink_square(const std::shared_ptr<const LineSink> &exact)
    {
      Scene scene = box(water(), 2, {-0.5, -0.5, 0}, {0.5, 0.5, 0}, 10, 475000);
      scene.sources.push_back(steady_sink({}, exact->strength()));
      return scene;
    }

    TEST(MeshFile, FrontsConvergeAsOnTheBoxOfTheSameSize)
    {
      const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
      // By the radius of a disk of the ice's area, over the second half of the run.
      const auto worst_front_error = [&exact](const RunRecord &record)
      {
        double worst = 0;
        for(std::size_t k = 0; k < record.time.size(); ++k)
          if(record.time[k] >= record.time.back() / 2)
            worst = std::max(worst, std::abs(std::sqrt(record.solid[k] / std::numbers::pi)
                                             - exact->front(record.time[k])));
        return worst / exact->front(record.time.back());
      };
      Scene on_box = line_sink_square(exact);
      for(const Side side : on_box.sides())
        set_boundary(on_box, side, exact_wall(exact));
      for(const CellKind kind : {CellKind::quadrilateral, CellKind::triangle})
      {
        Scene on_mesh = meshed(line_sink_square(exact), kind, 16,
                               [](const Position &p)
                               {
                                 const Position q = leaning(p);
                                 return Position{q[0] - 0.5, q[1] - 0.5, 0};
                               });
        for(const Side side : on_mesh.sides())
          set_boundary(on_mesh, side, exact_wall(exact));
        const std::vector<int> levels{1, 2, 4, 8};
        std::vector<double> errors;
        for(const int n : levels)
        {
          const RunRecord record = run(on_mesh, n, {}, exact.get());
          EXPECT_LE(record.worst_budget_defect(), 1e-12);
          EXPECT_LE(record.statistics.graph_inconsistency, 1e-11);
          EXPECT_EQ(record.cost.capped_steps, 0);
          errors.push_back(worst_front_error(record));
        }
        EXPECT_GE(fitted_order(levels, errors), 1) << to_string(kind);
        const double of_box = worst_front_error(run(on_box, 128, {}, exact.get()));
        EXPECT_LE(errors.back(), 2 * of_box) << to_string(kind);
      }
    }

    /** The unit square without its upper right quarter, cold at its lower edge. */
    TEST(MeshFile, AnAngleIronFreezesAsItsOutlineDoes)
    {
      Scene scene = box(unit_material(), 2, {}, {1, 1, 0}, 0.3, 0.05);
      take_mesh(scene,
                lattice_mesh(CellKind::quadrilateral, 8, {},
                             [](const Position &p) { return p[0] < 0.5 || p[1] < 0.5; }));
      for(const Side side : scene.sides())
        set_boundary(scene, side, fixed_wall(-1));
      Scene outline = scene;
      outline.boundaries = {};
      outline.domain.mesh.reset();
      outline.domain.shape = DomainShape::outline;
      outline.domain.outline
          = std::make_shared<const Outline>(std::vector<Outline::Point>{
              {0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}});
      const auto solid = [](const RunRecord &record)
      {
        return std::inner_product(record.weights.begin(), record.weights.end(),
                                  record.solid_fraction.begin(), 0.);
      };
      // The mesh's inner edges are of no wall and insulated; so is the outline's rim.
      for(const Side side : scene.sides())
        set_boundary(scene, side, Boundary());
      set_boundary(outline, Side::outer, Boundary());
      scene.sources.push_back(steady_sink({0.25, 0.25, 0}, 4));
      outline.sources = scene.sources;
      const double on_outline = solid(run(outline, 128));
      std::vector<double> differences;
      for(const int n : {1, 2, 4, 8})
        differences.push_back(std::abs(solid(run(scene, n)) - on_outline));
      EXPECT_LT(differences[3], differences[0]);
      EXPECT_LE(differences[3], 2e-3);
    }

    TEST(MeshFile, TetrahedraAreRefused)
    {
      const Scene scene = meshed(box(unit_material(), 3, {}, {1, 1, 1}, 0.3, 0.02),
                                 CellKind::tetrahedron, 2);
      EXPECT_THROW(run(scene, 1), Refusal);
    }

    TEST(MeshFile, WhatCannotBeMonotoneSaysSo)
    {
      // Triangles drawn out along their diagonals are obtuse.
      Scene scene = box(unit_material(), 2, {}, {1, 1, 0}, 0.3, 0.01);
      scene = meshed(scene, CellKind::triangle, 6,
                     [](const Position &p) {
                       return Position{p[0] + 0.8 * p[1], p[1], 0};
                     });
      set_boundary(scene, wall(scene, "x_min"), fixed_wall(-1));
      const RunRecord record = run(scene, 2);
      EXPECT_FALSE(record.obeys_maximum_principle);
      EXPECT_LE(record.worst_budget_defect(), 1e-12);
    }

    TEST(MeshFile, MaterialsConductAsTheirCellsDo)
    {
      // Two layers in series: the temperature bends where they meet.
      Scene scene = box(unit_material(-5), 2, {}, {1, 1, 0}, 0, 20);
      scene.material.latent_heat = 0;
      BodyMeshData mesh = lattice_mesh(CellKind::triangle, 4);
      mesh.materials = {"poor", "good"};
      for(std::size_t cell = 0; cell < mesh.material_of_cell.size(); ++cell)
        mesh.material_of_cell[cell] = cell / 2 % 4 >= 2; // beyond x = 0.5
      take_mesh(scene, mesh);
      scene.inclusion = Inclusion{Field::uniform(1), 3, 1u};
      set_boundary(scene, wall(scene, "x_min"), fixed_wall(0));
      set_boundary(scene, wall(scene, "x_max"), fixed_wall(1));
      const RunRecord record = run(scene, 2);
      for(std::size_t i = 0; i < record.temperature.size(); ++i)
      {
        const double x = record.positions[0][i];
        EXPECT_NEAR(record.temperature[i], x < 0.5 ? 1.5 * x : 0.75 + 0.5 * (x - 0.5),
                    1e-8);
      }
    }

    TEST(MeshFile, WallsTakeAllKinds)
    {
      Scene scene = meshed(box(unit_material(-5), 2, {}, {1, 1, 0}, 0, 0.1),
                           CellKind::triangle, 4);
      set_boundary(scene, wall(scene, "x_min"), flux_wall(2));
      Boundary exchange{BoundaryKind::heat_transfer, Field::uniform(1)};
      exchange.heat_transfer_coefficient = 3;
      set_boundary(scene, wall(scene, "y_max"), exchange);
      Boundary radiation{BoundaryKind::radiation, Field::uniform(1)};
      radiation.emission_coefficient = 1;
      radiation.absolute_zero = -4;
      set_boundary(scene, wall(scene, "y_min"), radiation);
      const RunRecord record = run(scene, 2);
      EXPECT_LE(record.worst_budget_defect(), 1e-12);
      EXPECT_GT(record.heat.boundary, 2 * 0.1) << "the flux, and more";
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
