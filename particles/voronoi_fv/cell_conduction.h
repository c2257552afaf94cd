#ifndef meltfront_particles_voronoi_fv_cell_conduction_h
#define meltfront_particles_voronoi_fv_cell_conduction_h

#include <cases/method.h>
#include <cases/scene.h>
#include <particles/scattered/linear_problem.h>
#include <particles/scattered/node_set.h>
#include <particles/voronoi_fv/voronoi.h>

#include <vector>

namespace meltfront::particles
{
  /** Where volumetric source is evaluated for a cell. */
  enum class SourcePoint
  {
    particle, ///< as published
    centroid  ///< second order on any cell
  };

  /**
   * Heat conduction between the Voronoi cells of nodes (Erickson et al. 2016,
   * SAND2016-9800, (5.3) to (5.7)),
   *
   *   rho c V_i dT_i/dt = sum_j k_ij S_ij (T_j - T_i) / |x_j - x_i| + q_i V_i + walls,
   *
   * k_ij the harmonic mean of both nodes' conductivities. Wall faces take in the wall's
   * flux, or transfer (T_ambient - T_i); those of walls with a temperature take in
   * nothing, as published: nodes on such walls hold it, and their cells are not balanced.
   * What two nodes exchange is symmetric to the last bit and never negative, so that the
   * matrix is an M-matrix.
   */
  class CellConduction
  {
  public:
    /** @param nodes, scene outlive the problem */
    CellConduction(const cases::Scene &scene, const NodeSet &nodes, VoronoiCells cells,
                   SourcePoint source_point);

    /** Refers to this object. */
    LinearProblem problem() const;

    /** Volume of each cell that is balanced, zero of the others (m^d). */
    const std::vector<double> &weights() const
    {
      return balanced;
    }

    /** Calls, memory and time of the effects so far. */
    std::vector<cases::EffectCost> effect_costs(const cases::EffectSet &effects) const;

  private:
    struct Contact
    {
      std::uint32_t free, fixed;
      double conductance; ///< W/K, in the measure of the scene
    };

    struct WallFace
    {
      std::uint32_t cell;
      const cases::Boundary *boundary;
      double area;
    };

    void find_contacts(const std::vector<double> &conductivity);
    void find_wall_faces();
    CompressedRows operator_rows() const;
    CompressedRows mass() const;
    double wall_temperature(std::uint32_t node, const LinearStep &step) const;
    cases::Position release_point(std::size_t cell) const;
    void set_source(const LinearStep &step, std::span<double> source) const;
    void set_release(const LinearStep &step, std::span<double> source) const;
    void set_walls(const LinearStep &step, std::span<double> source) const;
    HeatInflow inflow(const LinearStep &step, std::span<const double> temperature) const;

    const cases::Scene &scene;
    GivenValues given;
    const NodeSet &nodes;
    VoronoiCells cells;
    SourcePoint source_point;
    double fixed_row;                 ///< diagonal of a row that holds a temperature
    std::vector<WallCondition> fixed; ///< of each node; not fixed of those inside
    std::vector<double> balanced;
    std::vector<double> conductance;  ///< of each face (W/K)
    std::vector<Contact> contacts;    ///< faces between balanced cells and others
    std::vector<WallFace> wall_faces; ///< of balanced cells, with flux or transfer
    double inclusion_seconds = 0;
    mutable long evaluations = 0; ///< of the source
    mutable double release_seconds = 0, wall_seconds = 0;
  };
} // namespace meltfront::particles

#endif
