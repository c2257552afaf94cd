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
    find_images(dis, neighbours);
    std::vector<std::vector<std::uint32_t>> beyond(n);
    for(std::size_t i = 0; i < images.size(); ++i)
    {
      const auto number = static_cast<std::uint32_t>(n + i);
      beyond[images[i].of].push_back(number);
      for(const std::uint32_t a : neighbours[images[i].of])
        beyond[a].push_back(number);
    }
    offsets.reserve(n + 1);
    links.reserve(neighbours.size());
    for(std::size_t a = 0; a < n; ++a)
    {
      offsets.push_back(links.size());
      const auto link = [&](std::uint32_t b, const cases::Position &place)
      {
        const auto difference = [&](int d)
        { return dis.periodicity.shortest(d, place[d] - dis.particles.position[d][a]); };
        const double x = difference(0), y = difference(1);
        const double distance = std::hypot(x, y);
        if(distance < reach * dis.spacing)
          links.push_back({b, x / dis.spacing, y / dis.spacing,
                           -dis.kernel.radial_derivative_over_distance(distance)});
      };
      for(const std::uint32_t b : neighbours[a])
        link(b, dis.particles.point(b));
      for(const std::uint32_t image : beyond[a])
        link(image, images[image - n].place);
    }
    offsets.push_back(links.size());
    fraction.resize(n + images.size());
    lines.resize(n);
    distances.resize((n + ParticleOperator::lanes - 1) / ParticleOperator::lanes
                     * ParticleOperator::lanes);
  }

  /** Of the particles beside plane walls, in each wall and in each corner. */
  void FrontPlanes::find_images(const Discretisation &dis,
                                const NeighbourList &neighbours)
  {
    const auto beside = [&](const PlaneWall &wall, const cases::Position &place)
    { return std::abs(place[wall.direction] - wall.coordinate) < 0.75 * dis.spacing; };
    const auto inner_of = [&](std::uint32_t a, const PlaneWall &wall)
    {
      for(const std::uint32_t b : neighbours[a])
      {
        const cases::Position place = dis.particles.point(b),
                              own = dis.particles.point(a);
        const double depth = std::abs(place[wall.direction] - wall.coordinate)
                             - std::abs(own[wall.direction] - wall.coordinate);
        const int along = 1 - wall.direction;
        if(depth > 0.5 * dis.spacing
           && std::abs(dis.periodicity.shortest(along, place[along] - own[along]))
                  < 0.5 * dis.spacing)
          return b;
      }
      return a;
    };
    const auto driven = [](const PlaneWall &wall)
    { return wall.boundary->kind != cases::BoundaryKind::insulated; };
    const auto mirrored = [](const PlaneWall &wall, cases::Position place)
    {
      place[wall.direction] = 2 * wall.coordinate - place[wall.direction];
      return place;
    };
    for(std::uint32_t a = 0; a < dis.particles.size(); ++a)
    {
      const cases::Position place = dis.particles.point(a);
      for(std::size_t i = 0; i < dis.walls.size(); ++i)
      {
        const PlaneWall &wall = dis.walls[i];
        if(!beside(wall, place))
          continue;
        images.push_back({a, inner_of(a, wall), driven(wall), mirrored(wall, place)});
        for(std::size_t j = i + 1; j < dis.walls.size(); ++j)
          if(const PlaneWall &other = dis.walls[j];
             other.direction != wall.direction && beside(other, place))
            images.push_back({a, inner_of(a, driven(wall) ? wall : other),
                              driven(wall) || driven(other),
                              mirrored(other, mirrored(wall, place))});
      }
    }
  }

  /**
   * Insulated walls mirror the phases. A front sets out from a wall that lets heat
   * through, and ends there: beyond a particle that melts there is the phase that its
   * inner neighbour has less of.
   */
  double FrontPlanes::fraction_of(const Image &image) const
  {
    const double own = fraction[image.of], inner = fraction[image.inner];
    if(!image.driven || own == 0 || own == 1 || own == inner)
      return own;
    return inner < own ? 1 : 0;
  }

  void FrontPlanes::update(std::span<const std::uint32_t> slices, const double *enthalpy,
                           double latent_heat)
  {
    constexpr std::size_t lanes = ParticleOperator::lanes;
    const std::size_t n = lines.size();
    for(std::size_t a = 0; a < n; ++a)
      fraction[a] = 1 - std::clamp(enthalpy[a] / latent_heat, 0., 1.);
    for(std::size_t i = 0; i < images.size(); ++i)
      fraction[n + i] = fraction_of(images[i]);
    ++updates;
    const auto visit = [&](const auto &each)
    {
      for(const std::uint32_t slice : slices)
        for(std::size_t a = slice * lanes; a < std::min((slice + 1) * lanes, n); ++a)
          each(a);
    };
    visit([&](std::size_t a) { lines[a] = line_of(a); });
    visit([&](std::size_t a) { lines[a].curvature = curvature_of(a); });
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

  template <typename Visit>
  void FrontPlanes::visit_lines(std::size_t a, const Visit &visit) const
  {
    for(std::size_t i = offsets[a]; i < offsets[a + 1]; ++i)
    {
      if(links[i].neighbour >= lines.size()) // an image
        continue;
      const Line &other = lines[links[i].neighbour];
      if(other.update == updates && other.length > 0)
        visit(links[i], other);
    }
  }

  double FrontPlanes::curvature_of(std::size_t a) const
  {
    const Line &own = lines[a];
    if(own.length == 0)
      return 0;
    double count = 1, q = 0, r = 0, qq = 0, qr = 0;
    visit_lines(a,
                [&](const Link &link, const Line &other)
                {
                  const double along = own.normal_x * link.x + own.normal_y * link.y;
                  const double tangent = own.normal_x * link.y - own.normal_y * link.x;
                  const double bend = tangent * tangent / 2;
                  const double rest = other.distance - own.distance - along;
                  ++count;
                  q += bend;
                  r += rest;
                  qq += bend * bend;
                  qr += bend * rest;
                });
    const double spread = count * qq - q * q;
    if(!(spread > 1e-9))
      return 0;
    return std::clamp((count * qr - q * r) / spread, -most_curved, most_curved);
  }

  /**
   * How far the middle of the arc lies beyond its line, towards the liquid. The curvature
   * is the mean of the neighbours': that of one particle would feed rows that melt in
   * turns, every other one ahead, and hold the front back.
   */
  double FrontPlanes::beyond_line(std::size_t a) const
  {
    const Line &own = lines[a];
    if(own.length == 0)
      return 0;
    double count = 1, sum = own.curvature;
    visit_lines(a,
                [&](const Link &, const Line &other)
                {
                  ++count;
                  sum += other.curvature;
                });
    return sum / count * own.length * own.length / 24;
  }

  std::size_t FrontPlanes::bytes() const
  {
    return offsets.size() * sizeof(offsets[0]) + links.size() * sizeof(Link)
           + (fraction.size() + distances.size()) * sizeof(double)
           + lines.size() * sizeof(Line) + images.size() * sizeof(Image);
  }
} // namespace meltfront::particles
