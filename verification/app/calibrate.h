#ifndef meltfront_verification_app_calibrate_h
#define meltfront_verification_app_calibrate_h

#include <particles/greenspan/calibration/calibration.h>

#include <string>

namespace meltfront::verification
{
  struct CalibrateArguments
  {
    std::string what;                   ///< `greenspan`
    std::string substance = "triangle"; ///< or `rectangle`: the solids of the report
    bool full = false;                  ///< more seeds, larger and longer runs
    double pressure = -1; ///< force per length; below 0: as the effort has it
    double hot = 60;      ///< temperature of the wall that melts
    double cold = 30;     ///< temperature of the solid
    int seeds = 0;        ///< 0: as the effort has it
    int jobs = 0;         ///< seeds at once; 0: one per core
    std::string output;   ///< file; empty: results/calibration-SUBSTANCE.prm
  };

  /**
   * The continuum's properties of a particle solid: prints them with their standard
   * errors, and writes them as the material of a case file.
   * @return exit status
   */
  int calibrate(const CalibrateArguments &arguments);

  /** The properties in a table of plain text. */
  std::string calibration_text(const particles::greenspan::ContinuumMaterial &material);

  /**
   * Subsection `Material` of a case file for heat that flows between two temperatures.
   * Its lengths are masses over the density of the solid at the melting temperature, in
   * which thermal expansion drops out: both phases have that density, and conductivities
   * are multiplied by the phase's own density over it. Properties are those in the middle
   * between the melting temperature and the phase's other end.
   */
  std::string material_section(const particles::greenspan::ContinuumMaterial &material,
                               double hot, double cold);
} // namespace meltfront::verification

#endif
