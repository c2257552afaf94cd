#include <reference_fem/cut/level_set.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    /** Of the spacing. */
    constexpr double smallest_value = 1e-8;

    /** Nodes farther from the front, in cells, take the distance to the nearest sample of
     * it: only their sign matters. */
    constexpr double near_cells = 5;
    constexpr int newton_steps = 6;

    struct Sample
    {
      Point position;
      unsigned int cell;
    };

    std::vector<Sample> samples(const BackgroundMesh &mesh, const CutGeometry &geometry)
    {
      std::vector<Sample> result;
      for(const CutCell &cut : geometry.cut_cells)
        for(const SurfacePoint &point : cut.front)
          result.push_back({mesh.cells[cut.cell].real(point.unit), cut.cell});
      return result;
    }

    /**
     * The point nearest to `from` among the zeros near `start`: alternates a Newton step
     * onto the curve and a step along its tangent.
     */
    template <typename Evaluate>
    Point nearest_zero(const Point &from, const Point &start, double reach,
                       const Evaluate &evaluate)
    {
      Point foot = start;
      for(int step = 0; step < newton_steps; ++step)
      {
        const ValueAndGradient at = evaluate(foot);
        const double square = at.gradient.norm_square();
        if(!(square > 0))
          return start;
        foot -= at.value / square * at.gradient;
        if(step + 1 < newton_steps)
        {
          Gradient tangential = from - foot;
          tangential -= (tangential * at.gradient) / square * at.gradient;
          foot += tangential;
        }
        if(!(foot.distance(start) < reach))
          return start;
      }
      return foot;
    }

    const Sample &nearest(const std::vector<Sample> &samples, const Point &point)
    {
      const Sample *best = nullptr;
      double least = std::numeric_limits<double>::infinity();
      for(const Sample &sample : samples)
        if(const double square = sample.position.distance_square(point); square < least)
        {
          least = square;
          best = &sample;
        }
      return *best;
    }
  } // namespace

  ValueAndGradient evaluate(const BackgroundMesh &mesh, const Cell &cell,
                            const Values &level_set, const Point &unit)
  {
    ValueAndGradient result;
    for(unsigned int i = 0; i < cell.level_set_dofs.size(); ++i)
    {
      const double coefficient = level_set[cell.level_set_dofs[i]];
      result.value += coefficient * mesh.level_set_element.shape_value(i, unit);
      const Gradient gradient = mesh.level_set_element.shape_grad(i, unit);
      for(int d = 0; d < dim; ++d)
        result.gradient[d] += coefficient * gradient[d] / cell.size[d];
    }
    return result;
  }

  Values signed_distance_to_zeros(const BackgroundMesh &mesh,
                                  const PointFunction &function)
  {
    const double h = mesh.spacing, difference = 1e-4 * h;
    const auto evaluate = [&](const Point &point)
    {
      ValueAndGradient result{function(point), {}};
      for(int d = 0; d < dim; ++d)
      {
        Gradient shift;
        shift[d] = difference;
        result.gradient[d]
            = (function(point + shift) - function(point - shift)) / (2 * difference);
      }
      return result;
    };
    Values result(mesh.level_set_positions.size());
    for(std::size_t i = 0; i < result.size(); ++i)
    {
      const Point &point = mesh.level_set_positions[i];
      const double reach = near_cells * h;
      const Point foot = nearest_zero(point, point, reach, evaluate);
      const double distance = foot == point ? reach : foot.distance(point);
      const double value = function(point);
      result[i] = value == 0 ? 0 : std::copysign(distance, value);
    }
    keep_off_nodes(mesh, result);
    return result;
  }

  void keep_off_nodes(const BackgroundMesh &mesh, Values &level_set)
  {
    const double least = smallest_value * mesh.spacing;
    for(double &value : level_set)
      if(std::abs(value) < least)
        value = std::copysign(least, value);
  }

  void redistance(const BackgroundMesh &mesh, const CutGeometry &geometry,
                  Values &level_set)
  {
    const std::vector<Sample> front = samples(mesh, geometry);
    if(front.empty())
      return;
    std::vector<char> kept(level_set.size());
    for(const CutCell &cut : geometry.cut_cells)
      for(const unsigned int dof : mesh.cells[cut.cell].level_set_dofs)
        kept[dof] = 1;
    const Values old = level_set;
    for(std::size_t i = 0; i < level_set.size(); ++i)
    {
      if(kept[i])
        continue;
      const Point &point = mesh.level_set_positions[i];
      const Sample &sample = nearest(front, point);
      Point foot = sample.position;
      if(foot.distance(point) < near_cells * mesh.spacing)
        foot = nearest_zero(point, foot, mesh.spacing,
                            [&](const Point &p)
                            {
                              const Cell &cell = mesh.cells[sample.cell];
                              return evaluate(mesh, cell, old, cell.unit(p));
                            });
      level_set[i] = std::copysign(foot.distance(point), old[i]);
    }
    mesh.distribute_level_set(level_set);
  }

  double distance_to_phase(const Cell &cell, const Values &level_set, Phase phase)
  {
    double least = std::numeric_limits<double>::infinity();
    for(const unsigned int dof : cell.level_set_dofs)
      least = std::min(least, phase == Phase::solid ? level_set[dof] : -level_set[dof]);
    return least;
  }
} // namespace meltfront::reference_fem::cut
