#include <cases/dense_sampling.h>
#include <cases/error.h>
#include <cases/expression_words.h>
#include <cases/numbers.h>
#include <cases/scene.h>
#include <cases/temperature_slack.h>
#include <cases/wall_law.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace meltfront::cases
{
  Field Field::uniform(double value)
  {
    return {fmt::format("{}", value), [value](const Position &, double) { return value; },
            true};
  }

  double Domain::side() const
  {
    if(irregular())
      return reference_length;
    return round() ? 2 * radius : upper[0] - lower[0];
  }

  bool Domain::round() const
  {
    return shape == DomainShape::ball || shape == DomainShape::shell;
  }

  bool Domain::irregular() const
  {
    return shape == DomainShape::outline || shape == DomainShape::mesh;
  }

  bool Domain::rectangular() const
  {
    return shape == DomainShape::slab || shape == DomainShape::box
           || shape == DomainShape::axisymmetric;
  }

  const char *to_string(Side side)
  {
    constexpr const char *names[]
        = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max", "outer", "inner"};
    static_assert(std::size(names) == n_named_sides);
    return static_cast<std::size_t>(side) < n_named_sides
               ? names[static_cast<std::size_t>(side)]
               : "wall of a mesh";
  }

  std::string name_of(const Domain &domain, Side side)
  {
    return domain.mesh ? domain.mesh->walls()[index_of_mesh_wall(side)] : to_string(side);
  }

  const char *to_string(DomainShape shape)
  {
    constexpr const char *names[]
        = {"slab", "box", "ball", "shell", "outline", "axisymmetric", "mesh"};
    return names[static_cast<std::size_t>(shape)];
  }

  const char *to_string(BoundaryKind kind)
  {
    constexpr const char *names[] = {"insulated", "fixed temperature", "flux",
                                     "periodic",  "heat transfer",     "radiation"};
    static_assert(std::size(names) == n_boundary_kinds);
    return names[static_cast<std::size_t>(kind)];
  }

  const char *to_string(ProblemKind problem)
  {
    constexpr const char *names[]
        = {"stefan", "poisson", "interface advection", "particle solid"};
    return names[static_cast<std::size_t>(problem)];
  }

  const Boundary &Scene::boundary(Side side) const
  {
    const auto &found = boundaries[static_cast<std::size_t>(side)];
    if(!found)
      throw std::logic_error(fmt::format("the domain has no side {}", to_string(side)));
    return *found;
  }

  double Scene::conductivity_at(const Position &position) const
  {
    return inclusion && inclusion->contains(position) ? inclusion->conductivity
                                                      : material.solid.conductivity;
  }

  bool Scene::conducts_heat() const
  {
    return problem == ProblemKind::stefan || problem == ProblemKind::poisson;
  }

  bool Scene::changes_phase() const
  {
    return conducts_heat() && material.latent_heat > 0;
  }

  std::vector<Side> Scene::sides() const
  {
    std::vector<Side> result;
    for(std::size_t s = 0; s < n_sides; ++s)
      if(boundaries[s])
        result.push_back(static_cast<Side>(s));
    return result;
  }

  namespace
  {
    constexpr int samples_of_power = 257;

    void visit_power(const Scene &scene, const PointSource &source,
                     const ValueVisitor &visit)
    {
      double before = 0;
      for(int i = 0; i < samples_of_power; ++i)
      {
        const double time
            = scene.start_time
              + (scene.end_time - scene.start_time) * i / (samples_of_power - 1);
        visit(source.power(time));
        if(!source.energy)
          continue;
        // A pulse between the samples shows in the energy.
        const double energy = source.energy(time);
        if(i > 0)
          visit(energy - before);
        before = energy;
      }
    }
  } // namespace

  TemperatureBounds temperature_bounds(const Scene &scene)
  {
    // How cold or warm a curved front gets depends on how it bends.
    if(!scene.conducts_heat() || scene.material.gibbs_thomson_coefficient != 0)
      return {};
    double lower = infinity, upper = -infinity;
    const auto include = [&](double temperature)
    {
      lower = std::min(lower, temperature);
      upper = std::max(upper, temperature);
    };
    const auto widen = [&](double heat)
    {
      if(heat > 0)
        upper = infinity;
      if(heat < 0)
        lower = -infinity;
    };
    if(scene.problem != ProblemKind::poisson)
      visit_densely(scene, {&scene.initial.temperature},
                    [&](const Position &p)
                    { include(scene.initial.temperature(p, scene.start_time)); });
    // The front that grows into a metastable phase is at the melting point.
    if(metastable_initial_phase(scene) != nullptr)
      include(scene.material.melting_temperature);
    for(const Side side : scene.sides())
    {
      const Boundary &boundary = scene.boundary(side);
      if(boundary.kind == BoundaryKind::fixed_temperature
         || exchanges_heat(boundary.kind))
        visit_wall_values(scene, side, boundary.value, include);
    }
    for(const Side side : scene.sides())
      if(scene.boundary(side).kind == BoundaryKind::flux)
        visit_wall_values(scene, side, scene.boundary(side).value, widen);
    if(scene.volumetric_source)
      visit_release(scene, widen);
    for(const PointSource &source : scene.sources)
      visit_power(scene, source, widen);
    // Walls that vary are sampled; their extremes may fall between the samples.
    const bool varying
        = std::any_of(scene.boundaries.begin(), scene.boundaries.end(),
                      [](const auto &boundary)
                      {
                        return boundary
                               && (boundary->kind == BoundaryKind::fixed_temperature
                                   || exchanges_heat(boundary->kind))
                               && !boundary->value.constant;
                      });
    const double slack
        = varying && std::isfinite(upper - lower) ? 1e-3 * (upper - lower) : 0;
    if(lower > upper) // a steady scene whose walls prescribe no temperature
      return {};
    return {lower - slack, upper + slack};
  }

  MetastableStart metastable_start(const Scene &scene)
  {
    MetastableStart start;
    if(!scene.initial.front)
      return start;
    const double melting = scene.material.melting_temperature;
    double span = 0;
    visit_densely(scene, {&scene.initial.temperature, &*scene.initial.front},
                  [&](const Position &p)
                  {
                    const double excess
                        = scene.initial.temperature(p, scene.start_time) - melting;
                    const double distance = (*scene.initial.front)(p, scene.start_time);
                    if(std::isfinite(excess))
                      span = std::max(span, std::abs(excess));
                    if(distance > 0)
                      start.undercooling = std::max(start.undercooling, -excess);
                    if(distance < 0)
                      start.superheat = std::max(start.superheat, excess);
                  });
    const double round_off = 1e-9 * span;
    for(double *most : {&start.undercooling, &start.superheat})
      if(*most <= round_off)
        *most = 0;
    return start;
  }

  const char *metastable_initial_phase(const Scene &scene)
  {
    const MetastableStart start = metastable_start(scene);
    if(start.undercooling > 0)
      return "liquid is undercooled";
    return start.superheat > 0 ? "solid is superheated" : nullptr;
  }

  bool initially_present(const Scene &scene, std::size_t solute)
  {
    if(solute >= scene.initial.concentration.size())
      return false;
    const Field &concentration = scene.initial.concentration[solute];
    bool present = false;
    visit_densely(scene, {&concentration},
                  [&](const Position &p)
                  { present = present || concentration(p, scene.start_time) != 0; });
    return present;
  }

  void check_temperature(const TemperatureBounds &bounds, double lowest, double highest,
                         const std::string &method, long step, double time,
                         double tolerance)
  {
    if(!std::isfinite(lowest) || !std::isfinite(highest))
      throw NumericalError(method, step, time, "temperature", "is not finite");
    double span = bounds.upper - bounds.lower;
    if(!std::isfinite(span))
      span = std::max({std::isfinite(bounds.upper) ? std::abs(bounds.upper) : 0,
                       std::isfinite(bounds.lower) ? std::abs(bounds.lower) : 0,
                       highest - lowest});
    const double slack
        = tolerance * std::max(span, 1e-300) + temperature_round_off(bounds);
    if(lowest < bounds.lower - slack)
      throw NumericalError(
          method, step, time, "temperature",
          fmt::format("is {:.9g}, below the lowest initial and wall value {:.9g} "
                      "(maximum principle)",
                      lowest, bounds.lower));
    if(highest > bounds.upper + slack)
      throw NumericalError(
          method, step, time, "temperature",
          fmt::format("is {:.9g}, above the highest initial and wall value {:.9g} "
                      "(maximum principle)",
                      highest, bounds.upper));
  }

  void require_sinks(const Scene &scene, double time, const std::string &method)
  {
    for(const PointSource &source : scene.sources)
      if(source.power(time) > 0)
        throw Refusal(
            fmt::format("{} takes sources that draw heat out of solid; at time {:.6g} "
                        "that at ({:.6g}, {:.6g}) heats it, and a second front would "
                        "start there",
                        method, time, source.position[0], source.position[1]));
  }
} // namespace meltfront::cases
