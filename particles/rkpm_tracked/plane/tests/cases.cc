#include "cases.h"

#include <cases/effects.h>
#include <cases/exact/frank.h>
#include <cases/exact/line_sink.h>
#include <particles/rkpm_tracked/plane/run.h>
#include <particles/rkpm_tracked/rkpm_tracked.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    using cases::Position;

    /** A disk, or an annulus, whose rims follow the solution that it starts from. */
    cases::Scene round_scene(const cases::Material &material, double inner_radius,
                             const ExactPointer &exact)
    {
      cases::Scene scene = ball(material, 2, 1, 0, 1);
      set_boundary(scene, cases::Side::outer, exact_wall(exact));
      if(inner_radius > 0)
      {
        scene.domain.shape = cases::DomainShape::shell;
        scene.domain.inner_radius = inner_radius;
        set_boundary(scene, cases::Side::inner, exact_wall(exact));
      }
      start_from(scene, exact);
      return scene;
    }
  } // namespace

  cases::Scene line_sink_annulus()
  {
    cases::Material material;
    material.solid.conductivity = 2;
    const auto exact = std::make_shared<cases::LineSink>(material, 0.4206, 0.5);
    cases::Scene scene = round_scene(material, 0.2, exact);
    const double unit = exact->front(1);
    scene.start_time = 0.16 / (unit * unit);
    scene.end_time = 0.36 / (unit * unit);
    return scene;
  }

  cases::Scene frank_disk(double end_time)
  {
    const cases::Material material;
    const auto exact = std::make_shared<cases::FrankGrowth>(
        material, cases::Symmetry::cylindrical, -0.335221361207848338);
    cases::Scene scene = round_scene(material, 0, exact);
    scene.start_time = 0.04;
    scene.end_time = end_time;
    return scene;
  }

  cases::Scene insulated_box(const Position &upper, const PlaneFunction &front,
                             const PlaneFunction &temperature, double end_time)
  {
    cases::Scene scene = box({}, 2, {-upper[0], -upper[1], 0}, upper, 0, end_time);
    scene.initial.front = field_of(front);
    scene.initial.temperature = field_of(temperature);
    return scene;
  }

  cases::Scene merging_disks(double end_time)
  {
    constexpr double place = 0.36, radius = 0.15;
    const auto left = [](const Position &p) { return std::hypot(p[0] + place, p[1]); };
    const auto right = [](const Position &p) { return std::hypot(p[0] - place, p[1]); };
    const auto front
        = [=](const Position &p) { return std::min(left(p), right(p)) - radius; };
    const auto temperature = [=](const Position &p)
    {
      const double nearer = std::min(left(p), right(p));
      if(nearer < radius)
        return std::log(std::max(nearer, 1e-12) / radius) / std::numbers::pi;
      const auto far
          = [=](double r) { return 1 - std::exp((radius * radius - r * r) / 0.04); };
      return 0.1 * far(left(p)) * far(right(p));
    };
    cases::Scene scene = insulated_box({1, 0.5, 0}, front, temperature, end_time);
    for(const double x : {-place, place})
      scene.sources.push_back(steady_sink({x, 0, 0}, 2));
    return scene;
  }

  void PlaneRecord::observe(const cases::Snapshot &snapshot)
  {
    Frame frame{};
    frame.time = snapshot.time;
    frame.defect = snapshot.heat.defect();
    frame.latent = snapshot.heat.latent;
    frame.sensible = snapshot.heat.stored;
    frame.through_walls = snapshot.heat.boundary;
    frame.vanished = snapshot.vanished_volume;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
      frame.solid_area += snapshot.weights[i] * snapshot.solid_fraction[i];
    const auto [coldest, hottest] = std::ranges::minmax(snapshot.temperature);
    frame.coldest = coldest;
    frame.hottest = hottest;
    frame.front_points = snapshot.front[0].size();
    double least = 1e300, largest = 0, sum = 0;
    for(std::size_t p = 0; p < frame.front_points; ++p)
    {
      const double radius = std::hypot(snapshot.front[0][p], snapshot.front[1][p]);
      least = std::min(least, radius);
      largest = std::max(largest, radius);
      sum += radius;
    }
    frame.mean_radius = sum / static_cast<double>(frame.front_points);
    frame.roundness = (largest - least) / frame.mean_radius;
    frames.push_back(frame);
    for(int d = 0; d < 2; ++d)
      front[d].assign(snapshot.front[d].begin(), snapshot.front[d].end());
    temperature.assign(snapshot.temperature.begin(), snapshot.temperature.end());
  }

  void PlaneRecord::note(double, const std::string &event)
  {
    notes.push_back(event);
  }

  PlaneRecord run_plane(const cases::Scene &scene, int n, const OptionTexts &options,
                        int threads)
  {
    const auto method = make_rkpm_tracked();
    OptionTexts all{{"dimension", "2"}};
    all.insert(all.end(), options.begin(), options.end());
    PlaneRecord record;
    record.cost = solve(*method, scene, resolution_of(*method, n, all, threads), record);
    return record;
  }

  PlaneFront circle(double radius, int points, const PlanePoint &centre)
  {
    std::vector<PlanePoint> places;
    for(int i = 0; i < points; ++i)
    {
      const double phi = 2 * std::numbers::pi * i / points;
      places.push_back(centre + radius * PlanePoint(std::cos(phi), std::sin(phi)));
    }
    PlaneFront front;
    front.add_curve(places);
    return front;
  }
} // namespace meltfront::particles::rkpm_tracked
