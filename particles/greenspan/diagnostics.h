#ifndef meltfront_particles_greenspan_diagnostics_h
#define meltfront_particles_greenspan_diagnostics_h

#include <particles/greenspan/experiments.h>

#include <array>
#include <vector>

namespace meltfront::particles::greenspan
{
  /** Looks at a run now and then and writes its record. */
  class Diagnostics
  {
  public:
    /** @param experiment that is run; must outlive the diagnostics */
    explicit Diagnostics(const Experiment &experiment);

    /** Look at a state; the first is the start, each later one an interval on. */
    void look(const ParticleState &state);

    /** Whether each particle is solid (1) or fluid (0) in the last state. */
    const std::vector<char> &solid() const;

    const RunRecord &record() const;

    /** What it goes on from when a run is resumed. */
    struct Memory
    {
      RunRecord record;
      std::vector<std::array<std::vector<double>, 3>> positions; ///< oldest first
      std::vector<char> last_solid;
    };

    Memory memory() const;

    /** Go on as the diagnostics whose memory this is. */
    void remember(const Memory &memory);

  private:
    void judge(long step, int count);
    bool nobody_heated(const ParticleState &state) const;
    void look_at_corners(const ParticleState &state, const BondGraph &bonds);
    void finish(const ParticleState &state, const BondGraph &bonds);

    const Experiment &experiment;
    BondGraph first_bonds;
    AverageVelocity average;
    std::vector<char> last_solid;
    RunRecord the_record;
  };
} // namespace meltfront::particles::greenspan

#endif
