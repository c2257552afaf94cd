#ifndef meltfront_particles_rkpm_tracked_line_relax_h
#define meltfront_particles_rkpm_tracked_line_relax_h

#include <particles/rkpm_tracked/line/collocation.h>
#include <particles/rkpm_tracked/node_relaxation.h>

#include <span>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /**
   * Relaxes the inner nodes of a line, each phase between its ends. No node crosses a
   * front by that.
   *
   * A node whose home the front is about to pass is let go (RelaxRule::springs): it is
   * put so near to the front that the next steps pass it, and changes its phase by that.
   */
  class LineRelaxation
  {
  public:
    /** Nodes are at home where they are now. */
    LineRelaxation(const LineProblem &problem, RelaxRule rule);

    /**
     * Where the nodes of a state go, ascending.
     * @param time until they are relaxed again (s)
     */
    std::vector<double> places(const LineProblem &problem, const LineState &state,
                               double time);

  private:
    using NodeRange = std::pair<std::size_t, std::size_t>; ///< [first, end)

    void relax(const LineProblem &problem, const LineState &state, std::size_t number,
               double time, std::vector<double> &places) const;

    void relax_between(const LineProblem &problem, NodeRange range,
                       std::pair<double, double> ends, std::vector<double> &places) const;

    std::vector<double> homes;
    RelaxRule rule;
    bool settled = false; ///< relaxed once: only nodes about fronts move any more
  };

  /**
   * Give a state its temperatures at other places of the nodes: Lagrange polynomials
   * through the nearest points of the phase in which a place lies at the state's time,
   * nodes and ends, within the range of the phase. Nodes that stay keep theirs.
   * @param degree of the polynomials, where a phase has the points
   */
  void resample(const LineProblem &problem, std::span<const double> places,
                std::size_t degree, LineState &state);
} // namespace meltfront::particles::rkpm_tracked

#endif
