#ifndef meltfront_particles_rkpm_tracked_line_stencils_h
#define meltfront_particles_rkpm_tracked_line_stencils_h

#include <particles/core/particle_storage.h>
#include <particles/rkpm/moment_engine.h>

#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** Weights of the first and second derivative at a point, for points first, first + 1,
   * ... of an ascending cloud. */
  struct LineStencil
  {
    std::size_t first = 0;
    std::vector<double> slope, second; ///< 1/m, 1/m^2
    double radius = 0;                 ///< of the kernel (m)

    std::size_t size() const
    {
      return slope.size();
    }

    std::size_t end() const
    {
      return first + slope.size();
    }
  };

  /**
   * Collocation weights on a line: polynomials fitted to the points within the radius of
   * a kernel that is fixed at the point (a cubic spline). The radius grows until it holds
   * two points more than the order; where the whole cloud has fewer, all count, and the
   * order falls to what they determine.
   */
  class LineStencils
  {
  public:
    explicit LineStencils(int order);

    /**
     * Weights at a place.
     * @param reach of the kernel there (m)
     * @param cloud ascending places, two at least
     * @throws cases::InputError if the points determine no polynomial of first order
     */
    void evaluate(double place, double reach, const ParticleStorage &cloud,
                  LineStencil &stencil);

  private:
    /** The points nearer than a radius: [first, end). */
    void find_window(double place, double radius, const std::vector<double> &x);

    int order;
    std::vector<rkpm::MomentEngine> engines; ///< of order 1, 2, ...
    std::vector<std::uint32_t> neighbours;
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
