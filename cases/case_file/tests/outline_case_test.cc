#include <cases/case_file/tests/sample_case.h>

#include <gtest/gtest.h>

namespace meltfront::cases::test
{
  namespace
  {
    const std::string corners = "    set corners = -1, -1; 1, -1; 1, 1; 0, 0.5; -1, 1\n";

    /** The square of the sample case with another domain. */
    std::string outlined(const std::string &keys)
    {
      return replaced(square,
                      "    set shape = box\n    set dimension = 2\n"
                      "    set lower corner = -1, -1\n    set upper corner = 1, 1\n",
                      "    set shape = outline\n    set dimension = 2\n" + keys);
    }

    void expect_complaint(const std::string &text, const std::string &piece)
    {
      const std::string message = complaint(text);
      EXPECT_NE(message.find(piece), std::string::npos) << message;
    }
  } // namespace

  TEST(OutlineCase, PolygonIsRead)
  {
    const Case c = read(outlined(corners));
    const Domain &domain = c.scene.domain;
    EXPECT_EQ(domain.shape, DomainShape::outline);
    ASSERT_TRUE(domain.outline);
    EXPECT_DOUBLE_EQ(domain.outline->area(), 3.5);
    EXPECT_EQ(domain.lower, (Position{-1, -1, 0}));
    EXPECT_EQ(domain.upper, (Position{1, 1, 0}));
    EXPECT_EQ(domain.side(), 2) << "the larger side of its bounding box";
    EXPECT_EQ(c.scene.sides(), std::vector<Side>{Side::outer});
    EXPECT_EQ(c.scene.boundary(Side::outer).kind, BoundaryKind::insulated);
  }

  TEST(OutlineCase, PolarRadiusIsRead)
  {
    const Case c = read(outlined("    set polar radius = 0.5 + 0.1*cos(2*phi)\n"
                                 "    set centre = 0.1, 0.2\n"
                                 "    set reference length = 3\n"));
    const Outline &outline = *c.scene.domain.outline;
    EXPECT_NEAR(outline.area(), 3.14159265358979 * 0.25 * (1 + 0.02), 1e-11);
    EXPECT_EQ(outline.centre(), (Outline::Point{0.1, 0.2}));
    EXPECT_EQ(c.scene.domain.side(), 3);
    EXPECT_TRUE(outline.inside({0.69, 0.2, 0}));
    EXPECT_FALSE(outline.inside({0.1, 0.69, 0}));
  }

  TEST(OutlineCase, WhatMakesNoOutlineIsNamed)
  {
    expect_complaint(outlined(""),
                     "key 'corners' in subsection 'Scene/Domain' is missing");
    expect_complaint(outlined(corners + "    set polar radius = 1\n"),
                     "key 'corners' in subsection 'Scene/Domain' has no meaning here");
    expect_complaint(outlined("    set corners = 0, 0; 1, 0\n"), "three at least");
    expect_complaint(outlined("    set corners = -1, -1; 1, 1; 1, -1; -1, 1\n"),
                     "crosses or touches itself");
    expect_complaint(outlined("    set corners = 0, 0; 1; 1, 1\n"),
                     "two coordinates in corner 2");
    expect_complaint(outlined("    set corners = 0, 0; 1, 0m; 1, 1\n"),
                     "holds '0m' in corner 2");
    expect_complaint(outlined("    set polar radius = cos(phi)\n"),
                     "key 'polar radius' in subsection 'Scene/Domain' is -1 at phi = ");
    expect_complaint(outlined("    set polar radius = 5 + phi\n"), "does not close");
    expect_complaint(outlined("    set polar radius = 1 + 0.1*cos(theta)\n"),
                     "the unknown name 'theta'");
    expect_complaint(outlined("    set polar radius = 1 + x\n"), "depends on x");
    expect_complaint(outlined(corners + "    set centre = 1, 2, 3\n"),
                     "needs 2 coordinates, not 3");
    expect_complaint(outlined(corners + "    set reference length = 0\n"),
                     "greater than 0");
    expect_complaint(outlined(corners + "    set radius = 1\n"),
                     "key 'radius' in subsection 'Scene/Domain' has no meaning here");
    expect_complaint(
        replaced(outlined(corners), "set dimension = 2", "set dimension = 3"),
        "must be 2 for an outline");
    expect_complaint(replaced(square, "set upper corner = 1, 1",
                              "set upper corner = 1, 1\n    set centre = 0, 0"),
                     "key 'centre' in subsection 'Scene/Domain' has no meaning here: the "
                     "shape is a box");
  }

  TEST(OutlineCase, SceneMustFitTheOutline)
  {
    expect_complaint(
        replaced(outlined(corners), "set position = 0, 0", "set position = 0, 0.7"),
        "lies outside the domain");
    expect_complaint(
        replaced(outlined(corners), "set symmetry = none", "set symmetry = cylindrical"),
        "contradicts the domain: an outline in 2 dimensions is none, not cylindrical");
    const auto walled = [](const std::string &side, const std::string &kind)
    {
      return replaced(outlined(corners), "  subsection Source 1",
                      "  subsection Walls\n    subsection " + side + "\n      set kind = "
                          + kind + "\n    end\n  end\n  subsection Source 1");
    };
    expect_complaint(walled("x_min", "insulated"), "its walls are outer");
    expect_complaint(walled("outer", "periodic"), "cannot be periodic");
    expect_complaint(replaced(outlined(corners), "set temperature = 10",
                              "set temperature = if(y > 0.95, 0/0, 10)"),
                     "nan at x = ");
  }

  TEST(OutlineCase, ExactSolutionsAreNotHeldAgainstItsFluxes)
  {
    const std::string exact = "\nsubsection Exact solution\n  set kind = line sink\n"
                              "  set lambda = 0.15\nend\n";
    expect_complaint(with(outlined(corners), exact), "lets a flux through an outline");
    EXPECT_NO_THROW(read(with(
        outlined(corners), exact + "subsection Measure\n  set front floor = 1\nend\n")));
  }

  TEST(MeasuredEvents, AreRead)
  {
    const Case c
        = read(with(square, "subsection Measure\n  set events = half_frozen, all_frozen\n"
                            "  set mirror = y\n"
                            "  set intermediate times = 1, 2, 3, 4, 5, 6, 7, 8\nend\n"));
    EXPECT_EQ(c.measurement.events,
              (std::vector{TimedEvent::half_frozen, TimedEvent::all_frozen}));
    EXPECT_EQ(c.measurement.mirror, 1);
    EXPECT_EQ(c.measurement.intermediate_times.size(), 8u);
    EXPECT_TRUE(read(square).measurement.events.empty());
    EXPECT_FALSE(read(square).measurement.mirror);
  }

  TEST(MeasuredEvents, ThatTheSceneCannotShowAreNamed)
  {
    const auto measured = [](const std::string &key)
    { return with(square, "subsection Measure\n  set " + key + "\nend\n"); };
    expect_complaint(measured("events = half_frozn"), "the nearest is 'half_frozen'");
    expect_complaint(measured("events = first_contact"), "the scene has 1");
    expect_complaint(measured("mirror = z"), "a scene of 2 dimensions lacks");
    expect_complaint(measured("intermediate times = 1, 2, 3, 4, 5, 6, 7, 8, 9"),
                     "one to eight numbers");
  }
} // namespace meltfront::cases::test
