#include <reference_fem/cut/conservative/front_law.h>

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

  double add_displacement(const StepFrame &frame, const Front &front, double spacing,
                          const LocalVector &solution, Values &increment)
  {
    for(std::size_t node = 0; node < increment.size(); ++node)
      if(const int unknown = frame.displacement[node]; unknown >= 0)
        increment[node] += std::clamp(solution[unknown], -spacing, spacing);
    double largest = 0;
    for(const CutTriangle &cut : front.cut)
      for(const unsigned int node : cut.place->nodes)
        if(const int unknown = frame.displacement[node]; unknown >= 0)
          largest = std::max(largest, std::abs(solution[unknown]));
    return largest;
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
} // namespace meltfront::reference_fem::cut::conservative
