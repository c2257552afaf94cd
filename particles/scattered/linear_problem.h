#ifndef meltfront_particles_scattered_linear_problem_h
#define meltfront_particles_scattered_linear_problem_h

#include <cases/option_binder.h>
#include <cases/run.h>
#include <cases/scene.h>
#include <particles/scattered/compressed_rows.h>
#include <particles/scattered/given_values.h>
#include <particles/scattered/linear_solver.h>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace meltfront::particles
{
  /** Heat per time, in the measure of the sites' weights (W m^(d-3)). */
  struct HeatInflow
  {
    double through_walls = 0;
    double released = 0; ///< by sources in the domain
  };

  /**
   * Heat conduction on scattered unknowns,
   *
   *   mass * dU/dt = operator * U + source,
   *
   * with empty rows in the mass where an equation holds at each time (walls). A steady
   * problem is 0 = operator * U + source.
   */
  struct LinearProblem
  {
    CompressedRows operator_rows;
    CompressedRows mass;
    /** Right-hand side of a step, one value per row; overwritten. */
    std::function<void(const LinearStep &step, std::span<double>)> source;
    /** Temperatures at the sites from the unknowns; empty: the unknowns are them. */
    CompressedRows reconstruction;
    bool symmetric = false; ///< operator_rows is symmetric and -operator definite
    /** Heat that flows in with the unknowns at step.at and the right-hand side of a step;
     * empty: the method does not balance heat. */
    std::function<HeatInflow(const LinearStep &step, std::span<const double> unknowns)>
        inflow;
  };

  /** The sites at which temperatures are reported; outlive the run. */
  struct LinearSites
  {
    int dimension = 1;
    std::array<std::span<const double>, 3> positions{};
    std::span<const double> weights; ///< as Snapshot::weights
  };

  struct NodeSet;

  /** Nodes as sites. */
  LinearSites sites_of(const NodeSet &nodes, int dimension,
                       std::span<const double> weights);

  /** How a linear problem is stepped. */
  enum class LinearScheme
  {
    backward_euler,
    crank_nicolson,
    bdf2
  };

  /** The options that all methods on linear problems share. */
  struct LinearOptions
  {
    void bind(cases::OptionBinder &options);

    LinearMethod linear_solver = LinearMethod::automatic;
    double solver_tolerance = 1e-12;
    LinearScheme time_scheme = LinearScheme::bdf2;
    long steps = 0; ///< 0: by n
  };

  /** Matrices of a method, for what a run of it takes. */
  struct LinearSize
  {
    double nodes;
    double entries;  ///< of a row
    double matrices; ///< with as many entries that are kept at a time
    double per_node; ///< bytes that each node takes beside its rows
  };

  /** What a run on the linear problem of a scene takes,. */
  cases::Demand linear_demand(const cases::Scene &scene,
                              const cases::Resolution &resolution,
                              const LinearSize &size);

  /** What a run says of itself beside what all linear runs say. */
  struct LinearDescription
  {
    std::string method;
    cases::RunDescription run; ///< time_step and unknowns are filled in
    bool obeys_maximum_principle = false;
    cases::Overshoot overshoot{}; ///< of the method's capabilities
    long setup_work = 0;          ///< entries touched while rows were made
  };

  /** A linear problem with the nodes that it is posed on. */
  class PosedProblem
  {
  public:
    virtual ~PosedProblem() = default;
    virtual const LinearProblem &linear() const = 0;
    virtual LinearSites sites() const = 0;
    virtual LinearDescription description() const = 0;
    virtual std::vector<cases::EffectCost>
    effect_costs(const cases::EffectSet &effects) const = 0;
  };

  /**
   * A run that solves the steady problem, or steps the transient one from the scene's
   * initial temperature to its end, with one factorisation.
   *
   * @throws NumericalError (method, step, time) if a matrix is singular, a solve does not
   * converge, or a value is not finite.
   */
  std::unique_ptr<cases::Run> make_linear_run(const cases::Scene &scene,
                                              const cases::EffectSet &effects,
                                              std::unique_ptr<PosedProblem> posed,
                                              const cases::Resolution &resolution);
} // namespace meltfront::particles

#endif
