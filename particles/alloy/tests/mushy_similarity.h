#ifndef meltfront_particles_alloy_tests_mushy_similarity_h
#define meltfront_particles_alloy_tests_mushy_similarity_h

#include <cases/material.h>

#include <vector>

namespace meltfront::particles::testing
{
  /** An alloy that freezes from a wall at y = 0 as an ideal mushy layer, without flow and
   * diffusion of solute. */
  struct MushyLayer
  {
    cases::Material material;
    double depression = 0;      ///< of the liquidus by the bulk composition (K)
    double expansion = 1;       ///< density over the crystals'
    double wall = 0;            ///< T - T_m (K)
    double far = 0;             ///< T - T_m (K)
    bool constant_heat = false; ///< L, instead of L + (c_l - c_s)(T - T_m)
  };

  /**
   * Its similarity solution in eta = y / sqrt(4 k_l t/(rho c_l)), by shooting with the
   * classical Runge-Kutta method: an oracle that shares nothing with the methods.
   *
   *   (kbar T')' = -2 eta k_l (c_eff/c_l) T' in the mush, T = -P at eta = lambda with the
   *   slope of the liquid's error function.
   */
  class MushySimilarity
  {
  public:
    explicit MushySimilarity(const MushyLayer &layer);

    double lambda() const
    {
      return front_constant;
    }

    double front(double time) const;

    /** T - T_m */
    double temperature(double y, double time) const;

    /** By mass. */
    double solid_fraction(double y, double time) const;

    /** Integral of the solid fraction over y (m). */
    double solid_length(double time) const;

  private:
    struct Slope
    {
      double temperature, flux;
    };

    Slope slope(double eta, double temperature, double flux) const;
    double shoot(double lambda, bool keep);
    double scale(double time) const;
    double in_mush(double eta) const;
    double solid_at(double temperature) const;

    MushyLayer layer;
    double front_constant = 0;
    std::vector<double> values, slopes; ///< T and T' from eta = lambda down to 0
  };
} // namespace meltfront::particles::testing

#endif
