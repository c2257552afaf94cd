#include <cases/case_file/case_file.h>
#include <cases/case_file/prm_include.h>
#include <cases/effects.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

using namespace meltfront::cases;

namespace
{
  /** Each case is read once. */
  const Case &library_case(const std::string &name)
  {
    static std::map<std::string, Case> cases;
    const auto found = cases.find(name);
    return found != cases.end() ? found->second
                                : cases.emplace(name, load_case(name)).first->second;
  }

  bool has_tag(const Case &c, const std::string &tag)
  {
    return std::find(c.tags.begin(), c.tags.end(), tag) != c.tags.end();
  }

  std::set<Effect> effects_of(const std::string &name)
  {
    std::set<Effect> on;
    const EffectSet effects = effects_called_for(library_case(name).scene);
    for(const EffectDecision &decision : effects.decisions())
      if(decision.on)
        on.insert(decision.effect);
    return on;
  }

  double front_at_end(const std::string &name)
  {
    const Case &c = library_case(name);
    return c.exact->front(c.scene.end_time);
  }
} // namespace

TEST(Library, HoldsTheCasesThatOthersRelyOn)
{
  const std::vector<std::string> names = library_names();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for(const char *name : {"plane-freezing",
                          "plane-freezing-started",
                          "plane-freezing-2005",
                          "plane-freezing-water",
                          "plane-one-phase",
                          "plane-contrast",
                          "line-sink",
                          "line-sink-disk",
                          "line-sink-square",
                          "line-sink-strong",
                          "point-sink-3d",
                          "hard-stefan-0.01",
                          "hard-stefan-100",
                          "hard-conductivity-1e-3",
                          "hard-conductivity-1e3",
                          "hard-conductivity-1e9",
                          "hard-discontinuous-start",
                          "hard-thin-liquid",
                          "hard-reversal",
                          "hard-jitter",
                          "hard-line-sink-walls",
                          "frank-disk",
                          "frank-sphere",
                          "plane-density-jump",
                          "annulus",
                          "annulus-perturbed",
                          "merging-disks",
                          "line-sink-annulus",
                          "ring-melting",
                          "capillary-disk",
                          "bar-flux",
                          "alloy-sodium-nitrate",
                          "alloy-sodium-nitrate-diffusion",
                          "alloy-curved-liquidus",
                          "alloy-unit",
                          "alloy-melt-back",
                          "alloy-ternary",
                          "alloy-random",
                          "alloy-random-mush",
                          "alloy-eutectic"})
    EXPECT_TRUE(std::find(names.begin(), names.end(), name) != names.end()) << name;
}

TEST(Library, EveryCaseLoadsAndDescribesItself)
{
  for(const std::string &name : library_names())
  {
    const Case &c = library_case(name);
    EXPECT_EQ(c.scene.name, name);
    EXPECT_FALSE(c.title.empty()) << name;
    EXPECT_FALSE(c.description.empty()) << name;
    EXPECT_TRUE(c.text.starts_with("# ")) << name;
    EXPECT_EQ(name.starts_with("hard-"), has_tag(c, "hard")) << name;
    EXPECT_TRUE(c.exact || !c.limits.empty()) << name;
    for(const Criterion &criterion : c.criteria)
      EXPECT_EQ(criterion.method, any_method)
          << name << ": what one method has to keep belongs to the matrix that runs it";
  }
}

TEST(Library, ExactFrontsEndWhereTheyAreKnownTo)
{
  const std::map<std::string, double> fronts{
      {"plane-freezing", 0.2383275057562597},
      {"plane-freezing-started", 0.5},
      {"plane-freezing-water", 0.09460644723343456},
      {"plane-one-phase", 0.1056774146832831},
      {"plane-contrast", 0.2876678251770185},
      {"line-sink", 0.2121320343559643},
      {"line-sink-disk", 0.2121320343559643},
      {"line-sink-square", 0.2121320343559643},
      {"point-sink-cube", 0.2121320343559643},
      {"line-sink-lambda-0.05", 0.2121320343559643},
      {"line-sink-lambda-0.10", 0.2121320343559643},
      {"line-sink-lambda-0.15", 0.2121320343559643},
      {"line-sink-lambda-0.20", 0.2121320343559643},
      {"line-sink-lambda-0.30", 0.2121320343559643},
      {"line-sink-lambda-0.40", 0.2121320343559643},
      {"line-sink-strong", 0.2309401076758503},
      {"point-sink-3d", 0.2121320343559643},
      {"frank-disk", 0.5},
      {"frank-sphere", 0.5},
      {"plane-density-jump", 0.0985042522429317}};
  for(const auto &[name, front] : fronts)
    EXPECT_NEAR(front_at_end(name), front, 1e-12 * front) << name;
  EXPECT_NEAR(front_at_end("plane-freezing-2005"), 0.2383275, 1e-7);
  EXPECT_NEAR(front_at_end("alloy-sodium-nitrate"), 0.094403793, 1e-9);
  EXPECT_NEAR(front_at_end("alloy-ternary"), front_at_end("alloy-sodium-nitrate"), 1e-14);
  EXPECT_NEAR(front_at_end("alloy-sodium-nitrate-diffusion"), 0.0930682, 2e-7);
  // Integrated over the depth by Runge-Kutta steps of order 4, 400 and 1600 of them.
  EXPECT_NEAR(front_at_end("alloy-curved-liquidus"), 0.095632577768, 2e-12);
  EXPECT_NEAR(front_at_end("bar-flux"), 0.452097059863568, 1e-12);
  EXPECT_NEAR(front_at_end("annulus"), 0.632047368850, 1e-10);
  EXPECT_NEAR(front_at_end("bar-sandia"), 0.4096586, 1e-7);
  EXPECT_NEAR(front_at_end("bar-started"), 0.18, 1e-8);
}

TEST(Library, SinksDrawWhatTheirSolutionsNeed)
{
  const PointSource &line = library_case("line-sink").scene.sources.at(0);
  EXPECT_NEAR(line.power(1000), -148.4508990290751, 1e-9);
  EXPECT_NEAR(line.energy(475000), -148.4508990290751 * 475000, 1e-3);
  EXPECT_NEAR(library_case("line-sink-strong").scene.sources.at(0).power(0),
              -246.7249772523774, 1e-9);
  EXPECT_NEAR(library_case("hard-line-sink-walls").scene.sources.at(0).power(0),
              -246.7249772523774, 1e-9);
  const PointSource &point = library_case("point-sink-3d").scene.sources.at(0);
  EXPECT_NEAR(point.power(10000), -0.107715116113955 * 100, 1e-9);
  EXPECT_NEAR(point.energy(10000), -0.107715116113955 * 2. / 3. * 1e6, 1e-6);
}

TEST(Library, ExactSolutionsSatisfyTheirHeldWallsAndInitialStates)
{
  for(const std::string &name : library_names())
  {
    const Case &c = library_case(name);
    const Scene &scene = c.scene;
    if(!c.exact || scene.domain.shape == DomainShape::box
       || scene.problem == ProblemKind::poisson)
      continue;
    const TemperatureBounds bounds = temperature_bounds(scene);
    const double span
        = bounds.upper
          - (std::isfinite(bounds.lower) ? bounds.lower
                                         : scene.material.melting_temperature);
    const Domain &domain = scene.domain;
    const double inner = domain.round() ? domain.inner_radius : domain.lower[0];
    const double side = domain.round() ? domain.radius : domain.upper[0];
    for(const double share : {0.11, 0.37, 0.73, 0.99})
    {
      const double x = inner + share * (side - inner);
      EXPECT_NEAR(c.exact->temperature(Position{x, 0, 0}, scene.start_time),
                  scene.initial.temperature({x, 0, 0}, scene.start_time), 1e-9 * span)
          << name;
    }
    if(c.measurement.front_floor > 0)
      continue; // the exact solution holds approximately, as the case says
    for(const Side wall : scene.sides())
      for(const double share : {0.1, 0.4, 0.7, 1.})
      {
        const double time
            = scene.start_time + share * (scene.end_time - scene.start_time);
        const bool lower = wall == Side::x_min || wall == Side::inner;
        const Position p{lower ? inner : side, 0, 0};
        const Boundary &boundary = scene.boundary(wall);
        if(boundary.kind != BoundaryKind::fixed_temperature)
          continue;
        EXPECT_NEAR(boundary.value(p, time), c.exact->temperature(p, time), 1e-9 * span)
            << name << " " << to_string(wall) << " " << time;
      }
  }
}

/** Conduction at a point by differences of a formula: div(k grad T) + release - rho c
 * dT/dt, over what its terms amount to. */
double imbalance(const Scene &scene, const ExactSolution &exact, const Position &p,
                 double time)
{
  const double step = 1e-3 * scene.domain.side();
  const double conductivity = scene.conductivity_at(p);
  const double here = exact.temperature(p, time);
  double sum = scene.volumetric_source ? (*scene.volumetric_source)(p, time) : 0;
  double scale = std::abs(sum) + conductivity;
  for(int d = 0; d < scene.domain.dimension; ++d)
  {
    Position before = p, behind = p;
    before[d] -= step;
    behind[d] += step;
    sum += conductivity
           * (exact.temperature(before, time) - 2 * here
              + exact.temperature(behind, time))
           / (step * step);
  }
  if(scene.problem != ProblemKind::poisson)
  {
    const double interval = 1e-4 * (scene.end_time - scene.start_time);
    const double rate
        = (exact.temperature(p, time + interval) - exact.temperature(p, time - interval))
          / (2 * interval);
    sum -= scene.material.solid.volumetric_heat_capacity() * rate;
    scale += std::abs(rate);
  }
  return sum / scale;
}

TEST(Library, FormulasWithoutAFrontSolveTheirEquation)
{
  int formulas = 0;
  for(const std::string &name : library_names())
  {
    const Case &c = library_case(name);
    if(!c.exact || !c.exact->description().starts_with("closed form: T ="))
      continue;
    ++formulas;
    const Domain &domain = c.scene.domain;
    for(const double share : {0.13, 0.36, 0.61, 0.87})
    {
      Position p{};
      for(int d = 0; d < domain.dimension; ++d)
        p[d] = domain.lower[d]
               + (domain.upper[d] - domain.lower[d])
                     * std::fmod(share * (1 + 0.37 * d) + 0.05 * d, 1.);
      EXPECT_NEAR(imbalance(c.scene, *c.exact, p, 0.4 * c.scene.end_time), 0, 2e-3)
          << name << " " << p[0] << " " << p[1];
    }
  }
  EXPECT_GE(formulas, 15);
}

TEST(Library, ScenesCallForTheEffectsThatTheyShow)
{
  using enum Effect;
  const std::set<Effect> plain{phase_change, wall_temperature};
  const std::set<Effect> contrast{phase_change, phase_conductivity, phase_heat_capacity,
                                  wall_temperature};
  const std::set<Effect> sink{phase_change, phase_conductivity, phase_heat_capacity,
                              heat_sources};
  std::set<Effect> sink_and_rim = sink;
  sink_and_rim.insert(wall_temperature);
  EXPECT_EQ(effects_of("plane-freezing"), plain);
  EXPECT_EQ(effects_of("plane-freezing-started"), plain);
  EXPECT_EQ(effects_of("plane-freezing-2005"), plain);
  EXPECT_EQ(effects_of("hard-reversal"), plain);
  EXPECT_EQ(effects_of("plane-freezing-water"), contrast);
  EXPECT_EQ(effects_of("plane-contrast"), contrast);
  EXPECT_EQ(effects_of("line-sink"), sink);
  EXPECT_EQ(effects_of("line-sink-strong"), sink);
  EXPECT_EQ(effects_of("hard-line-sink-walls"), sink);
  EXPECT_EQ(effects_of("line-sink-disk"), sink_and_rim);
  EXPECT_EQ(effects_of("point-sink-3d"), sink_and_rim);
  const std::set<Effect> undercooled{phase_change, wall_temperature, metastable_phase};
  EXPECT_EQ(effects_of("frank-disk"), undercooled);
  EXPECT_EQ(effects_of("frank-sphere"), undercooled);
  std::set<Effect> displaced = contrast;
  displaced.insert(liquid_motion);
  EXPECT_EQ(effects_of("plane-density-jump"), displaced);
  EXPECT_EQ(effects_of("annulus-densities"), displaced);
  EXPECT_EQ(effects_of("annulus"), contrast);
  EXPECT_EQ(effects_of("annulus-perturbed"), contrast);
  EXPECT_EQ(effects_of("merging-disks"), (std::set{phase_change, heat_sources}));
  std::set<Effect> brine = contrast;
  brine.insert(solute);
  EXPECT_EQ(effects_of("alloy-sodium-nitrate"), brine);
  EXPECT_EQ(effects_of("alloy-ternary"), brine);
  EXPECT_EQ(effects_of("alloy-melt-back"), brine);
  EXPECT_EQ(effects_of("alloy-unit"), (std::set{phase_change, wall_temperature, solute}));
  brine.insert(eutectic);
  EXPECT_EQ(effects_of("alloy-eutectic"), brine);
  brine.erase(eutectic);
  brine.insert(solute_diffusion);
  EXPECT_EQ(effects_of("alloy-sodium-nitrate-diffusion"), brine);
  brine.erase(wall_temperature);
  EXPECT_EQ(effects_of("alloy-random"), brine);
  EXPECT_EQ(effects_of("alloy-random-mush"), brine);
  EXPECT_EQ(effects_of("bar-flux"),
            (std::set{phase_change, phase_conductivity, phase_heat_capacity, wall_flux}));
}

TEST(Library, TheFrontTurnsBackWhereItIsSaidTo)
{
  for(const std::string &name : library_names())
  {
    const Case &c = library_case(name);
    if(!c.exact || !c.exact->depends_on_one_coordinate())
      continue;
    bool monotone = true;
    double before = c.exact->front(c.scene.start_time);
    for(int i = 1; i <= 50; ++i)
    {
      const double front = c.exact->front(
          c.scene.start_time + (c.scene.end_time - c.scene.start_time) * i / 50);
      monotone = monotone && front >= before;
      before = front;
    }
    EXPECT_EQ(monotone, c.measurement.monotone_front) << name;
  }
}

/** A substance that no case has is there for users: it makes a scene by itself. */
TEST(Library, MaterialsAreIncludedAndAreNoCases)
{
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(library_path("x")).parent_path();
  std::string texts;
  for(const std::string &name : library_names())
    texts += library_case(name).text;
  int materials = 0;
  for(const auto &entry : fs::directory_iterator(folder / "materials"))
  {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(read_prm_text(entry.path().string()).starts_with("# ")) << name;
    if(texts.find(name + "\n") == std::string::npos)
    {
      const Case c = read_case_text(
          "set title = A slab\nsubsection Scene\n  set end time = 1\n"
          "  set symmetry = planar\n"
          "  subsection Domain\n    set shape = slab\n    set length = 1\n  end\n"
          "  subsection Material\n    include materials/"
              + name
              + "\n  end\n  subsection Initial state\n    set temperature = -50\n"
                "  end\nend\n",
          "slab.prm");
      EXPECT_GT(c.scene.material.latent_heat, 0) << name;
      EXPECT_GT(c.scene.material.solid.conductivity, 0) << name;
    }
    EXPECT_FALSE(fs::exists(folder / name)) << name;
    ++materials;
  }
  EXPECT_GE(materials, 4);
}

TEST(Library, TitlesAreReadAlone)
{
  for(const char *name : {"plane-freezing", "line-sink-lambda-0.05", "casting-aluminium"})
    EXPECT_EQ(library_title(name), library_case(name).title);
}
