// Explicit enthalpy method by finite volumes on n equal cells of a slab:
//   rho dH/dt = d/dx (k dT/dx), with T(H) and the solid fraction of cases/material.h
#include <cases/plugin.h>
#include <cases/run.h>
#include <cases/scene.h>

#include <cmath>

using namespace meltfront::cases;

class SlabRun : public Run {
public:
  SlabRun(const Scene &scene, const Resolution &resolution)
      : scene(scene),
        substance(scene.material),
        n(resolution.n),
        width(scene.domain.side() / n),
        enthalpy(n),
        flux(n + 1) {
    for (std::vector<double> *values : {&x, &temperature, &solid_fraction})
      values->resize(n);
    for (int i = 0; i < n; ++i)
      enthalpy[i] =
          substance.enthalpy(scene.initial.temperature({x[i] = (i + 0.5) * width}, scene.start_time));
    // A cell at a wall exchanges with a neighbour and, over half the distance, the wall.
    const double longest = 0.9 * width * width / (3 * substance.solid.diffusivity());
    steps = std::lround(std::ceil((scene.end_time - scene.start_time) / longest));
    dt = (scene.end_time - scene.start_time) / static_cast<double>(steps);
    find_state();
    heat.initial = heat.stored + heat.latent;
  }

  RunDescription describe() const override {
    RunDescription result;
    result.spacing = width;
    result.time_step = dt;
    result.unknowns = n;
    return result;
  }

  Cost cost() const override {
    Cost result;
    result.steps = steps;
    result.unknowns = n;
    result.work = 2 * n * steps;
    return result;
  }

private:
  void take_steps() override {
    reached(0, scene.start_time);
    for (long step = 1; step <= steps; ++step) {
      const double time = scene.start_time + static_cast<double>(step) * dt;
      flux[0] = from_wall(Side::x_min, 0, time); // along x
      for (int i = 1; i < n; ++i)
        flux[i] = (temperature[i - 1] - temperature[i]) * substance.solid.conductivity / width;
      flux[n] = -from_wall(Side::x_max, n - 1, time);
      for (int i = 0; i < n; ++i)
        enthalpy[i] += dt * (flux[i] - flux[i + 1]) / (width * substance.solid.density);
      heat.boundary += dt * (flux[0] - flux[n]);
      find_state();
      reached(step, step == steps ? scene.end_time : time);
    }
  }

  double from_wall(Side side, int cell, double time) const {
    const Boundary &wall = scene.boundary(side);
    if (wall.kind == BoundaryKind::insulated)
      return 0;
    const double outside = wall.value({side == Side::x_min ? 0 : n * width}, time);
    return 2 * (outside - temperature[cell]) * substance.solid.conductivity / width;
  }

  void find_state() {
    heat.stored = heat.latent = 0;
    for (int i = 0; i < n; ++i) {
      temperature[i] = substance.temperature(enthalpy[i]);
      solid_fraction[i] = substance.solid_fraction(enthalpy[i]);
      const double latent = substance.latent_heat * (1 - solid_fraction[i]);
      heat.latent += width * substance.solid.density * latent;
      heat.stored += width * substance.solid.density * (enthalpy[i] - latent);
    }
  }

  Snapshot snapshot(long step, double time) override {
    Snapshot result;
    result.step = step;
    result.time = time;
    result.positions[0] = x;
    result.weights = weights;
    result.temperature = temperature;
    result.solid_fraction = solid_fraction;
    result.heat = heat;
    return result;
  }

  const Scene &scene;
  const Material &substance;
  long n, steps = 0;
  double width, dt = 0;
  std::vector<double> enthalpy, flux, x, temperature, solid_fraction;
  std::vector<double> weights = std::vector<double>(n, width);
  HeatBudget heat;
};

struct SlabVolumes : Method {
  SlabVolumes() : Method("slab-volumes", "Explicit enthalpy method by finite volumes in a slab.") {}

  std::vector<Capabilities> capabilities() const override {
    return {{.problems = {ProblemKind::stefan},
        .effects = {Effect::phase_change, Effect::wall_temperature},
        .shapes = {{DomainShape::slab, {1}, {BoundaryKind::insulated, BoundaryKind::fixed_temperature}}},
        .front_origins = {FrontOrigin::none, FrontOrigin::wall}}};
  }

  std::vector<OptionDeclaration> option_declarations() const override { return {}; }

  std::unique_ptr<Run> set_up(
      const Scene &scene, const EffectSet &, const Resolution &resolution) const override {
    return std::make_unique<SlabRun>(scene, resolution);
  }
};

std::vector<std::unique_ptr<Method>> methods() {
  std::vector<std::unique_ptr<Method>> list;
  list.push_back(std::make_unique<SlabVolumes>());
  return list;
}

MELTFRONT_PLUGIN(methods)
