#include <reference_fem/enthalpy/tests/support.h>

#include <reference_fem/enthalpy/enthalpy.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::tests
{
  using namespace cases;

  Material normalised_material()
  {
    Material material;
    material.melting_temperature = 1;
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

  Boundary fixed_wall(double temperature)
  {
    return {BoundaryKind::fixed_temperature, Field::uniform(temperature), false};
  }

  Boundary varying_wall(std::function<double(double)> temperature)
  {
    return {BoundaryKind::fixed_temperature,
            {"varying",
             [temperature](const Position &, double time) { return temperature(time); },
             false},
            false};
  }

  Boundary exact_wall(const ExactPointer &exact)
  {
    return {BoundaryKind::fixed_temperature,
            {"exact",
             [exact](const Position &p, double time)
             { return exact->temperature(p, time); },
             false},
            true};
  }

  Boundary flux_wall(double flux)
  {
    return {BoundaryKind::flux, Field::uniform(flux), false};
  }

  namespace
  {
    Scene uniform_scene(const Material &material, double temperature, double start,
                        double end)
    {
      Scene scene;
      scene.name = "test";
      scene.material = material;
      scene.initial.temperature = Field::uniform(temperature);
      scene.start_time = start;
      scene.end_time = end;
      return scene;
    }
  } // namespace

  Scene slab(const Material &material, double length, double temperature, double start,
             double end)
  {
    Scene scene = uniform_scene(material, temperature, start, end);
    scene.symmetry = Symmetry::planar;
    scene.domain.upper = {length, 0, 0};
    set_boundary(scene, Side::x_min, {});
    set_boundary(scene, Side::x_max, {});
    return scene;
  }

  Scene ball(const Material &material, int dimension, double radius, double temperature,
             double end)
  {
    Scene scene = uniform_scene(material, temperature, 0, end);
    scene.symmetry = dimension == 2 ? Symmetry::cylindrical : Symmetry::spherical;
    scene.domain = {DomainShape::ball, dimension, {}, {}, radius};
    set_boundary(scene, Side::outer, {});
    return scene;
  }

  Scene box(const Material &material, int dimension, const Position &lower,
            const Position &upper, double temperature, double end)
  {
    Scene scene = uniform_scene(material, temperature, 0, end);
    scene.domain = {DomainShape::box, dimension, lower, upper, 0};
    for(int side = 0; side < 2 * dimension; ++side)
      set_boundary(scene, static_cast<Side>(side), {});
    return scene;
  }

  void set_boundary(Scene &scene, Side side, const Boundary &boundary)
  {
    scene.boundaries[static_cast<std::size_t>(side)] = boundary;
  }

  void start_from(Scene &scene, const ExactPointer &exact)
  {
    scene.initial.exact = exact;
    scene.initial.temperature = {"exact",
                                 [exact](const Position &p, double time)
                                 { return exact->temperature(p, time); },
                                 false};
    for(auto &boundary : scene.boundaries)
      if(boundary && boundary->kind == BoundaryKind::fixed_temperature)
        boundary = exact_wall(exact);
  }

  namespace
  {
    class Recorder : public Observer
    {
    public:
      Recorder(const Scene &scene, const ExactSolution *exact, RunRecord &record)
        : scene(scene)
        , exact(exact)
        , record(record)
      {
      }

      void begin(const RunDescription &description) override
      {
        record.description = description;
      }

      bool wants(long, double) override
      {
        return true;
      }

      void observe(const Snapshot &snapshot) override
      {
        double solid = 0;
        for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
          solid += snapshot.weights[i] * snapshot.solid_fraction[i];
        record.time.push_back(snapshot.time);
        const double hollow
            = volume_between(scene.symmetry, 0, scene.domain.inner_radius);
        record.front.push_back(enclosing_coordinate(scene.symmetry, hollow + solid));
        record.front_exact.push_back(exact ? exact->front(snapshot.time) : 0);
        record.budget_defect.push_back(snapshot.heat.defect());
        const auto [low, high] = std::minmax_element(snapshot.temperature.begin(),
                                                     snapshot.temperature.end());
        record.lowest.push_back(*low);
        record.highest.push_back(*high);
        record.heat = snapshot.heat;
        record.mass = snapshot.mass;
        record.solute = snapshot.solute;
        for(const SubstanceBudget &budget : snapshot.solute)
          record.worst_solute_defect
              = std::max(record.worst_solute_defect, budget.defect());
        if(snapshot.time == scene.end_time)
          keep_state(snapshot);
      }

    private:
      void keep_state(const Snapshot &snapshot)
      {
        record.temperature.assign(snapshot.temperature.begin(),
                                  snapshot.temperature.end());
        record.solid_fraction.assign(snapshot.solid_fraction.begin(),
                                     snapshot.solid_fraction.end());
        record.weights.assign(snapshot.weights.begin(), snapshot.weights.end());
        for(std::size_t s = 0; s < most_solutes; ++s)
          record.concentration[s].assign(snapshot.concentration[s].begin(),
                                         snapshot.concentration[s].end());
        record.cells.assign(snapshot.cells.begin(), snapshot.cells.end());
        for(int d = 0; d < 3; ++d)
          record.positions[d].assign(snapshot.positions[d].begin(),
                                     snapshot.positions[d].end());
        if(!exact)
          return;
        double error = 0, norm = 0;
        for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
        {
          Position p{};
          for(int d = 0; d < snapshot.dimension; ++d)
            p[d] = snapshot.positions[d][i];
          // The temperature of a sink is infinite at the sink itself.
          if(coordinate(exact->symmetry(), p) == 0
             && exact->symmetry() != Symmetry::planar)
            continue;
          const double value = exact->temperature(p, snapshot.time);
          const double excess = value - scene.material.melting_temperature;
          error += snapshot.weights[i] * std::pow(snapshot.temperature[i] - value, 2);
          norm += snapshot.weights[i] * excess * excess;
        }
        record.temperature_error = std::sqrt(error / norm);
      }

      const Scene &scene;
      const ExactSolution *exact;
      RunRecord &record;
    };
  } // namespace

  double RunRecord::worst_budget_defect() const
  {
    return *std::max_element(budget_defect.begin(), budget_defect.end());
  }

  double RunRecord::worst_front_error(double after) const
  {
    double worst = 0;
    for(std::size_t i = 0; i < time.size(); ++i)
      if(time[i] >= after)
        worst = std::max(worst, std::abs(front[i] - front_exact[i]));
    return worst / front_exact.back();
  }

  double RunRecord::final_front_error() const
  {
    return std::abs(front.back() / front_exact.back() - 1);
  }

  RunRecord run(const Scene &scene, int n, const OptionTexts &options,
                const ExactSolution *exact)
  {
    RunRecord record;
    const EffectSet effects = effects_called_for(scene);
    const Scene simulated = simulated_scene(scene, effects);
    Resolution resolution;
    resolution.n = n;
    resolution.options = Options(make_fem_enthalpy()->option_declarations());
    for(const auto &[key, text] : options)
      if(key == "threads")
        resolution.threads = std::stoi(text);
      else
        resolution.options.set(key, text);
    Recorder recorder(scene, exact, record);
    const Stopwatch watch;
    EnthalpyRun solver(simulated, effects, resolution);
    record.cost = solver.carry_out(simulated, watch, recorder);
    record.statistics = solver.worst_of_steps();
    return record;
  }

  double fitted_order(const std::vector<int> &n, const std::vector<double> &errors)
  {
    double x = 0, y = 0, xx = 0, xy = 0;
    const double count = static_cast<double>(n.size());
    for(std::size_t i = 0; i < n.size(); ++i)
    {
      const double log_h = -std::log(n[i]), log_error = std::log(errors[i]);
      x += log_h;
      y += log_error;
      xx += log_h * log_h;
      xy += log_h * log_error;
    }
    return (count * xy - x * y) / (count * xx - x * x);
  }
} // namespace meltfront::reference_fem::tests
