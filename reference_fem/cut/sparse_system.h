#ifndef meltfront_reference_fem_cut_sparse_system_h
#define meltfront_reference_fem_cut_sparse_system_h

#include <reference_fem/cut/background_mesh.h>

#include <Eigen/SparseCore>

#include <vector>

namespace meltfront::reference_fem::cut
{
  using LocalMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;
  using LocalVector = Eigen::Matrix<double, Eigen::Dynamic, 1>;

  /**
   * A symmetric positive definite system for the degrees of freedom of some of the mesh's
   * cells, hanging nodes eliminated; solved directly.
   */
  class SparseSystem
  {
  public:
    /** @param active by cell: whether its degrees of freedom take part */
    SparseSystem(const BackgroundMesh &mesh, const std::vector<char> &active);

    void add(const std::vector<unsigned int> &dofs, const LocalMatrix &matrix);
    void add(const std::vector<unsigned int> &dofs, const LocalVector &load);

    /**
     * Solve; degrees of freedom that take no part keep their value in `values`.
     * @return whether the matrix could be factorised as a positive definite one
     * @throws cases::OutOfMemory
     */
    bool solve(Values &values) const;

    /** Whether a degree of freedom takes part. */
    bool contains(unsigned int dof) const
    {
      return taking_part[dof];
    }

    long unknowns() const
    {
      return load.size();
    }
    long entries() const
    {
      return static_cast<long>(triplets.size());
    }

  private:
    const BackgroundMesh &mesh;
    std::vector<char> taking_part;
    std::vector<int> number;                      ///< by degree of freedom, -1: none
    std::vector<Eigen::Triplet<double>> triplets; ///< lower triangle
    LocalVector load;
  };
} // namespace meltfront::reference_fem::cut

#endif
