#include <cases/tests/support/course.h>

#include <algorithm>
#include <cmath>

namespace meltfront::test_support
{
  using namespace cases;

  namespace
  {
    template <typename T>
    void keep(std::span<const T> from, std::vector<T> &to)
    {
      to.assign(from.begin(), from.end());
    }
  } // namespace

  void Course::observe(const Snapshot &snapshot)
  {
    double of_solid = 0, of_all = 0;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
    {
      of_solid += snapshot.weights[i] * snapshot.solid_fraction[i];
      of_all += snapshot.weights[i];
    }
    time.push_back(snapshot.time);
    step.push_back(snapshot.step);
    solid.push_back(of_solid);
    volume.push_back(of_all);
    first_front.push_back(snapshot.front[0].empty() ? -1 : snapshot.front[0][0]);
    budget_defect.push_back(snapshot.heat.defect());
    const auto [low, high] = std::ranges::minmax(snapshot.temperature);
    lowest.push_back(low);
    highest.push_back(high);
    for(std::size_t d = 0; d < 3; ++d)
    {
      keep(snapshot.positions[d], positions[d]);
      keep(snapshot.front[d], front_points[d]);
    }
    keep(snapshot.weights, weights);
    keep(snapshot.temperature, temperature);
    keep(snapshot.solid_fraction, solid_fraction);
    keep(snapshot.cells, cells);
    for(std::size_t s = 0; s < most_solutes; ++s)
      keep(snapshot.concentration[s], concentration[s]);
    heat = snapshot.heat;
    obeys_maximum_principle = snapshot.obeys_maximum_principle;
    mass = snapshot.mass;
    solute = snapshot.solute;
    for(const SubstanceBudget &budget : solute)
      worst_solute_defect = std::max(worst_solute_defect, budget.defect());
  }

  double Course::worst_budget_defect() const
  {
    return *std::ranges::max_element(budget_defect);
  }

  FrontCourse::FrontCourse(Course seen, const Scene &scene, const ExactSolution *exact,
                           double temperature_from)
    : Course(std::move(seen))
  {
    const bool solid_inside = !exact || exact->solid_at_origin();
    const double hollow = volume_between(scene.symmetry, 0, scene.domain.inner_radius);
    for(std::size_t k = 0; k < time.size(); ++k)
    {
      front.push_back(enclosing_coordinate(
          scene.symmetry, hollow + (solid_inside ? solid[k] : volume[k] - solid[k])));
      front_exact.push_back(exact ? exact->front(time[k]) : 0);
    }
    if(!exact)
      return;
    double error = 0, norm = 0;
    for(std::size_t i = 0; i < weights.size(); ++i)
    {
      // The temperature of a sink is infinite at the sink itself.
      const double from_origin = coordinate(exact->symmetry(), place(i));
      if(weights[i] == 0 || from_origin < temperature_from
         || (from_origin == 0 && exact->symmetry() != Symmetry::planar))
        continue;
      const double value = exact->temperature(place(i), time.back());
      error += weights[i] * std::pow(temperature[i] - value, 2);
      norm += weights[i] * std::pow(value - scene.material.melting_temperature, 2);
    }
    temperature_error = std::sqrt(error / norm);
  }

  double FrontCourse::worst_front_error(double after) const
  {
    double worst = 0;
    for(std::size_t i = 0; i < time.size(); ++i)
      if(time[i] >= after)
        worst = std::max(worst, std::abs(front[i] - front_exact[i]));
    return worst / front_exact.back();
  }

  double FrontCourse::final_front_error() const
  {
    return std::abs(front.back() / front_exact.back() - 1);
  }

  Resolution resolution_of(const Method &method, int n, const OptionTexts &options,
                           int threads, std::uint64_t seed)
  {
    Resolution resolution;
    resolution.n = n;
    resolution.threads = threads;
    resolution.seed = seed;
    resolution.options = Options(method.option_declarations());
    for(const auto &[key, text] : options)
      if(key == "threads")
        resolution.threads = std::stoi(text);
      else
        resolution.options.set(key, text);
    return resolution;
  }

  Cost solve(const Method &method, const Scene &scene, const Resolution &resolution,
             Observer &observer)
  {
    const EffectSet effects = effects_called_for(scene);
    return method.solve(simulated_scene(scene, effects), effects, resolution, observer);
  }

  Course course_of(const Method &method, const Scene &scene, int n,
                   const OptionTexts &options, int threads)
  {
    Course course;
    course.cost
        = solve(method, scene, resolution_of(method, n, options, threads), course);
    return course;
  }

  double fitted_order(const std::vector<double> &spacing,
                      const std::vector<double> &errors)
  {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for(std::size_t i = 0; i < spacing.size(); ++i)
    {
      const double x = std::log(spacing[i]), y = std::log(std::abs(errors[i]));
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
    const auto count = static_cast<double>(spacing.size());
    return (count * sxy - sx * sy) / (count * sxx - sx * sx);
  }

  double fitted_order(const std::vector<int> &n, const std::vector<double> &errors)
  {
    std::vector<double> spacing;
    for(const int level : n)
      spacing.push_back(1. / level);
    return fitted_order(spacing, errors);
  }
} // namespace meltfront::test_support
