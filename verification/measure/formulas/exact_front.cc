#include <cases/shape.h>
#include <cases/velocity_field.h>
#include <verification/measure/formulas/exact_front.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using cases::Position;

    constexpr int cells_along_side = 400;
    constexpr int most_halvings = 14;

    double distance(const Position &a, const Position &b)
    {
      return std::hypot(a[0] - b[0], a[1] - b[1]);
    }

    Position between(const Position &a, const Position &b, double share)
    {
      return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), 0};
    }

    /** Where a square is cut: the ends of up to two pieces. */
    std::vector<Position> cuts(const std::array<Position, 4> &corners,
                               const std::array<double, 4> &values)
    {
      std::vector<Position> points;
      for(std::size_t i = 0; i < 4; ++i)
      {
        const std::size_t next = (i + 1) % 4;
        if((values[i] > 0) != (values[next] > 0))
          points.push_back(
              between(corners[i], corners[next], values[i] / (values[i] - values[next])));
      }
      return points;
    }

    /** The edge at the start. */
    std::vector<FrontPiece> edge_of(const cases::Shape &shape,
                                    const cases::Domain &domain)
    {
      const double cell = domain.side() / cells_along_side;
      const int columns = cells_along_side;
      const int rows = static_cast<int>(
          std::ceil((domain.upper[1] - domain.lower[1]) / cell - 1e-9));
      const auto corner = [&](int i, int j) {
        return Position{domain.lower[0] + i * cell, domain.lower[1] + j * cell, 0};
      };
      std::vector<double> values((columns + 1) * (rows + 1));
      for(int j = 0; j <= rows; ++j)
        for(int i = 0; i <= columns; ++i)
          values[j * (columns + 1) + i] = shape.signed_distance(corner(i, j));
      std::vector<FrontPiece> pieces;
      for(int j = 0; j < rows; ++j)
        for(int i = 0; i < columns; ++i)
        {
          const double *row = values.data() + j * (columns + 1) + i;
          const double *above = row + columns + 1;
          const auto points = cuts(
              {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)},
              {row[0], row[1], above[1], above[0]});
          for(std::size_t p = 0; p + 1 < points.size(); p += 2)
            pieces.push_back({points[p], points[p + 1]});
        }
      return pieces;
    }

    /** Follows pieces of the edge to where they are at a time. */
    class Follower
    {
    public:
      Follower(const cases::Scene &scene, double time, double longest)
        : velocity(*scene.interface->velocity)
        , start(scene.start_time)
        , time(time)
        , longest(longest)
      {
      }

      void follow(const FrontPiece &piece)
      {
        follow(piece, {carried(piece.begin), carried(piece.end)}, 0);
      }

      std::vector<FrontPiece> pieces;

    private:
      Position carried(const Position &point) const
      {
        return time == start ? point : velocity.carried(point, start, time, 2);
      }

      void follow(const FrontPiece &before, const FrontPiece &now, int halvings)
      {
        if(halvings == most_halvings || distance(now.begin, now.end) <= longest)
        {
          pieces.push_back(now);
          return;
        }
        const Position middle = between(before.begin, before.end, 0.5);
        const Position there = carried(middle);
        follow({before.begin, middle}, {now.begin, there}, halvings + 1);
        follow({middle, before.end}, {there, now.end}, halvings + 1);
      }

      const cases::VelocityField &velocity;
      double start, time, longest;
    };
  } // namespace

  std::vector<FrontPiece> exact_front_pieces(const cases::Scene &scene, double time,
                                             double longest)
  {
    Follower follower(scene, time, longest);
    for(const FrontPiece &piece : edge_of(*scene.interface->shape, scene.domain))
      follower.follow(piece);
    return follower.pieces;
  }
} // namespace meltfront::verification
