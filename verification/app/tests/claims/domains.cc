#include <verification/app/tests/claims/domains.h>

#include <cmath>
#include <vector>

namespace meltfront::verification::claims
{
  namespace
  {
    constexpr double depth = 0.5, inner_radius = 0.4;

    /** Of walls that radiate: so that it is felt, and absolute temperatures stay
     * positive.
     */
    constexpr double emission_coefficient = 0.2, absolute_zero = -4;
  } // namespace

  cases::Domain domain_of(cases::DomainShape shape, int dimension, bool round_outline)
  {
    using cases::DomainShape;
    cases::Domain domain;
    domain.shape = shape;
    domain.dimension = dimension;
    if(shape == DomainShape::slab || shape == DomainShape::box)
    {
      domain.upper[0] = 1;
      for(int d = 1; d < dimension; ++d)
        domain.upper[d] = depth;
      return domain;
    }
    if(shape != DomainShape::outline)
    {
      domain.radius = 1;
      if(shape == DomainShape::shell)
        domain.inner_radius = inner_radius;
      return domain;
    }
    const std::vector<cases::Outline::Point> corners{
        {0, 0}, {1, 0}, {1, depth}, {0, depth}};
    domain.outline = round_outline ? std::make_shared<const cases::Outline>(
                         [](double) { return 1.; }, cases::Outline::Point{0, 0})
                                   : std::make_shared<const cases::Outline>(corners);
    for(int d = 0; d < 2; ++d)
    {
      domain.lower[d] = domain.outline->lower()[d];
      domain.upper[d] = domain.outline->upper()[d];
    }
    domain.reference_length = domain.upper[0] - domain.lower[0];
    return domain;
  }

  cases::Scene scene_on(const cases::Domain &domain)
  {
    cases::Scene scene;
    scene.name = "claim";
    scene.domain = domain;
    scene.symmetry = domain.shape == cases::DomainShape::slab ? cases::Symmetry::planar
                                                              : cases::Symmetry::none;
    scene.material.latent_heat = 0;
    using cases::Side;
    if(domain.outline || domain.round())
      wall(scene, Side::outer);
    if(domain.shape == cases::DomainShape::shell)
      wall(scene, Side::inner);
    if(!domain.outline && !domain.round())
      for(int s = 0; s < 2 * domain.dimension; ++s)
        wall(scene, static_cast<Side>(s));
    return scene;
  }

  cases::Boundary &wall(cases::Scene &scene, cases::Side side)
  {
    auto &boundary = scene.boundaries[static_cast<std::size_t>(side)];
    if(!boundary)
      boundary.emplace();
    return *boundary;
  }

  cases::Field field(Value value)
  {
    return {.expression = "of the claim", .value = std::move(value)};
  }

  cases::Boundary held_at(Value temperature)
  {
    return {.kind = cases::BoundaryKind::fixed_temperature,
            .value = field(std::move(temperature))};
  }

  cases::Boundary surrounded(cases::BoundaryKind kind, Value temperature, Value flux)
  {
    cases::Boundary result;
    result.kind = kind;
    if(kind == cases::BoundaryKind::heat_transfer)
    {
      result.heat_transfer_coefficient = transfer_coefficient;
      result.value = field(
          [temperature, flux](const cases::Position &p, double time)
          { return temperature(p, time) + flux(p, time) / transfer_coefficient; });
      return result;
    }
    result.emission_coefficient = emission_coefficient;
    result.absolute_zero = absolute_zero;
    result.value = field(
        [temperature, flux](const cases::Position &p, double time)
        {
          const double own = std::pow(temperature(p, time) - absolute_zero, 4);
          return absolute_zero
                 + std::pow(own + flux(p, time) / emission_coefficient, 0.25);
        });
    return result;
  }

  cases::Position normal(const cases::Domain &domain, cases::Side side,
                         const cases::Position &point)
  {
    cases::Position result{};
    if(domain.round())
    {
      const double distance = std::hypot(point[0], point[1], point[2]);
      for(int d = 0; d < 3; ++d)
        result[d] = (side == cases::Side::inner ? -1 : 1) * point[d] / distance;
      return result;
    }
    if(!domain.outline)
    {
      const int s = static_cast<int>(side);
      result[s / 2] = s % 2 == 0 ? -1 : 1;
      return result;
    }
    // The side of the rectangle that is nearest.
    double nearest = 1e300;
    for(int d = 0; d < 2; ++d)
      for(const int sign : {-1, 1})
      {
        const double off
            = std::abs(point[d] - (sign < 0 ? domain.lower[d] : domain.upper[d]));
        if(off < nearest)
        {
          nearest = off;
          result = {};
          result[d] = sign;
        }
      }
    return result;
  }
} // namespace meltfront::verification::claims
