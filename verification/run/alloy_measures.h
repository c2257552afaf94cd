#ifndef meltfront_verification_run_alloy_measures_h
#define meltfront_verification_run_alloy_measures_h

#include <cases/case.h>
#include <verification/measure/formulas/entropy.h>
#include <verification/record/run_record.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * What is measured of a run beside its front: budgets of substances, entropy, and the
   * state of a mush against the exact one.
   *
   * Results by name, NaN where not defined:
   *
   * temperature_rms, solid_fraction_rms, concentration_rms, ice_error: MushError at the
   * end (K, mass fractions, relative), between Measurement::temperature_from and
   * temperature_to; the same with _1 to _8 at Measurement::marks, each in the first
   * snapshot at or after the mark, against the exact state of the snapshot's own time;
   * mass_defect, solute_defect: largest relative defect of any snapshot, of all mass and
   * of the solute that has the larger one;
   * entropy_fall, mixing_entropy_fall: largest fall of Entropy::total and of
   * Entropy::mixing from one snapshot to the next, over the largest gain since the start:
   * above round-off the second law is broken.
   */
  class AlloyMeasures
  {
  public:
    /**
     * @param c the case, which outlives the measures
     * @param simulated the case's scene as it is handed to the method
     * @param spacing of the sites (m)
     */
    AlloyMeasures(const cases::Case &c, const cases::Scene &simulated, double spacing);

    /** Take a snapshot into account; they come in the order of time. */
    void add(const cases::Snapshot &snapshot, const std::vector<double> &coordinates);

    /** Compare the last one, which has been added, as the end. */
    void measure_end(const cases::Snapshot &snapshot,
                     const std::vector<double> &coordinates);

    std::map<std::string, double> quantities() const;

    /** The states of an alloy at the marks, in their order; of a pure substance that at
     * Measurement::picture_mark. */
    const std::vector<RunProfile> &profiles() const;

    static const std::vector<std::string> &quantity_names();

  private:
    /** The course of an entropy. */
    struct EntropyCourse
    {
      void add(double value);

      double fall() const; ///< over the gain; NaN of nothing

      long samples = 0;
      double first = 0, last = 0, largest_fall = 0, largest_gain = 0;
    };

    void compare(const cases::Snapshot &snapshot, const std::vector<double> &coordinates,
                 const std::string &suffix);

    const cases::Case &the_case;
    const cases::ExactSolution *mush; ///< null where the exact state is no mush
    std::size_t solutes;
    double spacing;
    double lower, upper;   ///< ends of the coordinate (m)
    double time_tolerance; ///< a time this near a mark is the mark's (s)
    std::optional<EntropyMeter> entropy_meter;
    EntropyCourse total, mixing;
    std::size_t next_mark = 0;
    std::vector<RunProfile> mark_profiles;
    std::map<std::string, double> values;
  };
} // namespace meltfront::verification

#endif
