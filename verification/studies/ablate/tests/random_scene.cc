#include <cases/tests/support/scenes.h>
#include <verification/studies/ablate/tests/random_scene.h>
#include <verification/studies/crosscheck/random_stream.h>

#include <numbers>

namespace meltfront::verification::tests
{
  namespace
  {
    double weak(RandomStream &random)
    {
      return (random.chance(0.5) ? 1 : -1) * random.log_uniform(1e-4, 1e-1);
    }

    std::shared_ptr<const cases::PropertyCurve> sloped(double at_zero, double change)
    {
      return std::make_shared<const cases::PropertyCurve>(
          std::vector<double>{-2, 0, 2},
          std::vector<double>{at_zero * (1 - change), at_zero, at_zero * (1 + change)},
          "table");
    }

    cases::Material material(RandomStream &random)
    {
      cases::Material m = test_support::unit_material(0);
      m.latent_heat = random.log_uniform(0.3, 10);
      for(cases::PhaseProperties *phase : {&m.solid, &m.liquid})
      {
        phase->conductivity = phase->specific_heat_capacity = 1;
        if(random.chance(0.25))
          phase->conductivity_curve = sloped(1, weak(random));
        if(random.chance(0.25))
          phase->heat_capacity_curve = sloped(1, weak(random));
      }
      const bool curves_of_conductivity
          = m.solid.conductivity_curve || m.liquid.conductivity_curve;
      if(!curves_of_conductivity && random.chance(0.7))
        m.liquid.conductivity *= 1 + weak(random);
      if(!m.solid.heat_capacity_curve && !m.liquid.heat_capacity_curve
         && random.chance(0.7))
        m.liquid.specific_heat_capacity *= 1 + weak(random);
      m.update_curves();
      return m;
    }

    cases::Boundary weak_wall(RandomStream &random, double temperature)
    {
      if(random.chance(0.3))
        return test_support::flux_wall(0.1 * weak(random));
      cases::Boundary wall{cases::BoundaryKind::heat_transfer,
                           cases::Field::uniform(
                               random.chance(0.5) ? temperature : random.uniform(-1, 1))};
      wall.heat_transfer_coefficient = random.log_uniform(1e-4, 1e-1);
      return wall;
    }

    void add_walls(RandomStream &random, cases::Scene &scene, double start)
    {
      const double sign = random.chance(0.5) ? 1 : -1;
      const double driving = start == 0 ? sign * random.uniform(0.2, 1)
                                        : (start > 0 ? -1 : 1) * random.uniform(0.2, 1);
      bool first = true;
      for(const cases::Side side : scene.sides())
      {
        cases::Boundary wall;
        if(first)
        {
          wall = test_support::fixed_wall(driving);
          if(random.chance(0.3))
            wall = test_support::varying_wall(
                [driving, rate = random.uniform(1, 6)](double time) {
                  return driving
                         * (1 + 0.3 * std::sin(2 * std::numbers::pi * rate * time));
                });
        }
        else if(random.chance(0.25))
          wall = test_support::fixed_wall(start);
        else if(random.chance(0.5))
          wall = weak_wall(random, start);
        test_support::set_boundary(scene, side, wall);
        first = false;
      }
    }
  } // namespace

  cases::Scene random_weak_scene(std::uint64_t seed, std::uint64_t index)
  {
    RandomStream random(seed, index);
    const cases::Material substance = material(random);
    const double end = random.log_uniform(0.02, 1);
    const double start
        = random.chance(0.2) ? 0 : (random.chance(0.5) ? 1 : -1) * random.uniform(0.1, 1);
    cases::Scene scene;
    const int shape = random.weighted({0.8, 0.12, 0.08});
    if(shape == 0)
      scene = test_support::slab(substance, 1, start, 0, end);
    else if(shape == 1)
      scene = test_support::box(substance, 2, {0, 0, 0}, {1, 1, 0}, start, end);
    else
      scene = test_support::ball(substance, 2, 0.5, start, end);
    scene.symmetry = shape == 0   ? cases::Symmetry::planar
                     : shape == 1 ? cases::Symmetry::none
                                  : cases::Symmetry::cylindrical;
    add_walls(random, scene, start);
    if(shape == 0 && random.chance(0.25)) // two phases at the start
      scene.initial.temperature = test_support::field_of(
          [left = -random.uniform(0.1, 1), right = random.uniform(0.1, 1),
           from = random.uniform(0.2, 0.8)](const cases::Position &p)
          { return p[0] < from ? left : right; });
    if(random.chance(0.15))
      scene.volumetric_source = cases::Field::uniform(0.1 * weak(random));
    if(shape == 1 && random.chance(0.5))
      scene.sources.push_back(
          test_support::steady_sink({0.5, 0.5, 0}, 0.1 * random.log_uniform(1e-4, 1e-1)));
    return scene;
  }
} // namespace meltfront::verification::tests
