#include <particles/rkpm_tracked/line/collocation.h>
#include <particles/rkpm_tracked/line/measure.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** A front touches a node from this distance on, over the spacing. */
    constexpr double touching = 0.01;

    /** By how much more than half what comes from upstream counts at a face, so that
     * straight slopes are exact for the steady profile between two points (Il'in 1969),
     * for a Peclet number u h/a. */
    double upstream_excess(double peclet)
    {
      constexpr double straight = 1e-3;
      return std::abs(peclet) < straight ? peclet / 12
                                         : 0.5 / std::tanh(peclet / 2) - 1 / peclet;
    }
  } // namespace

  /** A face is half a spacing nearer to the points beside it than these to each other. */
  void LineCollocation::evaluate_face(double place, LineStencil &stencil)
  {
    const double reach = std::max(dilation - 0.5, dilation / 2);
    stencils.evaluate(place, reach * problem.spacing_at(place), cloud, stencil);
  }

  void LineCollocation::make_regular_faces()
  {
    const std::vector<double> &x = problem.nodes;
    regular_faces.resize(x.size() - 1);
    for(std::size_t i = 0; i + 1 < x.size(); ++i)
      evaluate_face((x[i] + x[i + 1]) / 2, regular_faces[i]);
  }

  /** Weights of the slope half-way between a point and the next. */
  void LineCollocation::face_stencil(std::size_t point)
  {
    const std::vector<double> &x = cloud.position[0];
    const double place = (x[point] + x[point + 1]) / 2;
    LineStencil &row = faces[point];
    const std::size_t node = first + point - offset;
    if(point >= offset && node + 1 < end)
    {
      const LineStencil &known = regular_faces[node];
      const bool inside = known.first >= first && known.end() <= end;
      const bool below = offset == 1 && place - x.front() < known.radius;
      const bool above
          = offset + (end - first) < cloud.size() && x.back() - place < known.radius;
      if(inside && !below && !above)
      {
        row = known;
        row.first = known.first - first + offset;
        return;
      }
    }
    evaluate_face(place, row);
  }

  bool LineCollocation::is_steep(const LineInterval &interval) const
  {
    return steep[interval.solid ? 1 : 0];
  }

  /** Slopes at all faces; straight ones, which overshoot nowhere, where a layer is
   * thinner than a cell. */
  void LineCollocation::find_faces(const LineInterval &interval, const StepTerms &terms)
  {
    const std::vector<double> &x = cloud.position[0];
    faces.resize(std::max(faces.size(), x.size()));
    const std::size_t last = x.size() - 2;
    if(!is_steep(interval))
    {
      for(std::size_t p = 0; p <= last; ++p)
        face_stencil(p);
      return;
    }
    for(std::size_t p = 0; p <= last; ++p)
    {
      const double slope = 1 / (x[p + 1] - x[p]);
      faces[p].first = p;
      faces[p].slope = {-slope, slope};
    }
    if(last == 0)
      return;
    if(interval.lower_front)
      hasten(faces[0], x[1] - x[0], x[2] - x[1], interval, terms);
    if(interval.upper_front)
      hasten(faces[last], x[last + 1] - x[last], x[last] - x[last - 1], interval, terms);
  }

  /**
   * A node that a front all but touches takes its temperature within the step, however
   * badly the phase conducts: a layer without thickness would let the front find no place
   * short of the node, whose cell's heat it needs.
   */
  void LineCollocation::hasten(LineStencil &face, double distance, double next,
                               const LineInterval &interval, const StepTerms &terms) const
  {
    const double closer = std::max(touching * next - distance, 0.);
    const double added = terms.leading * next / 2 * closer;
    for(double &weight : face.slope)
      weight *= 1 + added / problem.phase(interval.solid).diffusivity();
  }

  /** Where the phase moves: what flows through a face has the mean temperature of the
   * points beside it; in a layer that is thinner than a cell more of what comes from
   * upstream. */
  void LineCollocation::find_shares_of_faces(const LineInterval &interval,
                                             const StepTerms &terms)
  {
    displaced_flow = terms.displaced_speed == 0
                         ? 0.
                         : terms.displaced_speed
                               * area(problem.symmetry, terms.displacing_front)
                               / problem.phase(interval.solid).diffusivity();
    if(displaced_flow == 0)
      return;
    const std::vector<double> &x = cloud.position[0];
    share_below.assign(x.size() - 1, 0.5);
    if(is_steep(interval))
      for(std::size_t f = 0; f + 1 < x.size(); ++f)
        share_below[f]
            += upstream_excess(displaced_flow * (x[f + 1] - x[f])
                               / area(problem.symmetry, (x[f] + x[f + 1]) / 2));
  }

  /** Of what flows through a face, over the melting temperature. */
  double LineCollocation::excess_at_face(std::size_t face,
                                         std::span<const double> values) const
  {
    return share_below[face] * values[face] + (1 - share_below[face]) * values[face + 1]
           - problem.material.melting_temperature;
  }

  /** What the temperature at each point counts for in the heat of the phase. */
  void LineCollocation::measure_cells()
  {
    const std::vector<double> &x = cloud.position[0];
    volumes.assign(x.size(), 0.);
    for(std::size_t p = 0; p + 1 < x.size(); ++p)
    {
      const auto [own, next] = end_volumes(problem.symmetry, x[p], x[p + 1]);
      volumes[p] += own;
      volumes[p + 1] += next;
    }
  }

  bool LineCollocation::is_held_film(const LineInterval &interval) const
  {
    const std::size_t nodes = problem.balanced() ? end - first : all_end - all_first;
    return interval.lower_front != interval.upper_front && nodes == 1
           && problem.walls[interval.lower_front ? 1 : 0].fixed();
  }

  void LineCollocation::measure_cells_of(const LineInterval &interval)
  {
    gather(interval, coincidence);
    measure_cells();
  }

  void LineCollocation::write_cells(std::span<double> cells) const
  {
    for(std::size_t i = all_first; i < all_end; ++i)
      cells[i] = i >= first && i < end ? volumes[i - first + offset] : 0;
  }

  /** What flows into the cell of a point by conduction, and with a phase that moves, over
   * its volume, in the place of the Laplacian: what leaves one cell enters the next. */
  const LineStencil &LineCollocation::balance(std::size_t point)
  {
    const std::vector<double> &x = cloud.position[0];
    LineStencil &row = rows[point];
    const std::size_t from_face = point == 0 ? 0 : point - 1;
    const std::size_t to_face = std::min(point, x.size() - 2);
    row.first = point;
    std::size_t past = point + 1;
    for(std::size_t f = from_face; f <= to_face; ++f)
    {
      row.first = std::min(row.first, faces[f].first);
      past = std::max(past, faces[f].end());
    }
    row.slope.assign(past - row.first, 0.);
    row.second.assign(past - row.first, 0.);
    for(std::size_t f = from_face; f <= to_face; ++f)
    {
      const double weight = (f == point ? 1 : -1)
                            * area(problem.symmetry, (x[f] + x[f + 1]) / 2)
                            / volumes[point];
      for(std::size_t j = 0; j < faces[f].size(); ++j)
        row.second[faces[f].first + j - row.first] += weight * faces[f].slope[j];
    }
    if(displaced_flow == 0)
      return row;
    const double carried = displaced_flow / volumes[point];
    for(std::size_t f = from_face; f <= to_face; ++f)
    {
      const double weight = (f == point ? -1 : 1) * carried;
      row.second[f - row.first] += weight * share_below[f];
      row.second[f + 1 - row.first] += weight * (1 - share_below[f]);
    }
    if(point == 0)
      row.second[point - row.first] += carried;
    if(point + 1 == x.size())
      row.second[point - row.first] -= carried;
    return row;
  }

  double LineCollocation::face_slope(std::size_t face,
                                     std::span<const double> values) const
  {
    double sum = 0;
    for(std::size_t j = 0; j < faces[face].size(); ++j)
      sum += faces[face].slope[j] * values[faces[face].first + j];
    return sum;
  }

  /** The slope at a front for what flows through the first face and what is released in
   * the front's cell; the heat of cells that the front changes comes to it. */
  double LineCollocation::balanced_front_slope(std::size_t side, bool solid,
                                               std::span<const double> values) const
  {
    const std::vector<double> &x = cloud.position[0];
    const std::size_t front = side == 0 ? 0 : x.size() - 1;
    const std::size_t next = side == 0 ? 1 : front - 1;
    const double released
        = volumes[front] * unseen[side].seen / problem.phase(solid).conductivity;
    const std::size_t face = side == 0 ? 0 : next;
    const double carried
        = displaced_flow == 0 ? 0 : displaced_flow * excess_at_face(face, values);
    return (area(problem.symmetry, (x[front] + x[next]) / 2) * face_slope(face, values)
            - carried + (side == 0 ? released : -released))
           / area(problem.symmetry, x[front]);
  }

  /** The slope at a wall of what is conducted in through it: it heats the wall's cell or
   * goes on through the first face, as does what comes with a phase that moves. */
  double LineCollocation::balanced_wall_slope(std::size_t side, bool solid,
                                              const StepTerms &terms,
                                              std::span<const double> values) const
  {
    const std::vector<double> &x = cloud.position[0];
    const double diffusivity = problem.phase(solid).diffusivity(),
                 capacity = problem.phase(solid).volumetric_heat_capacity();
    const std::size_t wall = side == 0 ? 0 : x.size() - 1;
    const std::size_t next = side == 0 ? 1 : wall - 1;
    double change = terms.leading * values[wall] + terms.history[first + wall - offset];
    if(problem.volumetric_source)
      change -= problem.volumetric_source(x[wall], terms.time) / capacity;
    const std::size_t face = side == 0 ? 0 : next;
    const double excess = values[wall] - problem.material.melting_temperature;
    const double carried = displaced_flow == 0
                               ? 0
                               : displaced_flow * (excess - excess_at_face(face, values));
    return (area(problem.symmetry, (x[wall] + x[next]) / 2) * face_slope(face, values)
            + carried + (side == 0 ? -1 : 1) * volumes[wall] * change / diffusivity)
           / area(problem.symmetry, x[wall]);
  }

  EndSlopes LineCollocation::balanced_slopes(const LineInterval &interval,
                                             const StepTerms &terms) const
  {
    const std::array<bool, 2> front{interval.lower_front, interval.upper_front};
    EndSlopes result{};
    const bool film = is_held_film(interval);
    for(const std::size_t side : {0, 1})
      if(film)
        result[side] = face_slope(0, right_side);
      else if(front[side])
        result[side] = balanced_front_slope(side, interval.solid, right_side);
      else if(side == 1 || !problem.axis)
        result[side] = balanced_wall_slope(side, interval.solid, terms, right_side);
    return result;
  }
} // namespace meltfront::particles::rkpm_tracked
