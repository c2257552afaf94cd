#ifndef meltfront_particles_sph_two_population_sites_h
#define meltfront_particles_sph_two_population_sites_h

#include <cases/effect_meter.h>
#include <cases/snapshot.h>
#include <particles/alloy/mixture_state.h>
#include <particles/sph_two_population/kernel_sums.h>
#include <particles/sph_two_population/parameters.h>
#include <particles/sph_two_population/phase_exchange.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** One population: the liquid or the ice particles of all sites. */
  struct Population
  {
    std::vector<double> mass; ///< kg m^(d-3)
    std::vector<double> heat; ///< enthalpy, solid solvent at T_m counts zero (J m^(d-3))
    std::vector<double> excess; ///< T - T_m
    std::vector<double> share;  ///< volume over the site's
  };

  /** Sites with one liquid and one ice particle each, and the change of phase between
   * them (SiteExchange). New ice goes to its own site or is spread over the kernel. */
  class Sites
  {
  public:
    Sites(const Discretisation &discretisation, const AlloySubstance &substance,
          const TwoPopulationParameters &parameters, const MixtureState &initial,
          std::size_t padded);

    /** Freeze and melt until every liquid is in equilibrium with its ice, then update().
     */
    void change_phase();

    /** Temperatures and shares of volume from masses and heats. */
    void update();

    /** Add flows times a duration (s). */
    void add_heat(std::span<const double> to_liquid, std::span<const double> to_ice,
                  double duration);
    void add_solute(std::size_t solute, std::span<const double> flow, double duration);

    /** Arrays that steps change: masses and heats of both populations, concentrations. */
    std::size_t n_fields() const
    {
      return 4 + concentration.size();
    }

    /** All fields one after another. */
    void store(std::vector<double> &state) const;

    /** The opposite, then change_phase(). */
    void load(std::span<const double> state);

    /**
     * Rates of all fields from flows of heat in the places of the heats and of solutes in
     * those of the concentrations: liquid that stays at its liquidus freezes or melts ice
     * meanwhile (SiteExchange::freezing_rate).
     */
    void make_rates(std::span<double> flows) const;

    SiteContent<double> content(std::size_t site) const;
    void set_content(std::size_t site, const SiteContent<double> &content);

    /** What the depression of the liquidus follows: PS or, on a curve, the mass of
     * solute.
     */
    double dissolved(std::size_t site) const;

    /** Call visitor(solute_of), solute_of(dissolved) the StraightSolute or CurvedSolute
     * of a site: loops over sites within it know which. */
    template <typename Visitor>
    void with_liquidus(const Visitor &visitor) const
    {
      if(curve)
        visitor(
            [liquidus = &*curve](double solute) {
              return CurvedSolute{liquidus, solute};
            });
      else
        visitor([](double depression_mass) { return StraightSolute{depression_mass}; });
    }

    /** The liquidus where it is curved, else null. */
    const CurvedLiquidus *curved_liquidus() const
    {
      return curve ? &*curve : nullptr;
    }

    /** The first site whose liquid is saltier than a curved liquidus is known for. */
    std::optional<std::size_t> beyond_liquidus() const;

    const SiteExchange &phase_exchange() const
    {
      return exchange;
    }

    /** Costs of the effects that call for the change of phase and for both populations.
     * @param per_solute bytes of an array of concentrations. */
    std::vector<cases::EffectCost> costs(const cases::EffectSet &effects,
                                         std::size_t per_solute) const;

    cases::HeatBudget heat_content(double measure) const;
    double total_mass() const;
    double total_of(std::size_t solute) const;

    Population liquid, ice;
    /** Mass of each solute over the site's. */
    std::vector<std::vector<double>> concentration;
    /** Mass of the liquid over the site's. */
    std::vector<double> liquid_fraction;
    std::vector<double> depression;   ///< by the site's concentrations
    std::vector<double> solid_volume; ///< of densities summed over kernels
    std::vector<unsigned char> is_dirichlet;
    std::vector<unsigned char> is_kept; ///< both phases are kept in equilibrium
    double site_mass;
    double crystal_density;
    long work = 0; ///< interactions of the sums over kernels

  private:
    template <typename SoluteOf>
    void change_sites(const SoluteOf &solute_of);
    template <typename SoluteOf>
    void make_rates(std::span<double> flows, const SoluteOf &solute_of) const;
    void check_composition(const Discretisation &discretisation) const;
    void share_out(const MixtureState &initial, std::size_t site);
    void spread_new_ice();

    const AlloySubstance &substance;
    TwoPopulationParameters parameters;
    std::size_t n;
    double volume;
    SiteExchange exchange;
    std::optional<CurvedLiquidus> curve;
    std::vector<double> weight; ///< of each solute in dissolved()
    cases::EffectMeter meter;
    std::optional<KernelSums> kernel_sums;
    std::vector<double> normaliser;        ///< zeta of equation 4.14
    std::vector<double> new_ice, new_heat; ///< made by each liquid, not yet given
    std::vector<double> gained;
  };
} // namespace meltfront::particles

#endif
