#include <cases/error.h>
#include <cases/gmsh_file.h>
#include <cases/tests/support/meshes.h>

#include <gtest/gtest.h>

namespace meltfront::cases
{
  namespace
  {
    using test_support::gmsh_text;
    using test_support::lattice_mesh;

    /** Two triangles in format 4.1, one wall with a name and one with a number only. */
    const std::string blocks = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 3 "hot wall"
2 9 "ice"
$EndPhysicalNames
$Entities
1 2 1 0
1 0 0 0 0
1 0 0 0 1 0 0 1 3 2 1 -1
2 0 0 0 0 1 0 1 5 2 1 -1
1 0 0 0 1 1 0 1 9 2 1 2
$EndEntities
$Nodes
2 4 1 4
0 1 0 1
1
0 0 0
2 1 0 3
2
3
4
1 0 0
1 1 0
0 1 0
$EndNodes
$Elements
3 4 1 4
1 1 1 1
1 1 2
1 2 1 1
2 1 4
2 1 2 2
3 1 2 3
4 1 3 4
$EndElements
)";

    std::string changed(std::string text, const std::string &from, const std::string &to)
    {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      return text.replace(at, from.size(), to);
    }

    void expect_complaint(const std::string &text, const std::string &piece,
                          int dimension = 2)
    {
      try
      {
        read_gmsh(text, "body.msh", dimension);
        ADD_FAILURE() << "accepted, not " << piece;
      }
      catch(const InputError &error)
      {
        const std::string message = error.what();
        EXPECT_EQ(message.rfind("body.msh:", 0), 0u) << message;
        EXPECT_NE(message.find(piece), std::string::npos) << message;
      }
    }

    TEST(GmshFile, CellsOfAllKindsAreRead)
    {
      for(const CellKind kind : {CellKind::triangle, CellKind::quadrilateral,
                                 CellKind::tetrahedron, CellKind::hexahedron})
      {
        const BodyMeshData mesh = lattice_mesh(kind, 2);
        const BodyMeshData read
            = read_gmsh(gmsh_text(mesh), "body.msh", dimension_of(kind));
        EXPECT_EQ(read.kind, kind);
        EXPECT_EQ(read.cells, mesh.cells);
        EXPECT_EQ(read.vertices, mesh.vertices);
        EXPECT_EQ(read.materials, mesh.materials);
        EXPECT_EQ(BodyMesh(read).area(1), BodyMesh(mesh).area(1));
      }
    }

    TEST(GmshFile, BlocksOfFormatFourAreRead)
    {
      const BodyMeshData mesh = read_gmsh(blocks, "body.msh", 2);
      EXPECT_EQ(mesh.kind, CellKind::triangle);
      EXPECT_EQ(mesh.cells, (std::vector<unsigned int>{0, 1, 2, 0, 2, 3}));
      EXPECT_EQ(mesh.walls, (std::vector<std::string>{"hot wall", "5"}));
      EXPECT_EQ(mesh.materials, std::vector<std::string>{"ice"});
      const BodyMesh body(mesh);
      EXPECT_DOUBLE_EQ(body.volume(), 1);
      EXPECT_DOUBLE_EQ(body.area(0), 1);
      EXPECT_DOUBLE_EQ(body.area(-1), 2);
    }

    TEST(GmshFile, LinesEndAsTheyLike)
    {
      std::string text;
      for(const char c : blocks)
        text += c == '\n' ? "\r\n" : std::string(1, c);
      EXPECT_EQ(read_gmsh(text, "body.msh", 2).cells.size(), 6u);
    }

    TEST(GmshFile, WhatIsNoMeshIsNamedWithItsLine)
    {
      expect_complaint("solid cube\n", "body.msh:1: this is no mesh file of gmsh");
      expect_complaint("", "body.msh: the mesh holds no cells");
      expect_complaint(changed(blocks, "4.1 0 8", "4.1 1 8"), "body.msh:2: the file is "
                                                              "binary");
      expect_complaint(changed(blocks, "4.1 0 8", "4 0 8"), "2.2 and 4.1 are read");
      expect_complaint(blocks.substr(0, blocks.find("$EndElements") - 8), "breaks off");
      expect_complaint(blocks.substr(0, blocks.find("$EndEntities")),
                       "breaks off in the section $Entities");
      expect_complaint(changed(blocks, "3 1 2 3", "3 1 2 7"), ":36: there is no node 7");
      expect_complaint(changed(blocks, "3 1 2 3", "3 1 2"), "needs 3 nodes");
      expect_complaint(changed(blocks, "3 1 2 3", "3 1 2 x"), "needs numbers here");
      expect_complaint(changed(blocks, "2 1 2 2", "2 1 9 2"), "first order");
      expect_complaint(changed(blocks, "2 1 2 2", "2 1 6 2"), "prisms");
      expect_complaint(changed(blocks, "1 1 0\n", "1 1 nan\n"), "needs numbers here");
      expect_complaint(changed(blocks, "1 1 0\n", "1 1 1\n"), "their z varies");
      expect_complaint(changed(blocks, "1 9 2 1 2", "2 8 9 2 1 2"), "has to be of one");
      expect_complaint(changed(blocks, "2\n3\n4\n", "2\n3\n3\n"), "for the second time");
      expect_complaint(blocks, "has 2 dimensions, and the domain has 3", 3);
      expect_complaint(changed(blocks, "2 1 2 2\n3 1 2 3\n4 1 3 4",
                               "2 1 2 1\n3 1 2 3\n2 1 3 1\n4 1 2 3 4"),
                       "goes on where it should end");
    }

    TEST(GmshFile, CellsOfTwoKindsAreRefused)
    {
      expect_complaint(changed(changed(blocks, "3 4 1 4\n1 1 1 1", "4 5 1 5\n1 1 1 1"),
                               "4 1 3 4\n", "4 1 3 4\n2 1 3 1\n5 1 2 3 4\n"),
                       "holds triangles and quadrilaterals");
    }
  } // namespace
} // namespace meltfront::cases
