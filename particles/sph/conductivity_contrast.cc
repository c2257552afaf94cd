#include <cases/error.h>
#include <cases/scene.h>
#include <particles/sph/conductivity_contrast.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    constexpr double largest_lag = 0.25; ///< of the domain's side
    constexpr int samples_in_time = 257;

    /** Whether a wall both freezes and melts in the course of the scene. */
    bool turns(const cases::Scene &scene, cases::Side side)
    {
      const cases::Boundary &wall = scene.boundary(side);
      const bool flux = wall.kind == cases::BoundaryKind::flux;
      if(!flux && wall.kind != cases::BoundaryKind::fixed_temperature)
        return false;
      const cases::Position place
          = static_cast<int>(side) % 2 == 1 ? scene.domain.upper : scene.domain.lower;
      bool freezes = false, melts = false;
      for(int i = 0; i < samples_in_time; ++i)
      {
        const double time
            = scene.start_time
              + (scene.end_time - scene.start_time) * i / (samples_in_time - 1);
        const double excess
            = wall.value(place, time) - (flux ? 0 : scene.material.melting_temperature);
        freezes |= excess < 0;
        melts |= excess > 0;
      }
      return freezes && melts;
    }
  } // namespace

  double front_lag(double spacing, double behind, double ahead)
  {
    return 0.5 * spacing * (behind / ahead - 1);
  }

  void require_moderate_contrast(const Discretisation &dis, FrontRule rule,
                                 std::span<const double> enthalpy,
                                 const std::string &method)
  {
    const cases::Scene &scene = dis.scene;
    const cases::Material &material = scene.material;
    if((rule != FrontRule::partner && rule != FrontRule::liquid) || !scene.changes_phase()
       || !(material.latent_heat > 0))
      return;
    const bool any = std::ranges::any_of(scene.sides(), [&scene](cases::Side side)
                                         { return turns(scene, side); });
    const bool solid_ahead
        = any || std::ranges::any_of(enthalpy, [](double h) { return h <= 0; });
    const bool liquid_ahead
        = any
          || std::ranges::any_of(enthalpy, [&material](double h)
                                 { return h >= material.latent_heat; });
    const double solid = material.solid.conductivity,
                 liquid = material.liquid.conductivity;
    const double lag
        = std::max(solid_ahead ? front_lag(dis.spacing, liquid, solid) : 0.,
                   liquid_ahead ? front_lag(dis.spacing, solid, liquid) : 0.);
    const double most = largest_lag * scene.domain.side();
    if(lag > most)
      throw cases::Refusal(fmt::format(
          "{} exchanges heat across fronts by the harmonic mean of {:.3g} and {:.3g} "
          "W/(m K), which holds them back like {:.3g} m more of the phase behind them, "
          "and at most {:.3g} m are a sensible answer: take n >= {:.0f}, or sph",
          method, solid, liquid, lag, most,
          std::ceil(scene.domain.side() / dis.spacing * lag / most) + 1));
  }
} // namespace meltfront::particles
