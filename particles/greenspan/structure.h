#ifndef meltfront_particles_greenspan_structure_h
#define meltfront_particles_greenspan_structure_h

#include <particles/greenspan/experiments.h>

#include <map>
#include <string>
#include <vector>

namespace meltfront::particles::greenspan
{
  /**
   * Pair correlation g(r): how often two particles are at a distance, over how often they
   * would be without any order, but for a factor. Collected from states.
   */
  class PairCorrelation
  {
  public:
    /** @param unit of lengths: the distance at which a pair rests */
    explicit PairCorrelation(double unit);

    void add(const ParticleState &state);

    /**
     * Where g has maxima, ascending, in the unit: those that rise by a fifth over the
     * least g before them and fall by as much after them.
     */
    std::vector<double> peaks() const;

  private:
    double unit;
    int dimension = 2;
    std::vector<double> count; ///< of pairs, by distance
  };

  /** What stages of a run are like: means over the second half of each. */
  class Structure
  {
  public:
    /** @param experiment with stages; must outlive the structure */
    explicit Structure(const Experiment &experiment);

    /**
     * @param energy of all particles together
     * @param solid 1 for each solid particle, 0 for fluid ones
     */
    void look(const ParticleState &state, double energy, const std::vector<char> &solid);

    /** Names and values of cases::reported_scalars(). */
    std::map<std::string, double> report() const;

  private:
    /** Sums over the looks at a stage. */
    struct Sums
    {
      int looks = 0;
      double temperature = 0, energy = 0, partners = 0, order = 0;
      double warmer_above = 0, fluid_above_solid = 0;
      int looks_at_both = 0;
      std::vector<std::array<std::uint32_t, 2>> bonds; ///< of the first look
      std::vector<double> length, squared_length;      ///< sums for each of them
    };

    void look_at_heights(const ParticleState &state, Sums &sums,
                         const std::vector<char> &solid);
    void look_at_bonds(const ParticleState &state, Sums &sums, bool last);
    double lindemann(const Sums &sums) const;

    /** Whether two stages are held at the same temperature. */
    bool same_bath(std::size_t stage, std::size_t other) const;

    /** By how much a stage is warmer than the one before; 0 where one of them lacks. */
    double rise(std::size_t stage) const;

    /** Energy over temperature from the stage before to this one. */
    double heat_capacity(std::size_t stage) const;

    const Experiment &experiment;
    double bond_length; ///< half way between the first two shells of the crystal
    std::vector<Sums> stages;
    PairCorrelation correlation;     ///< of the last stage
    std::vector<long> with_partners; ///< particles by their number of partners
  };
} // namespace meltfront::particles::greenspan

#endif
