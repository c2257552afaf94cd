#include <cases/error.h>
#include <cases/method.h>
#include <cases/run.h>
#include <cases/scene.h>

#include <cases/tests/support/course.h>

#include <gtest/gtest.h>

#include <memory>

using namespace meltfront::cases;

namespace
{
  using Origins = std::vector<FrontOrigin>;

  /** A slab of liquid at 1 between insulated walls, which melts at 0. */
  Scene slab()
  {
    Scene scene;
    scene.symmetry = Symmetry::planar;
    scene.domain.upper = {1, 0, 0};
    scene.material.latent_heat = 1;
    scene.initial.temperature = Field::uniform(1);
    scene.boundaries[0] = Boundary();
    scene.boundaries[1] = Boundary();
    return scene;
  }

  Scene square()
  {
    Scene scene = slab();
    scene.symmetry = Symmetry::none;
    scene.domain = {.shape = DomainShape::box, .dimension = 2, .upper = {1, 1, 0}};
    scene.boundaries[2] = Boundary();
    scene.boundaries[3] = Boundary();
    return scene;
  }

  Field field(std::function<double(const Position &, double)> value)
  {
    return {"an expression", std::move(value)};
  }

  void hold(Scene &scene, Side side, Field temperature)
  {
    scene.boundaries[static_cast<std::size_t>(side)]
        = Boundary{BoundaryKind::fixed_temperature, std::move(temperature)};
  }

  PointSource source(double power)
  {
    return {{0.5, 0.5, 0},
            "constant",
            [power](double) { return power; },
            [power](double time) { return power * time; }};
  }

  /** Takes slabs with insulated and Dirichlet walls whose front is there at the start. */
  Capabilities modest()
  {
    return {.problems = {ProblemKind::stefan},
            .effects = {Effect::phase_change, Effect::wall_temperature},
            .shapes = {{DomainShape::slab,
                        {1},
                        {BoundaryKind::insulated, BoundaryKind::fixed_temperature}}},
            .front_origins = {FrontOrigin::initial_front},
            .most_fronts = 1};
  }

  /** Counts the steps that it is asked for. */
  class ModestRun : public Run
  {
  public:
    explicit ModestRun(long steps)
      : steps(steps)
    {
    }
    RunDescription describe() const override
    {
      return {};
    }
    Cost cost() const override
    {
      Cost cost;
      cost.steps = steps;
      return cost;
    }

  private:
    void take_steps() override
    {
    }
    Snapshot snapshot(long, double) override
    {
      return {};
    }

    long steps;
  };

  class Modest : public Method
  {
  public:
    explicit Modest(std::vector<Capabilities> forms, Demand needed = {})
      : Method("modest", "Takes little.")
      , forms(std::move(forms))
      , needed(needed)
    {
    }
    std::vector<Capabilities> capabilities() const override
    {
      return forms;
    }
    std::vector<OptionDeclaration> option_declarations() const override
    {
      return {{"steps", "1", 7L, "Steps.", 1, 100}};
    }
    Demand demand(const Scene &, const EffectSet &, const Resolution &) const override
    {
      return needed;
    }

  protected:
    std::unique_ptr<Run> set_up(const Scene &, const EffectSet &,
                                const Resolution &resolution) const override
    {
      return std::make_unique<ModestRun>(resolution.options.get_integer("steps"));
    }

  private:
    std::vector<Capabilities> forms;
    Demand needed;
  };

  std::string refusal(const Method &method, const Scene &scene,
                      const Resolution &resolution = {})
  {
    meltfront::test_support::NoObserver nobody;
    try
    {
      method.solve(scene, effects_called_for(scene), resolution, nobody);
    }
    catch(const Refusal &error)
    {
      return error.what();
    }
    return {};
  }

  void expect_refusal(const Scene &scene, const std::string &words)
  {
    const std::string said = refusal(Modest({modest()}), scene);
    EXPECT_NE(said.find(words), std::string::npos) << "'" << said << "'";
  }

  /** Solid below x = 0.5. */
  Scene with_front()
  {
    Scene scene = slab();
    scene.initial.temperature
        = field([](const Position &p, double) { return p[0] - 0.5; });
    return scene;
  }
} // namespace

TEST(FrontOrigins, WithoutLatentHeatThereIsNone)
{
  Scene scene = with_front();
  scene.material.latent_heat = 0;
  EXPECT_EQ(front_origins(scene), Origins{FrontOrigin::none});
  EXPECT_EQ(least_number_of_fronts(scene), 0);
}

TEST(FrontOrigins, OnePhaseAtRestHasNoFront)
{
  EXPECT_EQ(front_origins(slab()), Origins{});
  Scene at_melting_point = slab();
  at_melting_point.initial.temperature = Field::uniform(0);
  EXPECT_EQ(front_origins(at_melting_point), Origins{});
  at_melting_point.initial.solid_fraction_at_melting = 0.5;
  EXPECT_EQ(front_origins(at_melting_point), Origins{FrontOrigin::partly_melted});
}

TEST(FrontOrigins, BothPhasesAtTheStart)
{
  EXPECT_EQ(front_origins(with_front()), Origins{FrontOrigin::initial_front});
  EXPECT_EQ(least_number_of_fronts(with_front()), 1);
  Scene two = slab();
  two.initial.temperature
      = field([](const Position &p, double) { return std::abs(p[0] - 0.5) - 0.2; });
  EXPECT_EQ(least_number_of_fronts(two), 2);
  Scene given = slab();
  given.initial.front = field([](const Position &p, double) { return p[0] - 0.3; });
  EXPECT_EQ(front_origins(given), Origins{FrontOrigin::initial_front});
}

TEST(FrontOrigins, AWallThatFreezesNowOrLater)
{
  Scene scene = slab();
  hold(scene, Side::x_min, Field::uniform(-1));
  EXPECT_EQ(front_origins(scene), Origins{FrontOrigin::wall});
  hold(scene, Side::x_min, Field::uniform(0.5));
  EXPECT_EQ(front_origins(scene), Origins{});
  hold(scene, Side::x_min, field([](const Position &, double t) { return 0.5 - t; }));
  EXPECT_EQ(front_origins(scene), Origins{FrontOrigin::wall});
  hold(scene, Side::x_max, field([](const Position &, double t) { return 1 - 1.5 * t; }));
  EXPECT_EQ(least_number_of_fronts(scene), 2);
}

TEST(FrontOrigins, AWallThatKeepsItsPhaseStartsNone)
{
  Scene scene = with_front();
  hold(scene, Side::x_min, Field::uniform(-3));
  hold(scene, Side::x_max, Field::uniform(3));
  EXPECT_EQ(front_origins(scene), Origins{FrontOrigin::initial_front});
  hold(scene, Side::x_max, Field::uniform(-1));
  EXPECT_EQ(front_origins(scene),
            (Origins{FrontOrigin::initial_front, FrontOrigin::wall}));
  EXPECT_EQ(least_number_of_fronts(scene), 2);
}

TEST(FrontOrigins, AWallOfUndercooledLiquidStartsNone)
{
  Scene scene = slab();
  scene.initial.front = field([](const Position &p, double) { return p[0] - 0.3; });
  scene.initial.temperature
      = field([](const Position &p, double) { return std::min(0., 0.3 - p[0]); });
  hold(scene, Side::x_max, Field::uniform(-0.7));
  EXPECT_EQ(front_origins(scene), Origins{FrontOrigin::initial_front});
}

TEST(FrontOrigins, AWallBeyondWhatAMetastableSceneHoldsStartsOne)
{
  const Origins both{FrontOrigin::initial_front, FrontOrigin::wall};
  Scene scene = slab();
  scene.initial.front = field([](const Position &p, double) { return p[0] - 0.3; });
  scene.initial.temperature
      = field([](const Position &p, double) { return std::min(0., 0.3 - p[0]); });
  // The solid beside the undercooled liquid is stable, and melts.
  hold(scene, Side::x_min, Field::uniform(0.1));
  EXPECT_EQ(front_origins(scene), both);
  hold(scene, Side::x_min, Field::uniform(-0.1));
  EXPECT_EQ(front_origins(scene), Origins{FrontOrigin::initial_front});
  // Liquid that is colder than any at the start freezes.
  hold(scene, Side::x_max, field([](const Position &, double t) { return -0.6 - t; }));
  EXPECT_EQ(front_origins(scene), both);
  EXPECT_EQ(least_number_of_fronts(scene), 2);
}

TEST(FrontOrigins, ASinkInLiquidAndASourceInSolid)
{
  Scene scene = square();
  scene.sources = {source(-1)};
  EXPECT_EQ(front_origins(scene), Origins{FrontOrigin::source});
  scene.sources = {source(1)};
  EXPECT_EQ(front_origins(scene), Origins{});
  scene.initial.temperature = Field::uniform(-1);
  EXPECT_EQ(front_origins(scene), Origins{FrontOrigin::source});
}

TEST(Capabilities, WhatIsNamedIsTaken)
{
  EXPECT_EQ(refusal(Modest({modest()}), with_front()), "");
}

TEST(Capabilities, WhatIsNotNamedIsRefusedByName)
{
  Scene steady = with_front();
  steady.problem = ProblemKind::poisson;
  expect_refusal(steady, "modest solves no scenes of the kind 'poisson'");

  Scene contrast = with_front();
  contrast.material.liquid.conductivity = 3;
  expect_refusal(contrast, "modest does not simulate phase_conductivity (the solid");

  expect_refusal(square(), "modest takes no domain of the shape 'box'; it takes slab");

  Scene periodic = with_front();
  periodic.boundaries[0]->kind = periodic.boundaries[1]->kind = BoundaryKind::periodic;
  expect_refusal(periodic, "takes no wall of the kind 'periodic' on a domain of the "
                           "shape 'slab' (x_min is one)");

  Scene cold = slab();
  hold(cold, Side::x_min, Field::uniform(-1));
  expect_refusal(cold, "modest does not simulate fronts that set out from a wall");

  Scene without_latent_heat = with_front();
  without_latent_heat.material.latent_heat = 0;
  expect_refusal(without_latent_heat, "without latent heat there is none");
}

TEST(Capabilities, TooManyFrontsAreRefused)
{
  Scene two = slab();
  two.initial.temperature
      = field([](const Position &p, double) { return std::abs(p[0] - 0.5) - 0.2; });
  expect_refusal(two, "modest follows 1 front; this scene has 2 or more");
}

TEST(Capabilities, ThreadsThatWouldBeIgnoredAreRefused)
{
  Resolution resolution;
  resolution.threads = 2;
  EXPECT_NE(refusal(Modest({modest()}), with_front(), resolution)
                .find("modest runs in 1 thread, not in 2"),
            std::string::npos);
}

TEST(Capabilities, TheFirstFormThatTakesASceneIsMeant)
{
  Capabilities line = modest(), plane = modest();
  line.form = "along a line";
  plane.form = "in the plane";
  plane.shapes = {{DomainShape::box, {2}, {BoundaryKind::insulated}}};
  plane.front_origins = {FrontOrigin::source};
  const Modest both({line, plane});
  EXPECT_EQ(require_capable(both, with_front(), effects_called_for(with_front()), 1).form,
            "along a line");
  Scene cold = slab();
  hold(cold, Side::x_min, Field::uniform(-1));
  EXPECT_EQ(refusal(both, cold),
            "modest does not simulate fronts that set out from a wall")
      << "the other form takes no slabs at all";
}

TEST(Method, ARunWithoutOptionsGetsTheDeclaredDefaults)
{
  meltfront::test_support::NoObserver nobody;
  const Scene scene = with_front();
  EXPECT_EQ(Modest({modest()}).solve(scene, effects_called_for(scene), {}, nobody).steps,
            7);
}

TEST(Method, WhatCannotBeAffordedIsRefusedWithTheEstimate)
{
  Resolution resolution;
  resolution.memory_limit = 2e9;
  EXPECT_EQ(refusal(Modest({modest()}, {1.9e9, 1e6}), with_front(), resolution), "");
  EXPECT_NE(refusal(Modest({modest()}, {4e10, 1e6}), with_front(), resolution)
                .find("40 GB of memory, and 2 GB are allowed"),
            std::string::npos);
  EXPECT_NE(refusal(Modest({modest()}, {1e6, 1e12}), with_front(), resolution)
                .find("1e+12 time steps"),
            std::string::npos);
}
