#ifndef meltfront_reference_fem_fitted_events_resolution_h
#define meltfront_reference_fem_fitted_events_resolution_h

#include <reference_fem/fitted/fitted_problem.h>

#include <functional>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /**
   * How well each layer of cells resolves the temperature along the rays: the largest
   * highest Legendre mode of T - S over the temperature scale. Modes of what is resolved
   * decay geometrically, so that the last one tells what is left out (Mavriplis 1994).
   */
  std::vector<double> highest_modes(const FittedProblem &problem, double time,
                                    const dealii::Vector<double> &u);

  /**
   * Where cells of a state have a jump within, as resolving_mesh() leaves some that are
   * a 4096th of those asked for, it is a straight line from one end to the other: an
   * interpolant of degree 4 leaves what it joins by 13 % of the jump.
   */
  void straighten_jumps(const FittedProblem &problem, double time,
                        dealii::Vector<double> &u);

  /**
   * A mesh whose layers of cells are halved where they do not resolve the state at a
   * time: until their highest modes are below 1e-3, or twelve times. Elements below
   * degree 4 have too few modes to tell, and are left alone, as is the cell at a source.
   *
   * @param fronts as of FittedProblem::state()
   * @throws Refusal in more than one dimension where a cell's highest mode stays beyond
   * 0.05: the temperature jumps
   */
  RayMesh
  resolving_mesh(const RayMesh &mesh, const Physics &physics, double time,
                 const std::vector<double> &fronts,
                 const std::function<double(const cases::Position &)> &temperature);
} // namespace meltfront::reference_fem::fitted

#endif
