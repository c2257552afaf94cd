#include <cases/case_file/tests/sample_case.h>
#include <cases/effects.h>
#include <cases/exact/planar_neumann.h>

#include <fmt/format.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

TEST(CaseFile, GivesTheSceneThatItDescribes)
{
  const Case c = read(slab);
  EXPECT_EQ(c.title, "A slab");
  EXPECT_EQ(c.file, "a.prm");
  EXPECT_EQ(c.text, slab);
  EXPECT_EQ(c.scene.name, "a");
  EXPECT_EQ(c.scene.units, "SI");
  EXPECT_EQ(c.scene.symmetry, Symmetry::planar);
  EXPECT_EQ(c.scene.start_time, 0);
  EXPECT_EQ(c.scene.end_time, 100);
  EXPECT_EQ(c.scene.domain.shape, DomainShape::slab);
  EXPECT_EQ(c.scene.domain.side(), 0.1);
  EXPECT_EQ(c.scene.material.latent_heat, 333500);
  EXPECT_EQ(c.scene.material.solid.conductivity, 2.2);
  EXPECT_EQ(c.scene.material.liquid.conductivity, 0.591);
  EXPECT_EQ(c.scene.initial.temperature({0.05, 0, 0}, 0), 10);
  EXPECT_TRUE(c.scene.initial.temperature.constant);
  EXPECT_EQ(c.scene.sides(), (std::vector{Side::x_min, Side::x_max}));
  EXPECT_EQ(c.scene.boundary(Side::x_min).kind, BoundaryKind::fixed_temperature);
  EXPECT_EQ(c.scene.boundary(Side::x_min).value({}, 5), -10);
  EXPECT_EQ(c.scene.boundary(Side::x_max).kind, BoundaryKind::insulated);
  EXPECT_EQ(c.exact, nullptr);
  EXPECT_EQ(c.measurement.samples, 100);
  EXPECT_TRUE(c.measurement.monotone_front);
  EXPECT_TRUE(std::isinf(c.measurement.temperature_to));
}

TEST(CaseFile, ReadsWhatIsToBeMeasuredAndAccepted)
{
  const Case c = read(with(slab, R"(
set tags = one, two words ,three
set units = normalised
subsection Measure
  set samples = 0
  set clock = sqrt(t)
  set temperature from = 0.01
  set temperature to = 0.05
  set monotone front = false
end
subsection Effects
  set phase_change = off
end
subsection Acceptance
  set criterion 2 = sph: worst budget_defect <= 1e-12
  set criterion 1 = sph: front_rms at n=40 <= 1
end
subsection Printed
  set source = A paper
  set value 1 = sph: front_rms at n=40 = 0.5 (Table 2)
end
subsection Limits
  set limit 1 = It shows nothing.
end
)"));
  EXPECT_EQ(c.tags, (std::vector<std::string>{"one", "two words", "three"}));
  EXPECT_EQ(c.scene.units, "normalised");
  EXPECT_EQ(c.measurement.samples, 0);
  EXPECT_TRUE(c.measurement.square_root_clock);
  EXPECT_EQ(c.measurement.temperature_from, 0.01);
  EXPECT_EQ(c.measurement.temperature_to, 0.05);
  EXPECT_FALSE(c.measurement.monotone_front);
  EXPECT_FALSE(effects_called_for(c.scene).contains(Effect::phase_change));
  ASSERT_EQ(c.criteria.size(), 2u);
  EXPECT_EQ(c.criteria[0].quantity, "front_rms");
  EXPECT_EQ(c.printed.at(0).source, "A paper, Table 2");
  EXPECT_EQ(c.limits.at(0), "It shows nothing.");
}

TEST(CaseFile, SourcesKnowTheirEnergyFromTheStart)
{
  std::string text
      = replaced(square, "set end time", "set start time = 200\nset end time");
  const Case constant = read(text);
  ASSERT_EQ(constant.scene.sources.size(), 1u);
  EXPECT_EQ(constant.scene.sources[0].power(300), -100);
  EXPECT_EQ(constant.scene.sources[0].energy(300), -10000);
  EXPECT_EQ(constant.scene.sources[0].energy(200), 0);
  text = replaced(text, "power = -100", "power = -3*t^2");
  const Case varying = read(text);
  EXPECT_EQ(varying.scene.sources[0].power(10), -300);
  EXPECT_NEAR(varying.scene.sources[0].energy(1000), -(1e9 - 8e6), 1e-3);
}

TEST(CaseFile, TakesWallsSourcesAndStateFromTheExactSolution)
{
  std::string text = replaced(square, "shape = box", "shape = ball");
  text = replaced(text, "    set lower corner = -1, -1\n    set upper corner = 1, 1\n",
                  "    set radius = 0.5\n");
  text = replaced(text, "symmetry = none", "symmetry = cylindrical");
  text = replaced(text, "power = -100", "power = exact");
  text = replaced(text, "    set temperature = 10\n", "    set kind = exact\n");
  text = replaced(text, "set end time", "set start time = 500\nset end time");
  text = replaced(text, "  subsection Source 1",
                  "  subsection Walls\n    subsection outer\n      set kind = exact\n"
                  "    end\n  end\n  subsection Source 1");
  const Case c
      = read(with(text, "subsection Exact solution\n  set kind = line sink\n"
                        "  set lambda = 0.15\n  set far temperature = 10\nend\n"));
  ASSERT_NE(c.exact, nullptr);
  EXPECT_EQ(c.scene.initial.exact, c.exact);
  EXPECT_EQ(c.scene.initial.temperature({0.01, 0.01, 0}, 500),
            c.exact->temperature(Position{0.01, 0.01, 0}, 500));
  EXPECT_TRUE(c.scene.boundary(Side::outer).exact);
  EXPECT_EQ(c.scene.boundary(Side::outer).value({0.3, 0.4, 0}, 700),
            c.exact->temperature(0.5, 700));
  EXPECT_LT(c.scene.sources[0].power(600), 0);
  EXPECT_NEAR(c.scene.sources[0].energy(600), 100 * c.scene.sources[0].power(550), 1e-9);
}

TEST(CaseFile, TheSameSceneSaidInTwoWaysHasTheSameBits)
{
  std::string other
      = replaced(slab, "set conductivity = 2.2", "set conductivity = 22e-1");
  other = replaced(other, "      set conductivity = 0.591\n",
                   "      set density = 1e3\n      set conductivity = 0.5910\n"
                   "      set specific heat capacity = 2.09e3\n");
  other = replaced(other, "set temperature = -10", "set temperature = -4 - 2*3");
  other = replaced(other, "latent heat = 333500", "latent heat = 3.335e5");
  other = replaced(other, "    subsection x_max\n      set kind = insulated\n    end\n",
                   "");
  other = replaced(other, "set length = 0.1",
                   "set dimension = 1 # as a slab has\n"
                   "    set length = \\\n    1e-1");
  const Scene a = read(slab).scene, b = read(other).scene;
  const auto properties = [](const PhaseProperties &p) {
    return std::array{p.conductivity, p.specific_heat_capacity, p.density};
  };
  EXPECT_EQ(properties(a.material.solid), properties(b.material.solid));
  EXPECT_EQ(properties(a.material.liquid), properties(b.material.liquid));
  EXPECT_EQ(a.material.latent_heat, b.material.latent_heat);
  EXPECT_EQ(a.domain.upper, b.domain.upper);
  EXPECT_EQ(a.boundary(Side::x_min).value({}, 1), b.boundary(Side::x_min).value({}, 1));
  EXPECT_EQ(a.boundary(Side::x_max).kind, b.boundary(Side::x_max).kind);
  const EffectSet effects_a = effects_called_for(a), effects_b = effects_called_for(b);
  ASSERT_EQ(effects_a.decisions().size(), effects_b.decisions().size());
  for(std::size_t i = 0; i < effects_a.decisions().size(); ++i)
  {
    EXPECT_EQ(effects_a.decisions()[i].on, effects_b.decisions()[i].on);
    EXPECT_EQ(effects_a.decisions()[i].reason, effects_b.decisions()[i].reason);
  }
}

TEST(CaseFile, AnExactSolutionSaidInTwoWaysHasTheSameBits)
{
  const std::string held = replaced(slab, "set kind = insulated", "set kind = exact");
  const Case derived = read(with(held, "subsection Exact solution\n set kind = neumann\n"
                                       "end\n"));
  const Case given = read(with(held, "subsection Exact solution\n set kind = neumann\n"
                                     " set wall temperature = -10\n"
                                     " set far temperature = 10\nend\n"));
  EXPECT_EQ(derived.exact->front(50), given.exact->front(50));
  EXPECT_EQ(derived.exact->temperature(0.03, 50), given.exact->temperature(0.03, 50));
}

TEST(CaseFile, AnOracleFromTheInitialStateContinuesTheSimilaritySolution)
{
  const Material material = read(slab).scene.material;
  const PlanarNeumann neumann(material, -10, 10);
  const double solid = 2 * std::sqrt(material.solid.diffusivity() * 100);
  const double liquid = 2 * std::sqrt(material.liquid.diffusivity() * 100);
  const double front = neumann.front(100);
  std::string text = replaced(
      slab, "set temperature = 10",
      fmt::format("set temperature = if(x < {0}, -10 + 10*(1 - erfc(x/{1}))/(1 - "
                  "erfc({0}/{1})), 10 - 10*erfc(x/{2})/erfc({0}/{2}))",
                  front, solid, liquid));
  text = replaced(text, "set kind = insulated",
                  "set kind = fixed temperature\n      set temperature = 10");
  text = replaced(text, "set end time = 100",
                  "set start time = 100\n  set end time = 200");
  const Case c = read(with(
      text, fmt::format("subsection Exact solution\n  set kind = oracle\n"
                        "  set start = initial state\n  set initial front = {}\nend\n",
                        front)));
  EXPECT_TRUE(c.exact->solid_at_origin());
  EXPECT_EQ(c.exact->start_time(), 100);
  EXPECT_NEAR(c.exact->front(200), neumann.front(200), 1e-9 * neumann.front(200));
  EXPECT_NEAR(c.exact->temperature(0.01, 150), neumann.temperature(0.01, 150), 1e-7);
}

TEST(CaseFile, SolidGrowsIntoUndercooledLiquid)
{
  std::string text = replaced(slab, "set temperature = 10", "set temperature = -50");
  text = replaced(text, "set kind = fixed temperature\n      set temperature = -10",
                  "set kind = exact");
  text = replaced(text, "set kind = insulated", "set kind = exact");
  const Case c = read(with(text, "subsection Exact solution\n  set kind = frank\nend\n"));
  EXPECT_NEAR(c.exact->temperature(0.05, 1e-3), -50, 1e-9);
  EXPECT_EQ(c.exact->temperature(0, 50), 0);
  EXPECT_GT(c.exact->front(50), 0);
}

TEST(CaseFile, EveryKeyIsInTheReference)
{
  const std::string reference = case_file_reference();
  for(const char *key : {"subsection Scene/Walls/outer", "set latent heat", "set lambda",
                         "set criterion 1 .. 40", "set liquid_motion = auto"})
    EXPECT_NE(reference.find(key), std::string::npos) << key;
}

TEST(CaseFile, UnknownNamesAndFilesAreRefused)
{
  try
  {
    load_case("plane-frezing");
    FAIL();
  }
  catch(const InputError &error)
  {
    EXPECT_STREQ(error.what(),
                 "there is no case 'plane-frezing'; the nearest is 'plane-freezing'");
  }
  EXPECT_THROW(load_case("nowhere/plane-freezing.prm"), OutputError);
  EXPECT_THROW(load_case(""), InputError);
  EXPECT_THROW(load_case(std::string(100000, 'x')), InputError);
}

TEST(CaseFile, SaysByHowMuchLeftOutEffectsMayChangeTheScene)
{
  EXPECT_EQ(read(slab).effect_tolerance, 0);
  EXPECT_EQ(read(with(slab, "set effects = auto\n")).effect_tolerance, 0);
  EXPECT_EQ(read(with(slab, "set effects = auto within 1e-3\n")).effect_tolerance, 1e-3);
  for(const char *wrong : {"on", "auto within", "auto within 0", "auto within 1e-3 m",
                           "auto within 2", "auto within -1"})
    EXPECT_THROW(read(with(slab, fmt::format("set effects = {}\n", wrong))), InputError)
        << wrong;
}
