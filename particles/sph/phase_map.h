#ifndef meltfront_particles_sph_phase_map_h
#define meltfront_particles_sph_phase_map_h

#include <cases/effect_meter.h>
#include <cases/effects.h>
#include <cases/material.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /** Least and largest of the values of a pass, and whether all are finite. */
  struct Extremes
  {
    double lowest;
    double highest;
    bool finite;
  };

  /** Extremes of an array, the same whatever the number of threads. */
  Extremes find_extremes(std::span<const double> values, int threads);

  /**
   * The variable w whose differences drive conduction, as a function of enthalpy.
   *
   * Where a phase matters it is the Kirchhoff variable w = k (T - T_m), that is
   * (k_s/c_s) min(H, 0) + (k_l/c_l) max(H - L, 0). Without any phase effect it is the
   * enthalpy H = c (T - T_m) itself, no array is needed for it, and k/c is left to the
   * update. Where properties depend on temperature or the material melts over a range it
   * is w = int k dT along the material's curves.
   */
  class ConductionVariable
  {
  public:
    ConductionVariable(const cases::Material &material, const cases::EffectSet &effects);

    /** w differs from H. */
    bool mapped() const
    {
      return is_mapped;
    }

    /** Heat flow = flow_scale * sum of coefficients * differences of w. */
    double flow_scale() const
    {
      return is_mapped ? 1. : liquid_factor;
    }

    /** w of a wall at a temperature. */
    double of_temperature(double temperature) const;

    double temperature(double w) const;

    /** w = w(H) for all particles. */
    Extremes map(std::span<const double> enthalpy, std::span<double> w, int threads);

    /** dw/dH of all particles; zero while they melt. */
    void slopes(std::span<const double> enthalpy, std::span<double> slope) const;

    /** Costs of the effects that call for the map. */
    std::vector<cases::EffectCost> costs(const cases::EffectSet &effects,
                                         std::size_t bytes) const;

  private:
    cases::Material material;
    bool is_mapped;
    Extremes map_by_curves(std::span<const double> enthalpy, std::span<double> w,
                           int threads) const;

    double solid_factor;  ///< k_s/c_s
    double liquid_factor; ///< k_l/c_l
    cases::EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
