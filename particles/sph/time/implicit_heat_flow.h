#ifndef meltfront_particles_sph_time_implicit_heat_flow_h
#define meltfront_particles_sph_time_implicit_heat_flow_h

#include <particles/sph/heat_flow.h>
#include <particles/sph/time/implicit_solver.h>

namespace meltfront::particles
{
  /** The heat flow between particles of one substance: T(H) has the branches of solid, of
   * what melts at one temperature, of what is partly solid, and of liquid. */
  class ImplicitHeatFlow : public ImplicitFlow
  {
  public:
    ImplicitHeatFlow(HeatFlow &heat_flow, const cases::Material &material,
                     std::size_t particles);

    std::size_t size() const override
    {
      return n;
    }

    std::size_t padded_size() const override
    {
      return heat_flow.padded_size();
    }

    double scale() const override
    {
      return heat_flow.scale();
    }

    double evaluate(std::span<const double> enthalpy, double fraction,
                    std::span<double> flow) override;

    void linearise(std::span<const double> enthalpy, double fraction) override
    {
      heat_flow.linearise(enthalpy, fraction);
    }

    void apply_derivative(std::span<const double> change,
                          std::span<double> flow_change) override
    {
      heat_flow.apply_derivative(change, flow_change);
    }

    std::span<const double> derivative_diagonal() const override
    {
      return heat_flow.derivative_diagonal();
    }

    std::size_t half_bandwidth() const override
    {
      return heat_flow.half_bandwidth();
    }

    void correct(std::span<const double> correction,
                 std::span<double> enthalpy) const override;
    double largest_sensible_heat(std::span<const double> enthalpy) const override;

  private:
    double stop_at_kink(double from, double to) const;

    HeatFlow &heat_flow;
    double latent_heat; ///< exchanged at one temperature (J/kg)
    /** Specific enthalpies where a melting range begins and ends, off what is exchanged
     * at one temperature (J/kg). */
    std::vector<double> ends_of_range;
    std::size_t n;
  };
} // namespace meltfront::particles

#endif
