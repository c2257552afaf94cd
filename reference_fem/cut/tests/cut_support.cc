#include <reference_fem/cut/tests/cut_support.h>

#include <reference_fem/cut/cut.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::tests
{
  using namespace cases;

  void Course::observe(const Snapshot &snapshot)
  {
    double solid = 0, moment = 0;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
    {
      const double part = snapshot.weights[i] * snapshot.solid_fraction[i];
      solid += part;
      moment += part * (snapshot.positions[0][i] + 2 * snapshot.positions[1][i]);
    }
    time.push_back(snapshot.time);
    area.push_back(solid);
    last_moment = moment;
    defect = snapshot.heat.defect();
    heat = snapshot.heat;
  }

  bool Course::monotone() const
  {
    return std::is_sorted(area.begin(), area.end());
  }

  Course run_cut(const Scene &scene, int n,
                 const std::map<std::string, std::string> &options)
  {
    const auto method = make_fem_cut();
    const EffectSet effects = effects_called_for(scene);
    const Scene simulated = simulated_scene(scene, effects);
    Resolution resolution;
    resolution.n = n;
    resolution.options = Options(method->option_declarations());
    for(const auto &[key, text] : options)
      resolution.options.set(key, text);
    Course course;
    course.cost = method->solve(simulated, effects, resolution, course);
    return course;
  }

  PointSource sink(double x, double y, double strength)
  {
    return {{x, y, 0},
            "constant",
            [strength](double) { return -strength; },
            [strength](double time) { return -strength * time; }};
  }

  Scene sink_in_disk(const std::shared_ptr<const LineSink> &exact)
  {
    Scene scene = ball(water(), 2, 0.5, 10, end_of_sink);
    set_boundary(scene, Side::outer, exact_wall(exact));
    scene.sources.push_back(sink(0, 0, exact->strength()));
    return scene;
  }

  double front_error(const Course &course, const LineSink &exact)
  {
    double sum = 0;
    for(std::size_t i = 1; i < course.time.size(); ++i)
      sum += std::pow(
          std::sqrt(course.area[i] / std::numbers::pi) - exact.front(course.time[i]), 2);
    return std::sqrt(sum / static_cast<double>(course.time.size() - 1))
           / exact.front(end_of_sink);
  }

  Scene disks(const std::vector<Position> &places, double duration, const Position &lower,
              const Position &upper)
  {
    constexpr double radius = 0.15;
    Material material = normalised_material();
    material.melting_temperature = 0;
    Scene scene = box(material, 2, lower, upper, 0, duration);
    const auto nearest = [places](const Position &p)
    {
      double least = 1e300;
      for(const Position &place : places)
        least = std::min(least, std::hypot(p[0] - place[0], p[1] - place[1]));
      return least;
    };
    for(const Position &place : places)
      scene.sources.push_back(sink(place[0], place[1], 2));
    scene.initial.front = Field{
        "circles", [nearest](const Position &p, double) { return nearest(p) - radius; },
        false};
    scene.initial.temperature = {"logarithms",
                                 [nearest](const Position &p, double)
                                 {
                                   const double r = nearest(p);
                                   return r < radius
                                              ? std::log(r / radius) / std::numbers::pi
                                              : 0.1 * (1 - std::exp((radius - r) / 0.1));
                                 },
                                 false};
    return scene;
  }
} // namespace meltfront::reference_fem::tests
