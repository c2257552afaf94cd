#ifndef meltfront_reference_fem_cut_conservative_step_frame_h
#define meltfront_reference_fem_cut_conservative_step_frame_h

#include <reference_fem/cut/conservative/front.h>
#include <reference_fem/cut/sparse_system.h>

#include <Eigen/SparseCore>

#include <array>
#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  /** Rows by node, columns by unknown: y = A x + b. */
  struct Operator
  {
    explicit Operator(std::size_t nodes)
      : constant(nodes)
    {
    }

    void add(unsigned int node, int unknown, double value)
    {
      entries.emplace_back(static_cast<int>(node), unknown, value);
    }

    Values apply(const LocalVector &unknowns) const;

    std::vector<Eigen::Triplet<double>> entries;
    Values constant;
  };

  /** Add entries to a system whose rows are given by node. */
  void append(const Operator &source, double factor, const std::vector<int> &row_of_node,
              std::vector<Eigen::Triplet<double>> &result);

  double sum(const Values &values);

  /** What the stages of a step share: its front at the begin, where phases and front have
   * unknowns. */
  class StepFrame
  {
  public:
    /** Of the smoothing, what is alike in all directions: it holds nodes that no normal
     * ties to the front. */
    static constexpr double isotropic_share = 0.01;

    /** @param smoothing c_S of the front's law
     * @param isotropic share of the smoothing */
    StepFrame(const TriangleMesh &mesh, Values level_set, double smoothing,
              double isotropic = isotropic_share);

    const Values level_set;
    const Front front;
    /** Triangles, by phase, with temperatures: those within two spacings of it. */
    std::array<std::vector<char>, 2> active;
    std::array<std::vector<int>, 2> temperature; ///< unknowns by phase and node, -1: none
    std::vector<int> displacement; ///< of the level set: unknowns by node, -1: none
    int unknowns = 0;
    /** c_S h times the integral of (n . grad psi)(n . grad w) over the front's band: of
     * increments of the level set it selects the one that is constant along normals. Its
     * sum over all w is zero. */
    Operator smoothing;

    bool has_front() const
    {
      return !band.empty();
    }

    /** The level set after an increment. */
    Values moved(const Values &increment, double spacing) const;

    /** Nodal increments of the level set as a vector of unknowns. */
    LocalVector as_unknowns(const Values &increment) const;

  private:
    void number_temperatures(const TriangleMesh &mesh);
    void number_displacements(const TriangleMesh &mesh);
    void assemble_smoothing(const TriangleMesh &mesh, double factor, double isotropic);

    std::vector<unsigned int> band; ///< triangles
  };
} // namespace meltfront::reference_fem::cut::conservative

#endif
