#ifndef meltfront_cases_exact_mushy_layer_diffusing_h
#define meltfront_cases_exact_mushy_layer_diffusing_h

#include <cases/exact/mushy_layer_profile.h>

namespace meltfront::cases::similarity
{
  /**
   * The mush behind a front at eta = lambda where solute diffuses through the liquid,
   * with eps = D/a:
   *
   *   (K x')' = 2 eta H',   -2 eta (f x)' = eps (f x')'.
   *
   * The front is in marginal equilibrium: f = 1, and the liquid ahead is nowhere
   * undercooled, which makes the slopes of temperature and liquidus meet. With G f' = ...
   * both equations give
   *
   *   f' (2 eta x + eps x' + (eps f/K)(2 eta H_f - K_f x'))
   *     = -2 eta x' f (1 + (eps/K) H_x).
   *
   * Next to the wall the factor of f' comes near zero: in a layer of about eps all the
   * solute leaves, and solid without solute remains in front of the wall. f falls to zero
   * either within a fan, so that ln f is the parameter along which all is smooth, or at
   * once: with g = f (2 eta x + eps x') solute reads g' = 2 f x, so that g goes through
   * at a jump, and f may jump to zero where
   *
   *   2 eta x = eps q/K,
   *
   * behind which the path would turn back. There w goes through, too, and q jumps.
   */
  template <typename Real>
  class DiffusingMush
  {
  public:
    DiffusingMush(const Mush<Real> &mush, const Real &lambda, int steps)
      : mush(mush)
      , front(lambda)
      , front_composition(composition_at_front(mush, lambda))
      , path(rates(), 0, start())
    {
      using std::log;
      const Real full = mush.full();
      bool jumps = !forms_mush();
      if(full > least && !jumps)
        jumps = integrate_to(log(full), steps);
      if(!jumps)
        jumps = integrate_to(log(least), steps);
      MushPoint<Real> edge_point = point(path.last());
      if(jumps)
      {
        const Real freezing = edge_point.liquid * mush.heat_of_freezing(edge_point.depth);
        edge_point.enthalpy -= freezing;
        edge_point.flux += 2 * edge() * freezing;
      }
      edge_point.liquid = edge_point.composition = 0;
      solid.emplace(mush, edge(), edge_point);
    }

    /** Whether there is a mush at all: else the solid's front is sharp, and the liquid
     * ahead of it nowhere undercooled. */
    bool forms_mush() const
    {
      return surplus(path.first()) > 0;
    }

    /** Outer end of the solid without solute. */
    Real edge() const
    {
      return path.last().state[0];
    }

    MushPoint<Real> at(const Real &eta) const
    {
      return eta <= edge() ? solid->at(eta) : point(path.at(eta));
    }

    const std::optional<SolidLayer<Real>> &solid_layer() const
    {
      return solid;
    }

    /** Composition of the liquid at the front. */
    const Real &composition_at_front() const
    {
      return front_composition;
    }

  private:
    using MushPath = Path<Real, 5>; ///< eta, x, q, H, solid
    using State = typename MushPath::State;

    /** Where the liquid is taken to have gone. */
    static constexpr double least = 1e-9;

    static Real composition_at_front(const Mush<Real> &mush, const Real &lambda)
    {
      using std::sqrt;
      const Real squared = lambda * lambda;
      const Real heat = 2 / scaled_upper_gamma<Real>(1, squared);
      const Real solute = 2
                          / (sqrt(mush.diffusion)
                             * scaled_upper_gamma<Real>(1, squared / mush.diffusion));
      return (heat * mush.excess + solute * mush.composition) / (solute - heat);
    }

    State start() const
    {
      const Real flux = (mush.excess + front_composition) * 2
                        / scaled_upper_gamma<Real>(1, front * front);
      return {front, front_composition, flux, mush.latent - front_composition, 0};
    }

    typename MushPath::Rates rates() const
    {
      return [mush = mush](const State &state, State &rate, const Real &logarithm)
      {
        using std::exp;
        const Real f = exp(logarithm);
        const auto &[eta, x, flux, enthalpy, solid] = state;
        const Real conductivity = mush.conductivity(f);
        const Real slope = -flux / conductivity;
        const Real by_liquid = mush.heat_of_freezing(x);
        const Real by_depth = -mush.capacity_ratio - f * (1 - mush.capacity_ratio);
        const Real weight = mush.diffusion / conductivity;
        const Real factor
            = 2 * eta * x + mush.diffusion * slope
              + f * weight * (2 * eta * by_liquid - mush.conductivity_slope(f) * slope);
        rate[0] = factor / (-2 * eta * slope * (1 + weight * by_depth));
        rate[1] = slope * rate[0];
        rate[3] = by_depth * rate[1] + by_liquid * f;
        rate[2] = -2 * eta * rate[3];
        rate[4] = -(1 - f) * rate[0];
      };
    }

    /** 2 eta x - eps q/K, which is zero where f jumps to zero. */
    Real surplus(const typename MushPath::Place &place) const
    {
      const auto &[eta, x, flux, enthalpy, solid] = place.state;
      return 2 * eta * x
             - mush.diffusion * flux / mush.conductivity(exp_of(place.parameter));
    }

    /** Steps of 1/steps, and shorter where the fan draws neighbouring paths together.
     * @return whether f jumps to zero on the way */
    bool integrate_to(const Real &end, int steps)
    {
      while(path.last().parameter > end)
      {
        const auto &[parameter, state] = path.last();
        const Real pull
            = state[0] * state[2] / (state[1] * mush.conductivity(exp_of(parameter)));
        const Real step = std::min<Real>(Real(1) / steps, pull / 2);
        if(!(step > 1e-6))
          return false;
        if(path.advance_to_zero(-std::min<Real>(step, parameter - end),
                                [this](const auto &place) { return surplus(place); }))
          return true;
      }
      return false;
    }

    static Real exp_of(const Real &parameter)
    {
      using std::exp;
      return exp(parameter);
    }

    MushPoint<Real> point(const typename MushPath::Place &place) const
    {
      const Real f = exp_of(place.parameter);
      const auto &[eta, x, flux, enthalpy, solid] = place.state;
      return {x, f, f * x, enthalpy, flux, solid};
    }

    Mush<Real> mush;
    Real front, front_composition;
    MushPath path;
    std::optional<SolidLayer<Real>> solid;
  };
} // namespace meltfront::cases::similarity

#endif
