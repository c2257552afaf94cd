#include <reference_fem/cut/sites.h>

namespace meltfront::reference_fem::cut
{
  void Sites::clear()
  {
    for(int d = 0; d < dim; ++d)
    {
      positions[d].clear();
      front[d].clear();
    }
    weights.clear();
    temperatures.clear();
    solid_fractions.clear();
    cells.clear();
  }

  unsigned int Sites::add(const Point &point, double weight, double temperature,
                          bool solid)
  {
    for(int d = 0; d < dim; ++d)
      positions[d].push_back(point[d]);
    weights.push_back(weight);
    temperatures.push_back(temperature);
    solid_fractions.push_back(solid ? 1 : 0);
    return static_cast<unsigned int>(weights.size() - 1);
  }

  void Sites::add_on_front(const Point &point)
  {
    for(int d = 0; d < dim; ++d)
      front[d].push_back(point[d]);
  }

  cases::Snapshot Sites::snapshot(long step, double time,
                                  const cases::HeatBudget &heat) const
  {
    cases::Snapshot snapshot;
    snapshot.step = step;
    snapshot.time = time;
    snapshot.dimension = dim;
    for(int d = 0; d < dim; ++d)
    {
      snapshot.positions[d] = positions[d];
      snapshot.front[d] = front[d];
    }
    snapshot.weights = weights;
    snapshot.temperature = temperatures;
    snapshot.solid_fraction = solid_fractions;
    snapshot.cells = cells;
    snapshot.obeys_maximum_principle = false;
    snapshot.heat = heat;
    return snapshot;
  }
} // namespace meltfront::reference_fem::cut
