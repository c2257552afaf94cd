#include <cases/error.h>
#include <particles/sph/liquid_balance.h>

#include <fmt/format.h>

namespace meltfront::particles
{
  namespace
  {
    void require_lattice(const SphParameters &p)
    {
      const char *wrong = p.layout != LatticeLayout::cell_centred ? "layout = cell"
                          : p.jitter > 0 || p.arrangement >= Arrangement::random
                              ? "particles on a lattice (jitter = 0)"
                          : !p.moment_correction       ? "moment_correction = true"
                          : is_implicit(p.time_scheme) ? "explicit steps (time_scheme)"
                                                       : nullptr;
      if(wrong)
        throw cases::Refusal(fmt::format(
            "sph moves liquid in the plane and in space past particles that stay where "
            "they are: it needs {}",
            wrong));
    }

    /** An exact solution at the start, whose liquid has the solid's latent heat. */
    class SolutionAtRest : public cases::ExactSolution
    {
    public:
      SolutionAtRest(std::shared_ptr<const cases::ExactSolution> in_space,
                     double more_latent_heat)
        : in_space(std::move(in_space))
        , more_latent_heat(more_latent_heat)
      {
      }

      std::string description() const override
      {
        return in_space->description();
      }

      cases::Symmetry symmetry() const override
      {
        return in_space->symmetry();
      }

      bool has_front() const override
      {
        return in_space->has_front();
      }

      using ExactSolution::temperature;
      double temperature(double coordinate, double time) const override
      {
        return in_space->temperature(coordinate, time);
      }

      double front(double time) const override
      {
        return in_space->front(time);
      }

      bool solid_at_origin() const override
      {
        return in_space->solid_at_origin();
      }

      double heat_content(double lower, double upper, double time) const override
      {
        const double liquid = cases::volume_between(symmetry(), lower, upper)
                              - in_space->solid_volume(lower, upper, time);
        return in_space->heat_content(lower, upper, time) + more_latent_heat * liquid;
      }

    private:
      std::shared_ptr<const cases::ExactSolution> in_space;
      double more_latent_heat; ///< (rho_s - rho_l) L (J/m^3)
    };
  } // namespace

  LiquidBalance::LiquidBalance(const cases::Scene &scene, const SphParameters &p)
    : at_rest(scene)
    , density(scene.material.liquid.density)
    , expansion(1 - scene.material.solid.density / scene.material.liquid.density)
    , outlet(scene.domain.round() ? cases::Side::outer : cases::Side::x_max)
  {
    require_lattice(p);
    if(scene.boundary(outlet).kind == cases::BoundaryKind::periodic)
      throw cases::Refusal(
          fmt::format("sph lets displaced liquid leave through {}: that wall cannot be "
                      "periodic",
                      cases::to_string(outlet)));
    cases::PhaseProperties &liquid = at_rest.material.liquid;
    const double solid_density = scene.material.solid.density;
    liquid.specific_heat_capacity *= in_space();
    liquid.density = solid_density;
    if(auto &exact = at_rest.initial.exact)
      exact = std::make_shared<SolutionAtRest>(exact, (solid_density - density)
                                                          * scene.material.latent_heat);
  }
} // namespace meltfront::particles
