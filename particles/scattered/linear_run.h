#ifndef meltfront_particles_scattered_linear_run_h
#define meltfront_particles_scattered_linear_run_h

#include <particles/scattered/linear_problem.h>

#include <optional>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** One run: the matrices, the unknowns, and their advance in time. */
  class LinearRun : public cases::Run
  {
  public:
    /** Scene and effects must outlive it. */
    LinearRun(const cases::Scene &scene, const cases::EffectSet &effects,
              std::unique_ptr<PosedProblem> posed, const cases::Resolution &resolution);

    // In linear_report.cc:
    cases::RunDescription describe() const override;
    cases::Cost cost() const override;

  private:
    void take_steps() override;
    cases::Snapshot snapshot(long k, double time) override; // in linear_report.cc
    bool steady() const;

    void follow_walls(int cells);

    /** The unknowns whose temperatures are the initial ones. */
    void start();

    cases::Position position(std::size_t site) const;

    /** The matrix of a step; Crank-Nicolson's is that of backward Euler over half of
     * it, times two where time does not count (walls). */
    CompressedRows system(double length) const;

    LinearSolver make_solver(const CompressedRows &matrix, long at_step);
    void solve(LinearSolver &solver, long at_step, double time);
    std::span<const double> temperatures();
    double stored_heat();

    /** Backward Euler alone keeps the principle whatever the step. */
    bool obeys_maximum_principle() const;

    void check(long k, double time);

    // In linear_schemes.cc:
    double rate_of(double length) const;
    void advance(LinearSolver &solver, long k, double end, double length);

    /** Whether what the scene prescribes jumps or bends in a step or the one before: a
     * formula that continues the means of both would overshoot by half of the jump. */
    bool looks_back_over_breakpoint(double end, double length) const;

    /** The step to a time; the schemes of second order know the one before. */
    LinearStep step_to(double end, double length, bool knows_before) const;

    /** load = factor * mass * vector + source. */
    void set_load(double factor, std::span<const double> vector, const LinearStep &step);

    void take_euler_step(LinearSolver &solver, long k, double time, double length);
    void take_crank_nicolson_step(LinearSolver &solver, long k, double end,
                                  double length);

    /** A step of backward Euler, with a matrix of its own. */
    void start_bdf2(long k, double end, double length);

    void take_bdf2_step(LinearSolver &solver, long k, double end, double length);
    bool algebraic(std::size_t row) const;
    void book(const LinearStep &step, double length, double share);

    const cases::Scene &scene;
    const cases::EffectSet &effects;
    std::unique_ptr<PosedProblem> posed;
    const LinearProblem &problem;
    LinearSites sites;
    LinearDescription description;
    std::size_t n;
    LinearOptions options;
    int threads;
    cases::TemperatureBounds bounds;
    std::vector<double> breakpoints;      ///< ascending (s)
    std::optional<LinearSolver> starting; ///< of backward Euler, where BDF2 begins
    LinearSolverParameters solver_parameters;
    long steps = 0;
    double length = 0; ///< of a step (s)
    std::vector<double> unknowns, before, previous, load, source;
    std::vector<double> temperature; ///< where the unknowns are not them
    std::vector<double> solid_fraction;
    double initial_heat = 0;
    cases::HeatBudget heat, heat_before; ///< boundary and sources
    long work = 0, iterations = 0, most_iterations = 0;
    long matrix_entries = 0, entries_per_solve = 0;
    double worst_residual = 0;
    std::optional<LinearSolver> solver;
  };
} // namespace meltfront::particles

#endif
