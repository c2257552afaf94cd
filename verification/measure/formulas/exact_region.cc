#include <cases/velocity_field.h>
#include <verification/measure/formulas/exact_region.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  using cases::Position;

  namespace
  {
    Position difference(const Position &a, const Position &b, double scale)
    {
      return {(a[0] - b[0]) / scale, (a[1] - b[1]) / scale, (a[2] - b[2]) / scale};
    }

    /** Taken from where the corners of a large frame go. */
    RigidMap rigid_map(const cases::Scene &scene, double time)
    {
      const int dimension = scene.domain.dimension;
      const double side = scene.domain.side();
      const auto back = [&](const Position &point) {
        return scene.interface->velocity->carried(point, time, scene.start_time,
                                                  dimension);
      };
      RigidMap map;
      map.shift = back({});
      for(int d = 0; d < dimension; ++d)
      {
        Position corner{};
        corner[d] = side;
        map.columns[d] = difference(back(corner), map.shift, side);
      }
      return map;
    }

    bool all_are_back(const cases::Scene &scene, double time)
    {
      constexpr int points = 64;
      const cases::Domain &domain = scene.domain;
      // Multiples of the golden ratio's kind spread evenly (Roberts 2018).
      constexpr double steps[]
          = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
      for(int i = 1; i <= points; ++i)
      {
        Position point{};
        for(int d = 0; d < domain.dimension; ++d)
          point[d] = domain.lower[d]
                     + (i * steps[d] - std::floor(i * steps[d]))
                           * (domain.upper[d] - domain.lower[d]);
        const Position start = scene.interface->velocity->carried(
            point, time, scene.start_time, domain.dimension);
        const Position way = difference(start, point, domain.side());
        if(std::hypot(way[0], way[1], way[2]) > 1e-8)
          return false;
      }
      return true;
    }
  } // namespace

  Position RigidMap::operator()(const Position &point) const
  {
    Position result = shift;
    for(int d = 0; d < 3; ++d)
      for(int i = 0; i < 3; ++i)
        result[i] += columns[d][i] * point[d];
    return result;
  }

  Position RigidMap::turned_back(const Position &direction) const
  {
    Position result{};
    for(int d = 0; d < 3; ++d)
      for(int i = 0; i < 3; ++i)
        result[d] += columns[d][i] * direction[i];
    return result;
  }

  std::optional<RigidMap> way_back(const cases::Scene &scene, double time)
  {
    if(time == scene.start_time)
      return RigidMap();
    if(scene.interface->velocity->rigid())
      return rigid_map(scene, time);
    return all_are_back(scene, time) ? std::optional(RigidMap()) : std::nullopt;
  }

  EnclosedRows::EnclosedRows(const std::vector<FrontPiece> &pieces, double first,
                             double step, int rows)
    : crossings(rows)
  {
    for(const FrontPiece &piece : pieces)
    {
      const Position &low = piece.begin[1] < piece.end[1] ? piece.begin : piece.end;
      const Position &high = piece.begin[1] < piece.end[1] ? piece.end : piece.begin;
      // Rows with low <= height < high: a row through a common end counts once.
      const int from = std::max(0, static_cast<int>(std::ceil((low[1] - first) / step)));
      for(int row = from; row < rows && first + row * step < high[1]; ++row)
        crossings[row].push_back(low[0]
                                 + (first + row * step - low[1]) * (high[0] - low[0])
                                       / (high[1] - low[1]));
    }
    for(std::vector<double> &row : crossings)
      std::ranges::sort(row);
  }

  bool EnclosedRows::closed() const
  {
    return std::ranges::all_of(crossings, [](const std::vector<double> &row)
                               { return row.size() % 2 == 0; });
  }

  bool EnclosedRows::inside(int row, double x) const
  {
    const std::vector<double> &all = crossings[row];
    return (std::ranges::upper_bound(all, x) - all.begin()) % 2 == 1;
  }
} // namespace meltfront::verification
