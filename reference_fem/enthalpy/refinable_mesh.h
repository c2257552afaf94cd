#ifndef meltfront_reference_fem_enthalpy_refinable_mesh_h
#define meltfront_reference_fem_enthalpy_refinable_mesh_h

#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/nested_level.h>

#include <memory>
#include <vector>

namespace boost::archive
{
  class binary_iarchive;
  class binary_oarchive;
} // namespace boost::archive

namespace meltfront::reference_fem
{
  /** What is to become of a cell. */
  enum class Wish : char
  {
    join, ///< with its siblings, if all of them wish for it and the neighbours allow it
    keep,
    halve ///< along every direction
  };

  /** A mesh that changes in the course of a run. */
  class RefinableMesh : public Mesh
  {
  public:
    /** How often each cell may still be halved; cells as Discretisation has them. */
    virtual std::vector<int> halvings_left() const = 0;

    /**
     * Of each cell the largest jump of the mean gradient to a neighbour, times the cell's
     * size: what linear interpolation in it may be wrong by, as h^2 times the second
     * derivative.
     * @param values by site
     */
    virtual std::vector<double> jumps(const std::vector<double> &values) const = 0;

    /** The cell that holds a point. @throws cases::InputError if none does. */
    virtual std::size_t cell_at(const cases::Position &point) const = 0;

    /** From that of the nodes down to few nodes. @param network of the nodes */
    virtual std::vector<NestedLevel> levels(const ConductionMatrix &network) const = 0;

    /**
     * Join and halve cells. What a field holds in all (the sum of volume times value)
     * stays the same to round-off, a constant stays constant and no value passes the
     * largest or least of those around it.
     * @param fields densities by node, in the numbering of the discretisation before and
     * after
     * @return whether a cell has changed: what was taken of the mesh before is void then
     */
    virtual bool adapt(const std::vector<Wish> &wishes,
                       const std::vector<std::vector<double> *> &fields)
        = 0;

    /** Write which cells there are, and read it. */
    virtual void save(boost::archive::binary_oarchive &state) const = 0;
    virtual void restore(boost::archive::binary_iarchive &state) = 0;
  };

  /**
   * Mesh a box, or the half section of an axisymmetric body, so that cells as small as
   * with n along the domain's side (make_mesh) come about where they are wished for. It
   * begins with the coarsest cells: of twice the spacing or more, up to half the
   * geometric mean of spacing and side, the size at which what is smooth over the domain
   * is as well resolved as a front by the finest ones.
   *
   * Mass and stiffness are integrated at the vertices, with nodes that hang condensed
   * (C'MC with row sums, C'KC).
   *
   * @throws cases::Refusal for another domain, periodic sides, or a number of cells along
   * a side that cannot be halved
   */
  std::unique_ptr<RefinableMesh> make_refinable_mesh(const cases::Scene &scene,
                                                     int dimension, int n);
} // namespace meltfront::reference_fem

#endif
