#include <reference_fem/cut/conservative/front_law.h>
#include <reference_fem/cut/conservative/linear_system.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Minus the derivative of the solid's area by the level set. */
    void add_area(const StepFrame &frame, const CutTriangle &cut,
                  std::vector<Eigen::Triplet<double>> &entries)
    {
      const Triangle &triangle = *cut.place;
      for(const unsigned int node : triangle.nodes)
        if(frame.displacement[node] < 0)
          throw std::runtime_error("the front has left the band in which it moves");
      const double slope = cut.level_set.gradient.norm();
      integrate(cut.segment,
                [&](const Point &point, double weight)
                {
                  for(std::size_t i = 0; i < 3; ++i)
                    for(std::size_t j = 0; j < 3; ++j)
                      entries.emplace_back(
                          frame.displacement[triangle.nodes[i]],
                          frame.displacement[triangle.nodes[j]],
                          weight / slope * triangle.hat(static_cast<int>(i), point)
                              * triangle.hat(static_cast<int>(j), point));
                });
    }
  } // namespace

  void add_area_law(const StepFrame &frame, const Front &front, const Values &change,
                    const Values &increment, std::vector<Eigen::Triplet<double>> &entries,
                    LocalVector &load)
  {
    for(const CutTriangle &cut : front.cut)
      if(cut.crossed)
        add_area(frame, cut, entries);
    append(frame.smoothing, 1, frame.displacement, entries);
    const Values off = debt(frame, front, change, increment);
    for(std::size_t node = 0; node < off.size(); ++node)
      if(const int row = frame.displacement[node]; row >= 0)
        load[row] -= off[node];
  }

  Values debt(const StepFrame &frame, const Front &front, const Values &change,
              const Values &increment)
  {
    Values owed = frame.smoothing.apply(frame.as_unknowns(increment));
    for(std::size_t node = 0; node < owed.size(); ++node)
      owed[node]
          += change[node] - (front.solid_area[node] - frame.front.solid_area[node]);
    return owed;
  }

  FrontMove::FrontMove(const TriangleMesh &mesh, const StepFrame &frame,
                       const Values &change, const Values &increment)
    : largest(mesh.spacing)
    , mesh(mesh)
    , frame(frame)
  {
    go_to(increment, change);
  }

  void FrontMove::go_to(const Values &to, const Values &change)
  {
    increment = to;
    front.emplace(mesh, frame.moved(increment, mesh.spacing));
    debt = conservative::debt(frame, *front, change, increment);
  }

  double FrontMove::largest_at_front(const LocalVector &solution) const
  {
    double result = 0;
    for(const CutTriangle &cut : front->cut)
      for(const unsigned int node : cut.place->nodes)
        if(const int unknown = frame.displacement[node]; unknown >= 0)
          result = std::max(result, std::abs(solution[unknown]));
    return result;
  }

  void FrontMove::make(const LocalVector &solution, const Values &change)
  {
    /** Of what the function falls by at the begin. */
    constexpr double steepest_rise = 0.5;
    constexpr int most_halvings = 6;
    constexpr double negligible = 1e-9; ///< spacings: round-off tells the slope
    const Values begin = increment;
    largest = largest_at_front(solution);
    limited = limited || largest > mesh.spacing;
    const double whole = std::min(1., mesh.spacing / largest);
    // Nodes that no front is near follow hats' debts that no area is left for: however
    // far.
    Values displacement(begin.size());
    double longest = 0;
    for(std::size_t node = 0; node < displacement.size(); ++node)
      if(const int unknown = frame.displacement[node]; unknown >= 0)
      {
        displacement[node]
            = std::clamp(whole * solution[unknown], -mesh.spacing, mesh.spacing);
        longest = std::max(longest, std::abs(displacement[node]));
      }
    const auto slope = [&]
    {
      double sum = 0;
      for(std::size_t node = 0; node < debt.size(); ++node)
        sum += debt[node] * displacement[node];
      return sum;
    };
    debt = conservative::debt(frame, *front, change, begin);
    const double fall = std::abs(slope());
    double share = 1;
    for(int halvings = 0;; ++halvings)
    {
      Values next = begin;
      for(std::size_t node = 0; node < next.size(); ++node)
        next[node] += share * displacement[node];
      go_to(next, change);
      if(halvings == most_halvings || longest < negligible * mesh.spacing
         || slope() <= steepest_rise * fall)
        return;
      share /= 2;
    }
  }

  void FrontMove::approach(const Values &change)
  {
    std::vector<Eigen::Triplet<double>> entries;
    LocalVector load = LocalVector::Zero(frame.unknowns);
    for(const std::vector<int> &unknown : frame.temperature)
      for(const int row : unknown)
        if(row >= 0)
          entries.emplace_back(row, row, 1.);
    add_area_law(frame, *front, change, increment, entries, load);
    make(solve(frame.unknowns, entries, load), change);
  }
} // namespace meltfront::reference_fem::cut::conservative
