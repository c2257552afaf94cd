// Whatever a method claims to take, its capabilities, is tested: every effect by a scene
// with its datum at two values, every wall of every shape and every origin of fronts by a
// run, all of them held against exact solutions. The list comes from the declarations
// themselves.

#include <cases/error.h>
#include <cases/shared_run.h>
#include <verification/app/methods.h>
#include <verification/app/tests/claims/conduction.h>
#include <verification/app/tests/claims/fronts.h>
#include <verification/app/tests/claims/motion.h>
#include <verification/app/tests/claims/mushes.h>
#include <verification/app/tests/claims/not_shown.h>
#include <verification/app/tests/claims/tolerances.h>
#include <verification/app/tests/claims/turned.h>
#include <verification/app/tests/claims/varying.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <map>

namespace meltfront::verification::claims
{
  namespace
  {
    using cases::BoundaryKind, cases::DomainShape, cases::Effect, cases::FrontOrigin,
        cases::ProblemKind;

    /** What is wrong or indistinguishable is at least so many tolerances off. */
    constexpr double margin = 5;

    /** And what has happened at all, so many. */
    constexpr double least_change = 2;

    /** A form of a method. */
    struct Form
    {
      const cases::Method *method;
      cases::Capabilities capabilities;
      std::string scheme{}; ///< value of the option `scheme`; empty: as it stands

      Outcome run(Trial trial) const
      {
        adapt(method->name(), capabilities.form, trial);
        if(!scheme.empty())
          trial.options.emplace_back("scheme", scheme);
        Outcome outcome = claims::run(*method, trial);
        if(capabilities.form == "along a line" || solves_in_more_dimensions())
        {
          EXPECT_EQ(outcome.dimension > 1, solves_in_more_dimensions())
              << "not the form that claims it";
        }
        return outcome;
      }

      bool solves(ProblemKind problem) const
      {
        return std::ranges::find(capabilities.problems, problem)
               != capabilities.problems.end();
      }

      bool takes(DomainShape shape) const
      {
        return std::ranges::find(capabilities.shapes, shape,
                                 &cases::ShapeCapability::shape)
               != capabilities.shapes.end();
      }

      /** A form that is for alloys only: of those no origins of fronts are told. */
      bool needs_solute() const
      {
        return capabilities.takes(Effect::solute) && capabilities.front_origins.empty();
      }

      bool is_bar() const
      {
        return method->name() == "greenspan" && solves(ProblemKind::stefan);
      }

      /** Scenes that depend on one coordinate say so, but where the plane is meant. */
      bool symmetric() const
      {
        return !solves_in_more_dimensions();
      }

      /** A form for bodies about an axis only. */
      bool turned() const
      {
        return takes(DomainShape::axisymmetric) && !takes(DomainShape::box);
      }

      /** Over that of the solid, in scenes with a front. */
      double density_of_liquid() const
      {
        return capabilities.form == "where liquid is displaced"
                       || capabilities.form == "where liquid flows"
                   ? 0.8
                   : 1;
      }

      bool solves_in_more_dimensions() const
      {
        return capabilities.form == "in the plane"
               || capabilities.form == "in more dimensions"
               || capabilities.form == "on several ranks";
      }

      std::string name() const
      {
        std::string result = method->name();
        for(const std::string &part : {capabilities.form, scheme})
          if(!part.empty())
            result += " " + part;
        return result;
      }
    };

    bool has_option(const cases::Method &method, const std::string &key)
    {
      return std::ranges::any_of(method.option_declarations(),
                                 [&key](const cases::OptionDeclaration &option)
                                 { return option.key == key; });
    }

    std::vector<Form> forms()
    {
      std::vector<Form> result;
      for(const auto &method : methods())
      {
        // By the engine of several ranks, on one: tests in ranks/ compare one with two.
        // Where there is one engine for all, these hold the bits of one process.
        if(const auto *shared = dynamic_cast<const cases::SharedMethod *>(method.get());
           shared && has_option(*method, "engine"))
          result.push_back({method.get(), shared->capabilities_on_ranks()});
        if(method->name() == "fem-cut")
          for(const std::string scheme : {"extension", "conservative"})
          {
            cases::Options options(method->option_declarations());
            options.set("scheme", scheme);
            for(const cases::Capabilities &capabilities :
                method->capabilities_with(options))
              result.push_back({method.get(), capabilities, scheme});
          }
        else
          for(const cases::Capabilities &capabilities : method->capabilities())
            result.push_back({method.get(), capabilities});
      }
      return result;
    }

    /** The scenes of an effect for a form of a method; none if there are none. */
    std::optional<EffectTrials> trials_of(const Form &form, Effect effect)
    {
      if(form.solves(ProblemKind::particle_solid))
        return free_particle_trials(effect);
      if(form.is_bar())
        return particle_bar_trials(effect);
      if(form.needs_solute())
        return mush_trials(effect, !form.method->corrected_form().empty());
      switch(effect)
      {
      case Effect::solute:
      case Effect::solute_diffusion:
      case Effect::eutectic:
        return mush_trials(effect, !form.method->corrected_form().empty());
      case Effect::gibbs_thomson:
        return capillary_trials();
      case Effect::heat_sources:
      {
        const bool begun = !form.capabilities.takes(FrontOrigin::source);
        return EffectTrials{line_sink(0.4, form.symmetric(), begun),
                            line_sink(0.7, form.symmetric(), begun)};
      }
      case Effect::inclusion:
        if(!form.solves(ProblemKind::poisson))
          return inclusion_trials();
        break;
      default:
        break;
      }
      if(const auto trials = varying_trials(effect))
        return form.turned() ? upright(*trials) : *trials;
      if(form.turned())
        return effect == Effect::volumetric_source
                   ? upright(*front_trials(effect, DomainShape::slab, 1))
                   : turned(*front_trials(effect, DomainShape::shell, 2));
      if(!form.capabilities.takes(Effect::phase_change))
        return steady_trials(effect);
      const bool slab = form.takes(DomainShape::slab);
      return front_trials(effect, slab ? DomainShape::slab : DomainShape::box,
                          slab ? 1 : 2, form.density_of_liquid());
    }

    Trial trial_of(const Form &form, const cases::ShapeCapability &shape, int dimension,
                   BoundaryKind kind)
    {
      if(form.solves(ProblemKind::interface_advection))
        return advected_ball(dimension, kind);
      if(form.is_bar())
        return particle_bar(75);
      if(shape.shape == DomainShape::axisymmetric)
        return turned(moving_front(DomainShape::shell, 2, kind, false));
      // All of an outline is insulated, of a box the ends of x only.
      const bool all_insulated
          = shape.shape == DomainShape::outline && kind == BoundaryKind::insulated;
      const bool held = !all_insulated
                        && std::ranges::find(shape.walls, BoundaryKind::fixed_temperature)
                               != shape.walls.end();
      if(form.needs_solute())
        return dissolved(heat_wave(shape.shape, dimension, kind, held));
      if(form.capabilities.takes(FrontOrigin::none))
        return heat_wave(shape.shape, dimension, kind, held);
      const bool round
          = shape.shape == DomainShape::ball || shape.shape == DomainShape::shell;
      return moving_front(shape.shape, dimension, kind, round && form.symmetric(),
                          form.density_of_liquid());
    }

    /** About an axis. */
    Trial turned_trial_of(FrontOrigin origin)
    {
      switch(origin)
      {
      case FrontOrigin::none:
        return turned(heat_wave(DomainShape::ball, 2, BoundaryKind::insulated, true));
      case FrontOrigin::initial_front:
        return turned(
            moving_front(DomainShape::shell, 2, BoundaryKind::insulated, false));
      default:
        return upright(cold_wall(origin == FrontOrigin::partly_melted));
      }
    }

    Trial trial_of(const Form &form, FrontOrigin origin)
    {
      if(form.turned())
        return turned_trial_of(origin);
      if(form.is_bar())
        return particle_bar(75);
      switch(origin)
      {
      case FrontOrigin::none:
        return heat_wave(DomainShape::slab, 1, BoundaryKind::fixed_temperature, true);
      case FrontOrigin::initial_front:
        return form.takes(DomainShape::slab)
                   ? moving_front(DomainShape::slab, 1, BoundaryKind::insulated, false,
                                  form.density_of_liquid())
                   : moving_front(DomainShape::box, 2, BoundaryKind::insulated, false,
                                  form.density_of_liquid());
      case FrontOrigin::source:
        return line_sink(0.6, form.symmetric(), false);
      default:
        return cold_wall(origin == FrontOrigin::partly_melted, form.density_of_liquid(),
                         form.takes(DomainShape::slab) ? DomainShape::slab
                                                       : DomainShape::box);
      }
    }

    /** Largest of the shares of the tolerances that differences make up. */
    double in_tolerances(const Differences &differences, const Tolerance &tolerance,
                         const Trial &trial)
    {
      return std::fmax(differences.sites / (tolerance.sites * trial.scale),
                       differences.solid / tolerance.solid);
    }

    std::string words(const Differences &differences)
    {
      return fmt::format("sites differ by {:.3g}, the solid's share by {:.3g}",
                         differences.sites, differences.solid);
    }

    long calls_of(const cases::Cost &cost, Effect effect)
    {
      long calls = 0;
      for(const cases::EffectCost &entry : cost.effects)
        calls += entry.effect == effect ? entry.calls : 0;
      return calls;
    }

    /** An effect that is switched off costs nothing; a method may refuse what is left. */
    void expect_nothing_spent(const Form &form, Trial trial, Effect effect)
    {
      trial.scene.effect_choices[effect] = cases::EffectChoice::off;
      try
      {
        const Outcome off = form.run(trial);
        for(const cases::EffectCost &entry : off.cost.effects)
          if(entry.effect == effect)
          {
            EXPECT_EQ(entry.calls, 0);
            EXPECT_EQ(entry.bytes, 0);
          }
      }
      catch(const cases::Refusal &)
      {
      }
    }

    class EffectClaim : public testing::Test
    {
    public:
      EffectClaim(Form form, Effect effect)
        : form(std::move(form))
        , effect(effect)
      {
      }

      void TestBody() override
      {
        const std::optional<EffectTrials> trials = trials_of(form, effect);
        ASSERT_TRUE(trials) << form.name() << " claims '" << cases::to_string(effect)
                            << "', of which there is no scene";
        const auto &[first, second, one_value_only] = *trials;
        ASSERT_TRUE(cases::effects_called_for(second.scene).contains(effect));
        if(one_value_only)
        {
          EXPECT_THROW(form.run(second), cases::Refusal);
          return;
        }
        const Tolerance tolerance = tolerance_of(form.method->name(), first.scene);
        const Outcome with_first = form.run(first);
        const Differences at_first = first.judge(with_first.end);
        EXPECT_LE(in_tolerances(at_first, tolerance, first), 1) << words(at_first);
        const Outcome with_second = form.run(second);
        const Differences at_second = second.judge(with_second.end),
                          ignored = second.judge(with_first.end);
        EXPECT_LE(in_tolerances(at_second, tolerance, second), 1) << words(at_second);
        EXPECT_GT(in_tolerances(ignored, tolerance, second), margin)
            << "ignoring the effect would make too little difference: " << words(ignored);
        EXPECT_GT(calls_of(with_second.cost, effect), 0);
        expect_nothing_spent(form, second, effect);
      }

    private:
      Form form;
      Effect effect;
    };

    /** A run that is held against the exact solution, and must do something. */
    class RunClaim : public testing::Test
    {
    public:
      using Make = std::function<Trial()>;

      RunClaim(Form form, Make make, std::optional<FrontOrigin> origin = {})
        : form(std::move(form))
        , make(std::move(make))
        , origin(origin)
      {
      }

      void TestBody() override
      {
        const Trial trial = make();
        if(origin)
        {
          const auto origins = cases::front_origins(trial.scene);
          EXPECT_NE(std::ranges::find(origins, *origin), origins.end());
        }
        const Tolerance tolerance = tolerance_of(form.method->name(), trial.scene);
        const Outcome outcome = form.run(trial);
        const Differences end = trial.judge(outcome.end),
                          start = trial.judge(outcome.start);
        EXPECT_LE(in_tolerances(end, tolerance, trial), 1) << words(end);
        EXPECT_GT(in_tolerances(start, tolerance, trial), least_change)
            << "nothing happens in the scene: " << words(start);
      }

    private:
      Form form;
      Make make;
      std::optional<FrontOrigin> origin;
    };

    /** Letters and digits only, as names of tests must have. */
    std::string identifier(const std::string &text)
    {
      std::string result;
      bool upper = true;
      for(const char c : text)
        if(std::isalnum(static_cast<unsigned char>(c)))
        {
          result += upper ? static_cast<char>(std::toupper(c)) : c;
          upper = false;
        }
        else
          upper = true;
      return result;
    }

    /** Stands for a claim that is not shown yet. */
    class SkippedClaim : public testing::Test
    {
    public:
      explicit SkippedClaim(std::string reason)
        : reason(std::move(reason))
      {
      }

      void TestBody() override
      {
        GTEST_SKIP() << reason;
      }

    private:
      std::string reason;
    };

    template <typename Test, typename... Arguments>
    void add(const Form &form, const std::string &suite, const std::string &claim,
             const Arguments &...arguments)
    {
      const std::string name = identifier(form.name()) + "_" + identifier(claim);
      const auto open = not_shown.find(suite + "." + name);
      const std::string reason = open == not_shown.end() ? "" : open->second;
      testing::RegisterTest(suite.c_str(), name.c_str(), nullptr, nullptr, __FILE__,
                            __LINE__,
                            [=]() -> testing::Test *
                            {
                              if(reason.empty())
                                return new Test(form, arguments...);
                              return new SkippedClaim(reason);
                            });
    }

    void add_tests(const Form &form)
    {
      // On ranks there are boxes and half sections only, these scenes are slabs and
      // balls: rank_run_test holds sources and starts from one phase against the serial
      // engine, step by step.
      const bool boxes_only = form.capabilities.form == "on several ranks";
      for(const Effect effect : form.capabilities.effects)
        if(!boxes_only || effect != Effect::heat_sources)
          add<EffectClaim>(form, "EffectClaims", cases::to_string(effect), effect);
      for(const FrontOrigin origin : form.capabilities.front_origins)
        if(!boxes_only || origin == FrontOrigin::initial_front)
          add<RunClaim>(form, "FrontOriginClaims", cases::to_string(origin),
                        RunClaim::Make([=] { return trial_of(form, origin); }),
                        std::optional(origin));
      for(const cases::ShapeCapability &shape : form.capabilities.shapes)
      {
        // These scenes hold no mesh: mesh_file_test makes meshes and holds walls of all
        // kinds on them.
        if(shape.shape == DomainShape::mesh)
          continue;
        for(const int dimension : shape.dimensions)
          for(const BoundaryKind kind : shape.walls)
            add<RunClaim>(
                form, "WallClaims",
                fmt::format("{} {}D {}", cases::to_string(shape.shape), dimension,
                            cases::to_string(kind)),
                RunClaim::Make([=] { return trial_of(form, shape, dimension, kind); }),
                std::optional<FrontOrigin>());
      }
    }
  } // namespace
} // namespace meltfront::verification::claims

int main(int argc, char **argv)
{
  testing::InitGoogleTest(&argc, argv);
  for(const auto &form : meltfront::verification::claims::forms())
    meltfront::verification::claims::add_tests(form);
  return RUN_ALL_TESTS();
}
