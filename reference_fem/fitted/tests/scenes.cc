#include <reference_fem/fitted/tests/support.h>

#include <cases/exact/frank.h>
#include <cases/exact/line_sink.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/point_sink.h>

#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::fitted::tests
{
  using namespace reference_fem::tests;
  using namespace cases;

  namespace
  {
    ExactScene exact_slab(const Material &material, double length, double wall,
                          double far, double start, double end)
    {
      const auto exact = std::make_shared<PlanarNeumann>(material, wall, far);
      Scene scene = slab(material, length, far, start, end);
      set_boundary(scene, Side::x_min, exact_wall(exact));
      set_boundary(scene, Side::x_max, exact_wall(exact));
      start_from(scene, exact);
      return {scene, exact};
    }

    ExactScene started_ball(const Material &material, int dimension, double radius,
                            const ExactPointer &exact, double start, double end)
    {
      Scene scene = ball(material, dimension, radius, 0, end);
      scene.start_time = start;
      set_boundary(scene, Side::outer, exact_wall(exact));
      start_from(scene, exact);
      return {scene, exact};
    }

    void add_source(Scene &scene, const std::function<double(double)> &power)
    {
      PointSource source;
      source.power = power;
      source.energy = [](double) { return 0.; };
      scene.sources.push_back(source);
    }
  } // namespace

  ExactScene started_slab()
  {
    return exact_slab(normalised_material(), 1, normalised_wall, normalised_far, 0.01,
                      0.25);
  }

  ExactScene lighter_ice()
  {
    Material material = water();
    material.solid.density = 917;
    return exact_slab(material, 0.5, -10, 10, 3600, 86400);
  }

  ExactScene line_sink_disk()
  {
    const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
    ExactScene result = started_ball(water(), 2, 0.5, exact, 47500, 475000);
    add_source(result.scene, [q = exact->strength()](double) { return -q; });
    return result;
  }

  ExactScene point_sink_ball()
  {
    const auto exact = std::make_shared<PointSink>(water(), 0.15, 10);
    ExactScene result = started_ball(water(), 3, 0.5, exact, 47500, 475000);
    add_source(result.scene, [exact](double t) { return -exact->strength(t); });
    return result;
  }

  ExactScene frank(int dimension)
  {
    const Material material;
    const auto exact = std::make_shared<FrankGrowth>(
        material, dimension == 2 ? Symmetry::cylindrical : Symmetry::spherical, -0.5);
    const double growth = exact->growth_constant();
    ExactScene result = started_ball(material, dimension, 1, exact,
                                     0.04 / (growth * growth), 0.25 / (growth * growth));
    result.scene.initial.front = Field{"exact",
                                       [exact](const Position &p, double time)
                                       { return exact->signed_distance(p, time); },
                                       false};
    return result;
  }

  Scene perturbed_annulus(double end)
  {
    Material material;
    material.solid = {2, 1, 1};
    material.liquid = {1, 2, 1};
    material.latent_heat = 2;
    Scene scene = ball(material, 2, 1, 0, end);
    scene.symmetry = Symmetry::none;
    scene.domain.shape = DomainShape::shell;
    scene.domain.inner_radius = 0.3;
    const auto harmonic = [](const Position &p)
    {
      const double squared = p[0] * p[0] + p[1] * p[1];
      return 0.5 * std::log(squared / 0.25)
             - 0.0102 * (p[0] * p[0] * p[0] - 3 * p[0] * p[1] * p[1])
                   * (std::pow(squared, -3) - 1);
    };
    const Field temperature = field_of(
        [harmonic](const Position &p)
        {
          const double psi = harmonic(p);
          return psi < 0 ? (1 - std::exp(-0.4 * psi)) / 0.4
                         : 0.4 * (1 - std::exp(-1.6 * psi)) / 1.6;
        });
    scene.initial.temperature = temperature;
    scene.initial.front = field_of(harmonic);
    for(const Side side : {Side::inner, Side::outer})
      set_boundary(scene, side, {BoundaryKind::fixed_temperature, temperature, false});
    return scene;
  }

  Scene wavy_box(int dimension, double end)
  {
    Material material;
    material.solid = {2, 1, 1};
    Scene scene = box(material, dimension, {}, {1, 0.5, 0.5}, 0, end);
    const auto level = [dimension](const Position &p)
    {
      const double wave = std::cos(4 * std::numbers::pi * p[1])
                          + (dimension == 3 ? std::cos(4 * std::numbers::pi * p[2]) : 0.);
      return p[0] - 0.4 - 0.04 * wave * p[0] * (1 - p[0]);
    };
    scene.initial.temperature = field_of(level);
    scene.initial.front = field_of(level);
    set_boundary(scene, Side::x_min, fixed_wall(-0.4));
    set_boundary(scene, Side::x_max, fixed_wall(0.6));
    for(int side = 2; side < 2 * dimension; ++side)
      set_boundary(scene, static_cast<Side>(side), {BoundaryKind::periodic, {}, false});
    return scene;
  }
} // namespace meltfront::reference_fem::fitted::tests
