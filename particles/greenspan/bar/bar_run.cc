#include <cases/error.h>
#include <particles/greenspan/bar/bar.h>
#include <particles/greenspan/bar/bar_run.h>
#include <particles/greenspan/scene_experiment.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** By how much the bar's length may differ from the slab's, relative. */
    constexpr double length_tolerance = 0.03;

    /** Time between looks at the bar, and over which they are averaged: the front
     * fluctuates by several spacings from one to the next. */
    constexpr double time_between_looks = 0.2, average_time = 5;

    /** A property of the material that the particles make up, measured by
     * `meltfront calibrate greenspan` (README.md), with its standard error. */
    struct MeasuredProperty
    {
      const char *name;
      double value, standard_error;
      double (*of)(const cases::Material &);
    };

    /** Of the triangle's force under this pressure; conductivities over the densities, as
     * lengths are masses per width. */
    constexpr double measured_pressure = 30;
    constexpr MeasuredProperty measured_properties[]
        = {{"melting temperature", 44.99, 0.24,
            [](const cases::Material &m) { return m.melting_temperature; }},
           {"latent heat", 27.4, 1.4,
            [](const cases::Material &m) { return m.latent_heat; }},
           {"solid's heat capacity", 2.41, 0.04,
            [](const cases::Material &m) { return m.solid.specific_heat_capacity; }},
           {"liquid's heat capacity", 4.86, 0.16,
            [](const cases::Material &m) { return m.liquid.specific_heat_capacity; }},
           {"solid's conductivity", 177, 10,
            [](const cases::Material &m) { return m.solid.conductivity; }},
           {"liquid's conductivity", 45, 3,
            [](const cases::Material &m) { return m.liquid.conductivity; }}};

    /** Of a value stated from the standard error: beyond, it is another material. */
    constexpr double standard_errors = 3;

    /** The particles conduct and melt as they do, whatever the scene states of its
     * material: another is refused.
     * @throws Refusal */
    void require_measured_material(const cases::Scene &scene)
    {
      if(force_of(scene.particle_solid->law) != PairForce::triangle()
         || scene.particle_solid->pressure != measured_pressure)
        throw cases::Refusal(
            fmt::format("what a bar of particles melts and conducts like is measured of "
                        "the default pair law under a pressure of {} only",
                        measured_pressure));
      for(const MeasuredProperty &property : measured_properties)
        if(const double given = property.of(scene.material);
           std::abs(given - property.value) > standard_errors * property.standard_error)
          throw cases::Refusal(fmt::format("a bar of particles is its own material: its "
                                           "{} is measured to be {} +- "
                                           "{}, the scene states {:.6g}",
                                           property.name, property.value,
                                           property.standard_error, given));
    }

    /** The mean of looks: squares of the molten mass, temperatures of layers. */
    BarLook mean_of(const std::deque<BarLook> &looks)
    {
      BarLook mean = looks.back();
      const double share = 1. / static_cast<double>(looks.size());
      double square = 0, edge = 0;
      for(BarLayer &layer : mean.layers)
        layer.temperature = 0;
      for(const BarLook &look : looks)
      {
        square += share * look.molten() * std::abs(look.molten());
        edge += share * look.edge;
        for(std::size_t i = 0; i < mean.layers.size(); ++i)
          mean.layers[i].temperature += share * look.layers[i].temperature;
      }
      mean.edge = edge;
      mean.front = edge + std::sqrt(std::max(0., square));
      return mean;
    }

    double wall_temperature(const cases::Scene &scene, const cases::Side side)
    {
      const cases::Boundary &wall = scene.boundary(side);
      if(wall.kind != cases::BoundaryKind::fixed_temperature || !wall.value.constant)
        throw cases::Refusal(
            fmt::format("a bar of particles needs a constant temperature "
                        "at {}",
                        cases::to_string(side)));
      return wall.value({}, scene.start_time);
    }

    BarSettings settings_of(const cases::Scene &scene,
                            const cases::Resolution &resolution)
    {
      const cases::ParticleSolid &solid = *scene.particle_solid;
      BarSettings settings;
      settings.force = force_of(solid.law);
      settings.columns = resolution.n;
      // of the crystal whose density the scene states: from another it would be strained
      settings.spacing = std::sqrt(2 / (std::sqrt(3.) * scene.material.solid.density));
      settings.rows = solid.rows;
      settings.pressure = solid.pressure;
      settings.hot_temperature = wall_temperature(scene, cases::Side::x_min);
      settings.cold_temperature = wall_temperature(scene, cases::Side::x_max);
      settings.time_step = solid.time_step;
      settings.seed = resolution.seed;
      settings.threads = resolution.threads;
      if(!scene.initial.temperature.constant
         || scene.initial.temperature({}, scene.start_time) != settings.cold_temperature)
        throw cases::Refusal("a bar of particles starts at the temperature of x_max");
      return settings;
    }

    class BarRun : public cases::Run
    {
    public:
      BarRun(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution)
        : scene(scene)
        , effects(effects)
        , density(scene.material.solid.density)
        , bar(settings_of(scene, resolution))
      {
        require_length();
      }

      cases::RunDescription describe() const override
      {
        const BarSettings &settings = bar.settings();
        cases::RunDescription result;
        result.dimension = 2;
        result.spacing = scene.domain.side() / settings.columns;
        result.time_step = settings.time_step;
        result.unknowns = static_cast<long>(4 * bar.particles().size());
        const auto add = [&](const char *name, const double value) {
          result.parameters.push_back({name, fmt::format("{:.6g}", value), ""});
        };
        add("particles", static_cast<double>(bar.particles().size()));
        add("rows", settings.rows);
        add("width", bar.width());
        add("pressure", settings.pressure);
        add("length of the hot bath", settings.hot_length);
        add("length of the cold bath", settings.cold_length);
        add("time over which front and temperatures are averaged", average_time);
        return result;
      }

      cases::Cost cost() const override
      {
        cases::Cost cost;
        cost.steps = steps;
        cost.unknowns = static_cast<long>(4 * bar.particles().size());
        cost.work = cost.steps * static_cast<long>(bar.particles().size());
        for(const cases::EffectDecision &decision : effects.decisions())
          if(decision.on)
            cost.effects.push_back(bar.particles().cost(decision.effect));
        return cost;
      }

    private:
      /** @throws Refusal if the bar does not fit the slab */
      void require_length() const
      {
        const BarSettings &settings = bar.settings();
        const BarLook look = bar.look();
        double cold_edge = 0; // mass up to the cold bath
        for(const BarLayer &layer : look.layers)
          if(layer.position < look.length - settings.cold_length)
            cold_edge = layer.mass;
        const double length = (cold_edge - look.edge) / density;
        const double wanted = scene.domain.side();
        if(std::abs(length - wanted) <= length_tolerance * wanted)
          return;
        const double column = (cold_edge / density) / settings.columns;
        throw cases::Refusal(fmt::format(
            "{} columns of particles make a bar of length {:.4g} between its baths, the "
            "slab's is {:.4g}: n must be about {:.0f}",
            settings.columns, length, wanted,
            settings.columns + (wanted - length) / column));
      }

      void take_steps() override
      {
        const double duration = scene.end_time - scene.start_time;
        const auto looks = static_cast<long>(std::ceil(duration / time_between_looks));
        std::deque<BarLook> recent;
        for(long look = 0; look <= looks; ++look)
        {
          const double time = duration * static_cast<double>(look) / looks;
          bar.advance_to(time);
          steps = std::lround(time / bar.settings().time_step);
          recent.push_back(bar.look());
          if(static_cast<double>(recent.size()) * time_between_looks > average_time)
            recent.pop_front();
          seen = mean_of(recent);
          reached(steps, look == looks ? scene.end_time : scene.start_time + time);
        }
      }

      cases::Snapshot snapshot(long step, double time) override
      {
        front = std::max(0., seen.molten() / density);
        for(auto *values : {&x, &weights, &temperature, &solid})
          values->clear();
        double before = seen.edge;
        for(std::size_t i = 0; i < seen.layers.size(); ++i)
        {
          const BarLayer &layer = seen.layers[i];
          const double end = i + 1 < seen.layers.size()
                                 ? 0.5 * (layer.mass + seen.layers[i + 1].mass)
                                 : 2 * layer.mass - before;
          const double left = (before - seen.edge) / density;
          const double right = std::min((end - seen.edge) / density, scene.domain.side());
          before = std::max(before, end);
          if(layer.mass <= seen.edge || right <= left)
            continue;
          x.push_back((left + right) / 2);
          weights.push_back(right - left);
          temperature.push_back(layer.temperature);
          solid.push_back(std::clamp((right - front) / (right - left), 0., 1.));
        }
        cases::Snapshot snapshot;
        snapshot.step = step;
        snapshot.time = time;
        snapshot.dimension = 1;
        snapshot.positions[0] = x;
        snapshot.weights = weights;
        snapshot.temperature = temperature;
        snapshot.solid_fraction = solid;
        snapshot.front[0] = {&front, 1};
        snapshot.obeys_maximum_principle = false;
        snapshot.heat.conservative = false;
        return snapshot;
      }

      const cases::Scene &scene;
      const cases::EffectSet &effects;
      double density;
      Bar bar;
      long steps = 0;
      BarLook seen; ///< mean of the last looks
      double front = 0;
      std::vector<double> x, weights, temperature, solid;
    };
  } // namespace

  std::unique_ptr<cases::Run> make_bar_run(const cases::Scene &scene,
                                           const cases::EffectSet &effects,
                                           const cases::Resolution &resolution)
  {
    require_measured_material(scene);
    return std::make_unique<BarRun>(scene, effects, resolution);
  }
} // namespace meltfront::particles::greenspan
