#include <reference_fem/enthalpy/initial_state.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    using cases::ExactSolution;
    using cases::Material;
    using cases::Position;
    using cases::Symmetry;

    /** Enthalpy per volume of a coordinate's phase: the front decides, not the sign of a
     * temperature that may be the melting point's. */
    double phase_enthalpy(const Material &material, const ExactSolution &exact,
                          bool solid, double coordinate, double time)
    {
      const double excess
          = exact.temperature(coordinate, time) - material.melting_temperature;
      if(solid)
        return material.solid.volumetric_heat_capacity() * std::min(excess, 0.);
      return material.solid.density * material.latent_heat
             + material.liquid.volumetric_heat_capacity() * std::max(excess, 0.);
    }

    /** Average of the enthalpy between two coordinates with the measure of a symmetry. */
    double average(const cases::Scene &scene, Symmetry measure, double lower,
                   double upper)
    {
      const ExactSolution &exact = *scene.initial.exact;
      const double time = scene.start_time;
      const double front = std::clamp(exact.front(time), lower, upper);
      const auto piece = [&](bool inner, double from, double to)
      {
        if(from >= to)
          return 0.;
        const bool solid = inner == exact.solid_at_origin();
        return boost::math::quadrature::gauss<double, 7>::integrate(
            [&](double x)
            {
              const double jacobian = measure == Symmetry::cylindrical ? x
                                      : measure == Symmetry::spherical ? x * x
                                                                       : 1;
              return jacobian * phase_enthalpy(scene.material, exact, solid, x, time);
            },
            from, to);
      };
      const double factor = measure == Symmetry::cylindrical ? 2 * std::numbers::pi
                            : measure == Symmetry::spherical ? 4 * std::numbers::pi
                                                             : 1;
      return factor * (piece(true, lower, front) + piece(false, front, upper))
             / cases::volume_between(measure, lower, upper);
    }

    std::vector<double> averages(const cases::Scene &scene, const Mesh &mesh,
                                 const Discretization &discretization)
    {
      const std::size_t n = discretization.volume.size();
      std::vector<double> result(n);
      const Symmetry measure = discretization.measure;
      const double length = scene.domain.side(), half = discretization.spacing / 2;
      if(measure != Symmetry::none)
      {
        double volume = 0, lower = 0;
        for(std::size_t i = 0; i < n; ++i)
        {
          volume += discretization.volume[i];
          const double upper = cases::enclosing_coordinate(measure, volume);
          result[i] = average(scene, measure, lower, upper);
          lower = upper;
        }
      }
      else if(scene.domain.shape == cases::DomainShape::slab)
        for(std::size_t i = 0; i < n; ++i)
        {
          const double x = discretization.positions[i][0];
          result[i] = average(scene, measure, std::max(x - half, 0.),
                              std::min(x + half, length));
        }
      else
      {
        const ExactSolution &exact = *scene.initial.exact;
        result = mesh.node_averages(
            [&](const Position &p)
            {
              const double distance = exact.signed_distance(p, scene.start_time);
              return phase_enthalpy(
                  scene.material, exact, (distance < 0) == exact.solid_at_origin(),
                  cases::coordinate(exact.symmetry(), p), scene.start_time);
            });
      }
      return result;
    }
  } // namespace

  std::vector<double> initial_enthalpy(const cases::Scene &scene, const Mesh &mesh,
                                       const Discretization &discretization,
                                       const std::vector<char> &free)
  {
    const std::size_t n = discretization.volume.size();
    const auto &exact = scene.initial.exact;
    const bool has_front = exact && scene.start_time > exact->start_time()
                           && scene.material.latent_heat > 0;
    std::vector<double> result
        = has_front ? averages(scene, mesh, discretization) : std::vector<double>(n);
    for(std::size_t i = 0; i < n; ++i)
      if(!has_front || !free[i])
      {
        const double temperature
            = scene.initial.temperature(discretization.positions[i], scene.start_time);
        result[i] = scene.material.solid.density
                    * scene.material.enthalpy(temperature,
                                              scene.initial.solid_fraction_at_melting);
      }
    return result;
  }
} // namespace meltfront::reference_fem
