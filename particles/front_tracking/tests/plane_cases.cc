#include "plane_cases.h"

#include <cases/effects.h>
#include <cases/exact/frank.h>
#include <cases/exact/line_sink.h>
#include <particles/front_tracking/plane_run.h>
#include <particles/front_tracking/rkpm_tracked.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles::front_tracking
{
  namespace
  {
    using cases::Position;

    cases::Field field_of(const PlaneFunction &function)
    {
      return {"given", [function](const Position &p, double) { return function(p); }};
    }

    void start_from(cases::Scene &scene,
                    const std::shared_ptr<const cases::ExactSolution> &exact)
    {
      scene.initial.exact = exact;
      scene.initial.temperature = {"exact", [exact](const Position &p, double t)
                                   { return exact->temperature(p, t); }};
      cases::Boundary rim;
      rim.kind = cases::BoundaryKind::fixed_temperature;
      rim.exact = true;
      rim.value = scene.initial.temperature;
      scene.boundaries[static_cast<std::size_t>(cases::Side::outer)] = rim;
      if(scene.domain.shape == cases::DomainShape::shell)
        scene.boundaries[static_cast<std::size_t>(cases::Side::inner)] = rim;
    }
  } // namespace

  cases::Scene line_sink_annulus()
  {
    cases::Scene scene;
    scene.name = "line-sink-annulus";
    scene.symmetry = cases::Symmetry::cylindrical;
    scene.domain.shape = cases::DomainShape::shell;
    scene.domain.dimension = 2;
    scene.domain.radius = 1;
    scene.domain.inner_radius = 0.2;
    scene.material.solid.conductivity = 2;
    const auto exact = std::make_shared<cases::LineSink>(scene.material, 0.4206, 0.5);
    const double unit = exact->front(1);
    scene.start_time = 0.16 / (unit * unit);
    scene.end_time = 0.36 / (unit * unit);
    start_from(scene, exact);
    return scene;
  }

  cases::Scene frank_disk(double end_time)
  {
    cases::Scene scene;
    scene.name = "frank-disk";
    scene.symmetry = cases::Symmetry::cylindrical;
    scene.domain.shape = cases::DomainShape::ball;
    scene.domain.dimension = 2;
    scene.domain.radius = 1;
    const auto exact = std::make_shared<cases::FrankGrowth>(
        scene.material, cases::Symmetry::cylindrical, -0.335221361207848338);
    scene.start_time = 0.04;
    scene.end_time = end_time;
    start_from(scene, exact);
    return scene;
  }

  cases::Scene insulated_box(const Position &upper, const PlaneFunction &front,
                             const PlaneFunction &temperature, double end_time)
  {
    cases::Scene scene;
    scene.name = "box";
    scene.symmetry = cases::Symmetry::none;
    scene.domain.shape = cases::DomainShape::box;
    scene.domain.dimension = 2;
    scene.domain.upper = upper;
    scene.domain.lower = {-upper[0], -upper[1], 0};
    scene.end_time = end_time;
    scene.initial.front = field_of(front);
    scene.initial.temperature = field_of(temperature);
    using cases::Side;
    for(const Side side : {Side::x_min, Side::x_max, Side::y_min, Side::y_max})
      scene.boundaries[static_cast<std::size_t>(side)] = cases::Boundary{};
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
    {
      cases::PointSource sink;
      sink.position = {x, 0, 0};
      sink.power = [](double) { return -2.; };
      sink.energy = [](double time) { return -2 * time; };
      scene.sources.push_back(sink);
    }
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
    cases::Resolution resolution;
    resolution.n = n;
    resolution.threads = threads;
    resolution.options = cases::Options(method->option_declarations());
    resolution.options.set("dimension", "2");
    for(const auto &[key, value] : options)
      resolution.options.set(key, value);
    PlaneRecord record;
    record.cost
        = method->solve(scene, cases::effects_called_for(scene), resolution, record);
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
} // namespace meltfront::particles::front_tracking
