#include <cases/means_of_jumps.h>
#include <verification/measure/checks/given_heat.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    constexpr int intervals = 64;
    constexpr double offset = 0.7745966692414834; // sqrt(3/5)

    /** Heat of a power between two times, and what it would be if all were positive. */
    struct Heat
    {
      double net = 0, gross = 0;
    };

    Heat heat_between(const std::function<double(double)> &power, double from, double to)
    {
      const double middle = (from + to) / 2, half = (to - from) / 2;
      Heat heat;
      for(const auto &[place, weight] :
          {std::pair(-offset, 5. / 9), std::pair(0., 8. / 9), std::pair(offset, 5. / 9)})
      {
        const double part = weight * half * power(middle + place * half);
        heat.net += part;
        heat.gross += std::abs(part);
      }
      return heat;
    }
  } // namespace

  HeatOverTime::HeatOverTime(std::function<double(double)> power_over_time, double start,
                             double end, const std::vector<double> &breakpoints)
    : power(std::move(power_over_time))
  {
    for(int i = 0; i <= intervals; ++i)
      ends.push_back(start + (end - start) * i / intervals);
    for(const double time : breakpoints)
      if(time > start && time < end)
        ends.push_back(time);
    std::ranges::sort(ends);
    sums.assign(ends.size(), 0);
    for(std::size_t i = 1; i < ends.size(); ++i)
    {
      const Heat heat = heat_between(power, ends[i - 1], ends[i]);
      sums[i] = sums[i - 1] + heat.net;
      all += heat.gross;
    }
  }

  double HeatOverTime::operator()(double time) const
  {
    const auto next = std::ranges::lower_bound(ends, time);
    if(next == ends.begin())
      return 0;
    const auto last = static_cast<std::size_t>(next - ends.begin()) - 1;
    return sums[last] + heat_between(power, ends[last], time).net;
  }

  GivenHeat::GivenHeat(const cases::Scene &scene)
    : scene(scene)
  {
    add_walls();
    add_release();
    for(const cases::PointSource &source : scene.sources)
      gross_of_points
          += HeatOverTime(source.power, scene.start_time, scene.end_time, {}).gross();
  }

  /** One point stands for all where a field is the same everywhere. */
  std::vector<QuadraturePoint> GivenHeat::points_for(
      const cases::Field &field, double measure,
      const std::function<std::vector<QuadraturePoint>(int divisions)> &points) const
  {
    if(field.constant)
      return {{{}, measure}};
    return resolving_points(points, field, scene.start_time, scene.end_time);
  }

  void GivenHeat::add_walls()
  {
    using cases::BoundaryKind;
    // Points see where a wall's data jump to within their distance only, their means all.
    const cases::Scene seen = cases::with_means_of_jumps(
        scene, [&](cases::Side) { return point_distance_on_walls(scene.domain); });
    // What is displaced carries heat through a wall.
    if(scene.material.solid.density != scene.material.liquid.density)
      unknown_walls = "liquid that is displaced carries heat through walls";
    for(const cases::Side side : scene.sides())
    {
      const cases::Boundary &boundary = seen.boundary(side);
      if(boundary.kind == BoundaryKind::insulated
         || boundary.kind == BoundaryKind::periodic)
        continue;
      if(boundary.kind != BoundaryKind::flux)
      {
        unknown_walls = fmt::format("the heat through {} depends on the solution",
                                    name_of(scene.domain, side));
        return;
      }
      walls_vary |= !boundary.value.constant;
      const std::vector<QuadraturePoint> points = points_for(
          boundary.value, area_of(scene.domain, side),
          [&](int divisions) { return points_on(scene.domain, side, divisions); });
      if(points.empty())
      {
        unknown_walls
            = fmt::format("no quadrature for a flux that varies as it does along {}",
                          name_of(scene.domain, side));
        return;
      }
      walls.emplace_back([flux = boundary.value, points](double time)
                         { return integral(points, flux, time); },
                         scene.start_time, scene.end_time, boundary.value.breakpoints);
    }
  }

  void GivenHeat::add_release()
  {
    if(!scene.volumetric_source)
      return;
    const cases::Field release
        = cases::mean_release(scene, point_distance_over(scene.domain));
    sources_vary = !release.constant;
    const std::vector<QuadraturePoint> points
        = points_for(release, volume_of(scene.domain),
                     [&](int divisions) { return points_over(scene.domain, divisions); });
    if(points.empty())
    {
      unknown_sources
          = "no quadrature for a release that varies as it does in this domain";
      return;
    }
    released.emplace([release, points](double time)
                     { return integral(points, release, time); },
                     scene.start_time, scene.end_time, release.breakpoints);
  }

  double GivenHeat::through_walls(double time) const
  {
    double sum = 0;
    for(const HeatOverTime &wall : walls)
      sum += wall(time);
    return sum;
  }

  double GivenHeat::from_sources(double time) const
  {
    double sum = released ? (*released)(time) : 0;
    for(const cases::PointSource &source : scene.sources)
      sum += source.energy(time);
    return sum;
  }

  double GivenHeat::gross_walls() const
  {
    double sum = 0;
    for(const HeatOverTime &wall : walls)
      sum += wall.gross();
    return sum;
  }

  double GivenHeat::gross_sources() const
  {
    return gross_of_points + (released ? released->gross() : 0);
  }
} // namespace meltfront::verification
