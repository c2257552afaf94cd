#ifndef meltfront_particles_rkpm_tracked_line_history_h
#define meltfront_particles_rkpm_tracked_line_history_h

#include <particles/rkpm_tracked/line/collocation.h>

#include <array>
#include <deque>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /**
   * Weights of backward differentiation: y'(times[0]) ~ sum_j c_j y(times[j]), the slope
   * of the polynomial through all of them; steps may differ.
   * @param times distinct, the newest first (s)
   */
  std::vector<double> differentiation_weights(std::span<const double> times);

  /** Value at a place of Lagrange's polynomial that is one at one of some points and zero
   * at the others. */
  double lagrange_weight(std::span<const double> points, std::size_t own, double place);

  /**
   * The states that a step looks back on, each phase's temperature extended across its
   * fronts: a node that has changed its phase finds there what its new phase would have
   * had at its place (without it, backward differentiation falls to first order).
   */
  class LineHistory
  {
  public:
    LineHistory(const LineProblem &problem, const LineSettings &settings);

    /** Forget all but this state. */
    void restart(LineState state);

    /** Add a newer state; those that no step looks back on are dropped. */
    void push(LineState state);

    /** Add a state before all others. */
    void add_older(LineState state);

    const LineState &newest() const
    {
      return levels.front();
    }

    std::size_t size() const
    {
      return levels.size();
    }

    const std::deque<LineState> &states() const
    {
      return levels;
    }

    void set(std::deque<LineState> states)
    {
      levels = std::move(states);
    }

    /** Of a state, counted from the newest. */
    const LineState &level(std::size_t number) const
    {
      return levels[number];
    }

    /** Times of the coming state and of those that its step looks back on. */
    std::vector<double> times(double next) const;

    /** The temperature at a node in an interval of a level, extended where the node lay
     * in another one. */
    double temperature(std::size_t level, std::size_t node, std::size_t interval) const;

  private:
    /** Points that an extension goes through: a front, then nodes into the phase. */
    struct Support
    {
      static constexpr std::size_t most = 5;
      std::array<double, most> place{}, value{};
      std::size_t count = 0;

      void add(double x, double y)
      {
        place[count] = x;
        value[count++] = y;
      }
    };

    Support support(const LineState &state, const LineInterval &interval,
                    bool below) const;
    double extension(const LineState &state, const LineInterval &interval,
                     double place) const;

    const LineProblem &problem;
    std::size_t order;            ///< of time
    std::size_t degree;           ///< of extensions
    std::deque<LineState> levels; ///< the newest first
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
