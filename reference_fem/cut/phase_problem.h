#ifndef meltfront_reference_fem_cut_phase_problem_h
#define meltfront_reference_fem_cut_phase_problem_h

#include <reference_fem/cut/cut_geometry.h>
#include <reference_fem/cut/level_set.h>
#include <reference_fem/cut/sparse_system.h>

#include <functional>

namespace meltfront::reference_fem::cut
{
  /** What a wall asks of the unknown at a point. */
  struct WallCondition
  {
    bool fixes_temperature = false;
    double value = 0; ///< temperature, or heat flux into the domain (W/m^2)
    double slope = 0; ///< by which the flux grows with the unknown (W/(m^2 K)), <= 0
  };

  /**
   * The equation of a phase with unknown T, which takes the value g on the front:
   *
   *   mass T - div(conductivity grad T) = load
   */
  struct PhaseEquation
  {
    double mass = 0;         ///< W/(m^3 K)
    double conductivity = 0; ///< W/(m K)
    Values load;             ///< at the degrees of freedom; empty: none (W/m^3)
    PointFunction source;    ///< a second load; empty: none (W/m^3)
    /** A load that is the divergence of a flux which nothing but the front lets through;
     * empty: none (W/m^2). Of the temperature wanted, it makes the solution its Ritz
     * projection. */
    std::function<Gradient(const Cell &cell, const Point &unit)> divergence_source;
    PointFunction front_value;
    std::function<WallCondition(const WallPoint &)> wall; ///< empty: natural
  };

  /** Parameters of the discretisation, without unit. */
  struct Stabilisation
  {
    /** Nitsche's penalty for linear elements; grows with the square of the degree. */
    double penalty = 40;
    double ghost = 0.04; ///< ghost penalty on jumps of the normal derivative
    double extension
        = 2.5; ///< width of the band into which a phase is extended, in cells
  };

  /**
   * Finite elements for one phase on the cells that hold a part of it and on a band
   * beyond: Nitsche's method on the front and on walls with a fixed temperature (Nitsche
   * 1971; Hansbo and Hansbo 2002), ghost penalty on the faces of cut cells and of the
   * band (Burman 2010), which extends the solution for the next steps (Lehrenfeld and
   * Olshanskii 2019).
   */
  class PhaseProblem
  {
  public:
    PhaseProblem(const BackgroundMesh &mesh, const CutGeometry &geometry,
                 const Values &level_set, Phase phase,
                 const Stabilisation &stabilisation);

    /** Values at all degrees of freedom; those without a part in the problem take the
     * front's value. @throws std::runtime_error if the matrix is not positive definite */
    Values solve(const PhaseEquation &equation);

    /** Heat flux into the phase through the front (W/m^2), by point of the front: the
     * consistent flux of Nitsche's method, k dT/dn - penalty k/h (T - g). */
    std::vector<double> front_flux(const PhaseEquation &equation,
                                   const Values &solution) const;

    /** Heat into the phase through the walls (W/m), in the same sense. */
    double wall_heat(const PhaseEquation &equation, const Values &solution) const;

    long unknowns = 0, entries = 0; ///< of the last solve

  private:
    struct TraceValues
    {
      LocalVector shape, normal_derivative;
    };

    TraceValues trace(const Cell &cell, const SurfacePoint &point) const;
    double penalty(const PhaseEquation &equation, const Cell &cell) const;
    void add_whole_cells(const PhaseEquation &equation, SparseSystem &system) const;
    void add_parts(const PhaseEquation &equation, SparseSystem &system) const;
    void add_points(const PhaseEquation &equation, unsigned int cell,
                    const std::vector<VolumePoint> &points, SparseSystem &system) const;
    void add_front(const PhaseEquation &equation, SparseSystem &system) const;
    void add_walls(const PhaseEquation &equation, SparseSystem &system) const;
    void add_condition(const PhaseEquation &equation, const Cell &cell,
                       const SurfacePoint &point, double value,
                       SparseSystem &system) const;
    void add_ghost_penalty(const PhaseEquation &equation, SparseSystem &system) const;

    const BackgroundMesh &mesh;
    const CutGeometry &geometry;
    const Phase phase;
    const Stabilisation &stabilisation;
    std::vector<char> active; ///< by cell
  };

  /** Value of a field at a point of a cell. */
  double field_value(const BackgroundMesh &mesh, const Cell &cell, const Values &field,
                     const Point &unit);
} // namespace meltfront::reference_fem::cut

#endif
