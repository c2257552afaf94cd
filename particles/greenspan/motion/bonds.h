#ifndef meltfront_particles_greenspan_motion_bonds_h
#define meltfront_particles_greenspan_motion_bonds_h

#include <particles/greenspan/motion/particle_state.h>
#include <particles/greenspan/motion/sparse_cells.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace meltfront::particles::greenspan
{
  /** Pairs of particles nearer to each other than a bond's greatest length. */
  class BondGraph
  {
  public:
    /** @param length of a bond at most, exclusive: 1.5 in the report */
    BondGraph(int dimension, const std::array<std::vector<double>, 3> &position,
              double length = 1.5);

    /** The same where space repeats itself as it does for the state. */
    explicit BondGraph(const ParticleState &state, double length = 1.5);

    /** Number of particles. */
    std::size_t size() const
    {
      return found.first.size();
    }

    /** Number of bonds. */
    std::size_t count() const
    {
      return found.entries.size() / 2;
    }

    /** Partners of a particle, ascending. */
    std::span<const std::uint32_t> operator[](std::size_t particle) const
    {
      return found[particle];
    }

    /** Mean number of partners of a particle. */
    double coordination() const
    {
      return static_cast<double>(found.entries.size()) / static_cast<double>(size());
    }

    bool bonded(std::size_t a, std::size_t b) const;

    /** How many of this graph's bonds another one of the same particles has, too. */
    std::size_t shared_with(const BondGraph &other) const;

    /** 1 for each corner of a triangle of bonds whose three corners are eligible. */
    std::vector<char> in_triangle(const std::vector<char> &eligible) const;

    /** The same where all are eligible. */
    std::vector<char> in_triangle() const;

  private:
    FoundRows found;
  };

  /** The length of the shortest bond and of the longest one; NaN where there is none. */
  std::pair<double, double> bond_lengths(const ParticleState &state,
                                         const BondGraph &bonds);

  /**
   * Mean over all particles of the plane of |psi_6|, psi_6 the mean of exp(6 i angle)
   * over the directions to a particle's partners: 1 in a hexagonal crystal, whatever its
   * orientation; particles without partners count as 0.
   */
  double hexatic_order(const ParticleState &state, const BondGraph &bonds);

  /** |psi_6| of each particle of the plane, psi_6 averaged over it and its partners. */
  std::vector<double> order_of_surroundings(const ParticleState &state,
                                            const BondGraph &bonds);

  /**
   * Real part of psi_6 of each particle of the plane: 1 in a hexagonal crystal with rows
   * along x, on average 0 in a liquid and in crystals that lie any way.
   */
  std::vector<double> lattice_order(const ParticleState &state, const BondGraph &bonds);
} // namespace meltfront::particles::greenspan

#endif
