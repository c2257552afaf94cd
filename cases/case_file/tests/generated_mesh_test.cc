#include <cases/case_file/generated_mesh.h>
#include <cases/case_file/tests/sample_case.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace meltfront::cases::test
{
  namespace
  {
    constexpr double pi = std::numbers::pi;

    const MeshGenerator &generator_named(const std::string &name)
    {
      for(const MeshGenerator &generator : mesh_generators())
        if(generator.name == name)
          return generator;
      throw std::logic_error(name);
    }

    BodyMesh body_of(const std::string &name, int dimension, const std::string &arguments,
                     int halvings = 0)
    {
      return BodyMesh(
          generate_mesh(generator_named(name), dimension, arguments, halvings).cells);
    }

    struct Example
    {
      const char *generator;
      int dimension;
      const char *arguments;
      double volume; ///< of the body that the curves bound
      bool curved = false;
    };

    const Example examples[] = {
        {"hyper_cube", 2, "0 : 2 : true", 4},
        {"hyper_cube", 3, "-1 : 1 : false", 8},
        {"subdivided_hyper_cube", 2, "3 : 0 : 1 : false", 1},
        {"subdivided_hyper_cube", 3, "2 : 0 : 1 : true", 1},
        {"hyper_rectangle", 2, "0, 0 : 2, 3 : true", 6},
        {"hyper_rectangle", 3, "0, 0, 0 : 2, 3, 4 : true", 24},
        {"subdivided_hyper_rectangle", 2, "2, 3 : 0, 0 : 2, 3 : true", 6},
        {"subdivided_hyper_rectangle", 3, "2, 3, 1 : 0, 0, 0 : 2, 3, 1 : true", 6},
        {"general_cell", 2, "0, 0 ; 1, 0 ; 0, 1 ; 1.5, 2 : false", 1.75},
        {"general_cell", 3,
         "0, 0, 0; 1, 0, 0; 0, 1, 0; 1, 1, 0; 0, 0, 1; 1, 0, 1; 0, 2, 1; 1, 2, 1 : true",
         1.5},
        {"simplex", 2, "0, 0 ; 1, 0 ; 0, 1", 0.5},
        {"simplex", 3, "0, 0, 0 ; 1, 0, 0 ; 0, 1, 0 ; 0, 0, 1", 1. / 6},
        {"hyper_L", 2, "-1 : 1 : false", 3},
        {"hyper_L", 3, "-1 : 1 : true", 7},
        {"hyper_cross", 2, "1, 2, 1, 0 : false", 5},
        {"hyper_cross", 3, "1, 1, 1, 1, 1, 1 : true", 7},
        {"cheese", 2, "1, 2", 13},
        {"enclosed_hyper_cube", 2, "0 : 1 : 0.5 : false", 4},
        {"enclosed_hyper_cube", 3, "0 : 1 : 0.5 : false", 8},
        {"plate_with_a_hole", 2, "0.4 : 1 : 2 : 2 : 1 : 1 : 0, 0 : 0 : 1 : 1 : 2 : true",
         24 - 0.16 * pi, true},
        {"plate_with_a_hole", 3,
         "0.4 : 1 : 2 : 2 : 1 : 1 : 0, 0, 0 : 0 : 1 : 2 : 2 : true", 2 * (24 - 0.16 * pi),
         true},
        {"channel_with_cylinder", 2, "0.03 : 2 : 2 : true", 2.2 * 0.41 - 0.0025 * pi,
         true},
        {"channel_with_cylinder", 3, "0.03 : 1 : 2 : true",
         (2.2 * 0.41 - 0.0025 * pi) * 0.41, true},
        {"hyper_cube_with_cylindrical_hole", 2, "0.25 : 0.5 : 0.5 : 1 : true",
         1 - pi / 16, true},
        {"hyper_cube_with_cylindrical_hole", 3, "0.25 : 0.5 : 0.5 : 2 : true",
         0.5 * (1 - pi / 16), true},
        {"hyper_ball", 2, "1, 2 : 2 : false", 4 * pi, true},
        {"hyper_ball", 3, "0, 0, 0 : 1 : false", 4 * pi / 3, true},
        {"quarter_hyper_ball", 2, "0, 0 : 1", pi / 4, true},
        {"quarter_hyper_ball", 3, "0, 0, 0 : 1", pi / 6, true},
        {"half_hyper_ball", 2, "0, 0 : 1", pi / 2, true},
        {"half_hyper_ball", 3, "0, 0, 0 : 1", 2 * pi / 3, true},
        {"hyper_shell", 2, "0, 0 : 1 : 2 : 0 : true", 3 * pi, true},
        {"hyper_shell", 3, "0, 0, 0 : 1 : 2 : 12 : true", 4 * pi / 3 * 7, true},
        {"half_hyper_shell", 2, "0, 0 : 1 : 2 : 4 : true", 1.5 * pi, true},
        {"half_hyper_shell", 3, "0, 0, 0 : 1 : 2 : 0 : true", 2 * pi / 3 * 7, true},
        {"quarter_hyper_shell", 2, "0, 0 : 1 : 2 : 2 : true", 0.75 * pi, true},
        {"quarter_hyper_shell", 3, "0, 0, 0 : 1 : 2 : 0 : true", pi / 6 * 7, true},
        {"concentric_hyper_shells", 2, "0, 0 : 1 : 2 : 2 : 0 : 8 : true", 3 * pi, true},
        {"concentric_hyper_shells", 3, "0, 0, 0 : 1 : 2 : 2 : 0.1 : 6 : true",
         4 * pi / 3 * 7, true},
        {"cylinder", 3, "1 : 2", 4 * pi, true},
        {"truncated_cone", 3, "1 : 0.5 : 1", 2 * pi / 3 * 1.75, true},
        {"cylinder_shell", 3, "2 : 0.5 : 1 : 8 : 0", 1.5 * pi, true},
        {"torus", 3, "2 : 0.5 : 6 : 3", 0.25 * pi * 6, true},
        {"moebius", 3, "12 : 0 : 2 : 0.5", 0}};

    TEST(GeneratedMesh, EveryGeneratorMakesItsBody)
    {
      std::set<std::pair<std::string, int>> made;
      for(const Example &example : examples)
      {
        SCOPED_TRACE(example.generator);
        const auto error = [&](int halvings)
        {
          return body_of(example.generator, example.dimension, example.arguments,
                         halvings)
                         .volume()
                     / example.volume
                 - 1;
        };
        try
        {
          made.emplace(example.generator, example.dimension);
          const bool curved = generate_mesh(generator_named(example.generator),
                                            example.dimension, example.arguments, 0)
                                  .curved;
          EXPECT_EQ(curved, example.curved);
          if(example.volume == 0)
          {
            EXPECT_GT(body_of(example.generator, 3, example.arguments).volume(), 0);
          }
          else if(curved)
          {
            const double coarse = error(1), fine = error(2);
            EXPECT_NEAR(coarse / fine, 4, 0.6) << "the polygon nears the curve";
            EXPECT_NEAR((4 * fine - coarse) / 3, 0, 0.015) << "by Richardson's estimate";
          }
          else
          {
            EXPECT_NEAR(error(0), 0, 1e-13);
            EXPECT_NEAR(error(1), 0, 1e-13);
          }
        }
        catch(const InputError &complaint)
        {
          ADD_FAILURE() << example.dimension << ": " << complaint.what();
        }
      }
      for(const MeshGenerator &generator : mesh_generators())
        for(const int dimension : generator.dimensions)
          EXPECT_TRUE(made.contains({generator.name, dimension}))
              << generator.name << " in " << dimension << " dimensions has no example";
    }

    TEST(GeneratedMesh, ABallIsThePolygonOfItsHalvings)
    {
      for(const int halvings : {0, 1, 3})
      {
        const double sides = 4 * std::exp2(halvings);
        const BodyMesh body = body_of("hyper_ball", 2, "0, 0 : 1 : false", halvings);
        EXPECT_NEAR(body.volume(), sides / 2 * std::sin(2 * pi / sides), 1e-13);
        EXPECT_NEAR(body.area(0), 2 * sides * std::sin(pi / sides), 1e-13);
      }
    }

    /** The square of the sample case, made by a generator. */
    std::string generated(const std::string &generator, const std::string &arguments,
                          const std::string &keys = "", int dimension = 2)
    {
      return replaced(square,
                      "    set shape = box\n    set dimension = 2\n"
                      "    set lower corner = -1, -1\n    set upper corner = 1, 1\n",
                      "    set shape = mesh\n    set dimension = "
                          + std::to_string(dimension)
                          + "\n    set generator = " + generator
                          + "\n    set generator arguments = " + arguments + "\n" + keys);
    }

    std::string complaint_about(const std::string &text)
    {
      try
      {
        read_case_text(text, "body.prm");
        return "accepted";
      }
      catch(const InputError &error)
      {
        return error.what();
      }
    }

    void expect_complaint(const std::string &text, const std::string &piece)
    {
      const std::string message = complaint_about(text);
      EXPECT_NE(message.find(piece), std::string::npos) << message;
      EXPECT_EQ(message.rfind("body.prm:", 0), 0u) << "names a place: " << message;
    }

    TEST(GeneratedMeshCase, WallsAreTheNumbersOfTheBoundary)
    {
      const std::string walls = "  subsection Walls\n    subsection 2\n"
                                "      set kind = fixed temperature\n"
                                "      set temperature = -5\n    end\n  end\n";
      const Case c = read_case_text(
          replaced(generated("hyper_rectangle", "-1, -1 : 1, 1 : true"),
                   "  subsection Source 1\n", walls + "  subsection Source 1\n"),
          "body.prm");
      const Domain &domain = c.scene.domain;
      EXPECT_EQ(domain.shape, DomainShape::mesh);
      ASSERT_EQ(c.scene.sides().size(), 4u);
      for(const Side side : c.scene.sides())
        EXPECT_EQ(c.scene.boundary(side).kind, name_of(domain, side) == "2"
                                                   ? BoundaryKind::fixed_temperature
                                                   : BoundaryKind::insulated);
      EXPECT_EQ(domain.mesh->area(2), 2) << "y_min";
      EXPECT_EQ(domain.lower, (Position{-1, -1, 0}));
      EXPECT_EQ(domain.side(), 2);
      const Case again = read_case_text(c.text, "elsewhere.prm");
      EXPECT_EQ(again.scene.domain.mesh->cells(), domain.mesh->cells());
    }

    TEST(GeneratedMeshCase, MaterialsAreItsNumbers)
    {
      const std::string keys = "    set materials = 0, 1, 2, 4, 5, 6, 8, 9, 10\n";
      const std::string text = generated("enclosed_hyper_cube", "-1 : 1 : 1 : true");
      expect_complaint(text, "is neither named in the key 'materials'");
      EXPECT_FALSE(
          read_case_text(generated("enclosed_hyper_cube", "-1 : 1 : 1 : true", keys),
                         "body.prm")
              .scene.inclusion);
    }

    TEST(GeneratedMeshCase, WhatIsWrongIsNamed)
    {
      expect_complaint(generated("hyper_bal", "0, 0 : 1 : false"), "'hyper_ball'");
      expect_complaint(generated("cylinder", "1 : 1"),
                       "names cylinder, which makes no mesh in 2 dimensions");
      expect_complaint(generated("hyper_ball", "0, 0 : 1"),
                       "must hold 3 values separated by colons, not 2: centre (a point "
                       "x, y) : radius (a number greater than 0) : spheres inside (true "
                       "or false)");
      expect_complaint(generated("hyper_ball", "0, 0, 0 : 1 : false"),
                       "holds '0, 0, 0' as the centre of a hyper_ball, which must be a "
                       "point x, y");
      expect_complaint(generated("hyper_ball", "0, 0 : 3 cm : false"),
                       "holds '3 cm' as the radius");
      expect_complaint(generated("hyper_ball", "0, 0 : 0 : false"),
                       "which must be a number greater than 0");
      expect_complaint(generated("hyper_ball", "0, 0 : nan : false"), "holds 'nan'");
      expect_complaint(generated("hyper_ball", "0, 0 : 1 : yes"),
                       "must be true or false");
      expect_complaint(generated("hyper_ball", "0, 0 : 1 : false"),
                       "key 'generator halvings' in subsection 'Scene/Domain' is "
                       "missing: a hyper_ball is curved");
      expect_complaint(
          generated("hyper_shell", "0, 0 : 2 : 1 : 8 : true",
                    "    set generator halvings = 1\n"),
          "holds 2 as the inner radius of a hyper_shell and 1 as the outer radius, "
          "which must be larger");
      expect_complaint(
          generated("general_cell", "0, 0; 1, 0; 1, 1; 0, 1 : false"),
          "cannot be used: general_cell: the mesh has a cell that is folded or flat");
      expect_complaint(generated("subdivided_hyper_cube", "4000 : 0 : 1 : true"),
                       "there may be");
      expect_complaint(generated("subdivided_hyper_cube", "300 : 0 : 1 : true",
                                 "    set generator halvings = 4\n"),
                       "cells after 4 halvings");
      expect_complaint(generated("torus", "1 : 2 : 6 : 3", "", 3),
                       "and 1 as the radius of the ring, which must be larger");
      expect_complaint(replaced(generated("hyper_cube", "0 : 1 : true"),
                                "    set generator arguments = 0 : 1 : true\n", ""),
                       "key 'generator arguments' in subsection 'Scene/Domain' is "
                       "missing: hyper_cube needs left (a number)");
      expect_complaint(generated("hyper_cube", "0 : 1 : true",
                                 "    set file = ../data/wax-store.msh\n"),
                       "key 'file' in subsection 'Scene/Domain' has no meaning here");
      expect_complaint(replaced(square, "    set shape = box\n",
                                "    set shape = box\n    set generator = hyper_cube\n"),
                       "has no meaning here: the shape is a box");
    }
  } // namespace
} // namespace meltfront::cases::test
