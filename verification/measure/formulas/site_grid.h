#ifndef meltfront_verification_measure_formulas_site_grid_h
#define meltfront_verification_measure_formulas_site_grid_h

#include <cases/position.h>
#include <cases/snapshot.h>
#include <verification/measure/formulas/site_coordinates.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace meltfront::verification
{
  /** The sites of a snapshot sorted into cubes, to find those near a place. */
  class SiteGrid
  {
  public:
    /** @param width of the cubes (m) */
    SiteGrid(const cases::Snapshot &snapshot, double width)
      : dimension(snapshot.dimension)
      , width(width)
    {
      for(std::size_t i = 0; i < snapshot.temperature.size(); ++i)
        members[cube(site_position(snapshot, i))].push_back(
            static_cast<std::uint32_t>(i));
    }

    /** Visit the sites of the cubes around a place: all that are nearer than a width, and
     * some beyond. */
    template <typename Visit>
    void visit(const cases::Position &place, const Visit &visitor) const
    {
      const Cube centre = cube(place);
      const int reach_y = dimension > 1, reach_z = dimension > 2;
      for(int k = -reach_z; k <= reach_z; ++k)
        for(int j = -reach_y; j <= reach_y; ++j)
          for(int i = -1; i <= 1; ++i)
          {
            const auto found
                = members.find({centre[0] + i, centre[1] + j, centre[2] + k});
            if(found == members.end())
              continue;
            for(const std::uint32_t site : found->second)
              visitor(site);
          }
    }

  private:
    using Cube = std::array<long, 3>;

    Cube cube(const cases::Position &place) const
    {
      Cube result{};
      for(int d = 0; d < dimension; ++d)
        result[d] = static_cast<long>(std::floor(place[d] / width));
      return result;
    }

    int dimension;
    double width;
    std::map<Cube, std::vector<std::uint32_t>> members;
  };
} // namespace meltfront::verification

#endif
