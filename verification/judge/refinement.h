#ifndef meltfront_verification_judge_refinement_h
#define meltfront_verification_judge_refinement_h

#include <verification/measure/formulas/order_fit.h>
#include <verification/record/run_record.h>
#include <verification/record/stored_case.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * What the runs of one label refine: their spacing h, or at equal spacing their time
   * step dt. Orders, tables and plots of the label are over that.
   */
  class Refinement
  {
  public:
    /** Of no run: space. */
    Refinement() = default;

    /** @param runs of one label; those that did not finish do not count */
    explicit Refinement(const std::vector<const RunRecord *> &runs);

    bool in_time() const;

    /** `h` or `dt`. */
    std::string symbol() const;

    /** h (m) or dt (s) of a run. */
    double of(const RunRecord &run) const;

  private:
    bool time = false;
  };

  /** Of which power of a length volumes are in the measure of the scene: 1 in planar
   * scenes, 2 in cylindrical, 3 in spherical ones, 3 about an axis,
   * else the dimension. */
  int measure_dimension(const StoredCase &record);

  /**
   * The error of a quantity that says nothing any more: 1e-13 of the domain's side for
   * positions of the front and of the corresponding volume for the solid's, 1e-13 for
   * quantities that are relative.
   */
  double round_off_floor(const StoredCase &record, const std::string &quantity);

  /**
   * The highest order that is believed of a run's scheme: in space 3, or for elements of
   * degree p (the option `degree`) the superconvergent 2 p + 1/2 where that is more; in
   * time 5.5, half an order above the fifth, the highest that there is.
   */
  double plausible_order(const RunRecord &run, const Refinement &refinement);

  /** A quantity's errors over a label's levels. */
  struct ErrorLevels
  {
    std::vector<double> abscissa; ///< h (m) or dt (s)
    std::vector<double> error;
  };

  /** fit_order() with the floor of the quantity and the plausible order of the run. */
  OrderFit fit_levels(const ErrorLevels &levels, const StoredCase &record,
                      const std::string &quantity, const RunRecord &run,
                      const Refinement &refinement);
} // namespace meltfront::verification

#endif
