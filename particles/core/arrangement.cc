#include <cases/error.h>
#include <particles/core/arrangement.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace meltfront::particles
{
  namespace
  {
    /** Particles are numbered by 32 bits. */
    constexpr double most_particles = std::numeric_limits<std::uint32_t>::max();

    void require_numbers(double particles)
    {
      if(!(particles <= most_particles))
        throw cases::Refusal(
            fmt::format("{:.3g} particles would be needed, and at most {:.3g} can be "
                        "numbered: take a smaller n",
                        particles, most_particles));
    }

    std::vector<double> lattice_line(const LatticeDirection &direction, double spacing)
    {
      const double spacings = (direction.upper - direction.lower) / spacing;
      const double whole = std::round(spacings);
      require_numbers(whole + 1);
      if(whole < 1 || std::abs(spacings - whole) > 1e-6)
        throw cases::InputError(fmt::format(
            "a side of {:.6g} m is {:.6g} particle spacings of {:.6g} m long, which is "
            "not a whole number",
            direction.upper - direction.lower, spacings, spacing));
      const bool centred = direction.layout == LatticeLayout::cell_centred;
      std::vector<double> line(static_cast<std::size_t>(whole) + (centred ? 0 : 1));
      // Measured from the middle: opposite particles get coordinates that are opposite
      // to the last bit, so that a symmetric scene stays symmetric.
      const double middle = 0.5 * (direction.lower + direction.upper);
      for(std::size_t i = 0; i < line.size(); ++i)
        line[i] = middle + 0.5 * (2. * i - (line.size() - 1.)) * spacing;
      return line;
    }
  } // namespace

  double lattice_spacing(double length, int n, LatticeLayout layout)
  {
    const int spacings = layout == LatticeLayout::cell_centred ? n : n - 1;
    if(spacings < 4)
      throw cases::InputError(
          fmt::format("n = {} gives fewer than four particle spacings on a side", n));
    return length / spacings;
  }

  ParticleStorage arrange_in_box(int dimension,
                                 const std::array<LatticeDirection, 3> &directions,
                                 double spacing)
  {
    std::array<std::vector<double>, 3> line{{{0.}, {0.}, {0.}}};
    for(int d = 0; d < dimension; ++d)
      line[d] = lattice_line(directions[d],
                             directions[d].spacing > 0 ? directions[d].spacing : spacing);
    require_numbers(double(line[0].size()) * line[1].size() * line[2].size());
    ParticleStorage particles{dimension, {}};
    for(const double z : line[2])
      for(const double y : line[1])
        for(const double x : line[0])
          particles.add({x, y, z});
    return particles;
  }

  ParticleStorage arrange_in_shell(int dimension, double inner, double outer,
                                   double spacing, LatticeLayout layout)
  {
    require_numbers(std::pow(2 * (outer / spacing + 2), dimension));
    const double offset = layout == LatticeLayout::cell_centred ? 0.5 : 0;
    const int reach = static_cast<int>(std::ceil(outer / spacing)) + 1;
    const int reach_y = dimension > 1 ? reach : 0, reach_z = dimension > 2 ? reach : 0;
    const double slack = 1e-12 * outer;
    ParticleStorage particles{dimension, {}};
    for(int k = -reach_z; k <= reach_z; ++k)
      for(int j = -reach_y; j <= reach_y; ++j)
        for(int i = -reach; i <= reach; ++i)
        {
          const std::array<double, 3> point{(i + offset) * spacing,
                                            dimension > 1 ? (j + offset) * spacing : 0,
                                            dimension > 2 ? (k + offset) * spacing : 0};
          const double distance = std::hypot(point[0], point[1], point[2]);
          if(distance >= inner - slack && distance < outer - slack)
            particles.add(point);
        }
    return particles;
  }

  void jitter(ParticleStorage &particles, double amplitude, std::uint64_t seed,
              const std::function<bool(const std::array<double, 3> &)> &movable)
  {
    std::mt19937_64 generator(seed);
    for(std::size_t i = 0; i < particles.size(); ++i)
    {
      const bool moves = movable(particles.point(i));
      for(int d = 0; d < particles.dimension; ++d)
      {
        // Drawn for every particle, so that one that stays does not shift the others'.
        const double uniform = static_cast<double>(generator() >> 11) * 0x1p-53;
        if(moves)
          particles.position[d][i] += amplitude * (2 * uniform - 1);
      }
    }
  }

  void scatter(ParticleStorage &particles, std::span<const std::uint32_t> chosen,
               const std::array<double, 3> &lower, const std::array<double, 3> &upper,
               std::uint64_t seed)
  {
    std::mt19937_64 generator(seed);
    for(const std::uint32_t i : chosen)
      for(int d = 0; d < particles.dimension; ++d)
      {
        const double uniform = static_cast<double>(generator() >> 11) * 0x1p-53;
        particles.position[d][i] = lower[d] + (upper[d] - lower[d]) * uniform;
      }
  }
} // namespace meltfront::particles
