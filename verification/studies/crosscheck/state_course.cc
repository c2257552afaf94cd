#include <cases/numbers.h>
#include <verification/measure/checks/scene_quadrature.h>
#include <verification/measure/checks/site_heat.h>
#include <verification/record/json_values.h>
#include <verification/studies/crosscheck/state_course.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace meltfront::verification
{
  namespace
  {
    using cases::infinity;
    constexpr int most_degree = 3;

    double time_of(const cases::Scene &scene, int k)
    {
      return scene.start_time
             + (scene.end_time - scene.start_time) * k / course_intervals;
    }

    /** Spacings from a wall: a site nearer to it stands for what is at the wall. */
    constexpr double reach_of_wall = 0.75;

    std::vector<double> inner_times(const cases::Scene &scene)
    {
      std::vector<double> times;
      for(int k = 1; k < course_intervals; ++k)
        times.push_back(time_of(scene, k));
      return times;
    }

    /** Bernstein's polynomials of a degree at a point of [0, 1]. */
    std::array<double, most_degree + 1> bernstein(int degree, double x)
    {
      constexpr int binomials[][most_degree + 1] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};
      std::array<double, most_degree + 1> result{};
      for(int k = 0; k <= degree; ++k)
        result[k] = binomials[degree][k] * std::pow(x, k) * std::pow(1 - x, degree - k);
      return result;
    }

    /** The coordinate up to which a volume reaches from an inner wall, in the measure of
     * a symmetry. */
    double end_of_volume(cases::Symmetry symmetry, double inner, double volume)
    {
      using std::numbers::pi;
      if(symmetry == cases::Symmetry::cylindrical)
        return std::sqrt(inner * inner + volume / pi);
      if(symmetry == cases::Symmetry::spherical)
        return std::cbrt(inner * inner * inner + volume * 3 / (4 * pi));
      return inner + volume;
    }

    /** Middles of what sites along one coordinate stand for, one after the other: a site
     * at a wall or a front is not in the middle of it. */
    std::vector<double> middles_of(cases::Symmetry symmetry,
                                   std::span<const double> positions,
                                   std::span<const double> weights, double lower)
    {
      std::vector<std::size_t> order(positions.size());
      std::iota(order.begin(), order.end(), 0);
      std::ranges::stable_sort(order, {}, [&](std::size_t i) { return positions[i]; });
      std::vector<double> middles(positions.size());
      double volume = 0, begin = lower;
      for(const std::size_t i : order)
      {
        volume += weights[i];
        const double end = end_of_volume(symmetry, lower, volume);
        middles[i] = (begin + end) / 2;
        begin = end;
      }
      return middles;
    }

    /** Latent and sensible heat per volume at a site, of phases of one density. */
    double heat_density(const cases::Material &material, double temperature, double solid)
    {
      return material.solid.density
             * (sensible_heat(material, temperature, solid)
                + material.latent_heat * (1 - solid));
    }
  } // namespace

  void to_json(nlohmann::json &json, const StateCourse &course)
  {
    json = {{"lowest", json_of(course.lowest)}, {"highest", json_of(course.highest)}};
    for(const auto &[name, values] : course.quantities)
      json["quantities"][name] = json_of(values);
    for(const auto &[name, values] : course.misreadings)
      json["misreadings"][name] = json_of(values);
  }

  void from_json(const nlohmann::json &json, StateCourse &course)
  {
    course.lowest = number_in(json.at("lowest"));
    course.highest = number_in(json.at("highest"));
    for(const auto &[name, values] : json.at("quantities").items())
      course.quantities[name] = numbers_in(values);
    if(json.contains("misreadings"))
      for(const auto &[name, values] : json.at("misreadings").items())
        course.misreadings[name] = numbers_in(values);
  }

  CourseObserver::CourseObserver(const cases::Scene &scene)
    : scene(scene)
    , coordinates(scene.symmetry)
    , intermediate_times(inner_times(scene))
    , lowest(infinity)
    , highest(-infinity)
    , volume(volume_of(scene.domain))
  {
  }

  void CourseObserver::begin(const cases::RunDescription &description)
  {
    spacing = description.spacing;
  }

  bool CourseObserver::wants(long step, double time)
  {
    intermediate_times.pass(step, time);
    return step == 0 || intermediate_times.near_one();
  }

  void CourseObserver::add(const std::string &name, double value)
  {
    values[name].push_back(value);
  }

  std::vector<std::pair<cases::Side, double>> CourseObserver::walls_along_line() const
  {
    using cases::Side;
    const cases::Domain &domain = scene.domain;
    const bool round = domain.round();
    std::vector<std::pair<Side, double>> walls{
        {round ? Side::inner : Side::x_min,
         round ? domain.inner_radius : domain.lower[0]},
        {round ? Side::outer : Side::x_max, round ? domain.radius : domain.upper[0]}};
    const std::vector<Side> sides = scene.sides();
    std::erase_if(walls, [&](const auto &wall)
                  { return std::ranges::find(sides, wall.first) == sides.end(); });
    return walls;
  }

  /** The temperature of a wall that is given one, beside a site. */
  std::optional<double> CourseObserver::wall_beside(double time, double x) const
  {
    for(const auto &[side, place] : walls_along_line())
      if(std::abs(x - place) <= reach_of_wall * spacing
         && scene.boundary(side).kind == cases::BoundaryKind::fixed_temperature)
        return scene.boundary(side).value({place, 0, 0}, time);
    return {};
  }

  CourseObserver::Hidden CourseObserver::hidden_at(const cases::Snapshot &snapshot,
                                                   std::size_t site, double x) const
  {
    const cases::Material &material = scene.material;
    const auto wall = wall_beside(snapshot.time, x);
    if(!wall || *wall == material.melting_temperature)
      return {};
    const bool solid = *wall < material.melting_temperature;
    const cases::PhaseProperties &phase = solid ? material.solid : material.liquid;
    const double share
        = solid ? snapshot.solid_fraction[site] : 1 - snapshot.solid_fraction[site];
    double beyond = std::abs(*wall - snapshot.temperature[site]);
    if(share > 0 && share < 1)
      beyond = std::max(beyond, std::abs(*wall - material.melting_temperature));
    const double layer = share == 0 ? 0.5 : 0;
    return {beyond / 2, layer,
            share * phase.volumetric_heat_capacity() * beyond / 2
                + layer * phase.density * material.latent_heat};
  }

  void CourseObserver::add_means(const cases::Snapshot &snapshot,
                                 const std::string &coordinate,
                                 std::span<const double> positions, double lower,
                                 double upper, std::span<const Hidden> hidden)
  {
    const bool along_line = scene.symmetry != cases::Symmetry::none;
    const int degree = along_line ? 3 : 2;
    std::array<double, most_degree + 1> weight{}, temperature{}, solid{},
        hidden_temperature{}, hidden_solid{};
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
    {
      const double x = std::clamp((positions[i] - lower) / (upper - lower), 0., 1.);
      const auto shares = bernstein(degree, x);
      for(int k = 0; k <= degree; ++k)
      {
        const double w = snapshot.weights[i] * shares[k];
        weight[k] += w;
        temperature[k] += w * snapshot.temperature[i];
        solid[k] += w * snapshot.solid_fraction[i];
        if(!hidden.empty())
        {
          hidden_temperature[k] += w * hidden[i].temperature;
          hidden_solid[k] += w * hidden[i].solid;
        }
      }
    }
    for(int k = 0; k <= degree; ++k)
    {
      const std::string where = fmt::format(" near {} = {}/{}", coordinate, k, degree);
      add("temperature" + where, temperature[k] / weight[k]);
      misread["temperature" + where].push_back(hidden_temperature[k] / weight[k]
                                               + share_misread * (highest - lowest)
                                               + beside_front);
      if(!scene.changes_phase())
        continue;
      add("solid fraction" + where, solid[k] / weight[k]);
      misread["solid fraction" + where].push_back(hidden_solid[k] / weight[k]
                                                  + share_misread);
    }
  }

  /** How far temperatures may be off because a front stands in the cell of a wall:
   * methods that hold the melting temperature at the site may have it half a spacing
   * beside the front, the same share of a spacing at every resolution while the front is
   * nearer to the wall than that. */
  double CourseObserver::front_at_wall(const cases::Snapshot &snapshot,
                                       std::span<const double> middles, double wall) const
  {
    bool stands_there = false;
    double most = 0;
    for(std::size_t i = 0; i < middles.size(); ++i)
    {
      const double away = std::abs(middles[i] - wall) / spacing;
      const double fraction = snapshot.solid_fraction[i];
      stands_there |= away <= reach_of_wall && fraction > 0 && fraction < 1;
      if(away <= reach_of_wall + 1)
        most = std::max(
            most, std::abs(snapshot.temperature[i] - scene.material.melting_temperature));
    }
    return stands_there ? most / 2 : 0;
  }

  /** From the coldest solid to the warmest liquid so far, per volume. */
  double CourseObserver::heat_scale() const
  {
    const cases::Material &material = scene.material;
    if(scene.changes_phase())
      return heat_density(material, highest, 0) - heat_density(material, lowest, 1);
    return material.solid.volumetric_heat_capacity() * (highest - lowest);
  }

  double CourseObserver::share_lacking(const cases::Snapshot &snapshot,
                                       double of_sites) const
  {
    double share = scene.domain.round() ? std::abs(of_sites / volume - 1) : 0;
    if(snapshot.heat.conservative && heat_scale() > 0)
      share += (std::abs(snapshot.heat.imbalance())
                + heat_of_sites(scene.material, snapshot).difference(snapshot.heat))
               / (heat_scale() * volume);
    return share;
  }

  void CourseObserver::observe(const cases::Snapshot &snapshot)
  {
    if(!times.empty() && snapshot.time <= times.back())
      return;
    times.push_back(snapshot.time);
    const auto [least, most] = std::ranges::minmax(snapshot.temperature);
    lowest = std::min(lowest, least);
    highest = std::max(highest, most);
    const cases::Domain &domain = scene.domain;
    double of_sites = 0;
    for(const double weight : snapshot.weights)
      of_sites += weight;
    share_misread = share_lacking(snapshot, of_sites);
    std::vector<Hidden> hidden;
    if(scene.symmetry != cases::Symmetry::none)
    {
      const bool round = domain.round();
      const double lower = round ? domain.inner_radius : domain.lower[0];
      const std::vector<double> middles
          = middles_of(scene.symmetry, coordinates.of(snapshot), snapshot.weights, lower);
      for(std::size_t i = 0; scene.changes_phase() && i < middles.size(); ++i)
        hidden.push_back(hidden_at(snapshot, i, middles[i]));
      beside_front = 0;
      for(const auto &[side, place] : walls_along_line())
        if(scene.changes_phase()
           && scene.boundary(side).kind != cases::BoundaryKind::fixed_temperature)
          beside_front += front_at_wall(snapshot, middles, place);
      add_means(snapshot, round ? "r" : "x", middles, lower,
                round ? domain.radius : domain.upper[0], hidden);
    }
    else
      for(int d = 0; d < snapshot.dimension; ++d)
        add_means(snapshot, std::string(1, "xyz"[d]), snapshot.positions[d],
                  domain.round() ? -domain.radius : domain.lower[d],
                  domain.round() ? domain.radius : domain.upper[d], hidden);
    if(!scene.changes_phase())
      return;
    const cases::Material &material = scene.material;
    double solid = 0, heat = 0, hidden_solid = 0, hidden_heat = 0;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
    {
      const double w = snapshot.weights[i];
      solid += w * snapshot.solid_fraction[i];
      heat += w
              * heat_density(material, snapshot.temperature[i],
                             snapshot.solid_fraction[i]);
      if(!hidden.empty())
      {
        hidden_solid += w * hidden[i].solid;
        hidden_heat += w * hidden[i].heat;
      }
    }
    add("solid fraction", solid / of_sites);
    misread["solid fraction"].push_back(hidden_solid / of_sites + share_misread);
    if(material.solid.density != material.liquid.density)
      return;
    add("heat", heat / of_sites);
    misread["heat"].push_back(hidden_heat / of_sites + share_misread * heat_scale());
  }

  StateCourse CourseObserver::course() const
  {
    StateCourse result;
    result.lowest = lowest;
    result.highest = highest;
    const double tolerance = 1e-9 * (scene.end_time - scene.start_time);
    for(const auto &[name, series] : values)
      for(int k = 0; k <= course_intervals; ++k)
        result.quantities[name].push_back(
            interpolated(times, series, time_of(scene, k), tolerance));
    for(const auto &[name, series] : misread)
      for(int k = 0; k <= course_intervals; ++k)
        result.misreadings[name].push_back(
            std::max(0., interpolated(times, series, time_of(scene, k), tolerance)));
    return result;
  }
} // namespace meltfront::verification
