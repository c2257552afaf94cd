#include <cases/case_file/tests/sample_case.h>
#include <cases/case_file/vary_case.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

namespace
{
  /** A bar that melts from the exact state, between two places of its front. */
  const std::string bar = R"(set title = A bar
subsection Scene
  set symmetry = planar
  set start front = 0.06
  set end front = \
      0.18
  subsection Domain
    set shape = slab
    set length = 1
  end
  subsection Material
    set latent heat = 110
    set melting temperature = 430
    subsection Solid
      set conductivity = 2
      set specific heat capacity = 1
      set density = 1
    end
    subsection Liquid
      set conductivity = 1
    end
  end
  subsection Initial state
    set kind = exact
  end
  subsection Walls
    subsection x_min
      set kind = exact
    end
    subsection x_max
      set kind = exact
    end
  end
end
subsection Exact solution
  set kind = neumann
  set wall temperature = 500
  set far temperature = 380
end
subsection Acceptance
  set criterion 1 = sph: front_rms at n=40 <= 1
end
)";

  std::string complaint_about(const CaseSettings &settings)
  {
    try
    {
      vary_case(read(bar), "bar[x=1]", settings);
    }
    catch(const InputError &error)
    {
      return error.what();
    }
    return "no complaint";
  }

  void expect_in(const std::string &message, const std::string &part)
  {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
} // namespace

TEST(TimesByFronts, AreThoseOfNeumannsSolution)
{
  const Case c = read(bar);
  // Front constant of this set, from an independent program.
  const double lambda = 0.3543133690;
  EXPECT_NEAR(c.scene.start_time, std::pow(0.06 / (2 * lambda), 2), 1e-11);
  EXPECT_NEAR(c.scene.end_time, std::pow(0.18 / (2 * lambda), 2), 1e-10);
  EXPECT_NEAR(c.exact->front(c.scene.start_time), 0.06, 1e-15);
  EXPECT_NEAR(c.exact->front(c.scene.end_time), 0.18, 1e-15);
}

TEST(TimesByFronts, SayWhatDoesNotFit)
{
  expect_in(complaint(replaced(bar, "  set start front = 0.06\n", "")), "start front");
  expect_in(complaint(replaced(bar, "start front = 0.06", "start front = 0.2")),
            "must lie beyond 'start front'");
  expect_in(complaint(replaced(bar, "  set symmetry = planar\n",
                               "  set symmetry = planar\n  set end time = 1\n")),
            "begins and ends by its front");
  const std::string message = complaint(replaced(bar, "kind = neumann", "kind = frank"));
  expect_in(message, "a.prm:4:");
  expect_in(message, "only Neumann's solution");
}

TEST(VaryCase, ReplacesInPlaceAndAppends)
{
  const std::string varied = varied_text(
      bar, "a.prm",
      {{"Scene/end front", "0.3"}, {"Scene/Material/Liquid/density", "0.9"}});
  EXPECT_EQ(varied.find("0.18"), std::string::npos);
  EXPECT_NE(varied.find("\nset end front = 0.3\n\n  subsection Domain"),
            std::string::npos)
      << varied;
  EXPECT_TRUE(varied.ends_with("subsection Scene\nsubsection Material\nsubsection "
                               "Liquid\nset density = 0.9\nend\nend\nend\n"))
      << varied;
  const Case c = read(varied);
  EXPECT_NEAR(c.exact->front(c.scene.end_time), 0.3, 1e-15);
  EXPECT_EQ(c.scene.material.liquid.density, 0.9);
}

TEST(VaryCase, GivesACaseOfItsOwn)
{
  const Case base = read(bar);
  const Case same
      = vary_case(base, "bar[latent_heat=110]", {{"Scene/Material/latent heat", "110"}});
  EXPECT_EQ(same.scene.start_time, base.scene.start_time);
  EXPECT_EQ(same.scene.name, "bar[latent_heat=110]");
  EXPECT_TRUE(same.criteria.empty());
  EXPECT_FALSE(base.criteria.empty());
  const Case slower
      = vary_case(base, "bar[latent_heat=1e3]", {{"Scene/Material/latent heat", "1e3"}});
  EXPECT_EQ(slower.scene.name, "bar[latent_heat=1e3]");
  EXPECT_GT(slower.scene.end_time, 4 * base.scene.end_time);
  EXPECT_NEAR(slower.exact->front(slower.scene.end_time), 0.18, 1e-15);
  EXPECT_NE(slower.text, base.text);
}

TEST(VaryCase, SaysWhereAValueDoesNotFit)
{
  const std::string value
      = complaint_about({{"Scene/Material/Solid/conductivity", "much"}});
  expect_in(value, "bar[x=1].prm:15:"); // the line of the key in the case as written
  expect_in(value, "not 'much'");
  expect_in(complaint_about({{"Scene/Material/Solid/conductivty", "1"}}),
            "the nearest valid key is 'conductivity'");
  expect_in(complaint_about({{"Scene/Matter/density", "1"}}), "Matter");
  expect_in(complaint_about({{"Exact solution/wall temperature", "400"}}), "melting");
}
