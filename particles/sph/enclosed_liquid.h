#ifndef meltfront_particles_sph_enclosed_liquid_h
#define meltfront_particles_sph_enclosed_liquid_h

#include <particles/core/particle_operator.h>

#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * Finds the liquid that has no way to the outlet through particles that hold liquid.
   *
   * Where fronts meet, the last particles between them freeze one by one: whether such a
   * pocket, of particles that all border on solid, still has a way out is less than
   * particles tell. What it has to displace is handed on to the nearest particles that
   * have one. A wider pocket is really enclosed.
   */
  class EnclosedLiquid
  {
  public:
    /** @param openings particles beside the outlet */
    EnclosedLiquid(const ParticleOperator &rows, std::vector<std::uint32_t> openings);

    struct Outcome
    {
      double straight_out = 0; ///< due, where no liquid is left to have a way (m^d)
      double stuck = 0; ///< the most that a particle of a wide pocket has to displace
    };

    /**
     * Leave out of the liquid what is enclosed, and hand on what narrow pockets have to
     * displace.
     * @param liquid 1 for particles that hold liquid, else 0
     * @param due what each has to displace (m^d)
     */
    Outcome settle(std::span<double> liquid, std::span<double> due);

  private:
    struct Pocket
    {
      std::vector<std::uint32_t> particles;
      bool wide = false;
      double most_due = 0;
    };

    Pocket pocket_about(std::uint32_t particle, std::span<const double> liquid,
                        std::span<const double> due);
    template <typename Passes>
    void spread(const Passes &passes);

    const ParticleOperator &rows;
    std::vector<std::uint32_t> openings;
    std::vector<std::uint32_t> found; ///< in the order in which they were reached
    std::vector<std::uint32_t> heir;  ///< by particle: whom it was reached from, or none
  };
} // namespace meltfront::particles

#endif
