#ifndef meltfront_particles_sph_time_explicit_scheme_h
#define meltfront_particles_sph_time_explicit_scheme_h

#include <particles/sph/time/time_stepping.h>

#include <utility>
#include <vector>

namespace meltfront::particles
{
  /**
   * Explicit Euler steps and RKL2 super steps of a state y with dy/dt = F(y)/m, F the
   * flow into each particle. Whose flow it is the callers say: `follow()` finds what the
   * flow depends on after the state has changed; `evaluate(fraction, flow)` computes it
   * at a fraction of the step, and returns the flow of heat through walls.
   */
  class ExplicitScheme
  {
  public:
    /**
     * @param active entries of the state that steps change; the rest is padding
     * @param size of the state
     */
    ExplicitScheme(const StepPlan &plan, std::size_t active, std::size_t size,
                   int threads)
      : super_step(plan.stages)
      , active(active)
      , threads(threads)
      , flow(size)
    {
      if(plan.stages > 1)
        for(auto *array : {&start, &before, &start_flow})
          array->resize(size);
    }

    /** For super steps of any number of stages; see use_stages(). */
    ExplicitScheme(std::size_t active, std::size_t size, int threads)
      : super_step(3)
      , active(active)
      , threads(threads)
      , flow(size)
      , start(size)
      , before(size)
      , start_flow(size)
    {
    }

    /** Of super steps from now on. */
    void use_stages(int stages)
    {
      if(super_step.stages.size() + 1 != static_cast<std::size_t>(stages))
        super_step = SuperStep(stages);
    }

    /**
     * Equal Euler steps.
     * @param scale of the flows: evaluate() gives them over it
     * @return heat through walls.
     */
    template <typename Follow, typename Evaluate>
    double take_euler_steps(std::vector<double> &state, double duration, int steps,
                            double scale, double mass, const Follow &follow,
                            const Evaluate &evaluate)
    {
      const double step = duration / steps;
      double wall_heat = 0;
      for(int i = 0; i < steps; ++i)
      {
        if(i > 0)
          follow();
        wall_heat += step * scale * evaluate(double(i) / steps, flow);
        add(step * scale / mass, flow, state);
      }
      return wall_heat;
    }

    /** One step of RKL2. @return heat through walls, by the same recursion. */
    template <typename Follow, typename Evaluate>
    double take_super_step(std::vector<double> &state, double duration, double scale,
                           double mass, const Follow &follow, const Evaluate &evaluate)
    {
      const double step = duration * scale;
      const double factor = duration * scale / mass;
      start = state;
      before = state;
      const double start_rate = evaluate(0., start_flow);
      double wall_before = 0;
      double wall = super_step.first_rate * step * start_rate;
      add(super_step.first_rate * factor, start_flow, state);
      for(const SuperStage &stage : super_step.stages)
      {
        follow();
        const double rate = evaluate(stage.fraction, flow);
        combine(stage, factor, state);
        std::swap(before, state);
        const double wall_next
            = stage.previous * wall + stage.before * wall_before
              + step * (stage.rate * rate + stage.start_rate * start_rate);
        wall_before = wall;
        wall = wall_next;
      }
      return wall;
    }

    /** Back to the state before the last super step. */
    void restore(std::vector<double> &state)
    {
      std::swap(state, start);
    }

  private:
    void add(double factor, const std::vector<double> &added,
             std::vector<double> &state) const;

    /** Y_j from Y_(j-1), the state, into the array of Y_(j-2). */
    void combine(const SuperStage &stage, double factor,
                 const std::vector<double> &state);

    SuperStep super_step;
    std::size_t active;
    int threads;
    std::vector<double> flow;
    std::vector<double> start, before, start_flow; ///< Y_0, Y_(j-2), F(Y_0) of RKL2
  };
} // namespace meltfront::particles

#endif
