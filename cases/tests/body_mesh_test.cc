#include <cases/domain_measure.h>
#include <cases/error.h>
#include <cases/sampling.h>
#include <cases/tests/support/meshes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    using test_support::lattice_mesh;

    const CellKind all_kinds[] = {CellKind::triangle, CellKind::quadrilateral,
                                  CellKind::tetrahedron, CellKind::hexahedron};

    /** A shear with a bulge that leaves the walls where they are: cells are none of
     * rectangles, and faces within are bilinear. */
    Position bent(const Position &p)
    {
      const double bulge = 0.08 * std::sin(M_PI * p[0]) * std::sin(M_PI * p[1])
                           * (p[2] > 0 ? std::sin(M_PI * p[2]) : 1);
      return {p[0] + bulge + 0.3 * p[1], p[1] - bulge, p[2] + (p[2] > 0 ? bulge : 0)};
    }

    std::string complaint(const BodyMeshData &mesh)
    {
      try
      {
        const BodyMesh body(mesh);
      }
      catch(const InputError &error)
      {
        return error.what();
      }
      return "";
    }

    TEST(BodyMesh, MeasuresAreThoseOfTheBody)
    {
      for(const CellKind kind : all_kinds)
      {
        const BodyMesh mesh(lattice_mesh(kind, 4, bent));
        EXPECT_NEAR(mesh.volume(), 1, 1e-14) << to_string(kind);
        double volume = 0, moment = 0;
        mesh.visit_volume(1,
                          [&](const Position &p, double part)
                          {
                            volume += part;
                            moment += part * p[1];
                          });
        EXPECT_NEAR(volume, 1, 1e-13);
        EXPECT_NEAR(moment, 0.5, 1e-3);
        // x_min leans: it is sqrt(1 + 0.3^2) long.
        EXPECT_NEAR(mesh.area(0), std::sqrt(1.09), 1e-13);
        EXPECT_NEAR(mesh.area(2), 1, 1e-13);
        EXPECT_EQ(mesh.area(-1), 0);
        double wall = 0;
        mesh.visit_wall(3, 2,
                        [&](const Position &p, double part)
                        {
                          wall += part;
                          EXPECT_NEAR(p[1], 1, 1e-14);
                        });
        EXPECT_NEAR(wall, mesh.area(3), 1e-13);
      }
    }

    TEST(BodyMesh, PointsAreFoundInside)
    {
      for(const CellKind kind : all_kinds)
      {
        const int dimension = dimension_of(kind);
        // A body with a hole from side to side.
        const BodyMesh mesh(lattice_mesh(kind, 3, {},
                                         [](const Position &p) {
                                           return std::abs(p[0] - 0.5) > 0.2
                                                  || std::abs(p[1] - 0.5) > 0.2;
                                         }));
        EXPECT_NEAR(mesh.volume(), 8. / 9, 1e-14);
        EXPECT_NEAR(mesh.area(-1), 4. / 3, 1e-14) << "the hole's walls are of no group";
        const double z = dimension == 3 ? 0.4 : 0;
        EXPECT_TRUE(mesh.cell_at({0.1, 0.9, z}));
        EXPECT_TRUE(mesh.cell_at({1, 1, z})) << "its boundary belongs to it";
        EXPECT_TRUE(mesh.cell_at({1. / 3, 0.5, z}));
        EXPECT_FALSE(mesh.cell_at({0.5, 0.5, z})) << "the hole";
        EXPECT_FALSE(mesh.cell_at({1.01, 0.5, z}));
        EXPECT_NEAR(mesh.distance_from_boundary({0.5, 0.4, z}), 0.4 - 1. / 3, 1e-14);
        EXPECT_NEAR(mesh.distance_from_boundary({0.9, 0.5, z}), 0.1, 1e-14);
      }
    }

    TEST(BodyMesh, SamplesOfADomainLieInIt)
    {
      Scene scene;
      test_support::take_mesh(scene, lattice_mesh(CellKind::triangle, 2, {},
                                                  [](const Position &p)
                                                  { return p[0] < 0.5 || p[1] < 0.5; }));
      EXPECT_DOUBLE_EQ(volume_of(scene.domain), 0.75);
      EXPECT_DOUBLE_EQ(area_of(scene.domain, mesh_wall(1)), 0.5);
      EXPECT_EQ(name_of(scene.domain, mesh_wall(1)), "x_max");
      int count = 0;
      visit_points(scene.domain,
                   [&](const Position &p)
                   {
                     ++count;
                     EXPECT_FALSE(p[0] > 0.5 && p[1] > 0.5);
                   });
      EXPECT_GT(count, 600);
      count = 0;
      visit_wall(scene.domain, mesh_wall(1),
                 [&](const Position &p)
                 {
                   ++count;
                   EXPECT_EQ(p[0], 1);
                 });
      EXPECT_GT(count, 200);
    }

    TEST(BodyMesh, CellsThatAreTurnedAreTurnedBack)
    {
      for(const CellKind kind : all_kinds)
      {
        BodyMeshData data = lattice_mesh(kind, 2);
        for(Position &p : data.vertices)
          p[0] = -p[0]; // a mirror image
        const BodyMesh mesh(data);
        EXPECT_NEAR(mesh.volume(), 1, 1e-14);
        EXPECT_NEAR(mesh.area(0), 1, 1e-14);
      }
    }

    TEST(BodyMesh, WhatIsNoBodyIsNamed)
    {
      const auto expect = [](const BodyMeshData &mesh, const std::string &piece)
      {
        const std::string message = complaint(mesh);
        EXPECT_NE(message.find(piece), std::string::npos) << message;
      };
      const BodyMeshData good = lattice_mesh(CellKind::quadrilateral, 2);
      EXPECT_EQ(complaint(good), "");
      BodyMeshData mesh = good;
      mesh.cells.clear();
      mesh.material_of_cell.clear();
      expect(mesh, "holds no cells");
      mesh = good;
      mesh.vertices[4] = {1.2, 1.2, 0};
      expect(mesh, "folded or flat at");
      mesh = good;
      mesh.vertices[4] = mesh.vertices[8];
      expect(mesh, "two vertices at (1, 1)");
      mesh = good;
      mesh.cells.insert(mesh.cells.end(), mesh.cells.begin(), mesh.cells.begin() + 4);
      mesh.material_of_cell.push_back(0);
      mesh.cells.insert(mesh.cells.end(), mesh.cells.begin(), mesh.cells.begin() + 4);
      mesh.material_of_cell.push_back(0);
      expect(mesh, "more than two cells at one face");
      mesh = good;
      mesh.faces.push_back({{0, 1}, 1});
      expect(mesh, "a face of both");
      mesh = good;
      mesh.faces.push_back({{0, 8}, 1});
      expect(mesh, "a face of 'x_max' that no cell has");
      // Two small cells beside a large one: a vertex hangs between them.
      mesh = {};
      mesh.kind = CellKind::quadrilateral;
      mesh.vertices
          = {{0, 0, 0},   {1, 0, 0},   {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0},
             {1, 0.5, 0}, {2, 0.5, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}};
      mesh.cells = {0, 1, 3, 4, 1, 2, 6, 7, 6, 7, 4, 5, 3, 4, 8, 9, 4, 5, 9, 10};
      mesh.material_of_cell.assign(5, 0);
      mesh.materials = {"body"};
      expect(mesh, "on a face of a cell that lacks it, at (1, 0.5)");
      expect(lattice_mesh(CellKind::quadrilateral, 3, {},
                          [](const Position &p) { return std::abs(p[0] - 0.5) > 0.2; }),
             "falls apart");
    }
  } // namespace
} // namespace meltfront::cases
