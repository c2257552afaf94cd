#include <particles/sph/bent_walls.h>
#include <particles/sph/outline_shares.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace meltfront::particles
{
  namespace
  {
    /** Lengths along an outline between which it is smooth, then divided evenly. */
    std::vector<double> ends_of_pieces(const cases::Outline &outline, double longest)
    {
      std::vector<double> corners = outline.corner_arc_lengths();
      if(corners.empty())
        corners.push_back(0);
      std::vector<double> ends{corners.front()};
      for(std::size_t i = 0; i < corners.size(); ++i)
      {
        const double begin = corners[i],
                     end = i + 1 < corners.size() ? corners[i + 1]
                                                  : corners.front() + outline.perimeter();
        const int pieces = static_cast<int>(std::ceil((end - begin) / longest));
        for(int piece = 1; piece <= pieces; ++piece)
          ends.push_back(begin + (end - begin) * piece / pieces);
      }
      return ends;
    }

    /** Crossings by their lengths along an outline. */
    class CrossingsAlong
    {
    public:
      CrossingsAlong(const cases::Outline &outline,
                     const std::vector<OutlineCrossing> &crossings)
        : crossings(crossings)
        , perimeter(outline.perimeter())
      {
        for(std::size_t i = 0; i < crossings.size(); ++i)
          along.emplace_back(outline.arc_length_at(crossings[i].place), i);
        std::ranges::sort(along);
      }

      /** Strengths by particle of what crosses nearer to a length than a reach, each the
       * less the farther. */
      std::map<std::uint32_t, double> near(double length, double reach) const
      {
        std::map<std::uint32_t, double> result;
        for(const double turn : {-perimeter, 0., perimeter})
          for(auto entry
              = std::ranges::lower_bound(along, length + turn - reach, {},
                                         &std::pair<double, std::size_t>::first);
              entry != along.end() && entry->first < length + turn + reach; ++entry)
          {
            const OutlineCrossing &crossing = crossings[entry->second];
            const double distance = std::abs(entry->first - length - turn);
            if(crossing.strength > 0)
              result[crossing.particle] += crossing.strength * (1 - distance / reach);
          }
        return result;
      }

    private:
      const std::vector<OutlineCrossing> &crossings;
      double perimeter;
      std::vector<std::pair<double, std::size_t>> along;
    };
  } // namespace

  std::vector<OutlineShare> share_outline(const Discretisation &dis,
                                          const std::vector<OutlineCrossing> &crossings)
  {
    const cases::Outline &outline = *dis.scene.domain.outline;
    const CrossingsAlong along(outline, crossings);
    const std::vector<double> ends = ends_of_pieces(outline, dis.spacing / 2);
    std::vector<OutlineShare> result;
    for(std::size_t piece = 0; piece + 1 < ends.size(); ++piece)
    {
      const double length = ends[piece + 1] - ends[piece],
                   middle = (ends[piece] + ends[piece + 1]) / 2;
      const cases::Outline::Edge edge = outline.nearest_edge(outline.at(middle));
      std::map<std::uint32_t, double> strengths;
      // A tip may hold no particle: then those about it take its heat.
      for(double reach = dis.spacing; strengths.empty() && reach < outline.perimeter();
          reach *= 2)
        strengths = along.near(std::fmod(middle, outline.perimeter()), reach);
      double all = 0;
      for(const auto &[particle, strength] : strengths)
        all += strength;
      for(const auto &[particle, strength] : strengths)
      {
        const cases::Position own = dis.particles.point(particle);
        const double depth = edge.normal[0] * (edge.place[0] - own[0])
                             + edge.normal[1] * (edge.place[1] - own[1]);
        result.push_back({particle, edge.place, length * strength / all,
                          std::max(depth, shallowest_depth * dis.spacing)});
      }
    }
    return result;
  }
} // namespace meltfront::particles
