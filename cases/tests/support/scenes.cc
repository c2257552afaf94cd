#include <cases/tests/support/scenes.h>

#include <cmath>
#include <numbers>

namespace meltfront::test_support
{
  using namespace cases;

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

    Field temperature_of(const ExactPointer &exact)
    {
      return {"exact", [exact](const Position &p, double time)
              { return exact->temperature(p, time); }};
    }
  } // namespace

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

  Boundary fixed_wall(double temperature)
  {
    return {BoundaryKind::fixed_temperature, Field::uniform(temperature)};
  }

  Boundary varying_wall(std::function<double(double)> temperature)
  {
    return {BoundaryKind::fixed_temperature,
            {"varying",
             [temperature](const Position &, double time) { return temperature(time); }}};
  }

  Boundary exact_wall(const ExactPointer &exact)
  {
    return {BoundaryKind::fixed_temperature, temperature_of(exact), true};
  }

  Boundary flux_wall(double flux)
  {
    return {BoundaryKind::flux, Field::uniform(flux)};
  }

  Boundary periodic_wall()
  {
    return {BoundaryKind::periodic, {}};
  }

  void set_boundary(Scene &scene, Side side, const Boundary &boundary)
  {
    scene.boundaries[static_cast<std::size_t>(side)] = boundary;
  }

  Field field_of(std::function<double(const Position &)> value)
  {
    return {"given",
            [value = std::move(value)](const Position &p, double) { return value(p); }};
  }

  Field step_along_x(double at, double below, double above)
  {
    return {"if(x < at, below, above)",
            [=](const Position &p, double) { return p[0] < at ? below : above; }};
  }

  double speed_of_contact(double solid, double liquid)
  {
    const auto missing = [&](double speed)
    {
      const double bell = std::exp(-speed * speed) / std::sqrt(std::numbers::pi);
      return speed + solid * bell / std::erfc(-speed) + liquid * bell / std::erfc(speed);
    };
    double lower = -2, upper = 2;
    for(int i = 0; i < 60; ++i)
      (missing((lower + upper) / 2) < 0 ? lower : upper) = (lower + upper) / 2;
    return lower;
  }

  Scene bodies_in_contact(double at, double height, double solid, double liquid,
                          double end)
  {
    Scene scene = box(unit_material(), 2, {0, 0, 0}, {1, height, 0}, 0, end);
    scene.initial.temperature = step_along_x(at, solid, liquid);
    scene.initial.front
        = Field{"x - at", [at](const Position &p, double) { return p[0] - at; }};
    return scene;
  }

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

  Scene slab(const Material &material, double length, double temperature, double end,
             const Boundary &left, const Boundary &right)
  {
    Scene scene = slab(material, length, temperature, 0, end);
    set_boundary(scene, Side::x_min, left);
    set_boundary(scene, Side::x_max, right);
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

  Scene steady_box(int dimension, const Field &wall)
  {
    Position upper{};
    for(int d = 0; d < dimension; ++d)
      upper[d] = 1;
    Scene scene = box(unit_material(), dimension, {}, upper, 0, 1);
    scene.problem = ProblemKind::poisson;
    scene.material.latent_heat = 0;
    if(dimension == 1)
    {
      scene.domain.shape = DomainShape::slab;
      scene.symmetry = Symmetry::planar;
    }
    for(const Side side : scene.sides())
      set_boundary(scene, side, {BoundaryKind::fixed_temperature, wall});
    return scene;
  }

  void start_from(Scene &scene, const ExactPointer &exact)
  {
    scene.initial.exact = exact;
    scene.initial.temperature = temperature_of(exact);
    for(auto &boundary : scene.boundaries)
      if(boundary && boundary->kind == BoundaryKind::fixed_temperature)
        boundary = exact_wall(exact);
  }

  PointSource steady_sink(const Position &place, double strength)
  {
    return {place, "constant", [strength](double) { return -strength; },
            [strength](double time) { return -strength * time; }};
  }
} // namespace meltfront::test_support
