#include <reference_fem/fitted/events/cold_start.h>

#include <cases/error.h>
#include <cases/exact/line_sink.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/point_sink.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using cases::BoundaryKind;

    /** Where the front of a seed is, as a share of the ray. */
    constexpr double seed_share = 1e-4;

    /** The time of a seed is at most this share of the run. */
    constexpr double latest_seed = 1e-5;

    /** Widths of the thermal layer of the old phase that the ray must be long at the
     * seed: erfc(6) is 2e-17. */
    constexpr double layers_in_ray = 12;

    /** Beyond so many widths of its thermal layer the old phase is as it was: erfc(20) is
     * 5e-176, and what is left of it is no number. */
    constexpr double far_in_layers = 20;

    /** Steps are equal in this root of the clock. */
    constexpr double lengthening = 3;

    /** A wall this close to the melting temperature is at it. */
    constexpr double rounding = 1e-13;

    /** A seed is made before a wall of given flux or heat transfer has gone more than
     * this share of the time that takes it to the melting temperature; unless it gets
     * there within this share of the time of the seed, that is, at once. */
    constexpr double before_passing = 0.25, at_once = 1e-6;

    /** The front constant for which a sink of the given kind removes @p heat. */
    template <typename Sink, typename Strength>
    std::shared_ptr<const cases::ExactSolution>
    sink_that_removes(const double heat, const cases::Material &material,
                      const double far, const Strength &strength)
    {
      const auto excess = [&](const double logarithm)
      { return strength(Sink(material, std::exp(logarithm), far)) / heat - 1; };
      double lower = std::log(1e-3), upper = std::log(3.);
      if(!(excess(lower) < 0) || !(excess(upper) > 0))
        throw cases::Refusal("fem-fitted cannot start from this sink: it is too weak or "
                             "too strong for a front that grows with the root of time");
      std::uintmax_t iterations = 200;
      const auto bracket = boost::math::tools::toms748_solve(
          excess, lower, upper, boost::math::tools::eps_tolerance<double>(52),
          iterations);
      return std::make_shared<Sink>(
          material, std::exp(0.5 * (bracket.first + bracket.second)), far);
    }

    /** Heat that a sink draws around the time of seeds; its law in time must be the one
     * that the similarity solution asks for. */
    std::shared_ptr<const cases::ExactSolution> sink_start(const EventScene &setting,
                                                           const LayeredState &initial)
    {
      if(initial.solid_inside)
        throw cases::Refusal("fem-fitted starts in one phase from sinks that freeze "
                             "liquid; this one lies in solid");
      const cases::Scene &scene = setting.scene;
      const double early = latest_seed * (scene.end_time - scene.start_time);
      const auto drawn = [&](const double since)
      { return -scene.sources[0].power(scene.start_time + since); };
      if(!(drawn(early) > 0))
        throw cases::Refusal("fem-fitted starts in one phase from sinks; this source "
                             "gives off heat");
      const bool line = setting.rays.surface.exponent == 1;
      const double growth = drawn(early) / drawn(early / 4);
      if(std::abs(growth - (line ? 1 : 2)) > 1e-3)
        throw cases::Refusal(fmt::format(
            "fem-fitted starts in one phase from {}; this one has another law in time",
            line ? "a line sink of constant strength"
                 : "a point sink whose strength grows with the root of time"));
      const double far = temperature_at_end(setting, initial, true);
      if(line)
        return sink_that_removes<cases::LineSink>(drawn(early), scene.material, far,
                                                  [](const cases::LineSink &sink)
                                                  { return sink.strength(); });
      return sink_that_removes<cases::PointSink>(drawn(early), scene.material, far,
                                                 [&](const cases::PointSink &sink)
                                                 { return sink.strength(early); });
    }

    /** Since the start (s). */
    double seed_time(const EventScene &setting, const SuddenStart &start,
                     const LayeredState &state, const bool shares_room)
    {
      const cases::Scene &scene = setting.scene;
      const double length
          = room_at_wall(setting, state, start.at_inner_end) * (shares_room ? 0.5 : 1);
      const cases::PhaseProperties &old
          = start.local->solid_at_origin() ? scene.material.liquid : scene.material.solid;
      const double by_front = std::pow(seed_share * length / start.local->front(1), 2);
      const double by_layer = std::pow(length / layers_in_ray, 2) / old.diffusivity();
      return std::min({by_front, by_layer, latest_seed * (scene.end_time - state.time),
                       0.5 * time_to_breakpoint(scene, state.time)});
    }
  } // namespace

  std::optional<SuddenStart> start_at_wall(const EventScene &setting,
                                           const LayeredState &state, const bool inner)
  {
    const RayScene &rays = setting.rays;
    const RayMesh geometry(rays.surface, rays.inner, rays.outer, {0, 1});
    if(inner && geometry.has_centre())
      return std::nullopt;
    const cases::Side side = side_at(setting.scene, inner);
    const cases::Boundary &wall = setting.scene.boundary(side);
    if(wall.kind != BoundaryKind::fixed_temperature)
      return std::nullopt;
    const cases::Material &material = setting.scene.material;
    const double at_wall
        = wall.value(geometry.position(0, inner ? rays.inner : rays.outer), state.time);
    const double beside = temperature_at_end(setting, state, inner);
    const double sign = state.solid_at(inner) ? 1 : -1;
    // A metastable phase stays as it is.
    const double round_off
        = rounding * (std::abs(material.melting_temperature) + std::abs(beside));
    if(!(sign * (at_wall - material.melting_temperature) > round_off)
       || sign * (beside - material.melting_temperature) > 0)
      return std::nullopt;
    return SuddenStart{inner,
                       std::make_shared<cases::PlanarNeumann>(material, at_wall, beside),
                       fmt::format("the wall {}", to_string(side))};
  }

  std::vector<SuddenStart> sudden_starts(const EventScene &setting,
                                         const LayeredState &initial)
  {
    std::vector<SuddenStart> result;
    if(setting.effects.contains(cases::Effect::heat_sources) && initial.fronts.empty())
      result.push_back({true, sink_start(setting, initial), "the sink at the centre"});
    for(const bool inner : {true, false})
      if(auto start = start_at_wall(setting, initial, inner))
        result.push_back(*start);
    return result;
  }

  namespace
  {
    /** A new phase at an end of the ray, at the time of the seed. */
    struct Seed
    {
      NewLayer place;
      /** Temperature in it, and the change of that of the old phase; by the distance from
       * its end of the ray. */
      std::function<double(double distance)> temperature, change;
      std::string cause;
    };

    Seed seed_of(const SuddenStart &start, const double since,
                 const cases::Material &material, const double before)
    {
      const double width = start.local->front(since);
      const cases::PhaseProperties &old
          = start.local->solid_at_origin() ? material.liquid : material.solid;
      const double thermal_layer = 2 * std::sqrt(old.diffusivity() * since);
      const auto local = [solution = start.local, since](const double distance)
      { return solution->temperature(distance, since); };
      // The state need not be uniform farther away.
      const auto change = [local, before, reach = width + far_in_layers * thermal_layer](
                              const double distance)
      { return distance <= reach ? local(distance) - before : 0.; };
      // The old phase's thermal layer or the new phase, whichever is thinner.
      return {{start.at_inner_end, width, std::min(width, thermal_layer)},
              local,
              change,
              start.cause + ", from the similarity solution"};
    }

    /** A wall of given flux or heat transfer that leads the phase beside it towards and
     * beyond the melting temperature. */
    struct LeadingWall
    {
      bool inner;
      double flux;     ///< into the body at the melting temperature (W/m^2)
      double released; ///< by the new phase: what the old one does not conduct (W/m^2)
      double excess;   ///< of the melting temperature over the wall's (K)
      double passing;  ///< time until the wall is at the melting temperature (s)
    };

    std::optional<LeadingWall> leading_wall(const EventScene &setting,
                                            const LayeredState &state, const bool inner,
                                            const cases::WallLayer &form)
    {
      const cases::Material &material = setting.scene.material;
      const bool solid = state.solid_at(inner);
      if(form.slope == 0 || (form.slope > 0) != solid)
        return std::nullopt;
      const RayScene &rays = setting.rays;
      const double end = inner ? rays.inner : rays.outer;
      const RayMesh geometry(rays.surface, rays.inner, rays.outer, {0, 1});
      const double melting = material.melting_temperature;
      const cases::PhaseProperties &old = solid ? material.solid : material.liquid;
      const double excess = melting - state.temperature(end), room = excess / form.slope;
      return LeadingWall{
          inner,
          cases::heat_through(setting.scene.boundary(side_at(setting.scene, inner)),
                              geometry.position(0, end), state.time, melting)
              .flux,
          old.conductivity * std::abs(form.slope), excess,
          room > 0 ? std::numbers::pi / 4 * room * room / old.diffusivity() : 0};
    }

    /** Where the wall is at the melting temperature at once: the front takes up what the
     * old phase does not conduct. What little that phase is beyond it is drawn to it. */
    Seed seed_of(const LeadingWall &wall, const double since, const EventScene &setting,
                 const bool from_solid)
    {
      const cases::Material &material = setting.scene.material;
      const cases::PhaseProperties &grown = from_solid ? material.liquid : material.solid;
      const cases::PhaseProperties &old = from_solid ? material.solid : material.liquid;
      const double thermal_layer = 2 * std::sqrt(old.diffusivity() * since);
      const double width = wall.released * since / (grown.density * material.latent_heat);
      const std::string cause
          = fmt::format("the wall {}", to_string(side_at(setting.scene, wall.inner)));
      if(!(width > thinnest_seed * (setting.rays.outer - setting.rays.inner)))
        throw cases::Refusal(fmt::format(
            "fem-fitted cannot start a front at {} beside the one that starts at the "
            "other end: by the time of its seed it is not to be told from its wall",
            cause));
      return {{wall.inner, width, std::min(width, thermal_layer)},
              [=, melting = material.melting_temperature,
               gradient = -wall.flux / grown.conductivity](const double distance)
              { return melting + gradient * (distance - width); },
              [=, excess = wall.excess](const double distance)
              {
                const double x = (distance - width) / thermal_layer;
                return x < far_in_layers ? excess * std::erfc(x) : 0.;
              },
              cause + ", which leads more heat than is conducted to it"};
    }

    std::string text_of(const std::vector<Seed> &seeds)
    {
      std::string result;
      for(const Seed &seed : seeds)
        result += fmt::format("{}a front starts at {}, {:.3g} m away at first",
                              result.empty() ? "" : "; ", seed.cause, seed.place.width);
      return result;
    }

    std::vector<NewLayer> places_of(const std::vector<Seed> &seeds)
    {
      std::vector<NewLayer> result;
      for(const Seed &seed : seeds)
        result.push_back(seed.place);
      return result;
    }
  } // namespace

  RunSegment seeded_stretch(const EventScene &setting,
                            const std::vector<SuddenStart> &starts,
                            const LayeredState &state)
  {
    const cases::Scene &scene = setting.scene;
    const RayScene &rays = setting.rays;
    if(setting.effects.contains(cases::Effect::volumetric_source))
      throw cases::Refusal("fem-fitted does not start a front at once at a wall where "
                           "heat is released throughout");
    double since = std::numeric_limits<double>::infinity();
    for(const SuddenStart &start : starts)
      since = std::min(since, seed_time(setting, start, state,
                                        starts.size() > 1 && state.fronts.empty()));
    std::array<cases::WallLayer, 2> forms = layers_at_walls(setting, state);
    for(const SuddenStart &start : starts)
      forms[start.at_inner_end ? 0 : 1] = {};
    std::vector<LeadingWall> leading;
    for(const bool inner : {true, false})
      if(const auto wall = leading_wall(setting, state, inner, forms[inner ? 0 : 1]))
      {
        if(wall->passing > at_once * since)
        {
          since = std::min(since, before_passing * wall->passing);
          continue;
        }
        leading.push_back(*wall);
        forms[inner ? 0 : 1] = {};
      }

    std::vector<Seed> seeds;
    for(const SuddenStart &start : starts)
      seeds.push_back(seed_of(start, since, scene.material,
                              temperature_at_end(setting, state, start.at_inner_end)));
    for(const LeadingWall &wall : leading)
      seeds.push_back(seed_of(wall, since, setting, state.solid_at(wall.inner)));
    const std::vector<NewLayer> layers = places_of(seeds);
    std::array<double, 2> thickness{};
    for(const bool inner : {true, false})
      if(forms[inner ? 0 : 1].forms())
        thickness[inner ? 0 : 1]
            = 2
              * std::sqrt(
                  (state.solid_at(inner) ? scene.material.solid : scene.material.liquid)
                      .diffusivity()
                  * since);
    Clock clock = physics_between(setting, true, 0).clock;
    if(setting.options.clock != "t")
      clock = {true, state.time};

    RunSegment result;
    result.problem = problem_with(setting, state, layers, thickness, clock);
    result.time = state.time + since;
    result.state = result.problem->state(
        result.time, fronts_with(setting, state, layers),
        [&](const cases::Position &p)
        {
          const double r = coordinate_of(setting, p);
          double sum = state.temperature(r)
                       + forms[0].temperature(r - rays.inner, thickness[0])
                       + forms[1].temperature(rays.outer - r, thickness[1]);
          for(const Seed &seed : seeds)
          {
            const double distance = seed.place.inner ? r - rays.inner : rays.outer - r;
            if(distance < seed.place.width)
              return seed.temperature(distance);
            sum += seed.change(distance);
          }
          return sum;
        });
    result.before = state.before;
    for(const cases::PointSource &source : scene.sources)
      result.before.sources += source.energy(result.time) - source.energy(state.time);
    const HeatContent seed = result.problem->heat(result.time, result.state);
    result.before.walls += seed.sensible + seed.latent - state.heat
                           - (result.before.sources - state.before.sources);
    result.steps = lengthening_steps(
        clock.clock(result.time), clock.clock(scene.end_time),
        steps_for(setting, state.time), clock.root ? lengthening : 2 * lengthening);
    result.event = {state.time, text_of(seeds)};
    return result;
  }
} // namespace meltfront::reference_fem::fitted
