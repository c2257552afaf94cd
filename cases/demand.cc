#include <cases/demand.h>
#include <cases/scene.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::cases
{
  namespace
  {
    /** Area or volume that a circle or a sphere encloses (m^d). */
    double enclosed(int dimension, double radius)
    {
      return dimension == 2 ? std::numbers::pi * radius * radius
                            : 4 * std::numbers::pi / 3 * std::pow(radius, 3);
    }
  } // namespace

  double lattice_points(const Domain &domain, int dimension, double n)
  {
    if(dimension == 1 || domain.shape == DomainShape::slab)
      return n;
    if(domain.mesh) // n divides the cells' edges
      return static_cast<double>(domain.mesh->vertices().size()) * std::pow(n, dimension);
    const double spacing = domain.side() / n;
    if(domain.shape == DomainShape::outline)
      return domain.outline->area() / (spacing * spacing);
    if(domain.round())
      return (enclosed(dimension, domain.radius)
              - enclosed(dimension, domain.inner_radius))
             / std::pow(spacing, dimension);
    double points = n;
    for(int d = 1; d < dimension; ++d)
      points *= std::max(1., (domain.upper[d] - domain.lower[d]) / spacing);
    return points;
  }

  double points_within(int dimension, double distance)
  {
    return dimension == 1 ? 2 * distance : enclosed(dimension, distance);
  }

  double fill_of_factors(int dimension, double unknowns)
  {
    constexpr double in_plane = 1, in_space = 1;
    if(dimension == 1)
      return 1;
    return dimension == 2 ? std::max(1., in_plane * std::log2(unknowns))
                          : std::max(1., in_space * std::cbrt(unknowns));
  }
} // namespace meltfront::cases
