#ifndef meltfront_particles_greenspan_calibration_calibration_h
#define meltfront_particles_greenspan_calibration_calibration_h

#include <particles/greenspan/bar/conduction.h>
#include <particles/greenspan/bar/similarity.h>
#include <particles/greenspan/calibration/coexistence.h>

#include <functional>
#include <string>

namespace meltfront::particles::greenspan
{
  /** What is run to measure a substance. Each seed makes all runs of its own. */
  struct CalibrationSettings
  {
    PairForce force = PairForce::triangle();
    double pressure = 30;
    double melting_guess = 45; ///< of the melting temperature at this pressure
    /** Temperatures at which phases are held, relative to the guess. */
    std::vector<double> solid_excess{-8, -1}, liquid_excess{2, 8, 15};
    /** Temperatures in the middle of two baths, relative to the guess. */
    std::vector<double> solid_conduction{-8}, liquid_conduction{8};
    double half_difference = 7; ///< between a bath and the middle
    int bulk_side = 16;         ///< columns and rows of a phase
    int slab_columns = 48;      ///< between baths
    int rows = 12;              ///< of slabs between baths and of bars
    int bar_columns = 64;       ///< of the bar of which half is molten
    double time_step = 4e-4;
    double bulk_time = 12;       ///< of averages of a phase
    double conduction_time = 50; ///< of averages between baths
    double coexistence_time = 20;
    int members = 3; ///< seeds
    std::uint64_t first_seed = 1;
    int threads = 1; ///< seeds run side by side

    /** About a minute on two cores: conductivities within 5 to 10 %. */
    static CalibrationSettings quick(const PairForce &force);

    /** Ten times that: larger, longer, more seeds. */
    static CalibrationSettings full(const PairForce &force);

    /** @throws cases::InputError */
    void validate() const;
  };

  /** Mean over the seeds and its standard error. */
  struct Measured
  {
    double value = 0;
    double error = 0;
  };

  /** What one seed gives. */
  struct CalibrationMember
  {
    Substance substance;
    double liquid_order = 0;      ///< largest lattice_order of a liquid: not a crystal
    double solid_order = 0;       ///< least lattice_order of a solid: not molten
    double molten_share = 0;      ///< of the bar in balance
    double largest_imbalance = 0; ///< of the heat of two baths, relative
    double spacing = 0;           ///< of the crystal at the melting temperature
  };

  /** A seed whose runs did not come to their end, which the means go without. */
  struct FailedSeed
  {
    std::uint64_t seed;
    std::string reason;
  };

  struct MeasuredPhase
  {
    Measured density, density_slope;             ///< at the melting temperature
    Measured conductivity, conductivity_slope;   ///< there
    Measured heat_capacity, heat_capacity_slope; ///< there
  };

  /** A particle solid as a continuum at one pressure, in the units of the report. */
  struct ContinuumMaterial
  {
    CalibrationSettings settings; ///< of the runs
    Measured melting_temperature, latent_heat, spacing;
    MeasuredPhase solid, liquid;
    std::vector<CalibrationMember> members;
    std::vector<FailedSeed> failures;

    /** Of the means. */
    Substance substance() const;

    /** Slope of the squared mass of melt over time, melt_half_space, with the standard
     * error that the seeds' own substances give. */
    Measured front_slope(double wall_temperature, double initial_temperature) const;
  };

  /** Called with the share of runs done and what has just ended, by one thread at a time.
   */
  using CalibrationProgress = std::function<void(double, const std::string &)>;

  /**
   * Properties of a particle solid: densities, heat capacities and the jump of enthalpy
   * from phases held at constant temperature and pressure, the melting temperature from
   * bars of which half is molten, conductivities from slabs between two baths. A seed
   * that fails is named and left out as long as two or more are left.
   * @throws cases::InputError, cases::NumericalError
   */
  ContinuumMaterial calibrate(const CalibrationSettings &settings,
                              const CalibrationProgress &progress = {});

  /** Mean and standard error. */
  Measured measured(const std::vector<double> &values);

  /** Polynomial through values by least squares, coefficients from the constant on.
   * @throws cases::InputError for fewer values than coefficients */
  std::vector<double> fit_polynomial(const std::vector<double> &x,
                                     const std::vector<double> &y, int degree);
} // namespace meltfront::particles::greenspan

#endif
