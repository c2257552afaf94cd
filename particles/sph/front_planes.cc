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

    /** Largest curvature that a lattice shows, per spacing. */
    constexpr double most_curved = 0.5;
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

  double length_in_square(double distance, double normal_x, double normal_y)
  {
    const double longer = std::max(std::abs(normal_x), std::abs(normal_y));
    const double shorter = std::min(std::abs(normal_x), std::abs(normal_y));
    const double flat = (longer - shorter) / 2, corner = (longer + shorter) / 2;
    const double from_centre = std::abs(distance);
    if(from_centre <= flat)
      return 1 / longer;
    return from_centre < corner ? (corner - from_centre) / (longer * shorter) : 0;
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
        links.push_back({b, x / dis.spacing, y / dis.spacing, weight});
      }
    }
    offsets.push_back(links.size());
    fraction.resize(n);
    lines.resize(n);
    distances.resize((n + ParticleOperator::lanes - 1) / ParticleOperator::lanes
                     * ParticleOperator::lanes);
  }

  void FrontPlanes::update(std::span<const std::uint32_t> slices, const double *enthalpy,
                           double latent_heat)
  {
    constexpr std::size_t lanes = ParticleOperator::lanes;
    for(std::size_t a = 0; a < fraction.size(); ++a)
      fraction[a] = 1 - std::clamp(enthalpy[a] / latent_heat, 0., 1.);
    ++updates;
    const auto visit = [&](const auto &each)
    {
      for(const std::uint32_t slice : slices)
        for(std::size_t a = slice * lanes;
            a < std::min((slice + 1) * lanes, fraction.size()); ++a)
          each(a);
    };
    visit([&](std::size_t a) { lines[a] = line_of(a); });
    visit([&](std::size_t a) { distances[a] = lines[a].distance - beyond_line(a); });
  }

  FrontPlanes::Line FrontPlanes::line_of(std::size_t a) const
  {
    double sum = fraction[a], x = 0, y = 0;
    for(std::size_t i = offsets[a]; i < offsets[a + 1]; ++i)
    {
      const double other = fraction[links[i].neighbour];
      sum += other;
      x -= links[i].weight * links[i].x * (other - fraction[a]);
      y -= links[i].weight * links[i].y * (other - fraction[a]);
    }
    const double mean = sum / double(1 + offsets[a + 1] - offsets[a]);
    const double size = std::hypot(x, y);
    Line line{.update = updates};
    if(size == 0)
    {
      line.distance = side * (0.5 - mean);
      return line;
    }
    line.normal_x = x / size;
    line.normal_y = y / size;
    const double from_centre = line_through_square(mean, line.normal_x, line.normal_y);
    line.distance = -side * from_centre;
    line.length = side * length_in_square(from_centre, line.normal_x, line.normal_y);
    return line;
  }

  /** How far the middle of the arc lies beyond its line, towards the liquid. */
  double FrontPlanes::beyond_line(std::size_t a) const
  {
    const Line &own = lines[a];
    if(own.length == 0)
      return 0;
    double count = 1, q = 0, r = 0, qq = 0, qr = 0;
    for(std::size_t i = offsets[a]; i < offsets[a + 1]; ++i)
    {
      const Link &link = links[i];
      const Line &other = lines[link.neighbour];
      if(other.update != updates || other.length == 0)
        continue;
      const double along = own.normal_x * link.x + own.normal_y * link.y;
      const double tangent = own.normal_x * link.y - own.normal_y * link.x;
      const double bend = tangent * tangent / 2;
      const double rest = other.distance - own.distance - along;
      ++count;
      q += bend;
      r += rest;
      qq += bend * bend;
      qr += bend * rest;
    }
    const double spread = count * qq - q * q;
    if(!(spread > 1e-9))
      return 0;
    const double curvature
        = std::clamp((count * qr - q * r) / spread, -most_curved, most_curved);
    return curvature * own.length * own.length / 24;
  }

  std::size_t FrontPlanes::bytes() const
  {
    return offsets.size() * sizeof(offsets[0]) + links.size() * sizeof(Link)
           + (fraction.size() + distances.size()) * sizeof(double)
           + lines.size() * sizeof(Line);
  }
} // namespace meltfront::particles
