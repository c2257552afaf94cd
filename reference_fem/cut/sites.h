#ifndef meltfront_reference_fem_cut_sites_h
#define meltfront_reference_fem_cut_sites_h

#include <cases/run.h>
#include <reference_fem/cut/background_mesh.h>

#include <array>
#include <vector>

namespace meltfront::reference_fem::cut
{
  /** What is seen of a run with sharp fronts: quadrature points of both phases, vertices
   * of the mesh (without weight) for pictures, points on the front. */
  struct Sites
  {
    std::array<std::vector<double>, dim> positions, front;
    std::vector<double> weights, temperatures, solid_fractions;
    std::vector<unsigned int> cells;

    void clear();

    /** @return its number */
    unsigned int add(const Point &point, double weight, double temperature, bool solid);

    void add_on_front(const Point &point);

    /** It refers to these sites, which live as long as it is used. */
    cases::Snapshot snapshot(long step, double time, const cases::HeatBudget &heat) const;
  };
} // namespace meltfront::reference_fem::cut

#endif
