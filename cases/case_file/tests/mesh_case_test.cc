#include <cases/case_file/prm_attachment.h>
#include <cases/case_file/tests/sample_case.h>
#include <cases/case_file/vary_case.h>
#include <cases/tests/support/meshes.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace meltfront::cases::test
{
  namespace
  {
    namespace fs = std::filesystem;
    using test_support::gmsh_text;
    using test_support::lattice_mesh;

    /** A folder with a mesh in it and a case that names it. */
    class MeshCase : public ::testing::Test
    {
    protected:
      MeshCase()
        : folder(fs::temp_directory_path()
                 / ("meltfront-mesh-" + std::to_string(getpid())))
      {
        fs::create_directories(folder);
        write("body.msh", gmsh_text(lattice_mesh(CellKind::triangle, 4)));
      }

      ~MeshCase() override
      {
        fs::remove_all(folder);
      }

      std::string write(const std::string &name, const std::string &text) const
      {
        std::ofstream(folder / name) << text;
        return (folder / name).string();
      }

      /** The square of the sample case as a mesh. */
      static std::string meshed(const std::string &keys = "",
                                const std::string &scene = "")
      {
        return replaced(
            replaced(square,
                     "    set shape = box\n    set dimension = 2\n"
                     "    set lower corner = -1, -1\n    set upper corner = 1, 1\n",
                     "    set shape = mesh\n    set dimension = 2\n"
                     "    set file = body.msh\n"
                         + keys),
            "  subsection Source 1\n    set position = 0, 0\n",
            scene + "  subsection Source 1\n    set position = 0.5, 0.5\n");
      }

      Case read_there(const std::string &text) const
      {
        return read_case(write("body.prm", text));
      }

      void expect_complaint(const std::string &text, const std::string &piece) const
      {
        try
        {
          read_there(text);
          ADD_FAILURE() << "accepted, not " << piece;
        }
        catch(const InputError &error)
        {
          const std::string message = error.what();
          EXPECT_NE(message.find(piece), std::string::npos) << message;
          EXPECT_EQ(message.rfind(folder.string(), 0), 0u)
              << "names a place: " << message;
        }
      }

      fs::path folder;
    };

    const std::string cold_wall = "  subsection Walls\n    subsection x_min\n"
                                  "      set kind = fixed temperature\n"
                                  "      set temperature = -5 - y\n    end\n"
                                  "    subsection y_max\n      set kind = flux\n"
                                  "      set flux = 3*t\n    end\n  end\n";

    TEST_F(MeshCase, DomainAndWallsAreRead)
    {
      const Case c = read_there(meshed("", cold_wall));
      const Domain &domain = c.scene.domain;
      EXPECT_EQ(domain.shape, DomainShape::mesh);
      ASSERT_TRUE(domain.mesh);
      EXPECT_DOUBLE_EQ(domain.mesh->volume(), 1);
      EXPECT_EQ(domain.side(), 1);
      ASSERT_EQ(c.scene.sides().size(), 4u);
      for(const Side side : c.scene.sides())
      {
        const Boundary &boundary = c.scene.boundary(side);
        const std::string name = name_of(domain, side);
        EXPECT_EQ(boundary.kind, name == "x_min"   ? BoundaryKind::fixed_temperature
                                 : name == "y_max" ? BoundaryKind::flux
                                                   : BoundaryKind::insulated)
            << name << ": what the case does not name is insulated";
        if(name == "x_min")
        {
          EXPECT_EQ(boundary.value({0, 1, 0}, 0), -6);
        }
      }
      const TemperatureBounds bounds = temperature_bounds(c.scene);
      EXPECT_EQ(bounds.lower, -std::numeric_limits<double>::infinity()) << "a sink";
    }

    TEST_F(MeshCase, TextOfACaseHoldsItsMesh)
    {
      const Case c = read_there(meshed("", cold_wall));
      EXPECT_NE(c.text.find("#@ file body.msh"), std::string::npos);
      EXPECT_EQ(without_attachments(c.text).find("$MeshFormat"), std::string::npos);
      fs::remove(folder / "body.msh");
      const Case again = read_case_text(c.text, "elsewhere.prm");
      EXPECT_EQ(again.text, c.text);
      EXPECT_EQ(again.scene.domain.mesh->vertices(), c.scene.domain.mesh->vertices());
      const Case varied = vary_case(
          c, "varied", {{"Scene/Walls/y_max/flux", "7"}, {"title", "Another"}});
      EXPECT_EQ(varied.scene.domain.mesh->cells(), c.scene.domain.mesh->cells());
    }

    TEST_F(MeshCase, OtherMeshesMakeOtherTexts)
    {
      const std::string before = read_there(meshed()).text;
      write("body.msh", gmsh_text(lattice_mesh(CellKind::triangle, 5)));
      EXPECT_NE(read_there(meshed()).text, before) << "and so another hash";
    }

    TEST_F(MeshCase, WhatIsWrongWithAMeshIsNamed)
    {
      expect_complaint(
          replaced(meshed(), "body.msh", "bodi.msh"),
          "names the file 'bodi.msh', which is neither beside this file nor");
      expect_complaint(replaced(meshed(), "    set file = body.msh\n", ""),
                       "key 'file' in subsection 'Scene/Domain' is missing");
      expect_complaint(replaced(meshed(), "set dimension = 2", "set dimension = 3"),
                       "has 2 dimensions, and the domain has 3");
      expect_complaint(meshed("    set radius = 1\n"), "has no meaning here");
      expect_complaint(replaced(square, "    set shape = box\n",
                                "    set shape = box\n    set file = body.msh\n"),
                       "has no meaning here: the shape is a box");
      write("other.msh", "solid cube\n");
      expect_complaint(replaced(meshed(), "body.msh", "other.msh"),
                       "other.msh:1: this is no mesh file of gmsh");
      write("other.msh", std::string("$MeshFormat\n\x01\n", 15));
      expect_complaint(replaced(meshed(), "body.msh", "other.msh"),
                       "other.msh:2: the line is not UTF-8 text");
      BodyMeshData folded = lattice_mesh(CellKind::quadrilateral, 2);
      folded.vertices[4] = {1.2, 1.2, 0};
      write("other.msh", gmsh_text(folded));
      expect_complaint(replaced(meshed(), "body.msh", "other.msh"), "folded or flat");
      BodyMeshData parted
          = lattice_mesh(CellKind::quadrilateral, 3, {},
                         [](const Position &p) { return std::abs(p[0] - 0.5) > 0.2; });
      write("other.msh", gmsh_text(parted));
      expect_complaint(replaced(meshed(), "body.msh", "other.msh"), "falls apart");
    }

    TEST_F(MeshCase, WhatIsWrongWithItsWallsIsNamed)
    {
      expect_complaint(replaced(meshed("", cold_wall), "y_max", "lid"),
                       "'Scene/Walls/lid' names a wall that the domain lacks; its walls "
                       "are x_min, ");
      expect_complaint(replaced(meshed("", cold_wall), "set flux", "set flus"),
                       "the nearest valid key is 'flux'");
      expect_complaint(replaced(meshed("", cold_wall),
                                "set kind = flux\n      set flux = 3*t",
                                "set kind = periodic"),
                       "cannot be periodic");
      expect_complaint(replaced(meshed(), "position = 0.5, 0.5", "position = 1.5, 0.5"),
                       "lies outside the domain");
    }

    TEST_F(MeshCase, MaterialsAreMapped)
    {
      BodyMeshData mesh = lattice_mesh(CellKind::quadrilateral, 4);
      mesh.materials = {"steel", "copper"};
      for(std::size_t cell = 8; cell < 16; ++cell) // above y = 0.5
        mesh.material_of_cell[cell] = 1;
      write("body.msh", gmsh_text(mesh));
      expect_complaint(meshed(), "'steel' is neither named in the key 'materials'");
      expect_complaint(meshed("    set materials = steel, iron\n"),
                       "names the material 'iron', which the mesh lacks; it has steel, "
                       "copper");
      EXPECT_FALSE(
          read_there(meshed("    set materials = steel, copper\n")).scene.inclusion);
      const std::string solid_only
          = replaced(meshed("    set materials = steel\n",
                            "  subsection Inclusion\n    set material = copper\n"
                            "    set conductivity = 400\n  end\n"),
                     "    set latent heat = 333500\n", "    set latent heat = 0\n");
      const Case c = read_there(solid_only);
      EXPECT_EQ(c.scene.conductivity_at({0.3, 0.7, 0}), 400);
      EXPECT_EQ(c.scene.conductivity_at({0.3, 0.2, 0}), 2.2);
      ASSERT_TRUE(c.scene.inclusion->material);
      EXPECT_EQ(*c.scene.inclusion->material, 1u);
    }
  } // namespace
} // namespace meltfront::cases::test
