#ifndef meltfront_cases_exact_mushy_layer_profile_h
#define meltfront_cases_exact_mushy_layer_profile_h

#include <cases/exact/mushy_layer_path.h>
#include <cases/exact/root.h>
#include <cases/exact/special_functions.h>

#include <boost/math/constants/constants.hpp>

#include <array>
#include <functional>
#include <limits>
#include <optional>

/**
 * Directional freezing of an alloy from a cold wall into a half space at rest, as a
 * function of eta = y / (2 sqrt(a t)), a = k_l/(rho c_l) the diffusivity of the liquid;
 * for any number type, so that tests may ask for more digits.
 *
 * Temperatures are depths x = T_m - T below the melting point of the solvent, and
 * compositions are the fall of the liquidus that they cause (K): the liquid of a mush has
 * the composition x. f is the mass fraction of liquid, H the specific enthalpy over c_l
 * (K), K = kbar/k_l the mean conductivity, q = -K x' (K) the heat flux, and a prime is
 * d/d eta. What holds everywhere, with w = q + 2 eta H,
 *
 *   w' = 2 H                                                          (heat).
 *
 * (Ideal mushy layer without flow: Worster 1986, J. Fluid Mech. 167, 481; the front of
 * marginal equilibrium where solute diffuses: the same, section 3. Here in the form that
 * conserves heat, which needs no derivative of the liquidus.)
 */
namespace meltfront::cases::similarity
{
  /** Heat of freezing below the melting point of the solvent. */
  enum class HeatOfFreezing
  {
    consistent, ///< L + (c_l - c_s)(T - T_m), that of an energy function
    constant    ///< L at any temperature (Monaghan, Huppert and Worster 2005, 4.4)
  };

  /** How a mush conducts heat. */
  enum class MushConduction
  {
    mean,     ///< the mean of both phases by volume
    published ///< with 4 k_l' k_s'/(k_l' + k_s') besides, k' by volume: what particles of
              ///< liquid and ice conduct that exchange heat as Monaghan, Huppert and
              ///< Worster (2005) printed it
  };

  /** What the equations hold. */
  template <typename Real>
  struct Mush
  {
    Real conductivity_ratio; ///< k_s/k_l
    Real capacity_ratio;     ///< c_s/c_l
    Real expansion;          ///< rho/rho_crystal
    Real latent;             ///< L/c_l (K)
    Real composition;        ///< P, of the melt far away (K)
    Real excess;             ///< of the far temperature over T_m (K)
    Real wall;               ///< depth of the wall's temperature (K)
    Real diffusion = 0;      ///< D/a
    Real eutectic = std::numeric_limits<Real>::infinity(); ///< depth (K)
    HeatOfFreezing heat = HeatOfFreezing::consistent;
    MushConduction conduction = MushConduction::mean;
    /** f in equilibrium at a depth, of a liquidus that is not straight. */
    std::function<Real(const Real &depth)> curved_liquid{};

    /** Lever rule: the liquid fraction of a mush that has kept all its solute. */
    Real liquid(const Real &depth) const
    {
      return curved_liquid ? curved_liquid(depth) : composition / depth;
    }

    Real conductivity(const Real &f) const
    {
      const auto [liquid, solid] = conductivities(f);
      const Real mean = liquid + solid;
      return conduction == MushConduction::mean ? mean : mean + 4 * liquid * solid / mean;
    }

    /** dK/df */
    Real conductivity_slope(const Real &f) const
    {
      if(!(expansion * (1 - f) < 1))
        return 0;
      const Real by_f = -expansion * (conductivity_ratio - 1);
      if(conduction == MushConduction::mean)
        return by_f;
      const auto [liquid, solid] = conductivities(f);
      const Real mean = liquid + solid;
      return by_f
             + 4 * expansion * (solid * solid - conductivity_ratio * liquid * liquid)
                   / (mean * mean);
    }

    /** Of the liquid and of the solid, over k_l, times the volumes that they take up. */
    std::array<Real, 2> conductivities(const Real &f) const
    {
      const Real volume = expansion * (1 - f);
      const Real solid = volume < 1 ? volume : Real(1);
      return {1 - solid, solid * conductivity_ratio};
    }

    /** Liquid fraction at which crystals take up all the volume; not positive where they
     * never do. */
    Real full() const
    {
      return 1 - 1 / expansion;
    }

    Real heat_of_freezing(const Real &depth) const
    {
      return heat == HeatOfFreezing::constant ? latent
                                              : latent - (1 - capacity_ratio) * depth;
    }

    /** H of a mush that has kept its solute; for a constant heat of freezing the integral
     * of its apparent heat capacity, of a straight liquidus. */
    Real enthalpy(const Real &depth) const
    {
      using std::log;
      const Real f = liquid(depth);
      if(heat == HeatOfFreezing::consistent)
        return -capacity_ratio * depth + f * heat_of_freezing(depth);
      return -capacity_ratio * depth
             - (1 - capacity_ratio) * composition * (log(depth / composition) + 1)
             + latent * f;
    }
  };

  /** What is known of one eta. */
  template <typename Real>
  struct MushPoint
  {
    Real depth;
    Real liquid;      ///< f
    Real composition; ///< of all that is there, liquid and solid (K)
    Real enthalpy;    ///< H; of liquid at T_m latent
    Real flux;        ///< q
    Real solid;       ///< integral of 1 - f from eta to the front
  };

  /**
   * Solid between the wall and the mush: q' = (c_s/c_l)/K_s 2 eta q, an error function.
   */
  template <typename Real>
  class SolidLayer
  {
  public:
    SolidLayer(const Mush<Real> &mush, const Real &edge, const MushPoint<Real> &at_edge)
      : conductivity(mush.conductivity(Real(0)))
      , capacity(mush.capacity_ratio)
      , edge(edge)
      , at_edge(at_edge)
    {
    }

    MushPoint<Real> at(const Real &eta) const
    {
      using std::exp, std::sqrt;
      const Real alpha = capacity / conductivity, root = sqrt(alpha);
      MushPoint<Real> point = at_edge;
      const Real growth = exp(alpha * edge * edge);
      point.depth += at_edge.flux * growth / conductivity
                     * sqrt(boost::math::constants::pi<Real>()) / (2 * root)
                     * (boost::math::erf(root * edge) - boost::math::erf(root * eta));
      point.flux *= growth * exp(-alpha * eta * eta);
      point.enthalpy -= capacity * (point.depth - at_edge.depth);
      point.solid += edge - eta;
      return point;
    }

    Real conductivity, capacity;
    Real edge;
    MushPoint<Real> at_edge; ///< on the solid's side
  };

  /**
   * The mush behind a front at eta = lambda, without diffusion of solute: f = P/x (lever
   * rule), so that w, eta and all else are integrated over the depth. The parameter u =
   * ln(1 + (x - P)/x_0) resolves the layer of thickness x_0 at the front in which little
   * solute leaves nearly a front of the pure solvent.
   */
  template <typename Real>
  class LeverRuleMush
  {
  public:
    LeverRuleMush(const Mush<Real> &mush, const Real &lambda, int steps)
      : mush(mush)
      , scale(layer(mush))
      , path(rates(), 0, start(lambda))
    {
      const Real end = std::min(mush.wall, mush.eutectic);
      const Real full = mush.full();
      if(!mush.curved_liquid && full > 0 && mush.composition / full < end)
        integrate_to(mush.composition / full, steps);
      integrate_to(end, steps);
      if(mush.eutectic < mush.wall)
        solid.emplace(mush, edge(), frozen());
    }

    /** Innermost eta of the mush. */
    Real edge() const
    {
      return path.last().state[0];
    }

    MushPoint<Real> at(const Real &eta) const
    {
      if(solid && eta <= edge())
        return solid->at(eta);
      return point(eta < edge() ? path.last() : path.at(eta));
    }

    const std::optional<SolidLayer<Real>> &solid_layer() const
    {
      return solid;
    }

  private:
    using MushPath = Path<Real, 3>; ///< eta, w, solid
    using State = typename MushPath::State;

    /** x_0: depth by which the flux doubles behind the front, at most P. */
    static Real layer(const Mush<Real> &mush)
    {
      const Real p = mush.composition, near = p * (1 + Real(1) / 1024);
      const Real slope = (mush.enthalpy(p) - mush.enthalpy(near)) / (near - p);
      return std::min<Real>(p, (mush.excess + p) / slope);
    }

    Real depth(const Real &u) const
    {
      using std::exp;
      return mush.composition + scale * (exp(u) - 1);
    }

    State start(const Real &lambda) const
    {
      const Real flux = (mush.excess + mush.composition) * 2
                        / scaled_upper_gamma<Real>(1, lambda * lambda);
      return {lambda, flux + 2 * lambda * mush.enthalpy(mush.composition), 0};
    }

    typename MushPath::Rates rates() const
    {
      return [mush = mush, scale = scale](const State &state, State &rate, const Real &u)
      {
        using std::exp;
        const Real grown = scale * exp(u);
        const Real depth = mush.composition + (grown - scale);
        const Real f = mush.liquid(depth), enthalpy = mush.enthalpy(depth);
        const Real flux = state[1] - 2 * state[0] * enthalpy;
        rate[0] = -grown * mush.conductivity(f) / flux;
        rate[1] = 2 * enthalpy * rate[0];
        rate[2] = -(1 - f) * rate[0];
      };
    }

    void integrate_to(const Real &end, int steps)
    {
      using std::ceil, std::log;
      const Real span = log(1 + (end - mush.composition) / scale) - path.last().parameter;
      const int count = std::max(4, static_cast<int>(ceil(span * steps)));
      for(int i = 0; i < count; ++i)
        path.advance(span / count);
    }

    MushPoint<Real> point(const typename MushPath::Place &place) const
    {
      const Real x = depth(place.parameter), enthalpy = mush.enthalpy(x);
      return {x,
              mush.liquid(x),
              mush.composition,
              enthalpy,
              place.state[1] - 2 * place.state[0] * enthalpy,
              place.state[2]};
    }

    /** The innermost mush once the rest of its liquid has frozen: w goes through. */
    MushPoint<Real> frozen() const
    {
      MushPoint<Real> edge_point = point(path.last());
      const Real heat = edge_point.liquid * mush.heat_of_freezing(edge_point.depth);
      edge_point.enthalpy -= heat;
      edge_point.flux += 2 * edge() * heat;
      edge_point.liquid = 0;
      return edge_point;
    }

    Mush<Real> mush;
    Real scale;
    MushPath path;
    std::optional<SolidLayer<Real>> solid;
  };
} // namespace meltfront::cases::similarity

#endif
