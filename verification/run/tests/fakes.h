#ifndef meltfront_verification_run_tests_fakes_h
#define meltfront_verification_run_tests_fakes_h

#include <cases/case.h>
#include <cases/error.h>
#include <cases/run.h>
#include <verification/matrix/matrix.h>
#include <verification/measure/tests/fixtures.h>
#include <verification/record/temporary_directory.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

namespace meltfront::verification::tests
{
  /** The text of a slab from 0 to 1 s between walls at -1 and 1. */
  inline std::string slab_text(const std::string &title)
  {
    return "set title = " + title + R"(
subsection Scene
  set symmetry = planar
  set end time = 1
  subsection Domain
    set shape = slab
    set length = 1
  end
  subsection Material
    set latent heat = 1
    set melting temperature = 0
    subsection Solid
      set conductivity = 1
      set specific heat capacity = 1
      set density = 1
    end
  end
  subsection Initial state
    set temperature = 1
  end
  subsection Walls
    subsection x_min
      set kind = fixed temperature
      set temperature = -1
    end
    subsection x_max
      set kind = fixed temperature
      set temperature = 1
    end
  end
end
)";
  }

  /** The same whose solution is LinearProfile: front at 0.5 sqrt(t). */
  inline cases::Case slab_case(const std::string &name)
  {
    cases::Case c;
    c.scene = scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
    c.scene.name = name;
    for(const auto &[side, temperature] :
        {std::pair(cases::Side::x_min, -1.), std::pair(cases::Side::x_max, 1.)})
      c.scene.boundaries[static_cast<std::size_t>(side)]
          = cases::Boundary{cases::BoundaryKind::fixed_temperature,
                            cases::Field::uniform(temperature), false};
    c.title = "A slab";
    c.text = slab_text(name);
    c.exact = std::make_shared<LinearProfile>(cases::Symmetry::planar);
    return c;
  }

  /** The state of n cells with a given front and the temperature x - front. */
  inline State slab_state(int n, double front)
  {
    State state;
    for(int i = 0; i < n; ++i)
    {
      const double x = (i + 0.5) / n;
      state.positions[0].push_back(x);
      state.weights.push_back(1. / n);
      state.solid_fraction.push_back(std::clamp(front * n - i, 0., 1.));
      state.temperature.push_back(x - front);
    }
    return state;
  }

  inline cases::Capabilities fake_capabilities()
  {
    using cases::BoundaryKind, cases::DomainShape, cases::FrontOrigin;
    const std::vector<BoundaryKind> walls{BoundaryKind::insulated,
                                          BoundaryKind::fixed_temperature};
    return {.form = {},
            .problems = {cases::ProblemKind::stefan},
            .effects = cases::all_effects(),
            .shapes = {{DomainShape::slab, {1}, walls},
                       {DomainShape::box, {2, 3}, walls},
                       {DomainShape::ball, {2, 3}, walls}},
            .front_origins
            = {FrontOrigin::none, FrontOrigin::initial_front, FrontOrigin::partly_melted,
               FrontOrigin::wall, FrontOrigin::source},
            .most_threads = cases::any_number_of_threads};
  }

  /** What is done to a state before it is handed out. */
  using Cheat = std::function<void(State &)>;

  /** The solution of slab_case() in 200 steps, with a known error at every time but the
   * start. */
  class FakeRun : public cases::Run
  {
  public:
    FakeRun(const cases::EffectSet &effects, int n, double error, Cheat cheat)
      : effects(effects)
      , n(n)
      , error(error)
      , cheat(std::move(cheat))
    {
    }

    cases::RunDescription describe() const override
    {
      cases::RunDescription description;
      description.spacing = 1. / n;
      description.unknowns = n;
      return description;
    }

    cases::Cost cost() const override
    {
      cases::Cost cost;
      cost.steps = steps;
      cost.unknowns = n;
      cost.work = static_cast<long>(n) * steps;
      for(const cases::EffectDecision &decision : effects.decisions())
        if(decision.on)
          cost.effects.push_back({decision.effect, steps, 8L * n, 1e-4});
      return cost;
    }

  private:
    void take_steps() override
    {
      for(; next <= steps; ++next)
        reached(next, static_cast<double>(next) / steps);
    }

    void save(boost::archive::binary_oarchive &kept) const override
    {
      kept << next << initial_heat;
    }

    void restore(boost::archive::binary_iarchive &kept) override
    {
      kept >> next >> initial_heat;
      ++next;
    }

    cases::Snapshot snapshot(long step, double time) override
    {
      state = slab_state(n, 0.5 * std::sqrt(time) + (step > 0 ? error : 0));
      state.book(initial_heat);
      if(step == 0)
      {
        initial_heat = state.snapshot.heat.boundary;
        state.book(initial_heat);
      }
      state.snapshot.step = step;
      if(cheat && step > 0)
        cheat(state);
      return state.view(1, time);
    }

    static constexpr int steps = 200;

    const cases::EffectSet &effects;
    int n;
    double error;
    Cheat cheat;
    double initial_heat = 0;
    int next = 0; ///< step
    State state;
  };

  /**
   * A method that knows the solution of slab_case() and adds a known error: its front is
   * off by factor * h^order at every time but the start.
   */
  class FakeMethod : public cases::Method
  {
  public:
    /** What a run does at its start, before it solves anything. */
    using Act = std::function<void(const cases::Scene &, const cases::Resolution &)>;

    explicit FakeMethod(const std::string &name, Act act = {}, double factor = 0.1,
                        double order = 1, Cheat cheat = {})
      : Method(name, "A method with a known error.")
      , act(std::move(act))
      , factor(factor)
      , order(order)
      , cheat(std::move(cheat))
    {
    }

    std::vector<cases::Capabilities> capabilities() const override
    {
      return {fake_capabilities()};
    }

    std::vector<cases::OptionDeclaration> option_declarations() const override
    {
      return {{"step_factor", "1", 0.5, "A number.", 0, 2},
              {"scheme", "", std::string("euler"), "A word.", 0, 0, {"euler", "rkl2"}},
              {"checkpoint", "s", 0., "Wall time between checkpoints.", 0, 1e9}};
    }

    std::unique_ptr<cases::Run> set_up(const cases::Scene &scene,
                                       const cases::EffectSet &effects,
                                       const cases::Resolution &resolution) const override
    {
      if(act)
        act(scene, resolution);
      return std::make_unique<FakeRun>(
          effects, resolution.n, factor * std::pow(1. / resolution.n, order), cheat);
    }

  private:
    Act act;
    double factor, order;
    Cheat cheat;
  };

  /** A directory of a test's own, removed at its end. */
  class ScratchDirectory
  {
  public:
    std::string path(const std::string &name = "") const
    {
      return directory.path(name);
    }

  private:
    TemporaryDirectory directory;
  };

  /** Append a line in one write, so that lines of several processes do not mix. */
  inline void append_line(const std::string &path, const std::string &line)
  {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    const std::string text = line + "\n";
    if(write(file, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
      throw cases::OutputError("cannot append to " + path);
    close(file);
  }

  inline std::vector<std::string> lines_of(const std::string &path)
  {
    std::vector<std::string> lines;
    std::ifstream in(path);
    for(std::string line; std::getline(in, line);)
      lines.push_back(line);
    return lines;
  }

  inline std::string text_of(const std::string &path)
  {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
  }
} // namespace meltfront::verification::tests

#endif
