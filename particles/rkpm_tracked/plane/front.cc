#include <particles/rkpm_tracked/plane/front.h>
#include <particles/rkpm_tracked/plane/spline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Of two pieces that face each other the normals have at most this cosine. */
    constexpr double facing_normals = -0.3;

    constexpr std::size_t most_crossings = 8;

    std::vector<double> lengths_along(const PlaneFront &front, std::size_t curve)
    {
      std::vector<double> knots{0};
      for(std::size_t p = front.offsets[curve]; p < front.offsets[curve + 1]; ++p)
        knots.push_back(
            knots.back()
            + (front.position[front.next(curve, p)] - front.position[p]).norm());
      return knots;
    }

    template <typename Value>
    std::span<const Value> of_curve(const PlaneFront &front, std::size_t curve,
                                    const std::vector<Value> &values)
    {
      return {values.data() + front.offsets[curve],
              front.offsets[curve + 1] - front.offsets[curve]};
    }

    PeriodicSpline<PlanePoint> spline_of(const PlaneFront &front, std::size_t curve)
    {
      return {lengths_along(front, curve), of_curve(front, curve, front.position)};
    }

    double cross(const PlanePoint &a, const PlanePoint &b)
    {
      return a.x() * b.y() - a.y() * b.x();
    }

    void update_curve(PlaneFront &front, std::size_t curve)
    {
      const auto spline = spline_of(front, curve);
      for(std::size_t p = front.offsets[curve], k = 0; p < front.offsets[curve + 1];
          ++p, ++k)
      {
        const PlanePoint slope = spline.slope(k, 0);
        const double size = slope.norm();
        front.normal[p] = PlanePoint(-slope.y(), slope.x()) / size;
        front.curvature[p] = cross(slope, spline.bend(k)) / (size * size * size);
      }
    }

    /** Replace entries first <= i < last. */
    template <typename Value>
    void replace(std::vector<Value> &values, std::size_t first, std::size_t last,
                 const std::vector<Value> &others)
    {
      values.erase(values.begin() + first, values.begin() + last);
      values.insert(values.begin() + first, others.begin(), others.end());
    }
  } // namespace

  void PlaneFront::add_curve(std::span<const PlanePoint> points)
  {
    position.insert(position.end(), points.begin(), points.end());
    normal.resize(position.size(), PlanePoint(0, 0));
    curvature.resize(position.size(), 0.);
    speed.resize(position.size(), 0.);
    displacement.resize(position.size(), PlanePoint(0, 0));
    active.resize(position.size(), 1);
    offsets.push_back(position.size());
    update_curve(*this, curves() - 1);
  }

  void PlaneFront::remove_curve(std::size_t curve)
  {
    const std::size_t first = offsets[curve], last = offsets[curve + 1];
    replace(position, first, last, {});
    replace(normal, first, last, {});
    replace(curvature, first, last, {});
    replace(speed, first, last, {});
    replace(displacement, first, last, {});
    replace(active, first, last, {});
    offsets.erase(offsets.begin() + curve + 1);
    for(std::size_t c = curve + 1; c < offsets.size(); ++c)
      offsets[c] -= last - first;
  }

  void update_geometry(PlaneFront &front)
  {
    for(std::size_t curve = 0; curve < front.curves(); ++curve)
      update_curve(front, curve);
  }

  SpacingRange spacing_range(const PlaneFront &front)
  {
    SpacingRange range{std::numeric_limits<double>::infinity(), 0};
    for(std::size_t curve = 0; curve < front.curves(); ++curve)
    {
      const std::vector<double> knots = lengths_along(front, curve);
      for(std::size_t k = 1; k < knots.size(); ++k)
      {
        range.least = std::min(range.least, knots[k] - knots[k - 1]);
        range.largest = std::max(range.largest, knots[k] - knots[k - 1]);
      }
    }
    return range;
  }

  void redistribute(PlaneFront &front, std::size_t curve, double target)
  {
    const double area = signed_area(front, curve);
    const std::vector<double> knots = lengths_along(front, curve);
    const PeriodicSpline<PlanePoint> places(knots,
                                            of_curve(front, curve, front.position)),
        displacements(knots, of_curve(front, curve, front.displacement));
    const PeriodicSpline<double> speeds(knots, of_curve(front, curve, front.speed));
    const auto count
        = std::max<std::size_t>(fewest_on_curve, std::lround(knots.back() / target));
    std::vector<PlanePoint> position, displacement;
    std::vector<double> speed;
    for(std::size_t i = 0, piece = 0; i < count; ++i)
    {
      const double at
          = knots.back() * static_cast<double>(i) / static_cast<double>(count);
      while(piece + 2 < knots.size() && knots[piece + 1] <= at)
        ++piece;
      const double share = (at - knots[piece]) / (knots[piece + 1] - knots[piece]);
      position.push_back(places.value(piece, share));
      displacement.push_back(displacements.value(piece, share));
      speed.push_back(speeds.value(piece, share));
    }
    const std::size_t first = front.offsets[curve], last = front.offsets[curve + 1];
    replace(front.position, first, last, position);
    replace(front.displacement, first, last, displacement);
    replace(front.speed, first, last, speed);
    replace(front.normal, first, last, std::vector<PlanePoint>(count));
    replace(front.curvature, first, last, std::vector<double>(count));
    replace(front.active, first, last, std::vector<char>(count, 1));
    for(std::size_t c = curve + 1; c < front.offsets.size(); ++c)
      front.offsets[c] = front.offsets[c] + count - (last - first);
    update_curve(front, curve);
    // Cut corners are given back, so that redistribution melts and freezes nothing.
    restore_area(front, curve, area);
  }

  std::size_t redistribute(PlaneFront &front, double target, double least, double largest)
  {
    std::size_t changed = 0;
    for(std::size_t curve = 0; curve < front.curves(); ++curve)
    {
      const std::vector<double> knots = lengths_along(front, curve);
      bool leaves = false;
      for(std::size_t k = 1; k < knots.size(); ++k)
      {
        const double share = (knots[k] - knots[k - 1]) / target;
        leaves = leaves || share < least || share > largest;
      }
      // On the smallest curves the fewest particles stand closer than the target.
      const bool smallest = knots.size() == fewest_on_curve + 1
                            && knots.back() < fewest_on_curve * target;
      if(!leaves || smallest)
        continue;
      redistribute(front, curve, target);
      ++changed;
    }
    return changed;
  }

  double signed_area(const PlaneFront &front, std::size_t curve)
  {
    // Gauss points make the area of the cubic pieces exact.
    constexpr double nodes[] = {0.1127016653792583, 0.5, 0.8872983346207417};
    constexpr double weights[] = {5. / 18, 8. / 18, 5. / 18};
    const auto spline = spline_of(front, curve);
    const std::vector<double> knots = lengths_along(front, curve);
    const PlanePoint origin = front.position[front.offsets[curve]];
    double area = 0;
    for(std::size_t k = 0; k + 1 < knots.size(); ++k)
      for(int g = 0; g < 3; ++g)
        area += weights[g] * (knots[k + 1] - knots[k])
                * cross(spline.value(k, nodes[g]) - origin, spline.slope(k, nodes[g]))
                / 2;
    return area;
  }

  void restore_area(PlaneFront &front, std::size_t curve, double area)
  {
    const double shift = (area - signed_area(front, curve)) / curve_length(front, curve);
    for(std::size_t p = front.offsets[curve]; p < front.offsets[curve + 1]; ++p)
      front.position[p] -= shift * front.normal[p];
    update_curve(front, curve);
  }

  double curve_length(const PlaneFront &front, std::size_t curve)
  {
    return lengths_along(front, curve).back();
  }

  FrontPolygon::FrontPolygon(const PlaneFront &front, int parts)
  {
    for(std::size_t curve = 0; curve < front.curves(); ++curve)
    {
      const auto spline = spline_of(front, curve);
      const std::size_t pieces = front.offsets[curve + 1] - front.offsets[curve];
      for(std::size_t k = 0; k < pieces; ++k)
        for(int part = 0; part < parts; ++part)
          vertices.push_back(spline.value(k, static_cast<double>(part) / parts));
      offsets.push_back(vertices.size());
    }
  }

  std::vector<PlanePoint> along_polygon(const PlaneFront &front,
                                        const std::vector<PlanePoint> &values)
  {
    constexpr int parts = FrontIndex::parts_of_piece;
    std::vector<PlanePoint> result;
    for(std::size_t curve = 0; curve < front.curves(); ++curve)
    {
      const PeriodicSpline<PlanePoint> spline(lengths_along(front, curve),
                                              of_curve(front, curve, values));
      const std::size_t pieces = front.offsets[curve + 1] - front.offsets[curve];
      for(std::size_t k = 0; k < pieces; ++k)
        for(int part = 0; part < parts; ++part)
          result.push_back(spline.value(k, static_cast<double>(part) / parts));
    }
    return result;
  }

  FrontIndex::FrontIndex(const PlaneFront &front, bool solid_beyond, double cell)
    : polygon(front, parts_of_piece)
    , solid_beyond(solid_beyond)
    , cell(cell)
    , bins(polygon.vertices, cell)
  {
    following.resize(polygon.vertices.size());
    for(std::size_t c = 0; c + 1 < polygon.offsets.size(); ++c)
      for(std::size_t v = polygon.offsets[c]; v < polygon.offsets[c + 1]; ++v)
        following[v] = static_cast<std::uint32_t>(
            v + 1 < polygon.offsets[c + 1] ? v + 1 : polygon.offsets[c]);
    if(polygon.vertices.empty())
      return;
    double top = bottom = polygon.vertices.front().y();
    for(std::size_t v = 0; v < following.size(); ++v)
    {
      bottom = std::min(bottom, polygon.vertices[v].y());
      top = std::max(top, polygon.vertices[v].y());
      longest = std::max(longest,
                         (polygon.vertices[following[v]] - polygon.vertices[v]).norm());
    }
    const auto bands = static_cast<std::size_t>((top - bottom) / cell) + 1;
    const auto band = [&](double y)
    { return std::min(static_cast<std::size_t>((y - bottom) / cell), bands - 1); };
    const auto each = [&](auto &&use)
    {
      for(std::size_t v = 0; v < following.size(); ++v)
      {
        const auto [low, high]
            = std::minmax(polygon.vertices[v].y(), polygon.vertices[following[v]].y());
        for(std::size_t b = band(low); b <= band(high); ++b)
          use(b, v);
      }
    };
    band_offsets.assign(bands + 1, 0);
    each([&](std::size_t b, std::size_t) { ++band_offsets[b + 1]; });
    for(std::size_t b = 1; b <= bands; ++b)
      band_offsets[b] += band_offsets[b - 1];
    band_pieces.resize(band_offsets.back());
    std::vector<std::size_t> next(band_offsets.begin(), band_offsets.end() - 1);
    each([&](std::size_t b, std::size_t v)
         { band_pieces[next[b]++] = static_cast<std::uint32_t>(v); });
  }

  int FrontIndex::winding(const PlanePoint &place) const
  {
    int winding = solid_beyond ? 1 : 0;
    const double level = (place.y() - bottom) / cell;
    if(level >= 0 && level < static_cast<double>(band_offsets.size()))
    {
      const auto band = static_cast<std::size_t>(level);
      for(std::size_t i = band + 1 < band_offsets.size() ? band_offsets[band] : 0;
          band + 1 < band_offsets.size() && i < band_offsets[band + 1]; ++i)
      {
        const PlanePoint &a = polygon.vertices[band_pieces[i]],
                         &b = polygon.vertices[following[band_pieces[i]]];
        const bool upwards = a.y() <= place.y() && b.y() > place.y();
        const bool downwards = b.y() <= place.y() && a.y() > place.y();
        if(!upwards && !downwards)
          continue;
        const double side = cross(b - a, place - a);
        if(upwards && side > 0)
          ++winding;
        if(downwards && side < 0)
          --winding;
      }
    }
    return winding;
  }

  FrontPlace FrontIndex::closest(const PlanePoint &place, double reach) const
  {
    FrontPlace found;
    found.square = reach * reach;
    // Each piece is tried from the vertex that it begins at, which may be farther.
    bins.visit(place, reach + longest,
               [&](std::uint32_t v, double)
               {
                 const PlanePoint &a = polygon.vertices[v];
                 const PlanePoint along = polygon.vertices[following[v]] - a;
                 const double length = along.squaredNorm();
                 const double share
                     = length > 0 ? std::clamp((place - a).dot(along) / length, 0., 1.)
                                  : 0.;
                 const double square = (a + share * along - place).squaredNorm();
                 if(square < found.square)
                   found = {v, following[v], share, square};
               });
    return found;
  }

  double FrontIndex::signed_distance(const PlanePoint &place, double reach) const
  {
    const double distance = std::sqrt(closest(place, reach).square);
    return solid(place) ? -distance : distance;
  }

  bool FrontIndex::film_between(const PlanePoint &from, const PlanePoint &to) const
  {
    const PlanePoint way = to - from;
    std::array<PlanePoint, most_crossings> normals;
    std::size_t count = 0;
    bool film = false;
    bins.visit((from + to) / 2, way.norm() / 2 + longest,
               [&](std::uint32_t vertex, double)
               {
                 const PlanePoint &start = polygon.vertices[vertex];
                 const PlanePoint along = polygon.vertices[following[vertex]] - start;
                 const double area = cross(way, along);
                 if(area == 0 || film)
                   return;
                 const double on_way = cross(start - from, along) / area,
                              on_piece = cross(start - from, way) / area;
                 if(on_way < 0 || on_way > 1 || on_piece < 0 || on_piece >= 1)
                   return;
                 const PlanePoint normal = PlanePoint(-along.y(), along.x()).normalized();
                 for(std::size_t i = 0; i < count; ++i)
                   film = film || normals[i].dot(normal) < facing_normals;
                 if(count < most_crossings)
                   normals[count++] = normal;
               });
    return film;
  }
} // namespace meltfront::particles::rkpm_tracked
