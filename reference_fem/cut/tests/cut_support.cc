#include <reference_fem/cut/tests/cut_support.h>

#include <reference_fem/cut/cut.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::tests
{
  using namespace cases;

  double moment_of_solid(const Course &course)
  {
    double moment = 0;
    for(std::size_t i = 0; i < course.weights.size(); ++i)
      moment += course.weights[i] * course.solid_fraction[i]
                * (course.positions[0][i] + 2 * course.positions[1][i]);
    return moment;
  }

  bool grows(const Course &course)
  {
    return std::ranges::is_sorted(course.solid);
  }

  Course run_cut(const Scene &scene, int n, const OptionTexts &options)
  {
    OptionTexts given{{"scheme", "extension"}};
    given.insert(given.end(), options.begin(), options.end());
    return course_of(*make_fem_cut(), scene, n, given);
  }

  Scene sink_in_disk(const std::shared_ptr<const LineSink> &exact)
  {
    Scene scene = ball(water(), 2, 0.5, 10, end_of_sink);
    set_boundary(scene, Side::outer, exact_wall(exact));
    scene.sources.push_back(steady_sink({}, exact->strength()));
    return scene;
  }

  double front_error(const Course &course, const LineSink &exact)
  {
    double sum = 0;
    for(std::size_t i = 1; i < course.time.size(); ++i)
      sum += std::pow(
          std::sqrt(course.solid[i] / std::numbers::pi) - exact.front(course.time[i]), 2);
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
      scene.sources.push_back(steady_sink(place, 2));
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
