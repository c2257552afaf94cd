#include <cases/numbers.h>
#include <verification/measure/formulas/front_reader.h>
#include <verification/measure/formulas/front_shape.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;

    /** Relative to the largest |T - T_m|, a temperature so near the melting point is at
     * it. */
    constexpr double melting_tolerance = 1e-10;
    constexpr double lost_quarter = 0.25;

    /** One front parts the phases if no more of the smaller one lies beyond it. */
    constexpr double most_misplaced = 0.2;

    /** isotherm_crossing() of sites of which each is a point of the profile. */
    double crossing_of_sites(const std::vector<double> &coordinate,
                             std::span<const double> temperature,
                             double melting_temperature)
    {
      std::vector<std::size_t> order(coordinate.size());
      std::iota(order.begin(), order.end(), 0);
      if(!std::ranges::is_sorted(coordinate))
        std::ranges::stable_sort(order, {}, [&](std::size_t i) { return coordinate[i]; });
      std::vector<double> sorted, excess;
      for(const std::size_t i : order)
      {
        sorted.push_back(coordinate[i]);
        excess.push_back(temperature[i] - melting_temperature);
      }
      return isotherm_crossing(sorted, excess);
    }

    /** The point of the domain with the least coordinate. */
    cases::Position start_of_coordinate(const cases::Scene &scene)
    {
      if(scene.domain.shape == cases::DomainShape::shell)
        return {scene.domain.inner_radius, 0, 0};
      return measured_symmetry(scene, nullptr) == cases::Symmetry::planar
                 ? scene.domain.lower
                 : cases::Position{};
    }

    /** Whether the wall where the coordinate starts freezes (true) or melts (false);
     * nothing if there is none or it does neither. */
    std::optional<bool> first_wall_freezes(const cases::Scene &scene,
                                           const cases::Position &start)
    {
      const bool shell = scene.domain.shape == cases::DomainShape::shell;
      if(!shell && measured_symmetry(scene, nullptr) != cases::Symmetry::planar)
        return {};
      const cases::Side side = shell ? cases::Side::inner : cases::Side::x_min;
      const auto &wall = scene.boundaries[static_cast<std::size_t>(side)];
      if(!wall || !wall->value.value)
        return {};
      const double at_wall = wall->value(start, scene.start_time);
      const double melting = scene.material.melting_temperature;
      switch(wall->kind)
      {
      case cases::BoundaryKind::fixed_temperature:
      case cases::BoundaryKind::heat_transfer:
      case cases::BoundaryKind::radiation:
        if(at_wall != melting)
          return at_wall < melting;
        return {};
      case cases::BoundaryKind::flux:
        if(at_wall != 0)
          return at_wall < 0;
        return {};
      default:
        return {};
      }
    }

    int sign(double value, double tolerance)
    {
      return value > tolerance ? 1 : value < -tolerance ? -1 : 0;
    }
  } // namespace

  cases::Symmetry measured_symmetry(const cases::Scene &scene,
                                    const cases::ExactSolution *exact)
  {
    if(exact)
      return exact->symmetry();
    if(scene.symmetry != cases::Symmetry::none)
      return scene.symmetry;
    // The volumes are those of a body in space, though its half section is a plane.
    if(scene.domain.shape == cases::DomainShape::axisymmetric)
      return cases::Symmetry::spherical;
    switch(scene.domain.dimension)
    {
    case 2:
      return cases::Symmetry::cylindrical;
    case 3:
      return cases::Symmetry::spherical;
    default:
      return cases::Symmetry::planar;
    }
  }

  bool solid_holds_origin(const cases::Scene &scene, const cases::ExactSolution *exact)
  {
    if(exact)
      return exact->solid_at_origin();
    const cases::Position start = start_of_coordinate(scene);
    double heat = 0;
    for(const cases::PointSource &source : scene.sources)
      heat += source.energy(scene.end_time);
    if(scene.initial.front && (scene.symmetry != cases::Symmetry::none || heat == 0))
      return (*scene.initial.front)(start, scene.start_time) < 0;
    if(heat != 0)
      return heat < 0;
    if(const auto freezes = first_wall_freezes(scene, start))
      return *freezes;
    return scene.initial.temperature(start, scene.start_time)
           <= scene.material.melting_temperature;
  }

  double isotherm_crossing(std::span<const double> coordinate,
                           std::span<const double> excess)
  {
    double scale = 0;
    for(const double value : excess)
      scale = std::max(scale, std::abs(value));
    const double tolerance = melting_tolerance * scale;
    const std::size_t n = excess.size();
    std::size_t k = 0;
    while(k < n && sign(excess[k], tolerance) == 0)
      ++k;
    if(k == n)
      return nan;
    if(k > 0)
      return coordinate[k - 1];
    const int side = sign(excess[0], tolerance);
    while(k < n && sign(excess[k], tolerance) == side)
      ++k;
    if(k == n)
      return nan;
    std::size_t beyond = k;
    while(beyond < n && sign(excess[beyond], tolerance) == 0)
      ++beyond;
    if(beyond == n)
      return coordinate[k];
    if(beyond > k)
      return (coordinate[k] + coordinate[beyond - 1]) / 2;
    const double part = excess[k - 1] / (excess[k - 1] - excess[k]);
    return coordinate[k - 1] + part * (coordinate[k] - coordinate[k - 1]);
  }

  namespace
  {
    /** Temperature of the front: of an alloy whose exact state is known that of its front
     * (solute that diffuses has made it colder), else that at which what stands at the
     * origin begins to freeze. */
    double front_temperature(const cases::Scene &scene, const cases::ExactSolution *exact)
    {
      if(!scene.alloy)
        return scene.material.melting_temperature;
      if(exact && exact->mushy())
        return exact->temperature(exact->front(scene.end_time), scene.end_time);
      double concentration[cases::most_solutes] = {};
      for(std::size_t s = 0; s < scene.alloy->solutes.size(); ++s)
        concentration[s]
            = scene.initial.concentration[s](cases::Position{}, scene.start_time);
      return cases::PhaseDiagram(scene.material, *scene.alloy)
          .liquidus(concentration[0], concentration[1]);
    }
  } // namespace

  FrontReader::FrontReader(const cases::Scene &scene, const cases::ExactSolution *exact,
                           double spacing, double smoothing_length)
    : symmetry(measured_symmetry(scene, exact))
    , solid_at_origin(solid_holds_origin(scene, exact))
    , sites_tell_phase(!exact && !scene.initial.front && scene.sources.empty())
    , alloy(scene.alloy.has_value())
    , melting_temperature(front_temperature(scene, exact))
    , spacing(spacing)
    , smoothing_length(smoothing_length)
    , site_coordinates(symmetry)
  {
    hole = hole_volume(symmetry, scene.domain);
    if(symmetry != cases::Symmetry::planar)
      return;
    origin = scene.domain.lower[0];
    if(scene.symmetry == cases::Symmetry::none)
      for(int d = 1; d < scene.domain.dimension; ++d)
        cross_section *= scene.domain.upper[d] - scene.domain.lower[d];
  }

  const std::vector<double> &FrontReader::coordinates(const cases::Snapshot &snapshot)
  {
    return site_coordinates.of(snapshot);
  }

  double FrontReader::enclosing(const cases::Snapshot &snapshot, bool solid) const
  {
    double volume = 0;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
      volume += snapshot.weights[i]
                * (solid ? snapshot.solid_fraction[i] : 1 - snapshot.solid_fraction[i]);
    return origin
           + cases::enclosing_coordinate(symmetry, (volume + hole) / cross_section);
  }

  double FrontReader::by_latent_heat(const cases::Snapshot &snapshot,
                                     const std::vector<double> &coordinate)
  {
    if(sites_tell_phase)
      find_phase_at_origin(snapshot, coordinate);
    return enclosing(snapshot, solid_at_origin);
  }

  /** What is known stays unless the sites show one front with the phases the other way
   * round: a wall may melt what it froze before. */
  void FrontReader::find_phase_at_origin(const cases::Snapshot &snapshot,
                                         const std::vector<double> &coordinate)
  {
    const double front = enclosing(snapshot, !solid_at_origin);
    double inner = 0, outer = 0, inside = 0, beyond = 0;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
    {
      const double fraction
          = solid_at_origin ? 1 - snapshot.solid_fraction[i] : snapshot.solid_fraction[i];
      const double volume = snapshot.weights[i];
      inner += volume * fraction;
      outer += volume * (1 - fraction);
      (coordinate[i] > front ? beyond : inside)
          += volume * (coordinate[i] > front ? fraction : 1 - fraction);
    }
    const double smaller = std::min(inner, outer);
    if(smaller > 0 && std::max(inside, beyond) <= most_misplaced * smaller)
      solid_at_origin = !solid_at_origin;
  }

  Shells::Shells(const std::vector<double> &coordinates, double width)
  {
    const auto [first, last] = std::ranges::minmax(coordinates);
    const auto shell = [width, start = first](double c)
    { return static_cast<std::size_t>(std::round((c - start) / width)); };
    std::vector<int> count(shell(last) + 1);
    for(const double c : coordinates)
      ++count[shell(c)];
    std::vector<std::uint32_t> number(count.size());
    for(std::size_t s = 0; s < count.size(); ++s)
    {
      number[s] = static_cast<std::uint32_t>(sites.size());
      if(count[s] > 0)
        sites.push_back(count[s]);
    }
    shell_of_site.reserve(coordinates.size());
    for(const double c : coordinates)
      shell_of_site.push_back(number[shell(c)]);
    coordinate = means(coordinates);
  }

  std::vector<double> Shells::means(std::span<const double> values) const
  {
    std::vector<double> result(sites.size());
    for(std::size_t i = 0; i < values.size(); ++i)
      result[shell_of_site[i]] += values[i];
    for(std::size_t s = 0; s < sites.size(); ++s)
      result[s] /= sites[s];
    return result;
  }

  double FrontReader::by_isotherm(const cases::Snapshot &snapshot,
                                  const std::vector<double> &coordinate)
  {
    if(coordinate.empty())
      return nan;
    if(snapshot.dimension == 1 || spacing <= 0)
      return crossing_of_sites(coordinate, snapshot.temperature, melting_temperature);
    if(!shells || shells_version != site_coordinates.version())
    {
      shells.emplace(coordinate, spacing);
      shells_version = site_coordinates.version();
    }
    std::vector<double> excess = shells->means(snapshot.temperature);
    for(double &value : excess)
      value -= melting_temperature;
    return isotherm_crossing(shells->coordinate, excess);
  }

  void FrontReader::read_extreme_sites(const cases::Snapshot &snapshot,
                                       const std::vector<double> &coordinate,
                                       FrontReading &reading) const
  {
    reading.max_ice = reading.heat_loss = nan;
    if(!solid_at_origin)
      return;
    for(std::size_t i = 0; i < coordinate.size(); ++i)
    {
      if(snapshot.weights[i] == 0)
        continue;
      if(snapshot.solid_fraction[i] == 1)
        reading.max_ice
            = std::fmax(reading.max_ice, coordinate[i] + 0.5 * smoothing_length);
      if(snapshot.solid_fraction[i] > lost_quarter)
        reading.heat_loss = std::fmax(reading.heat_loss, coordinate[i]);
    }
  }

  FrontReading FrontReader::read(const cases::Snapshot &snapshot)
  {
    const std::vector<double> &coordinate = coordinates(snapshot);
    FrontReading reading;
    reading.isotherm = by_isotherm(snapshot, coordinate);
    reading.latent_heat = alloy ? reading.isotherm : by_latent_heat(snapshot, coordinate);
    read_extreme_sites(snapshot, coordinate, reading);
    return reading;
  }
} // namespace meltfront::verification
