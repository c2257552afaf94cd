#include <cases/domain_measure.h>

#include <cmath>
#include <numbers>

namespace meltfront::cases
{
  namespace
  {
    Symmetry symmetry_of(const Domain &domain)
    {
      return domain.dimension == 2 ? Symmetry::cylindrical : Symmetry::spherical;
    }
  } // namespace

  double volume_of(const Domain &domain)
  {
    switch(domain.shape)
    {
    case DomainShape::slab:
      return domain.side();
    case DomainShape::ball:
      return volume_between(symmetry_of(domain), 0, domain.radius);
    case DomainShape::shell:
      return volume_between(symmetry_of(domain), domain.inner_radius, domain.radius);
    case DomainShape::outline:
      return domain.outline->area();
    case DomainShape::mesh:
      return domain.mesh->volume();
    case DomainShape::axisymmetric:
      return volume_between(Symmetry::cylindrical, domain.lower[0], domain.upper[0])
             * (domain.upper[1] - domain.lower[1]);
    default:
    {
      double product = 1;
      for(int d = 0; d < domain.dimension; ++d)
        product *= domain.upper[d] - domain.lower[d];
      return product;
    }
    }
  }

  double area_of(const Domain &domain, Side side)
  {
    const int direction = static_cast<int>(side) / 2;
    if(domain.round())
    {
      const double r = side == Side::inner ? domain.inner_radius : domain.radius;
      return domain.dimension == 2 ? 2 * std::numbers::pi * r
                                   : 4 * std::numbers::pi * r * r;
    }
    switch(domain.shape)
    {
    case DomainShape::slab:
      return 1;
    case DomainShape::outline:
      return domain.outline->perimeter();
    case DomainShape::mesh:
      return domain.mesh->area(static_cast<int>(index_of_mesh_wall(side)));
    case DomainShape::axisymmetric:
      return direction == 1
                 ? volume_between(Symmetry::cylindrical, domain.lower[0], domain.upper[0])
                 : 2 * std::numbers::pi
                       * (side == Side::x_min ? domain.lower : domain.upper)[0]
                       * (domain.upper[1] - domain.lower[1]);
    default:
      return volume_of(domain) / (domain.upper[direction] - domain.lower[direction]);
    }
  }

  int fewest_whole_cells(const Domain &domain)
  {
    constexpr int most = 1000;
    constexpr double tolerance = 1e-9; // of a cell
    if(!domain.rectangular())
      return 1;
    const auto fits = [&domain](int cells)
    {
      for(int d = 0; d < domain.dimension; ++d)
      {
        const double along = cells * (domain.upper[d] - domain.lower[d]) / domain.side();
        if(std::abs(along - std::round(along)) > tolerance || std::round(along) < 1)
          return false;
      }
      return true;
    };
    for(int cells = 1; cells <= most; ++cells)
      if(fits(cells))
        return cells;
    return 1;
  }
} // namespace meltfront::cases
