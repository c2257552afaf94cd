#ifndef meltfront_reference_fem_fitted_fitted_problem_h
#define meltfront_reference_fem_fitted_fitted_problem_h

#include <reference_fem/fitted/cell_integrals.h>
#include <reference_fem/fitted/conservation_problem.h>

#include <cases/method.h>

#include <functional>
#include <optional>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** Heat in the domain and what has come into it since the state was set up, in the
   * measure of the mesh (J, J/m or J/m^2). */
  struct HeatContent
  {
    double sensible = 0; ///< integral of rho c (T - T_m)
    double latent = 0;   ///< integral of rho L over the liquid
    double walls = 0;    ///< through walls, with what moving liquid carries along
    double sources = 0;
  };

  /**
   * The Stefan problem on a mesh of rays that carries its front:
   *
   *   d/dclock int rho e phi = - int rho e (x' - u) . grad phi
   *                            - dt/dclock [int k grad T . grad phi - walls - sources
   *                                         - int q phi]
   *
   * for all test functions phi, those of the front's nodes included: the sum over all of
   * them is the heat balance. Unknowns are theta = T - T_m - S by node (S the field of a
   * source at the centre), a front's coordinate h in the place of theta at its nodes,
   * and heat accounts: what has come in at each node of a wall of fixed temperature,
   * through walls of given flux, from sources and with liquid that leaves.
   */
  class FittedProblem : public ConservationProblem
  {
  public:
    FittedProblem(RayMesh mesh, Physics physics);

    unsigned int size() const override;
    const dealii::SparsityPattern &sparsity() const override;
    void evaluate(double clock, const dealii::Vector<double> &u,
                  const dealii::Vector<double> &rate, dealii::Vector<double> &mass,
                  dealii::Vector<double> &flow) const override;
    void linearise(double clock, const dealii::Vector<double> &u,
                   const dealii::Vector<double> &rate, dealii::Vector<double> &mass,
                   dealii::Vector<double> &flow,
                   dealii::SparseMatrix<double> &mass_jacobian,
                   dealii::SparseMatrix<double> &flow_jacobian,
                   dealii::SparseMatrix<double> &rate_jacobian) const override;
    dealii::Vector<double> scale(const dealii::Vector<double> &u) const override;
    std::string reason_invalid(const dealii::Vector<double> &u) const override;

    /**
     * The unknowns of a temperature at a time, by values at the nodes; accounts at zero.
     * @param fronts coordinates by front and ray (m); empty for a single phase
     */
    dealii::Vector<double>
    state(double time, const std::vector<double> &fronts,
          const std::function<double(const cases::Position &)> &temperature) const;

    HeatContent heat(double time, const dealii::Vector<double> &u) const;

    /** The phase that lies in an interval between fronts and walls. */
    const Phase &phase(unsigned int interval) const
    {
      return laws.phases[interval % 2];
    }

    /** The field split off the temperature in an interval at a time. */
    SourceField source(unsigned int interval, double time) const;

    /** T - T_m at a wall's node; of a ball the inner end of the rays is no wall. */
    double wall_excess(bool inner, unsigned int ray, double time,
                       const dealii::Vector<double> &u) const;

    /** What the code of an effect has cost in this problem: calls, bytes of its own
     * unknowns and tables, seconds. Differences of the phases and a phase beyond the
     * melting temperature are called in each assembly that holds both phases. */
    cases::EffectCost effect_cost(cases::Effect effect) const;

    /** T - T_m - S at a node, at a front that of its side in an interval. */
    double theta(unsigned int interval, unsigned int ray, unsigned int level, double time,
                 const dealii::Vector<double> &u) const;

    /** Coordinate of a node on its ray (m). */
    double coordinate(unsigned int ray, unsigned int level,
                      const dealii::Vector<double> &u) const;

    const RayMesh &mesh() const
    {
      return rays;
    }

    const Physics &physics() const
    {
      return laws;
    }

    /** Quadrature of the cells of a layer. */
    const CellTables &tables(unsigned int layer) const;

    /** Points of a cell of the surface to which those of tables() belong. */
    const std::vector<SurfacePoint> &surface_points(unsigned int surface_cell) const
    {
      return surface_rule.cells[surface_cell].points;
    }

    CellPhysics cell_physics(unsigned int layer, double time) const;
    CellState cell_state(unsigned int surface_cell, unsigned int layer, double time,
                         const dealii::Vector<double> &u,
                         const dealii::Vector<double> &rate) const;

  private:
    struct Matrices;
    struct Metered;

    /** One of the two walls. */
    struct Wall
    {
      unsigned int interval = 0;                 ///< that ends at it
      const cases::Boundary *boundary = nullptr; ///< null where the rays meet
      double r = 0;
      unsigned int level = 0;
      unsigned int first_account = RayMesh::none; ///< of fixed temperature
    };

    double theta_at_centre(
        double time, double nearest,
        const std::function<double(const cases::Position &)> &temperature) const;
    std::string reason_inverted(const dealii::Vector<double> &u) const;
    void number_accounts();
    void make_sparsity();
    void assemble(double clock, const dealii::Vector<double> &u,
                  const dealii::Vector<double> &rate, dealii::Vector<double> &mass,
                  dealii::Vector<double> &flow, Matrices *matrices) const;
    std::vector<unsigned int> nodes_of(unsigned int surface_cell,
                                       unsigned int layer) const;
    void scatter(unsigned int surface_cell, unsigned int layer, double time,
                 const dealii::Vector<double> &u, const CellMatrices &local,
                 Matrices &matrices) const;
    void add_walls(double clock, const dealii::Vector<double> &u,
                   dealii::Vector<double> &mass, dealii::Vector<double> &flow,
                   Matrices *matrices) const;
    void add_fixed_temperature(const Wall &wall, double time,
                               const dealii::Vector<double> &u,
                               dealii::Vector<double> &mass, dealii::Vector<double> &flow,
                               Matrices *matrices) const;
    void add_flux(const Wall &wall, double clock, const dealii::Vector<double> &u,
                  dealii::Vector<double> &flow, Matrices *matrices) const;
    void add_source(double clock, dealii::Vector<double> &flow) const;
    void add_volumetric_source(unsigned int surface_cell, unsigned int layer, double time,
                               const CellIntegrals &integrals,
                               dealii::Vector<double> &flow, Matrices *matrices) const;
    void add_outflow(const dealii::Vector<double> &u, const dealii::Vector<double> &rate,
                     dealii::Vector<double> &flow, Matrices *matrices) const;

    RayMesh rays;
    Physics laws;
    SurfaceRule surface_rule;
    CellTables regular;
    std::optional<CellTables> at_centre; ///< of the innermost layer with a source
    std::array<Wall, 2> walls;
    unsigned int flux_account = RayMesh::none, source_account = RayMesh::none,
                 volumetric_account = RayMesh::none, outflow_account = RayMesh::none;
    unsigned int n_unknowns = 0;
    std::vector<RayMesh::Place> places; ///< by level
    double total_measure = 0;           ///< of the surface at r = 1
    /** By effect: seconds and calls of the code that only this effect enters. */
    struct Meter
    {
      long calls = 0;
      double seconds = 0;
    };
    mutable std::array<Meter, cases::n_effects> meters;
    mutable long assemblies_of_both_phases = 0;
    dealii::SparsityPattern pattern;
  };
} // namespace meltfront::reference_fem::fitted

#endif
