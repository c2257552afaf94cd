#include <verification/measure/tests/fixtures.h>
#include <verification/report/tests/fixture.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include <stdlib.h>

namespace meltfront::verification::fixture
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::nan("");

    void fill_series(RunRecord &run, double error)
    {
      for(int i = 0; i <= 60; ++i)
      {
        const double t = i / 60., exact = 0.4 * std::sqrt(t);
        run.series.time.push_back(t);
        run.series.front.push_back(exact + error * std::cos(9 * t));
        run.series.front_isotherm.push_back(i == 0 ? nan : exact);
        run.series.front_exact.push_back(exact);
        run.series.budget_defect.push_back(i == 0 ? 0 : 1e-15 * t);
        run.series.temperature_min.push_back(-1);
        run.series.temperature_max.push_back(1);
      }
    }

    void fill_profile(RunRecord &run)
    {
      run.profile.time = 1;
      for(int i = 0; i <= run.n; ++i)
      {
        const double x = static_cast<double>(i) / run.n;
        run.profile.coordinate.push_back(x);
        run.profile.temperature.push_back(std::tanh(4 * (x - 0.4)));
        run.profile.solid_fraction.push_back(x < 0.4 ? 1 : 0);
        run.profile.temperature_exact.push_back(std::tanh(4 * (x - 0.4)));
      }
    }

    void fill_picture(RunRecord &run)
    {
      run.description.dimension = 2;
      for(int i = 0; i < run.n; ++i)
        for(int j = 0; j < run.n; ++j)
        {
          const double x = -0.5 + (i + 0.5) / run.n, y = -0.5 + (j + 0.5) / run.n;
          run.profile.picture_x.push_back(x);
          run.profile.picture_y.push_back(y);
          run.profile.picture_solid_fraction.push_back(std::hypot(x, y) < 0.4 ? 1 : 0);
          run.profile.picture_temperature.push_back(0);
        }
    }
  } // namespace

  RunRecord run(const std::string &case_name, const std::string &label, int n,
                double factor, double order, double seconds)
  {
    RunRecord run;
    run.case_name = case_name;
    run.label = label;
    run.method = label.substr(0, label.find('['));
    run.n = n;
    run.status = RunStatus::finished;
    run.description.spacing = 1. / n;
    run.description.unknowns = n;
    run.description.time_step = 1e-4;
    run.description.parameters = {{"kernel", "Wendland C2 <&>", ""}};
    run.effects = {{cases::Effect::phase_change, true, "the latent heat is 1 J/kg"},
                   {cases::Effect::wall_flux, false, "no wall prescribes a heat flux"}};
    run.cost.setup_wall = run.cost.setup_cpu = 0.25 * seconds * n * n / 400;
    run.cost.stepping_wall = run.cost.stepping_cpu = 0.75 * seconds * n * n / 400;
    run.cost.steps = 10 * n;
    run.cost.unknowns = n;
    run.cost.work = 1000L * n;
    run.cost.effects
        = {{cases::Effect::phase_change, 10, 20000, 0.1 * seconds * n * n / 400}};
    run.peak_memory_mb = 20;
    const double error = factor * std::pow(1. / n, order);
    run.quantities = {{"front_rms", error},          {"front_end", error / 2},
                      {"front_isotherm_rms", nan},   {"temperature_l2", 3 * error},
                      {"temperature_max", infinity}, {"budget_defect", 1e-15}};
    fill_series(run, error);
    fill_profile(run);
    run.provenance = {{"cpu", "A processor <1 & 2>"}, {"compiler", "GNU 12"}};
    return run;
  }

  namespace
  {
    /** A front at 0.4 sqrt(t) and a wall at -1. */
    class Known : public tests::LinearProfile
    {
    public:
      Known(cases::Symmetry symmetry, const std::string &words)
        : LinearProfile(symmetry)
        , words(words)
      {
      }

      std::string description() const override
      {
        return words;
      }

      double front(double time) const override
      {
        return 0.4 * std::sqrt(time);
      }

      double temperature(double coordinate, double time) const override
      {
        return coordinate / front(time) - 1;
      }

    private:
      std::string words;
    };

    cases::Field field(const std::string &expression)
    {
      cases::Field result = cases::Field::uniform(0);
      result.expression = expression;
      result.constant = false;
      return result;
    }
  } // namespace

  void set_wall(StoredCase &record, cases::Side side, cases::BoundaryKind kind,
                const std::string &expression)
  {
    record.scene.boundaries[static_cast<std::size_t>(side)]
        = cases::Boundary{kind, field(expression), false};
  }

  StoredCase plane_case(const std::string &name)
  {
    using cases::BoundaryKind;
    StoredCase record;
    cases::Scene &scene = record.scene;
    scene = tests::scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
    scene.name = name;
    scene.units = "normalised";
    scene.material.liquid.conductivity = 0.5;
    scene.initial.temperature = field("1.2 where x > 0 & t < 1");
    scene.boundaries[static_cast<std::size_t>(cases::Side::x_min)] = cases::Boundary{
        BoundaryKind::fixed_temperature, cases::Field::uniform(-10.123456789), false};
    record.title = "Plane <freezing> & \"melting\"";
    record.description = "A <slab> & nothing else.";
    record.tags = {"plane", "a&b"};
    record.limits = {"Nothing holds for x < 0 & t < 0."};
    record.exact = std::make_shared<Known>(
        cases::Symmetry::planar, "planar two-phase Neumann solution, lambda = 0.5");
    record.text = "set title = <&>\n";
    record.hash = std::string(64, 'a');
    return record;
  }

  StoredCase sink_case(const std::string &name)
  {
    using cases::BoundaryKind, cases::Side;
    StoredCase record = plane_case(name);
    record.title
        = "A line sink with a rather long title that has to wrap on a small screen "
          "without pushing anything aside";
    record.scene.units = "SI";
    record.scene.symmetry = cases::Symmetry::none;
    record.scene.domain
        = tests::scene_of(cases::DomainShape::box, 2, cases::Symmetry::none).domain;
    set_wall(record, Side::x_min, BoundaryKind::insulated, "");
    set_wall(record, Side::x_max, BoundaryKind::periodic, "");
    set_wall(record, Side::y_min, BoundaryKind::flux, "sin(pi*x)*exp(-t)");
    set_wall(record, Side::y_max, BoundaryKind::fixed_temperature,
             "sin(3*pi*x) + 0.25*cos(7*pi*x)*exp(-t) - 1");
    record.scene.sources = {{{}, "-148.45", {}, {}}};
    record.exact
        = std::make_shared<Known>(cases::Symmetry::none, "line sink, lambda = 0.15");
    record.measurement.front_floor = 3e-5;
    for(const int n : {20, 40, 80, 160})
      record.printed.push_back(
          {"A paper <1999>, Table 1", "sph-2005", "front_rms", n, 0.5 / n});
    return record;
  }

  MatrixResult matrix()
  {
    MatrixResult result;
    result.name = "synthetic";
    result.title = "A <synthetic> matrix & more";
    result.description = "Made up: nothing of this was computed.";
    result.date = "2026-01-02";
    result.program_version = "0.1.0";
    result.hard_cases = true;
    result.cases = {plane_case("plane"), sink_case("sink")};
    for(const int n : {20, 40, 80, 160})
    {
      result.runs.push_back(run("plane", "sph", n, 0.5, 1.5, 0.01));
      result.runs.push_back(run("plane", "sph-2005", n, 0.5, 1, 0.04));
      result.runs.push_back(run("plane", "fem-enthalpy", n, 1, 2, 0.02));
      result.runs.push_back(run("sink", "sph-2005", n, 0.55, 1, 0.04));
      for(const std::uint64_t seed : {1, 2})
      {
        RunRecord seeded
            = run("sink", "sph[jitter=0.2]", n, seed == 1 ? 0.4 : 0.6, 1.5, 0.02);
        seeded.seed = seed;
        if(n == 40)
          fill_picture(seeded);
        result.runs.push_back(seeded);
      }
    }
    RunRecord &failed = result.runs.emplace_back(run("plane", "sph", 320, 1, 1, 1));
    failed.status = RunStatus::failed;
    failed.message = "sph, step 12, t = 0.5: temperature is <not> finite & 'broken'";
    RunRecord &refused
        = result.runs.emplace_back(run("sink", "fem-enthalpy", 40, 1, 1, 1));
    refused.status = RunStatus::refused;
    refused.message = "fem-enthalpy lacks the effect \"liquid_motion\"";
    RunRecord &empty
        = result.runs.emplace_back(run("plane", "fem-enthalpy", 320, nan, 1, nan));
    for(auto &[name, value] : empty.quantities)
      value = nan;
    result.criteria
        = {{"plane", "sph", "front_rms at n=40", 0.00198, -infinity, 0.002, true, ""},
           {"plane", "sph", "order of front_rms", nan, 1.6, infinity, false,
            "1.5 <measured> & known"}};
    result.omissions = {"plane, sph, n = 320: failed: " + failed.message,
                        "sink, fem-enthalpy, n = 40: refused: " + refused.message};
    result.stability = {{"plane", "sph", 40, "held", ""},
                        {"plane", "sph", 320, "failed", failed.message},
                        {"sink", "fem-enthalpy", 40, "refused", refused.message}};
    return result;
  }

  std::string Directory::path() const
  {
    return directory.path();
  }

  std::string Directory::read(const std::string &file) const
  {
    std::ifstream stream(directory.path(file), std::ios::binary);
    EXPECT_TRUE(stream) << file;
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  bool Directory::has(const std::string &file) const
  {
    return std::filesystem::exists(directory.path(file));
  }

  std::size_t count(const std::string &in, const std::string &what)
  {
    std::size_t found = 0;
    for(std::size_t at = in.find(what); at != std::string::npos;
        at = in.find(what, at + 1))
      ++found;
    return found;
  }
} // namespace meltfront::verification::fixture
