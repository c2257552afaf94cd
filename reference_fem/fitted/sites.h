#ifndef meltfront_reference_fem_fitted_sites_h
#define meltfront_reference_fem_fitted_sites_h

#include <cases/snapshot.h>
#include <reference_fem/fitted/fitted_problem.h>

#include <vector>

namespace meltfront::reference_fem::fitted
{
  /**
   * The sites of snapshots: the nodes, without weight, as vertices of cells for pictures,
   * then the quadrature points with their volumes.
   */
  class Sites
  {
  public:
    explicit Sites(const FittedProblem &problem);

    /** Read a state. The snapshot views arrays of this object until the next call. */
    void read(double time, const dealii::Vector<double> &u, cases::Snapshot &snapshot);

  private:
    void make_cells();
    void read_nodes(double time, const dealii::Vector<double> &u);
    void read_points(double time, const dealii::Vector<double> &u);
    void set_position(std::size_t site, const cases::Position &position);

    const FittedProblem &problem;
    std::vector<double> positions[3], front[3];
    std::vector<double> weights, temperature, solid_fraction;
    std::vector<unsigned int> cells;
  };
} // namespace meltfront::reference_fem::fitted

#endif
