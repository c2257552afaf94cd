#include <cases/error.h>
#include <cases/exact/check_material.h>
#include <cases/exact/varying_neumann.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace meltfront::cases
{
  namespace
  {
    const char *const name = "planar solution of varying properties";

    constexpr double step_tolerance = 1e-14;

    /** After one whose error was so many tolerances. */
    double next_step(double step, double error)
    {
      return step * std::clamp(0.9 * std::pow(std::max(error, 1e-30), -1. / 8), 0.2, 4.);
    }
  } // namespace

  VaryingMaterial VaryingMaterial::of(const Material &material)
  {
    require_equal_densities(material, name);
    VaryingMaterial result;
    const double density = material.solid.density;
    const auto conductivity = [](const PhaseProperties &phase) {
      return [phase](double temperature) { return phase.conductivity_at(temperature); };
    };
    const auto capacity = [density](const PhaseProperties &phase)
    {
      return [phase, density](double temperature)
      { return density * phase.heat_capacity_at(temperature); };
    };
    result.solid_conductivity = conductivity(material.solid);
    result.liquid_conductivity = conductivity(material.liquid);
    result.solid_capacity = capacity(material.solid);
    result.liquid_capacity = capacity(material.liquid);
    result.latent_heat = density * material.latent_heat;
    result.melting_temperature = material.melting_temperature;
    std::vector<std::shared_ptr<const PropertyCurve>> curves{
        material.solid.conductivity_curve, material.solid.heat_capacity_curve,
        material.liquid.conductivity_curve, material.liquid.heat_capacity_curve};
    if(const auto &range = material.melting_range)
    {
      result.liquidus = range->liquidus;
      result.solid_fraction = [curve = range->solid_fraction](double temperature)
      { return (*curve)(temperature); };
      curves.push_back(range->solid_fraction);
    }
    for(const auto &curve : curves)
      if(curve)
        result.kinks.insert(result.kinks.end(), curve->temperatures().begin(),
                            curve->temperatures().end());
    return result;
  }

  VaryingNeumann::VaryingNeumann(const VaryingMaterial &material, double wall_temperature,
                                 double far_temperature)
    : material(material)
    , wall(wall_temperature)
    , far(far_temperature)
    , sign(far_temperature > wall_temperature ? 1 : -1)
  {
    check();
    find_pieces();
    shoot(sign * find_wall_flux());
    sensible_at_melting
        = std::ranges::find(nodes, material.melting_temperature, &Node::temperature)
              ->state[2];
  }

  void VaryingNeumann::check() const
  {
    const double solidus = material.melting_temperature,
                 liquidus = material.liquidus.value_or(solidus);
    const bool freezes = wall < solidus && far >= liquidus;
    const bool melts = wall > liquidus && far <= solidus;
    if(!(freezes || melts) || !std::isfinite(wall) || !std::isfinite(far))
      throw InputError(fmt::format(
          "{}: the wall must be below {} and the far field not below {} (to freeze), or "
          "above {} and not above {} (to melt), not {} and {}",
          name, solidus, liquidus, liquidus, solidus, wall, far));
    if(!(material.latent_heat > 0))
      throw InputError(fmt::format("{}: the latent heat must be positive, not {}", name,
                                   material.latent_heat));
  }

  void VaryingNeumann::find_pieces()
  {
    const double solidus = material.melting_temperature;
    std::vector<double> bounds = material.kinks;
    bounds.push_back(solidus);
    if(material.liquidus)
      bounds.push_back(*material.liquidus);
    const auto [lowest, highest] = std::minmax(wall, far);
    std::erase_if(bounds,
                  [&](double bound) { return !(bound > lowest && bound < highest); });
    bounds.push_back(wall);
    bounds.push_back(far);
    std::ranges::sort(bounds);
    bounds.erase(std::ranges::unique(bounds).begin(), bounds.end());
    if(sign < 0)
      std::ranges::reverse(bounds);
    for(std::size_t i = 0; i + 1 < bounds.size(); ++i)
    {
      const double middle = (bounds[i] + bounds[i + 1]) / 2;
      Piece piece{bounds[i], bounds[i + 1],
                  middle < solidus                                   ? 1
                  : material.liquidus && middle < *material.liquidus ? -1
                                                                     : 0};
      for(const double temperature : {piece.start, middle, piece.end})
        if(!(conductivity(piece, temperature) > 0 && capacity(piece, temperature) > 0))
          throw InputError(fmt::format(
              "{}: conductivity and heat capacity must be positive, not {} and {} at {}",
              name, conductivity(piece, temperature), capacity(piece, temperature),
              temperature));
      pieces.push_back(piece);
    }
    const double fraction_at_end
        = pieces.back().solid >= 0 ? pieces.back().solid : fraction(pieces.back(), far);
    ends_at_front = far == solidus && fraction_at_end != far_fraction();
  }

  double VaryingNeumann::fraction(const Piece &piece, double temperature) const
  {
    return piece.solid >= 0 ? piece.solid
                            : std::clamp(material.solid_fraction(temperature), 0., 1.);
  }

  double VaryingNeumann::conductivity(const Piece &piece, double temperature) const
  {
    const double f = fraction(piece, temperature);
    return (f > 0 ? f * material.solid_conductivity(temperature) : 0)
           + (f < 1 ? (1 - f) * material.liquid_conductivity(temperature) : 0);
  }

  double VaryingNeumann::capacity(const Piece &piece, double temperature) const
  {
    const double f = fraction(piece, temperature);
    return (f > 0 ? f * material.solid_capacity(temperature) : 0)
           + (f < 1 ? (1 - f) * material.liquid_capacity(temperature) : 0);
  }

  double VaryingNeumann::flux(const Piece &piece, double temperature,
                              const State &state) const
  {
    return state[1] + state[0] / 2 * material.latent_heat * fraction(piece, temperature);
  }

  VaryingNeumann::State VaryingNeumann::over_temperature(const Piece &piece,
                                                         double temperature,
                                                         const State &state) const
  {
    const double f = fraction(piece, temperature), c = capacity(piece, temperature);
    const double speed
        = conductivity(piece, temperature)
          / (state[1] + state[0] / 2 * material.latent_heat * f); // d eta/dT
    return {speed, -state[0] / 2 * c - material.latent_heat * f / 2 * speed, c,
            (sign > 0 ? f : 1 - f) * speed};
  }

  VaryingNeumann::State VaryingNeumann::over_eta(const Piece &piece, double eta,
                                                 const State &state) const
  {
    const double temperature = state[0];
    const double f = fraction(piece, temperature), c = capacity(piece, temperature);
    const double slope = (state[1] + eta / 2 * material.latent_heat * f)
                         / conductivity(piece, temperature);
    return {slope, -eta / 2 * c * slope - material.latent_heat * f / 2, c * slope,
            sign > 0 ? f : 1 - f};
  }

  double VaryingNeumann::find_wall_flux()
  {
    const Piece &first = pieces.front();
    double lower = 0, upper = 0;
    double trial = std::abs(far - wall)
                   * std::sqrt(conductivity(first, wall) * capacity(first, wall));
    const int most_doublings = 60;
    for(int i = 0; i < most_doublings && !(lower > 0 && upper > 0); ++i)
    {
      const bool enough = shoot(sign * trial) >= 0;
      (enough ? upper : lower) = trial;
      trial *= enough ? 0.5 : 2;
    }
    if(!(lower > 0 && upper > 0))
      throw NumericalError(name, 0, 0, "the heat flux at the wall",
                           "has no value that leads to the far temperature");
    std::uintmax_t iterations = 200;
    const auto bracket = boost::math::tools::toms748_solve(
        [this](double flux) { return shoot(sign * flux); }, lower, upper,
        boost::math::tools::eps_tolerance<double>(), iterations);
    return bracket.second;
  }

  double VaryingNeumann::shoot(double wall_flux)
  {
    nodes.clear();
    State state{0, wall_flux, 0, 0};
    const double whole = std::abs(far - wall);
    for(std::size_t i = 0; i < pieces.size(); ++i)
    {
      const Piece &piece = pieces[i];
      const bool last = i + 1 == pieces.size();
      const double end
          = last && !ends_at_front ? (piece.start + piece.end) / 2 : piece.end;
      const double reached = sign * flux(piece, piece.start, state) > 0
                                 ? cross(i, end, wall_flux, state)
                                 : piece.start;
      if(reached != end)
        return -std::abs(far - reached) / whole;
      if(last && !ends_at_front)
        return sign * (run_out(i, end, wall_flux, state) - far) / whole;
    }
    nodes.push_back({far, state, pieces.size() - 1});
    last_eta = state[0];
    return sign * (state[1] + state[0] / 2 * material.latent_heat * far_fraction())
           / std::abs(wall_flux);
  }

  namespace
  {
    template <typename State>
    struct Step
    {
      State state;
      double error; ///< over the tolerance
    };

    /** One step of Fehlberg's method of order 8, with its error over sizes. */
    template <typename State, typename Slope>
    Step<State> step_of(const Slope &slope, const State &state, double at, double length,
                        const State &sizes)
    {
      boost::numeric::odeint::runge_kutta_fehlberg78<State, double, State, double> method;
      State next = state, error{};
      method.do_step([&](const State &x, State &dx, double where)
                     { dx = slope(where, x); },
                     next, at, length, error);
      double largest = 0;
      for(std::size_t i = 0; i < state.size(); ++i)
        largest = std::max(largest, std::abs(error[i]) / sizes[i]);
      const bool finite
          = std::ranges::all_of(next, [](double value) { return std::isfinite(value); });
      return {next, finite ? largest / step_tolerance
                           : std::numeric_limits<double>::infinity()};
    }
  } // namespace

  double VaryingNeumann::cross(std::size_t number, double end, double wall_flux,
                               State &state)
  {
    const Piece &piece = pieces[number];
    const double whole = far - wall;
    const double time_scale
        = std::sqrt(conductivity(piece, piece.start) / capacity(piece, piece.start));
    const State sizes{time_scale, std::abs(wall_flux),
                      std::abs(whole) * capacity(piece, piece.start), time_scale};
    double temperature = piece.start, length = end - piece.start;
    while(temperature != end)
    {
      nodes.push_back({temperature, state, number});
      while(true)
      {
        if(std::abs(length) < 1e-13 * std::abs(whole))
          return temperature;
        const auto slope = [&](double at, const State &x)
        {
          State result = over_temperature(piece, at, x);
          if(!(sign * result[0] > 0)) // the flux has ended
            result.fill(std::numeric_limits<double>::quiet_NaN());
          return result;
        };
        const bool last = std::abs(end - temperature) <= 1.000001 * std::abs(length);
        const auto step = step_of(slope, state, temperature,
                                  last ? end - temperature : length, sizes);
        if(step.error <= 1)
        {
          state = step.state;
          temperature = last ? end : temperature + length;
          length = next_step(length, step.error);
          break;
        }
        length = next_step(length, step.error);
      }
    }
    return temperature;
  }

  double VaryingNeumann::run_out(std::size_t number, double temperature, double wall_flux,
                                 const State &start)
  {
    const Piece &piece = pieces[number];
    const double diffusivity = conductivity(piece, far) / capacity(piece, far);
    const double exponent = 42; // e^-42 is round-off
    const double end = std::sqrt(start[0] * start[0] + 4 * exponent * diffusivity);
    State state{temperature, start[1], start[2], start[3]};
    const State sizes{std::abs(far - wall), std::abs(wall_flux),
                      std::abs(far - wall) * capacity(piece, far), end};
    double eta = start[0], length = (end - eta) / 32;
    const auto slope = [&](double at, const State &x) { return over_eta(piece, at, x); };
    while(eta < end)
    {
      nodes.push_back({state[0], {eta, state[1], state[2], state[3]}, number});
      while(true)
      {
        const double taken = std::min(length, end - eta);
        const auto step = step_of(slope, state, eta, taken, sizes);
        length = next_step(taken, step.error);
        if(length < 1e-12 * end)
          throw NumericalError(name, 0, 0, "the profile", "cannot be integrated");
        if(step.error > 1)
          continue;
        state = step.state;
        eta = taken < end - eta ? eta + taken : end;
        break;
      }
    }
    last_eta = end;
    nodes.push_back({state[0], {eta, state[1], state[2], state[3]}, number});
    return state[0];
  }

  VaryingNeumann::Node VaryingNeumann::at(double eta) const
  {
    if(eta >= last_eta)
    {
      Node node{far, nodes.back().state, pieces.size() - 1};
      node.state[0] = eta;
      node.state[1] = -eta / 2 * material.latent_heat * far_fraction();
      return node;
    }
    const auto after = std::ranges::upper_bound(
        nodes, eta, {}, [](const Node &node) { return node.state[0]; });
    const Node &before = *std::prev(after);
    const Piece &piece = pieces[before.piece];
    State state{before.temperature, before.state[1], before.state[2], before.state[3]};
    if(eta > before.state[0])
      state = step_of([&](double at, const State &x) { return over_eta(piece, at, x); },
                      state, before.state[0], eta - before.state[0], State{1, 1, 1, 1})
                  .state;
    return {state[0], {eta, state[1], state[2], state[3]}, before.piece};
  }

  VaryingNeumann::Isotherm VaryingNeumann::isotherm(double temperature) const
  {
    const auto node = std::ranges::find(nodes, temperature, &Node::temperature);
    if(node == nodes.end() || node == nodes.begin())
      throw InputError(fmt::format("{}: {} is no temperature at which melting begins or "
                                   "ends",
                                   name, temperature));
    const bool outermost = ends_at_front && std::next(node) == nodes.end();
    const Piece &behind = pieces[outermost ? node->piece : node->piece - 1];
    return {node->state[0], flux(behind, temperature, node->state),
            outermost ? 0 : flux(pieces[node->piece], temperature, node->state)};
  }

  std::string VaryingNeumann::description() const
  {
    const Isotherm melting = isotherm(material.melting_temperature);
    return fmt::format("{}, {}{}, wall {:.12g}, far {:.12g}, {} at {:.15g} sqrt(t)", name,
                       sign > 0 ? "freezing" : "melting",
                       material.liquidus ? " over a range" : "", wall, far,
                       material.liquidus ? "solidus" : "front", melting.eta);
  }

  Symmetry VaryingNeumann::symmetry() const
  {
    return Symmetry::planar;
  }

  bool VaryingNeumann::solid_at_origin() const
  {
    return sign > 0;
  }

  double VaryingNeumann::front(double time) const
  {
    return nodes.back().state[3] * std::sqrt(time);
  }

  double VaryingNeumann::temperature(double coordinate, double time) const
  {
    if(time <= 0)
      return coordinate > 0 ? far : wall;
    return at(coordinate / std::sqrt(time)).temperature;
  }

  double VaryingNeumann::solid_fraction(double coordinate, double time) const
  {
    if(time <= 0)
      return far_fraction();
    const double eta = coordinate / std::sqrt(time);
    const Node node = at(eta);
    return eta >= last_eta ? far_fraction()
                           : fraction(pieces[node.piece], node.temperature);
  }

  double VaryingNeumann::solid_volume(double lower, double upper, double time) const
  {
    if(time <= 0)
      return far_fraction() * (upper - lower);
    const double root = std::sqrt(time);
    const double of_wall = root * (at(upper / root).state[3] - at(lower / root).state[3]);
    return sign > 0 ? of_wall : upper - lower - of_wall;
  }

  double VaryingNeumann::heat_content(double lower, double upper, double time) const
  {
    const double far_heat = nodes.back().state[2] - sensible_at_melting
                            + material.latent_heat * (1 - far_fraction());
    if(time <= 0)
      return far_heat * (upper - lower);
    const double root = std::sqrt(time);
    const auto primitive = [&](double coordinate)
    {
      const Node node = at(coordinate / root);
      return node.state[0] * (node.state[2] - sensible_at_melting + material.latent_heat)
             + 2 * node.state[1];
    };
    return root * (primitive(upper) - primitive(lower));
  }
} // namespace meltfront::cases
