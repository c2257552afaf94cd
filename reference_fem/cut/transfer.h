#ifndef meltfront_reference_fem_cut_transfer_h
#define meltfront_reference_fem_cut_transfer_h

#include <reference_fem/cut/cut_geometry.h>
#include <reference_fem/cut/front_speed.h>

namespace meltfront::reference_fem::cut
{
  /**
   * Carries fields from a mesh to another that divides the same base mesh. Where both
   * have the same cells nothing changes, not even by round-off; divided cells keep their
   * field. Where cells become larger their field is interpolated, and what that changes
   * of the field's integral is given back to it.
   */
  class Transfer
  {
  public:
    Transfer(const BackgroundMesh &from, const BackgroundMesh &to)
      : from(from)
      , to(to)
    {
    }

    Values level_set(const Values &field) const;

    /**
     * The integral of the field over a phase stays what it is to round-off: each shape
     * function takes up what it lost, over its own integral (a step of Jacobi's towards
     * the projection in L2, with the lumped mass).
     * @param geometry on the new mesh; no cell that changes may be cut
     */
    Values temperature(const Values &field, const CutGeometry &geometry,
                       Phase phase) const;

    SpeedField speed(const SpeedField &field) const;

  private:
    /** A point in a cell of the old mesh. */
    struct OldPoint
    {
      unsigned int cell;
      Point unit;
    };

    OldPoint old_point(const Point &point) const;
    void add_change(const Values &before, const Values &after, unsigned int cell_before,
                    unsigned int cell_after, const std::vector<VolumePoint> &points,
                    Values &result) const;
    Values lost(const Values &before, const Values &after, const CutGeometry &geometry,
                Phase phase) const;
    Values integrals_of_shapes(const CutGeometry &geometry, Phase phase) const;
    void add_by_shape(const Cell &cell, const Point &unit, double amount,
                      Values &result) const;

    const BackgroundMesh &from, &to;
  };
} // namespace meltfront::reference_fem::cut

#endif
