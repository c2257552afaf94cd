#include <cases/exact/line_sink.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/point_sink.h>
#include <particles/sph/discretisation.h>
#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::testing
{
  using namespace cases;

  Material unit_material(double melting_temperature)
  {
    Material material;
    material.melting_temperature = melting_temperature;
    return material;
  }

  Material water()
  {
    Material material;
    material.solid = {2.2, 2090, 1000};
    material.liquid = {0.591, 4190, 1000};
    material.latent_heat = 333500;
    return material;
  }

  Boundary insulated()
  {
    return {};
  }

  Boundary periodic()
  {
    return {BoundaryKind::periodic, {}, false};
  }

  Boundary fixed(double temperature)
  {
    return {BoundaryKind::fixed_temperature, Field::uniform(temperature), false};
  }

  Boundary exact_wall(std::shared_ptr<const ExactSolution> exact)
  {
    return {BoundaryKind::fixed_temperature,
            {"exact",
             [exact](const Position &p, double t) { return exact->temperature(p, t); },
             false},
            true};
  }

  Boundary flux(double value)
  {
    return {BoundaryKind::flux, Field::uniform(value), false};
  }

  Scene slab(const Material &material, double length, double temperature, double end_time,
             const Boundary &left, const Boundary &right)
  {
    Scene scene;
    scene.symmetry = Symmetry::planar;
    scene.domain = {DomainShape::slab, 1, {}, {length, 0, 0}, 0};
    scene.material = material;
    scene.initial.temperature = Field::uniform(temperature);
    scene.boundaries[0] = left;
    scene.boundaries[1] = right;
    scene.end_time = end_time;
    return scene;
  }

  Scene unit_box(int dimension, const Material &material, double temperature,
                 double end_time)
  {
    Scene scene;
    scene.domain.shape = DomainShape::box;
    scene.domain.dimension = dimension;
    for(int d = 0; d < dimension; ++d)
    {
      scene.domain.lower[d] = -0.5;
      scene.domain.upper[d] = 0.5;
      scene.boundaries[2 * d] = scene.boundaries[2 * d + 1] = insulated();
    }
    scene.material = material;
    scene.initial.temperature = Field::uniform(temperature);
    scene.end_time = end_time;
    return scene;
  }

  Problem freezing_slab(const Material &material, double wall_temperature,
                        double initial_temperature, double length, double end_time)
  {
    const auto exact = std::make_shared<PlanarNeumann>(material, wall_temperature,
                                                       initial_temperature);
    return {slab(material, length, initial_temperature, end_time, fixed(wall_temperature),
                 exact_wall(exact)),
            exact};
  }

  Problem plane_freezing()
  {
    return freezing_slab(unit_material(1), 0.190602422788870409, 1.2, 1, 0.0568);
  }

  Problem plane_freezing_water()
  {
    return freezing_slab(water(), -10, 10, 1, 86400);
  }

  Problem plane_contrast()
  {
    Material material = unit_material();
    material.liquid = {0.1, 2, 1};
    return freezing_slab(material, -1, 0.5, 1, 0.1);
  }

  Problem line_sink(double end_time)
  {
    const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
    Scene scene = unit_box(2, water(), 10, end_time);
    scene.symmetry = Symmetry::cylindrical;
    const double strength = exact->strength();
    scene.sources = {{{},
                      "-Q",
                      [strength](double) { return -strength; },
                      [strength](double time) { return -strength * time; }}};
    return {scene, exact};
  }

  namespace
  {
    Scene ball(int dimension, const std::shared_ptr<const ExactSolution> &exact,
               const PointSource &sink)
    {
      Scene scene;
      scene.symmetry = exact->symmetry();
      scene.domain.shape = DomainShape::ball;
      scene.domain.dimension = dimension;
      scene.domain.radius = 0.5;
      scene.material = water();
      scene.initial.temperature = Field::uniform(10);
      scene.boundaries[static_cast<std::size_t>(Side::outer)] = exact_wall(exact);
      scene.sources = {sink};
      scene.end_time = 475000;
      return scene;
    }
  } // namespace

  Problem line_sink_in_disk()
  {
    const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
    const Problem in_square = line_sink();
    return {ball(2, exact, in_square.scene.sources[0]), exact};
  }

  Problem line_sink_in_annulus()
  {
    Material material = unit_material();
    material.solid.conductivity = 2;
    const auto exact = std::make_shared<LineSink>(material, 0.4206, 0.5);
    Scene scene;
    scene.symmetry = Symmetry::cylindrical;
    scene.domain = {DomainShape::shell, 2, {}, {}, 1, 0.2};
    scene.material = material;
    scene.initial.temperature = exact_wall(exact).value;
    scene.initial.exact = exact;
    for(const Side side : {Side::inner, Side::outer})
      scene.boundaries[static_cast<std::size_t>(side)] = exact_wall(exact);
    scene.start_time = 0.11305544;
    scene.end_time = 0.25437474;
    return {scene, exact};
  }

  Problem point_sink_in_ball()
  {
    const auto exact = std::make_shared<PointSink>(water(), 0.15, 10);
    return {ball(3, exact,
                 {{},
                  "-Q(t)",
                  [exact](double time) { return -exact->strength(time); },
                  [exact](double time) { return -exact->energy(time); }}),
            exact};
  }

  namespace
  {
    /** Root mean square of what is added. */
    class MeanSquare
    {
    public:
      void add(double value)
      {
        sum += value * value;
        ++count;
      }

      double root() const
      {
        return count > 0 ? std::sqrt(sum / count) : 0;
      }

    private:
      double sum = 0;
      long count = 0;
    };

    class Watcher : public Observer
    {
    public:
      Watcher(const Problem &problem, Outcome &outcome)
        : problem(problem)
        , outcome(outcome)
      {
      }

      void begin(const RunDescription &description) override
      {
        outcome.description = description;
      }

      bool wants(long, double) override
      {
        return true;
      }

      void observe(const Snapshot &snapshot) override
      {
        const Symmetry symmetry = problem.scene.symmetry;
        const RoundWall hole{nullptr, problem.scene.domain.inner_radius, true};
        double solid = hole.enclosed(snapshot.dimension), ice_radius = 0,
               heat_loss_radius = 0;
        outcome.distance.clear();
        for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
        {
          Position p{};
          for(int d = 0; d < snapshot.dimension; ++d)
            p[d] = snapshot.positions[d][i];
          const double r = coordinate(symmetry, p);
          outcome.distance.push_back(std::hypot(p[0], p[1], p[2]));
          const double fraction = snapshot.solid_fraction[i];
          solid += snapshot.weights[i] * fraction;
          if(fraction == 1)
            ice_radius = std::max(ice_radius, r);
          if(fraction > 0.25)
            heat_loss_radius = std::max(heat_loss_radius, r);
        }
        const double front = enclosing_coordinate(symmetry, solid);
        if(snapshot.step > 0)
        {
          outcome.steepest_retreat
              = std::max(outcome.steepest_retreat, outcome.front_end - front);
          if(problem.exact)
            compare(problem.exact->front(snapshot.time), front, ice_radius,
                    heat_loss_radius);
          outcome.fronts.push_back(front);
        }
        outcome.front_end = front;
        outcome.largest_defect = std::max(outcome.largest_defect, snapshot.heat.defect());
        const auto [low, high] = std::minmax_element(snapshot.temperature.begin(),
                                                     snapshot.temperature.end());
        outcome.lowest = snapshot.step > 0 ? std::min(outcome.lowest, *low) : *low;
        outcome.highest = snapshot.step > 0 ? std::max(outcome.highest, *high) : *high;
        const auto &x = snapshot.positions[0];
        outcome.position_x.assign(x.begin(), x.end());
        outcome.weights.assign(snapshot.weights.begin(), snapshot.weights.end());
        outcome.temperature.assign(snapshot.temperature.begin(),
                                   snapshot.temperature.end());
        outcome.solid_fraction.assign(snapshot.solid_fraction.begin(),
                                      snapshot.solid_fraction.end());
        outcome.heat = snapshot.heat;
      }

      void finish() const
      {
        outcome.front_rms = by_latent_heat.root();
        outcome.ice_radius_rms = by_ice_radius.root();
        outcome.heat_loss_rms = by_heat_loss.root();
      }

    private:
      void compare(double exact, double front, double ice_radius, double heat_loss_radius)
      {
        by_latent_heat.add(front - exact);
        // The paper's estimates exist once there is ice.
        if(ice_radius > 0)
        {
          by_ice_radius.add(ice_radius + 0.5 * outcome.description.smoothing_length
                            - exact);
          by_heat_loss.add(heat_loss_radius - exact);
        }
      }

      const Problem &problem;
      Outcome &outcome;
      MeanSquare by_latent_heat, by_ice_radius, by_heat_loss;
    };
  } // namespace

  Outcome run(const Method &method, const Problem &problem, int n,
              const OptionTexts &options, std::uint64_t seed, int threads)
  {
    Resolution resolution;
    resolution.n = n;
    resolution.seed = seed;
    resolution.threads = threads;
    resolution.options = Options(method.option_declarations());
    for(const auto &[key, text] : options)
      resolution.options.set(key, text);
    const EffectSet effects = effects_called_for(problem.scene);
    const Scene scene = simulated_scene(problem.scene, effects);
    Outcome outcome;
    Watcher watcher(problem, outcome);
    outcome.cost = method.solve(scene, effects, resolution, watcher);
    watcher.finish();
    return outcome;
  }

  Convergence converge(const Method &method, const Problem &problem,
                       const std::vector<int> &n, const OptionTexts &options)
  {
    Convergence result;
    std::vector<double> spacing;
    for(const int level : n)
    {
      const Outcome outcome = run(method, problem, level, options);
      spacing.push_back(outcome.description.spacing);
      result.errors.push_back(outcome.front_rms);
    }
    result.order = fitted_order(spacing, result.errors);
    return result;
  }

  double fitted_order(const std::vector<double> &spacing,
                      const std::vector<double> &errors)
  {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for(std::size_t i = 0; i < spacing.size(); ++i)
    {
      const double x = std::log(spacing[i]), y = std::log(errors[i]);
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
    const double count = spacing.size();
    return (count * sxy - sx * sy) / (count * sxx - sx * sx);
  }
} // namespace meltfront::particles::testing
