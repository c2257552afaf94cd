#ifndef meltfront_particles_rkpm_tracked_plane_stencils_h
#define meltfront_particles_rkpm_tracked_plane_stencils_h

#include <particles/rkpm/moment_engine.h>
#include <particles/rkpm_tracked/plane/front.h>
#include <particles/rkpm_tracked/plane/nodes.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** Where a node is. */
  enum class NodePhase : std::uint8_t
  {
    liquid,
    solid,
    front ///< so near to the front that it counts as on it
  };

  /** Those that have a temperature of their own. */
  inline constexpr NodePhase phases[] = {NodePhase::liquid, NodePhase::solid};

  /** Derivatives that a stencil gives, numbered as those of a basis of order 2. */
  enum Derivative : int
  {
    value_of = 0,
    d_x = 1,
    d_y = 2,
    d_xx = 3,
    d_xy = 4,
    d_yy = 5
  };

  /** Weights of a local polynomial fit at a point, of the value and its derivatives. */
  struct PlaneStencil
  {
    /** Nodes by their numbers, front particles by theirs plus the number of nodes. */
    std::vector<std::uint32_t> columns;
    std::array<std::vector<double>, 6> weights;
    double dilation = 0; ///< m
    int order = 0;       ///< of the polynomial; 0: the points determine none
    bool pure = false;   ///< no front particle nor node of the other phase in reach

    double apply(Derivative derivative, std::span<const double> values) const;
  };

  /**
   * Fixed-kernel stencils in one phase: weights of a polynomial fitted to the nodes of
   * the phase and to the front particles, with the kernel frozen at the centre.
   *
   * The kernel's radius is max(2.2 h, 1.3 d), d the distance of the 2k-th neighbour and k
   * the number of basis functions. It grows by 1.2 while the points do not determine the
   * polynomial well; then the order falls. Points that the other phase hides do not
   * count.
   *
   * One for each thread: it owns a workspace.
   */
  class StencilMaker
  {
  public:
    /**
     * @param nodes outlive the maker
     * @param order of the basis
     */
    StencilMaker(const PlaneNodes &nodes, int order);

    /** The front and the phases from now on; they outlive their use. */
    void set_front(const PlaneFront &front, const FrontIndex &index,
                   std::span<const NodePhase> phases);

    /** The nodes have moved: look at their places again. */
    void nodes_moved();

    /** The stencil at a place in a phase (liquid or solid). */
    void make(const PlanePoint &centre, NodePhase phase, PlaneStencil &stencil);

    /** Condition number of the last stencil's moment matrix; infinite if it has none. */
    double condition_number() const;

  private:
    struct Candidate
    {
      double distance;
      std::uint32_t column;
    };

    void gather(const PlanePoint &centre, NodePhase phase, double radius);
    bool hidden(const PlanePoint &from, std::uint32_t column, bool solid) const;
    bool fit(const PlanePoint &centre, double dilation, int order);

    const PlaneNodes &nodes;
    int order;
    std::vector<rkpm::MomentEngine> engines; ///< of order 1, 2, ...
    int last_engine = -1;
    ParticleStorage points; ///< nodes, then front particles
    const PlaneFront *front = nullptr;
    const FrontIndex *index = nullptr;
    std::span<const NodePhase> phases;
    PlaneBins front_bins;
    std::vector<Candidate> candidates;
    std::vector<std::uint32_t> neighbours;
    bool mixed = false;
    long own_particle = -1; ///< front particle at the centre
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
