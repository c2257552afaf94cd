#ifndef meltfront_cases_wall_law_h
#define meltfront_cases_wall_law_h

#include <cases/scene.h>

#include <cmath>

namespace meltfront::cases
{
  /** Heat that flows in through a wall by its law (W/m^2), and its derivative with
   * respect to the wall's temperature (W/(m^2 K)). */
  struct HeatThroughWall
  {
    double flux = 0, slope = 0;
  };

  /** Whether a wall exchanges heat with its surroundings, by a difference of temperatures
   * (heat transfer) or of their fourth powers (radiation). */
  inline bool exchanges_heat(BoundaryKind kind)
  {
    return kind == BoundaryKind::heat_transfer || kind == BoundaryKind::radiation;
  }

  /** Whether a wall's law prescribes the heat that flows in, which may depend on the
   * wall's temperature. */
  inline bool prescribes_heat(BoundaryKind kind)
  {
    return kind == BoundaryKind::flux || exchanges_heat(kind);
  }

  /**
   * What flows in through a wall that has a temperature (not one that is prescribed):
   *
   *   flux            q = given
   *   heat transfer   q = h (given - T)
   *   radiation       q = eps sigma ((given - T_0)^4 - (T - T_0)^4), T_0 absolute zero
   *
   * @param given the value of Boundary::value (W/m^2 or, ambient temperature, K)
   * @param temperature of the wall (K)
   */
  inline HeatThroughWall heat_through(const Boundary &wall, double given,
                                      double temperature)
  {
    switch(wall.kind)
    {
    case BoundaryKind::flux:
      return {given, 0};
    case BoundaryKind::heat_transfer:
      return {wall.heat_transfer_coefficient * (given - temperature),
              -wall.heat_transfer_coefficient};
    case BoundaryKind::radiation:
    {
      const double around = given - wall.absolute_zero,
                   own = temperature - wall.absolute_zero;
      const double coefficient = wall.emission_coefficient;
      return {coefficient * (around - own) * (around + own)
                  * (around * around + own * own),
              -4 * coefficient * own * own * own};
    }
    default:
      return {};
    }
  }

  /** Heat transfer q = coefficient (ambient - T) (W/(m^2 K), K). */
  struct HeatTransfer
  {
    double coefficient = 0, ambient = 0;
  };

  /** What a wall that exchanges heat does near a temperature: its own law, or the tangent
   * of radiation there, which makes Newton's method of solving again and again. */
  inline HeatTransfer heat_transfer_near(const Boundary &wall, double given,
                                         double temperature)
  {
    if(wall.kind == BoundaryKind::heat_transfer)
      return {wall.heat_transfer_coefficient, given};
    const HeatThroughWall through = heat_through(wall, given, temperature);
    return {-through.slope, temperature - through.flux / through.slope};
  }

  /** What flows in through a wall and a layer behind it (W/m^2), its derivatives with
   * respect to the temperature behind the layer (W/(m^2 K)) and the layer's resistance.
   */
  struct HeatThroughLayer
  {
    double flux = 0, slope = 0, by_resistance = 0;
  };

  /**
   * The same where the temperature is known behind a layer of the resistance R = d/k
   * (m^2 K/W), in which heat flows steadily: q = law(T + R q), solved by Newton's method,
   * whose first step ends it for a linear law.
   */
  inline HeatThroughLayer heat_through_layer(const Boundary &wall, double given,
                                             double temperature, double resistance)
  {
    constexpr int most_iterations = 50;
    constexpr double settled = 1e-14;
    double at_wall = temperature;
    HeatThroughWall through = heat_through(wall, given, at_wall);
    for(int i = 0; i < most_iterations && resistance > 0; ++i)
    {
      const double change = (temperature + resistance * through.flux - at_wall)
                            / (1 - resistance * through.slope);
      at_wall += change;
      through = heat_through(wall, given, at_wall);
      if(std::abs(change) <= settled * (std::abs(at_wall) + std::abs(given)))
        break;
    }
    const double share = 1 / (1 - resistance * through.slope);
    return {through.flux, share * through.slope, share * through.slope * through.flux};
  }

  /** The same at a place of the wall and a time. */
  inline HeatThroughWall heat_through(const Boundary &wall, const Position &position,
                                      double time, double temperature)
  {
    return prescribes_heat(wall.kind)
               ? heat_through(wall, wall.value(position, time), temperature)
               : HeatThroughWall();
  }
} // namespace meltfront::cases

#endif
