#include <verification/measure/formulas/site_coordinates.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::verification
{
  cases::Position site_position(const cases::Snapshot &snapshot, std::size_t site)
  {
    cases::Position position{};
    for(int d = 0; d < snapshot.dimension; ++d)
      position[d] = snapshot.positions[d][site];
    return position;
  }

  std::string place_text(const cases::Position &place, int dimension)
  {
    std::string text;
    for(int d = 0; d < dimension; ++d)
      text += fmt::format("{}{:.6g}", d == 0 ? "" : ", ", place[d]);
    return dimension == 1 ? "x = " + text : "(" + text + ")";
  }

  SiteCoordinates::SiteCoordinates(cases::Symmetry symmetry)
    : symmetry(symmetry)
  {
  }

  bool SiteCoordinates::moved(const cases::Snapshot &snapshot) const
  {
    if(coordinates.size() != snapshot.temperature.size())
      return true;
    for(int d = 0; d < snapshot.dimension; ++d)
      if(!std::ranges::equal(positions[d], snapshot.positions[d]))
        return true;
    return false;
  }

  const std::vector<double> &SiteCoordinates::of(const cases::Snapshot &snapshot)
  {
    if(moved(snapshot))
    {
      ++times_computed;
      for(int d = 0; d < snapshot.dimension; ++d)
        positions[d].assign(snapshot.positions[d].begin(), snapshot.positions[d].end());
      coordinates.resize(snapshot.temperature.size());
      for(std::size_t i = 0; i < coordinates.size(); ++i)
        coordinates[i] = cases::coordinate(symmetry, site_position(snapshot, i));
    }
    return coordinates;
  }

  long SiteCoordinates::version() const
  {
    return times_computed;
  }
} // namespace meltfront::verification
