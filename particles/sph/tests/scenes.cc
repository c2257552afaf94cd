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

  Scene unit_box(int dimension, const Material &material, double temperature,
                 double end_time)
  {
    Position corner{};
    for(int d = 0; d < dimension; ++d)
      corner[d] = 0.5;
    return box(material, dimension, {-corner[0], -corner[1], -corner[2]}, corner,
               temperature, end_time);
  }

  Problem freezing_slab(const Material &material, double wall_temperature,
                        double initial_temperature, double length, double end_time)
  {
    const auto exact = std::make_shared<PlanarNeumann>(material, wall_temperature,
                                                       initial_temperature);
    return {slab(material, length, initial_temperature, end_time,
                 fixed_wall(wall_temperature), exact_wall(exact)),
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
    scene.sources = {steady_sink({}, exact->strength())};
    return {scene, exact};
  }

  namespace
  {
    Scene ball_about(const PointSource &sink, int dimension, const ExactPointer &exact)
    {
      Scene scene = ball(water(), dimension, 0.5, 10, 475000);
      set_boundary(scene, Side::outer, exact_wall(exact));
      scene.sources = {sink};
      return scene;
    }
  } // namespace

  Problem line_sink_in_disk()
  {
    const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
    const Problem in_square = line_sink();
    return {ball_about(in_square.scene.sources[0], 2, exact), exact};
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
    return {ball_about({{},
                        "-Q(t)",
                        [exact](double time) { return -exact->strength(time); },
                        [exact](double time) { return -exact->energy(time); }},
                       3, exact),
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
    Outcome outcome;
    Watcher watcher(problem, outcome);
    outcome.cost = solve(method, problem.scene,
                         resolution_of(method, n, options, threads, seed), watcher);
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
} // namespace meltfront::particles::testing
