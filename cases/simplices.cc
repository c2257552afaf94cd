#include <cases/simplices.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace meltfront::cases
{
  namespace
  {
    Position difference(const Position &a, const Position &b)
    {
      return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    }

    Position cross(const Position &a, const Position &b)
    {
      return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
              a[0] * b[1] - a[1] * b[0]};
    }

    double dot(const Position &a, const Position &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    double norm(const Position &a)
    {
      return std::sqrt(dot(a, a));
    }

    Position middle(const Position &a, const Position &b)
    {
      return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
    }

    /** Equal parts: halves of an edge; four triangles; eight tetrahedra (Bey 1995), of
     * which four share a diagonal of the octahedron in the middle. */
    std::vector<Simplex> parts_of(const Simplex &s)
    {
      const auto m = [&s](std::size_t a, std::size_t b) { return middle(s[a], s[b]); };
      switch(s.size())
      {
      case 2:
        return {{s[0], m(0, 1)}, {m(0, 1), s[1]}};
      case 3:
        return {{s[0], m(0, 1), m(0, 2)},
                {m(0, 1), s[1], m(1, 2)},
                {m(0, 2), m(1, 2), s[2]},
                {m(0, 1), m(1, 2), m(0, 2)}};
      default:
        return {
            {s[0], m(0, 1), m(0, 2), m(0, 3)},    {m(0, 1), s[1], m(1, 2), m(1, 3)},
            {m(0, 2), m(1, 2), s[2], m(2, 3)},    {m(0, 3), m(1, 3), m(2, 3), s[3]},
            {m(0, 1), m(0, 2), m(0, 3), m(1, 3)}, {m(0, 1), m(0, 2), m(1, 2), m(1, 3)},
            {m(0, 2), m(0, 3), m(1, 3), m(2, 3)}, {m(0, 2), m(1, 2), m(1, 3), m(2, 3)}};
      }
    }

    double distance_from_edge(const Position &a, const Position &b, const Position &point)
    {
      const Position along = difference(b, a), to = difference(point, a);
      const double square = dot(along, along);
      const double share = square > 0 ? std::clamp(dot(to, along) / square, 0., 1.) : 0;
      return norm(
          {to[0] - share * along[0], to[1] - share * along[1], to[2] - share * along[2]});
    }
  } // namespace

  double measure_of(const Simplex &simplex)
  {
    switch(simplex.size())
    {
    case 1:
      return 1;
    case 2:
      return norm(difference(simplex[1], simplex[0]));
    case 3:
      return norm(cross(difference(simplex[1], simplex[0]),
                        difference(simplex[2], simplex[0])))
             / 2;
    default:
      return std::abs(signed_measure(simplex));
    }
  }

  double signed_measure(const Simplex &simplex)
  {
    const Position a = difference(simplex[1], simplex[0]),
                   b = difference(simplex[2], simplex[0]);
    if(simplex.size() == 3)
      return (a[0] * b[1] - a[1] * b[0]) / 2;
    return dot(cross(a, b), difference(simplex[3], simplex[0])) / 6;
  }

  bool holds_point(const Simplex &simplex, const Position &point)
  {
    constexpr double round_off = 1e-10;
    const double all = signed_measure(simplex);
    for(std::size_t corner = 0; corner < simplex.size(); ++corner)
    {
      Simplex part = simplex;
      part[corner] = point;
      if(!(signed_measure(part) / all >= -round_off))
        return false;
    }
    return true;
  }

  double distance_from(const Simplex &simplex, const Position &point)
  {
    if(simplex.size() == 2)
      return distance_from_edge(simplex[0], simplex[1], point);
    const Position normal
        = cross(difference(simplex[1], simplex[0]), difference(simplex[2], simplex[0]));
    double result = std::numeric_limits<double>::infinity();
    bool above = true;
    for(std::size_t a = 0; a < 3; ++a)
    {
      const Position &from = simplex[a], &to = simplex[(a + 1) % 3];
      above = above
              && dot(cross(normal, difference(to, from)), difference(point, from)) >= 0;
      result = std::min(result, distance_from_edge(from, to, point));
    }
    const double area = norm(normal);
    return above && area > 0 ? std::abs(dot(normal, difference(point, simplex[0]))) / area
                             : result;
  }

  void visit_parts(const Simplex &simplex, int levels,
                   const std::function<void(const Position &, double measure)> &visit)
  {
    if(levels > 0 && simplex.size() > 1)
    {
      for(const Simplex &part : parts_of(simplex))
        visit_parts(part, levels - 1, visit);
      return;
    }
    Position centroid{};
    for(std::size_t a = 0; a < simplex.size(); ++a)
      for(int d = 0; d < 3; ++d)
        centroid[d] += simplex[a][d] / static_cast<double>(simplex.size());
    visit(centroid, measure_of(simplex));
  }
} // namespace meltfront::cases
