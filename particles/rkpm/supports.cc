#include <cases/error.h>
#include <particles/core/neighbour_list.h>
#include <particles/rkpm/supports.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace meltfront::particles::rkpm
{
  namespace
  {
    struct Row
    {
      std::vector<std::uint32_t> neighbours;
      double dilation = 0;
    };

    double squared_distance(const ParticleStorage &points, std::size_t point,
                            const ParticleStorage &particles, std::size_t particle)
    {
      double squared = 0;
      for(int d = 0; d < points.dimension; ++d)
      {
        const double difference
            = particles.position[d][particle] - points.position[d][point];
        squared += difference * difference;
      }
      return squared;
    }

    ParticleStorage subset(const ParticleStorage &points,
                           std::span<const std::uint32_t> chosen)
    {
      ParticleStorage result;
      result.dimension = points.dimension;
      for(int d = 0; d < points.dimension; ++d)
        for(const std::uint32_t point : chosen)
          result.position[d].push_back(points.position[d][point]);
      return result;
    }

    void find_within(const ParticleStorage &points, const ParticleStorage &particles,
                     std::span<const std::uint32_t> chosen, double dilation,
                     std::vector<Row> &rows)
    {
      const NeighbourList list(subset(points, chosen), particles, dilation);
      for(std::size_t i = 0; i < chosen.size(); ++i)
        rows[chosen[i]]
            = {std::vector<std::uint32_t>(list[i].begin(), list[i].end()), dilation};
    }

    /** Radius of a ball that holds a number of particles, were they spread evenly over
     * the box around them. */
    double even_radius(const ParticleStorage &particles, int number)
    {
      double volume = 1, longest = 0;
      for(int d = 0; d < particles.dimension; ++d)
      {
        const auto [low, high] = std::minmax_element(particles.position[d].begin(),
                                                     particles.position[d].end());
        volume *= *high - *low;
        longest = std::max(longest, *high - *low);
      }
      const double share = double(number) / double(particles.size());
      switch(volume > 0 ? particles.dimension : 1)
      {
      case 1:
        return longest * share / 2;
      case 2:
        return std::sqrt(volume * share / std::numbers::pi);
      default:
        return std::cbrt(volume * share * 3 / (4 * std::numbers::pi));
      }
    }

    /** The nearest of the candidates, and the distance of the next as dilation. Equal
     * distances are ordered by number. */
    Row nearest(const ParticleStorage &points, std::size_t point,
                const ParticleStorage &particles,
                std::span<const std::uint32_t> candidates, std::size_t number,
                std::vector<std::pair<double, std::uint32_t>> &distances)
    {
      distances.clear();
      for(const std::uint32_t particle : candidates)
        distances.emplace_back(squared_distance(points, point, particles, particle),
                               particle);
      const auto next = distances.begin() + static_cast<std::ptrdiff_t>(number);
      std::nth_element(distances.begin(), next, distances.end());
      Row row;
      row.dilation = std::sqrt(next->first);
      for(auto entry = distances.begin(); entry != next; ++entry)
        if(entry->first < next->first)
          row.neighbours.push_back(entry->second);
      std::sort(row.neighbours.begin(), row.neighbours.end());
      return row;
    }

    void find_nearest(const ParticleStorage &points, const ParticleStorage &particles,
                      std::vector<std::uint32_t> pending, std::size_t number,
                      std::vector<Row> &rows)
    {
      if(number >= particles.size())
        throw cases::InputError(fmt::format(
            "supports of {} neighbours need at least {} particles, there are {}", number,
            number + 1, particles.size()));
      // At a wall about half of the ball is empty, in a corner more.
      double radius = even_radius(particles, static_cast<int>(2 * (number + 1)));
      if(!(radius > 0))
        throw cases::InputError("supports cannot be found: the particles all lie at one "
                                "place, or a position is not finite");
      std::vector<std::pair<double, std::uint32_t>> distances;
      for(; !pending.empty(); radius *= 1.5)
      {
        const NeighbourList list(subset(points, pending), particles, radius);
        std::vector<std::uint32_t> left;
        for(std::size_t i = 0; i < pending.size(); ++i)
          if(list[i].size() > number)
            rows[pending[i]]
                = nearest(points, pending[i], particles, list[i], number, distances);
          else
            left.push_back(pending[i]);
        pending.swap(left);
      }
    }

    Supports compress(const std::vector<Row> &rows)
    {
      Supports supports;
      supports.offsets.push_back(0);
      for(const Row &row : rows)
      {
        supports.neighbours.insert(supports.neighbours.end(), row.neighbours.begin(),
                                   row.neighbours.end());
        supports.offsets.push_back(supports.neighbours.size());
        supports.dilation.push_back(row.dilation);
      }
      return supports;
    }

    void require_finite(const ParticleStorage &points)
    {
      for(int d = 0; d < points.dimension; ++d)
        for(const double x : points.position[d])
          if(!std::isfinite(x))
            throw cases::InputError("supports cannot be found: a position is not finite");
    }
  } // namespace

  Supports find_supports(const ParticleStorage &points, const ParticleStorage &particles,
                         const SupportSettings &settings, int basis_size,
                         std::span<const int> enlargements)
  {
    const bool fixed = settings.rule == SupportRule::fixed_dilation;
    const double base = settings.alpha * settings.spacing;
    if(fixed && !(base > 0))
      throw cases::InputError(fmt::format(
          "a fixed dilation is alpha times the spacing, both positive, not {:.6g} times "
          "{:.6g} m",
          settings.alpha, settings.spacing));
    require_finite(points);
    require_finite(particles);
    const int number = settings.neighbours > 0 ? settings.neighbours : 2 * basis_size;
    const int levels
        = enlargements.empty()
              ? 0
              : *std::max_element(enlargements.begin(), enlargements.end()) + 1;
    std::vector<Row> rows(points.size());
    for(int level = 0; level < levels; ++level)
    {
      std::vector<std::uint32_t> chosen;
      for(std::size_t point = 0; point < points.size(); ++point)
        if(enlargements[point] == level)
          chosen.push_back(point);
      if(chosen.empty())
        continue;
      double dilation = base;
      for(int i = 0; i < level; ++i)
        dilation *= enlargement_factor;
      const std::size_t wanted = number + level * ((basis_size + 1) / 2);
      if(fixed)
        find_within(points, particles, chosen, dilation, rows);
      else
        find_nearest(points, particles, std::move(chosen), wanted, rows);
    }
    return compress(rows);
  }

  Supports reach_of_neighbours(const ParticleStorage &particles,
                               std::span<const double> dilations)
  {
    std::vector<Row> rows(particles.size());
    if(!rows.empty())
    {
      const double widest = *std::max_element(dilations.begin(), dilations.end());
      const NeighbourList list(particles, particles, widest);
      for(std::size_t a = 0; a < rows.size(); ++a)
      {
        rows[a].dilation = dilations[a];
        for(const std::uint32_t b : list[a])
          if(squared_distance(particles, a, particles, b) < dilations[b] * dilations[b])
            rows[a].neighbours.push_back(b);
      }
    }
    return compress(rows);
  }
} // namespace meltfront::particles::rkpm
