#include <cases/error.h>
#include <cases/initial_level.h>
#include <particles/sph/mass_coordinates.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    using cases::Position;

    /** Of a length in X: the least part that counts. */
    constexpr double round_off = 1e-9;

    void require_nearest_neighbours(const SphParameters &p)
    {
      const double reach = SmoothingKernel(p.kernel, 1, p.smoothing_length).support();
      const char *wrong
          = p.layout != LatticeLayout::cell_centred ? "layout = cell"
            : p.jitter > 0 || p.arrangement >= Arrangement::random
                ? "particles on a lattice (jitter = 0)"
            : !p.moment_correction ? "moment_correction = true"
            : reach > 2 * (1 + round_off)
                ? "a kernel that reaches the nearest particles alone (smoothing_length)"
                : nullptr;
      if(wrong)
        throw cases::Refusal(fmt::format(
            "along a line sph moves particles with displaced liquid: it needs {}",
            wrong));
    }

    /** @throws cases::Refusal unless solid lies at the lower end alone. */
    double thickness_of_solid(const cases::Scene &scene, double lowest, double length)
    {
      const auto refuse = []
      {
        throw cases::Refusal("sph moves liquid only away from solid at x_min: at the "
                             "start there is solid elsewhere");
      };
      const cases::InitialState &initial = scene.initial;
      if(initial.exact && initial.exact->has_front())
      {
        if(!initial.exact->solid_at_origin())
          refuse();
        return std::clamp(initial.exact->front(scene.start_time) - lowest, 0., length);
      }
      const cases::Field level = cases::initial_level(scene);
      const auto is_solid = [&](double share) {
        return level({lowest + share * length, 0, 0}, scene.start_time) < 0;
      };
      constexpr int samples = 4096;
      int solid = 0;
      for(int i = 0; i < samples; ++i)
        if(is_solid((i + 0.5) / samples) && solid++ != i)
          refuse();
      if(solid == 0 || solid == samples)
        return solid == 0 ? 0 : length;
      double lower = (solid - 0.5) / samples, upper = (solid + 0.5) / samples;
      for(int k = 0; k < 60; ++k)
        (is_solid((lower + upper) / 2) ? lower : upper) = (lower + upper) / 2;
      return length * lower;
    }

    /** From X to x at the start; beyond the open end it is x_max. */
    struct ToSpace
    {
      double lowest, solid, length, density_ratio;

      double operator()(double mass) const
      {
        const double beyond = std::max(mass - solid, 0.) / density_ratio;
        return lowest + std::min(std::min(mass, solid) + beyond, length);
      }
    };

    cases::Field moved(const cases::Field &field, const ToSpace &to_space)
    {
      cases::Field result = field;
      result.value = [value = field.value, to_space](const Position &p, double time) {
        return value({to_space(p[0]), 0, 0}, time);
      };
      return result;
    }

    /** The same at one place, at all times. */
    void hold_place(cases::Boundary &boundary, double x)
    {
      if(boundary.value.value)
        boundary.value.value
            = [value = boundary.value.value, x](const Position &, double time) {
                return value({x, 0, 0}, time);
              };
    }

    /** An exact solution at the start. */
    class MovedSolution : public cases::ExactSolution
    {
    public:
      MovedSolution(std::shared_ptr<const cases::ExactSolution> in_space,
                    const ToSpace &to_space)
        : in_space(std::move(in_space))
        , to_space(to_space)
      {
      }

      std::string description() const override
      {
        return in_space->description();
      }

      cases::Symmetry symmetry() const override
      {
        return cases::Symmetry::planar;
      }

      bool has_front() const override
      {
        return in_space->has_front();
      }

      using ExactSolution::temperature;
      double temperature(double coordinate, double time) const override
      {
        return in_space->temperature(to_space(coordinate), time);
      }

      double front(double time) const override
      {
        return in_space->front(time);
      }

      double heat_content(double lower, double upper, double time) const override
      {
        return in_space->heat_content(to_space(lower), to_space(upper), time);
      }

    private:
      std::shared_ptr<const cases::ExactSolution> in_space;
      ToSpace to_space;
    };
  } // namespace

  MassCoordinates::MassCoordinates(const cases::Scene &scene, const SphParameters &p)
    : at_rest(scene)
    , lowest(scene.domain.lower[0])
    , length(scene.domain.side())
    , density_ratio(scene.material.liquid.density / scene.material.solid.density)
  {
    require_nearest_neighbours(p);
    solid = thickness_of_solid(scene, lowest, length);
    const double end = open_end(solid);
    const double filled = std::max(4., std::round(p.n * end / length));
    const double spacing = end / filled;
    particles
        = static_cast<int>(std::max(filled, std::ceil(std::max(density_ratio, 1.) * length
                                                      / spacing * (1 - round_off))));

    const ToSpace to_space{lowest, solid, length, density_ratio};
    at_rest.domain.lower[0] = 0;
    at_rest.domain.upper[0] = particles * spacing;
    cases::PhaseProperties &liquid = at_rest.material.liquid;
    liquid.conductivity *= density_ratio;
    liquid.density = at_rest.material.solid.density;
    cases::InitialState &initial = at_rest.initial;
    initial.temperature = moved(initial.temperature, to_space);
    if(initial.front)
      initial.front = moved(*initial.front, to_space);
    if(initial.exact)
      initial.exact = std::make_shared<MovedSolution>(initial.exact, to_space);
    for(const auto &[side, x] : {std::pair(cases::Side::x_min, lowest),
                                 std::pair(cases::Side::x_max, lowest + length)})
      hold_place(*at_rest.boundaries[static_cast<std::size_t>(side)], x);
  }
} // namespace meltfront::particles
