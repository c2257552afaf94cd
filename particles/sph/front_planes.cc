#include <particles/core/particle_operator.h>
#include <particles/sph/front_planes.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    /** Spacings within which neighbours lie in the square of three by three cells. */
    constexpr double reach = 1.5;

    /** Side of the square in spacings. */
    constexpr double side = 3;
  } // namespace

  double line_through_square(double part_behind, double normal_x, double normal_y)
  {
    const double longer = std::max(std::abs(normal_x), std::abs(normal_y));
    const double shorter = std::min(std::abs(normal_x), std::abs(normal_y));
    // The chord is of constant length up to `flat`, then shrinks to a corner.
    const double flat = (longer - shorter) / 2, corner = (longer + shorter) / 2;
    const double beyond_centre = std::abs(std::clamp(part_behind, 0., 1.) - 0.5);
    const double distance
        = beyond_centre * longer <= flat
              ? beyond_centre * longer
              : corner - std::sqrt(2 * longer * shorter * (0.5 - beyond_centre));
    return std::copysign(distance, part_behind - 0.5);
  }

  FrontPlanes::FrontPlanes(const Discretisation &dis)
  {
    const NeighbourList neighbours(dis.particles, reach * dis.spacing, dis.periodicity);
    const std::size_t n = dis.particles.size();
    offsets.reserve(n + 1);
    links.reserve(neighbours.size());
    for(std::size_t a = 0; a < n; ++a)
    {
      offsets.push_back(links.size());
      for(const std::uint32_t b : neighbours[a])
      {
        const auto difference = [&](int d)
        {
          return dis.periodicity.shortest(d, dis.particles.position[d][b]
                                                 - dis.particles.position[d][a]);
        };
        const double x = difference(0), y = difference(1);
        const double weight
            = -dis.kernel.radial_derivative_over_distance(std::hypot(x, y));
        links.push_back({b, weight * x, weight * y});
      }
    }
    offsets.push_back(links.size());
    fraction.resize(n);
    distances.resize((n + ParticleOperator::lanes - 1) / ParticleOperator::lanes
                     * ParticleOperator::lanes);
  }

  void FrontPlanes::update(std::span<const std::uint32_t> slices, const double *enthalpy,
                           double latent_heat)
  {
    constexpr std::size_t lanes = ParticleOperator::lanes;
    for(std::size_t a = 0; a < fraction.size(); ++a)
      fraction[a] = 1 - std::clamp(enthalpy[a] / latent_heat, 0., 1.);
    for(const std::uint32_t slice : slices)
      for(std::size_t a = slice * lanes;
          a < std::min((slice + 1) * lanes, fraction.size()); ++a)
        distances[a] = distance_of(a);
  }

  double FrontPlanes::distance_of(std::size_t a) const
  {
    double sum = fraction[a], x = 0, y = 0;
    for(std::size_t i = offsets[a]; i < offsets[a + 1]; ++i)
    {
      const double other = fraction[links[i].neighbour];
      sum += other;
      x -= links[i].along_x * (other - fraction[a]);
      y -= links[i].along_y * (other - fraction[a]);
    }
    const double mean = sum / double(1 + offsets[a + 1] - offsets[a]);
    const double length = std::hypot(x, y);
    return length > 0 ? -side * line_through_square(mean, x / length, y / length)
                      : side * (0.5 - mean);
  }

  std::size_t FrontPlanes::bytes() const
  {
    return offsets.size() * sizeof(offsets[0]) + links.size() * sizeof(Link)
           + (fraction.size() + distances.size()) * sizeof(double);
  }
} // namespace meltfront::particles
