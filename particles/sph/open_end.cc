#include <cases/error.h>
#include <cases/wall_law.h>
#include <particles/sph/open_end.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    /** How far from a face, in spacings, the end counts as being there. */
    constexpr double face_tolerance = 1e-9;
  } // namespace

  OpenEnd::OpenEnd(const MassCoordinates &coordinates, const Discretisation &dis)
    : coordinates(coordinates)
    , material(coordinates.at_rest.material)
    , spacing(dis.spacing)
    , particles(dis.particles.size())
    , last_particle(static_cast<std::uint32_t>(
          std::lround(coordinates.open_end(coordinates.solid) / spacing) - 1))
    , width(spacing)
  {
  }

  void OpenEnd::hide(std::span<double> values) const
  {
    std::fill(values.begin() + last_particle + 1, values.begin() + particles,
              values[last_particle]);
  }

  void OpenEnd::correct(double driving, std::span<double> flow)
  {
    meter.measure(
        [&]
        {
          // The nearest neighbours' coefficient is 1/spacing, by the second moment.
          const double missing = driving * (2 / (spacing + width) - 1 / spacing);
          flow[last_particle] += missing;
          flow[last_particle - 1] -= missing;
          std::fill(flow.begin() + last_particle + 1, flow.begin() + particles, 0.);
        });
  }

  double OpenEnd::solid_thickness(std::span<const double> enthalpy, double time) const
  {
    double sum = 0;
    bool liquid = false;
    for(std::uint32_t a = 0; a <= last_particle; ++a)
    {
      const double fraction = material.solid_fraction(enthalpy[a]);
      if(liquid && fraction > 0.5)
        throw cases::Refusal(fmt::format(
            "sph moves liquid only away from solid at x_min: at t = {:.6g} s there is "
            "solid beyond liquid",
            time));
      liquid = liquid || fraction < 0.5;
      sum += fraction * (a < last_particle ? spacing : width);
    }
    return sum;
  }

  double OpenEnd::wall_temperature(double own_enthalpy, double time) const
  {
    const cases::Boundary &wall = coordinates.at_rest.boundary(cases::Side::x_max);
    if(wall.kind == cases::BoundaryKind::fixed_temperature)
      return wall.value({}, time);
    const double own = material.temperature(own_enthalpy);
    if(!cases::prescribes_heat(wall.kind))
      return own;
    const double resistance = depth() / material.liquid.conductivity;
    return own
           + resistance
                 * cases::heat_through_layer(wall, wall.value({}, time), own, resistance)
                       .flux;
  }

  void OpenEnd::merge(std::span<double> enthalpy)
  {
    double &inner = enthalpy[last_particle - 1];
    inner = (spacing * inner + width * enthalpy[last_particle]) / (spacing + width);
    width += spacing;
    --last_particle;
  }

  /** By the lesser slope of those to the neighbour and to the end, in liquid. */
  void OpenEnd::split(std::span<double> enthalpy, double at_end)
  {
    double &own = enthalpy[last_particle];
    const double inward = enthalpy[last_particle - 1];
    const double outer = width - spacing;
    double slope = 0;
    if(std::min(own, inward) > material.latent_heat)
    {
      const double left = (own - inward) / (0.5 * (spacing + width));
      const double right = (at_end - own) / depth();
      if(left * right > 0)
        slope = std::abs(left) < std::abs(right) ? left : right;
    }
    enthalpy[last_particle + 1] = own + 0.5 * slope * spacing;
    own -= 0.5 * slope * outer;
    width = outer;
    ++last_particle;
  }

  double OpenEnd::move(std::span<double> enthalpy, double begin, double end)
  {
    return meter.measure(
        [&]
        {
          const double place = coordinates.open_end(solid_thickness(enthalpy, end));
          const double inflow = place - (last_particle * spacing + width);
          double &own = enthalpy[last_particle];
          const double at_end
              = material.latent_heat
                + material.liquid.specific_heat_capacity
                      * std::max(wall_temperature(own, 0.5 * (begin + end))
                                     - material.melting_temperature,
                                 0.);
          // What leaves a particle warmer or colder than all around is the particle's.
          const double passing
              = inflow < 0 && own > material.latent_heat
                        && (at_end - own) * (own - enthalpy[last_particle - 1]) < 0
                    ? own
                    : at_end;
          own = (width * own + inflow * passing) / (width + inflow);
          width += inflow;
          while(width < spacing * (1 - face_tolerance) && last_particle > 1)
            merge(enthalpy);
          while(width > 2 * spacing * (1 - face_tolerance)
                && last_particle + 1 < particles)
            split(enthalpy, at_end);
          return inflow * passing * material.solid.density;
        });
  }

  void OpenEnd::weigh(std::span<double> thickness) const
  {
    for(std::size_t a = 0; a < particles; ++a)
      thickness[a] = a < last_particle ? spacing : a == last_particle ? width : 0;
  }
} // namespace meltfront::particles
