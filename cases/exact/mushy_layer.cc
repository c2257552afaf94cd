#include <cases/error.h>
#include <cases/exact/check_material.h>
#include <cases/exact/mushy_layer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

namespace meltfront::cases
{
  using similarity::DiffusingMush;
  using similarity::LeverRuleMush;
  using similarity::Mush;
  using similarity::MushPoint;

  namespace
  {
    /** Steps per unit of the profile's parameter: round-off, as twice as many show. */
    constexpr int steps = 16;

    [[noreturn]] void refuse(const std::string &problem)
    {
      throw InputError(fmt::format("mushy layer: {}", problem));
    }

    double common_diffusivity(const Alloy &alloy)
    {
      const double first = alloy.solutes[0].diffusivity;
      for(const Solute &solute : alloy.solutes)
        if(solute.diffusivity != first)
          refuse(fmt::format("both solutes must diffuse equally, not {} and {} m^2/s",
                             first, solute.diffusivity));
      return first;
    }

    void check(const Material &material, const Alloy &alloy,
               const std::vector<double> &concentration)
    {
      check_material(material, "mushy layer");
      require_equal_densities(material, "mushy layer");
      if(alloy.solutes.empty() || concentration.size() != alloy.solutes.size())
        refuse(fmt::format("{} solute{} but {} concentration{}", alloy.solutes.size(),
                           alloy.solutes.size() == 1 ? "" : "s", concentration.size(),
                           concentration.size() == 1 ? "" : "s"));
      for(const double c : concentration)
        if(!(c >= 0 && c < 1))
          refuse(fmt::format("a concentration must be at least 0 and less than 1, not {}",
                             c));
    }

    double depression(const PhaseDiagram &diagram, const std::vector<double> &c)
    {
      return diagram.depression(c[0], c.size() > 1 ? c[1] : 0);
    }

    void check_temperatures(const Mush<double> &mush, double melting)
    {
      const double liquidus = melting - mush.composition;
      if(!(mush.composition > 0))
        refuse("there is no solute: Neumann's solution is that of the pure substance");
      if(!(mush.wall > mush.composition) || !std::isfinite(mush.wall))
        refuse(fmt::format("the wall ({}) must be colder than the liquidus ({:.6g})",
                           melting - mush.wall, liquidus));
      if(!(mush.excess > -mush.composition) || !std::isfinite(mush.excess))
        refuse(fmt::format("the far temperature ({}) must be above the liquidus ({:.6g})",
                           melting + mush.excess, liquidus));
      if(!(mush.eutectic > mush.composition))
        refuse(fmt::format("the eutectic temperature ({}) must be below the liquidus "
                           "({:.6g})",
                           melting - mush.eutectic, liquidus));
      if(!(mush.heat_of_freezing(mush.wall) > 0))
        refuse(fmt::format("at the wall's temperature ({}) nothing is left of the heat "
                           "of freezing, {:.6g} J/(kg K) of which go with each kelvin",
                           melting - mush.wall, 1 - mush.capacity_ratio));
    }

    Mush<double> mush_of(const Material &material, const Alloy &alloy,
                         const std::vector<double> &concentration, double wall,
                         double far, similarity::HeatOfFreezing heat,
                         similarity::MushConduction conduction)
    {
      check(material, alloy, concentration);
      const PhaseDiagram diagram(material, alloy);
      const double melting = material.melting_temperature;
      const double capacity = material.liquid.specific_heat_capacity;
      Mush<double> mush;
      mush.conductivity_ratio
          = material.solid.conductivity / material.liquid.conductivity;
      mush.capacity_ratio = material.solid.specific_heat_capacity / capacity;
      mush.expansion = alloy.crystal_density > 0
                           ? material.liquid.density / alloy.crystal_density
                           : 1;
      mush.latent = material.latent_heat / capacity;
      mush.composition = depression(diagram, concentration);
      mush.excess = far - melting;
      mush.wall = melting - wall;
      mush.diffusion = common_diffusivity(alloy) / material.liquid.diffusivity();
      mush.eutectic = melting - alloy.eutectic_temperature;
      mush.heat = heat;
      mush.conduction = conduction;
      check_temperatures(mush, melting);
      if(mush.diffusion > 0 && mush.wall > mush.eutectic)
        refuse("where solute diffuses, the wall must not be below the eutectic "
               "temperature");
      if(diagram.straight())
        return mush;
      if(mush.diffusion > 0 || heat == similarity::HeatOfFreezing::constant)
        refuse("a curved liquidus needs solute that does not diffuse, and a heat of "
               "freezing that follows from an energy");
      // Infinitely deep below T_m no liquid would be left; the wall is as deep as it
      // gets.
      diagram.solid_fraction(
          std::max(wall, std::nextafter(alloy.eutectic_temperature, melting)),
          concentration[0]);
      Alloy unbounded = alloy;
      unbounded.eutectic_temperature = Alloy().eutectic_temperature;
      mush.curved_liquid = [diagram = PhaseDiagram(material, unbounded), melting,
                            c = concentration[0]](double depth)
      { return 1 - diagram.solid_fraction(melting - depth, c); };
      return mush;
    }

    /** Integral of erfc from x to infinity, over erfc(reference): neither underflows. */
    double integrated_erfc_ratio(double x, double reference)
    {
      const double scaled = similarity::scaled_upper_gamma<double>(1, x * x);
      return std::exp(reference * reference - x * x) * (1 - x * scaled)
             / similarity::scaled_upper_gamma<double>(1, reference * reference);
    }

    double find_lambda(const Mush<double> &mush)
    {
      using similarity::Balance;
      const std::string what = "the front constant of the mushy layer";
      const auto without = [&mush](double x) -> Balance<double>
      {
        const LeverRuleMush<double> trial(mush, x, steps);
        if(!trial.solid_layer())
          return {-trial.edge(), x};
        return {mush.wall - trial.solid_layer()->at(0).depth, mush.wall};
      };
      const auto with = [&mush](double x) -> Balance<double>
      {
        const DiffusingMush<double> trial(mush, x, steps);
        return {mush.wall - trial.solid_layer()->at(0).depth, mush.wall};
      };
      if(!(mush.diffusion > 0))
        return similarity::decreasing_root<double>(without, what);
      const double lambda = similarity::decreasing_root<double>(with, what);
      if(!DiffusingMush<double>(mush, lambda, steps).forms_mush())
        refuse("solute diffuses away so fast that no mush forms: the front is sharp");
      return lambda;
    }
  } // namespace

  /** The mush, of either kind, between solid at the wall and liquid. */
  struct MushyLayer::Profile
  {
    using Either = std::variant<LeverRuleMush<double>, DiffusingMush<double>>;

    explicit Profile(const Mush<double> &mush)
      : lambda(find_lambda(mush))
      , layer(mush.diffusion > 0 ? Either(DiffusingMush<double>(mush, lambda, steps))
                                 : Either(LeverRuleMush<double>(mush, lambda, steps)))
      , front(behind_front(lambda))
      , wall(behind_front(0))
      , diffusion(mush.diffusion)
      , far(far_away(mush))
    {
    }

    static MushPoint<double> far_away(const Mush<double> &mush)
    {
      return {-mush.excess, 1, mush.composition, mush.latent + mush.excess, 0, 0};
    }

    MushPoint<double> behind_front(double eta) const
    {
      return std::visit([eta](const auto &mush) { return mush.at(eta); }, layer);
    }

    MushPoint<double> at(double eta) const
    {
      if(eta <= lambda)
        return behind_front(eta);
      MushPoint<double> point = far;
      const double left
          = similarity::upper_gamma_ratio<double>(1, eta * eta, lambda * lambda);
      point.depth += (front.depth - far.depth) * left;
      point.enthalpy -= (front.depth - far.depth) * left;
      if(diffusion > 0)
        point.composition += (front.composition - far.composition)
                             * similarity::upper_gamma_ratio<double>(
                                 1, eta * eta / diffusion, lambda * lambda / diffusion);
      return point;
    }

    /** Integral of H from the wall on, from the balance w' = 2 H. */
    double content_up_to(double eta) const
    {
      const double end = std::min(eta, lambda);
      const MushPoint<double> point = behind_front(end);
      const double content = 0.5 * (point.flux + 2 * end * point.enthalpy - wall.flux);
      if(eta <= lambda)
        return content;
      return content + far.enthalpy * (eta - lambda)
             - (front.depth - far.depth)
                   * (integrated_erfc_ratio(lambda, lambda)
                      - integrated_erfc_ratio(eta, lambda));
    }

    double lambda;
    Either layer;
    MushPoint<double> front, wall;
    double diffusion;
    MushPoint<double> far;
  };

  MushyLayer::MushyLayer(const Material &material, const Alloy &alloy,
                         const std::vector<double> &concentration,
                         double wall_temperature, double far_temperature,
                         similarity::HeatOfFreezing heat,
                         similarity::MushConduction conduction)
    : material(material)
    , far_concentration(concentration)
    , mush(mush_of(material, alloy, concentration, wall_temperature, far_temperature,
                   heat, conduction))
    , profile(std::make_unique<const Profile>(mush))
  {
  }

  MushyLayer::~MushyLayer() = default;

  double MushyLayer::lambda() const
  {
    return profile->lambda;
  }

  double MushyLayer::front_concentration() const
  {
    return far_concentration[0] * profile->front.composition / mush.composition;
  }

  std::string MushyLayer::description() const
  {
    const double melting = material.melting_temperature;
    return fmt::format(
        "mushy layer {} of solute, wall {:.12g}, far {:.12g}, liquidus {:.12g}, lambda "
        "= {:.16g}{}{}",
        mush.diffusion > 0 ? "with diffusion" : "without diffusion", melting - mush.wall,
        melting + mush.excess, melting - mush.composition, profile->lambda,
        mush.diffusion > 0
            ? fmt::format(", concentration at the front {:.12g}", front_concentration())
            : "",
        mush.wall > mush.eutectic ? ", eutectic solid at the wall" : "");
  }

  Symmetry MushyLayer::symmetry() const
  {
    return Symmetry::planar;
  }

  bool MushyLayer::mushy() const
  {
    return true;
  }

  double MushyLayer::length(double time) const
  {
    return 2 * std::sqrt(material.liquid.diffusivity() * time);
  }

  double MushyLayer::front(double time) const
  {
    return time > 0 ? profile->lambda * length(time) : 0;
  }

  double MushyLayer::temperature(double coordinate, double time) const
  {
    const double melting = material.melting_temperature;
    if(coordinate <= 0)
      return melting - mush.wall;
    return time > 0 ? melting - profile->at(coordinate / length(time)).depth
                    : melting + mush.excess;
  }

  double MushyLayer::solid_fraction(double coordinate, double time) const
  {
    return time > 0 ? 1 - profile->at(coordinate / length(time)).liquid : 0;
  }

  double MushyLayer::concentration(std::size_t solute, double coordinate,
                                   double time) const
  {
    if(time <= 0)
      return far_concentration.at(solute);
    return far_concentration.at(solute)
           * (profile->at(coordinate / length(time)).composition / mush.composition);
  }

  double MushyLayer::concentration(double coordinate, double time) const
  {
    return concentration(0, coordinate, time);
  }

  double MushyLayer::heat_content(double lower, double upper, double time) const
  {
    const double capacity = material.liquid.volumetric_heat_capacity();
    if(time <= 0)
      return capacity * profile->far.enthalpy * (upper - lower);
    const double unit = length(time);
    return capacity * unit
           * (profile->content_up_to(upper / unit)
              - profile->content_up_to(lower / unit));
  }

  double MushyLayer::solid_volume(double lower, double upper, double time) const
  {
    if(time <= 0)
      return 0;
    const double unit = length(time);
    const auto beyond = [this, unit](double coordinate)
    { return profile->behind_front(std::min(coordinate / unit, profile->lambda)).solid; };
    return unit * (beyond(lower) - beyond(upper));
  }

  double MushyLayer::wall_heat(double time) const
  {
    return -material.liquid.volumetric_heat_capacity() * length(time) * profile->wall.flux
           / 2;
  }
} // namespace meltfront::cases
