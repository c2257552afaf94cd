#ifndef meltfront_reference_fem_cut_cut_geometry_h
#define meltfront_reference_fem_cut_cut_geometry_h

#include <reference_fem/cut/background_mesh.h>

#include <array>
#include <vector>

namespace meltfront::reference_fem::cut
{
  enum class Phase : char
  {
    solid,
    liquid
  };
  inline constexpr std::array<Phase, 2> phases{Phase::solid, Phase::liquid};

  /** Where a phase stands in arrays by phase. */
  constexpr std::size_t index(Phase phase)
  {
    return static_cast<std::size_t>(phase);
  }

  /** Where a cell lies with respect to the front. */
  enum class Location : char
  {
    outside, ///< of the domain
    solid,
    liquid,
    cut
  };

  /** A cell that the front cuts. */
  struct CutCell
  {
    unsigned int cell;
    std::array<std::vector<VolumePoint>, 2> volume; ///< by Phase
    std::vector<SurfacePoint> front;                ///< normals point into the liquid
  };

  /** A point of the quadrature over the walls. */
  struct WallPoint
  {
    unsigned int cell;
    SurfacePoint point; ///< normal out of the domain
    Point position;
    cases::Side side;
    Phase phase;
  };

  /** Both phases, the front between them and the walls as quadratures. */
  class CutGeometry
  {
  public:
    /**
     * @param level_set negative in the solid, at the level set's degrees of freedom
     * @throws cases::Refusal where the front reaches the rim of a disk or an annulus
     */
    CutGeometry(const BackgroundMesh &mesh, const Values &level_set);

    std::vector<Location> location; ///< by cell
    std::vector<CutCell> cut_cells;
    std::vector<WallPoint> walls;

    bool has(Phase phase) const
    {
      return areas[index(phase)] > 0;
    }

    /** m^2 */
    double area(Phase phase) const
    {
      return areas[index(phase)];
    }

    /** Call visit(cell, points) for the part of every cell that lies in a phase, but for
     * the cells that lie in it as a whole. */
    template <typename Visit>
    void visit_parts(const BackgroundMesh &mesh, Phase phase, const Visit &visit) const
    {
      for(const CutCell &cut : cut_cells)
        visit(cut.cell, cut.volume[index(phase)]);
      for(const CurvedBoundaryCell &rim : mesh.curved_boundary_cells)
        if(is(location[rim.cell], phase))
          visit(rim.cell, rim.volume);
    }

    static bool is(Location location, Phase phase)
    {
      return location == (phase == Phase::solid ? Location::solid : Location::liquid);
    }

  private:
    void integrate_walls(const BackgroundMesh &mesh, const Values &level_set);
    void measure(const BackgroundMesh &mesh);

    std::array<double, 2> areas{};
  };
} // namespace meltfront::reference_fem::cut

#endif
