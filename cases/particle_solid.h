#ifndef meltfront_cases_particle_solid_h
#define meltfront_cases_particle_solid_h

#include <cases/position.h>

#include <functional>
#include <optional>
#include <vector>

namespace meltfront::cases
{
  /**
   * The force between two particles of mass 1 at a distance r: attraction / r^p is taken
   * from repulsion / r^q, up to the cutoff (Greenspan 1976, equations 2.5, 2.6). Units
   * are the report's, Boltzmann's constant is 1.
   */
  struct PairLaw
  {
    double attraction = 2500;       ///< G
    double repulsion = 2900;        ///< H
    double attraction_exponent = 4; ///< beta
    double repulsion_exponent = 6;  ///< alpha
    double cutoff = 1.5;            ///< beyond which there is no force
    bool shifted = false;           ///< by its value at the cutoff, to end there at zero
  };

  /** How the particles are arranged at the start. */
  enum class SolidArrangement
  {
    table,     ///< one of the tables of the report
    triangle,  ///< rows that become shorter upwards, at rest on the base
    rectangle, ///< rows of L and L - 1 particles, at rest on the base
    bar,       ///< a crystal between a hot and a cold wall
    disk,      ///< of a diameter of n spacings
    outline,   ///< within a curve
    block,     ///< a cubic close packing of n cells along each side, in space
    ball       ///< a cubic close packing within a diameter of n spacings, in space
  };

  /** So many steps with such a strength of heating. */
  struct HeatingStage
  {
    long steps = 0;
    double strength = 0; ///< Gamma: velocity added in each step at distance 1
  };

  /** A source that drives particles away from itself, equation (4.1). */
  struct PointHeating
  {
    Position position{};
    std::vector<HeatingStage> stages; ///< in turn; the last holds on
    double power = 2;                 ///< of the distance that the strength is divided by
    double reach = 2.5;
  };

  /** The part |x| < half_width of the base that heats, equation (5.1): gamma falls from
   * `left` at its left end by `slope` per length. */
  struct HotBase
  {
    double half_width = 5;
    double left = 1.5;
    double slope = 0.025;
  };

  /** The floor y = 0 that throws particles back, equation (3.1). */
  struct SolidBase
  {
    double restitution = 0.1; ///< gamma: share of the velocity that is thrown back
    std::optional<HotBase> hot;
  };

  /** A bath (Langevin) that all particles are in. */
  struct HeatBath
  {
    std::vector<double> times;        ///< since the start, ascending
    std::vector<double> temperatures; ///< at these times, linear between them
    double rate = 1;                  ///< at which velocities forget, per unit of time
  };

  /** Light that heats what no other particle hides from it (section 6). */
  struct Light
  {
    bool parallel = false;
    Position at{};     ///< where it comes from, or the direction of parallel rays
    double power = 0;  ///< per time, of a point; per time and width or area, of rays
    double radius = 0; ///< of the particles; 0: half of the equilibrium distance
  };

  /** What makes a particle fluid. */
  enum class SolidTest
  {
    average_speed, ///< it moves faster than 7.5 on average over 1000 steps
    temperature,   ///< its mean kinetic energy since the start is 25 or more
    order          ///< its partners lie about it otherwise than in a crystal of the plane
  };

  /** Most stages of a run that means are taken over. */
  inline constexpr int most_stages = 6;

  /** A solid of particles that bind each other (D. Greenspan, A particle model of the
   * Stefan problem, 1976). */
  struct ParticleSolid
  {
    PairLaw law;
    SolidArrangement arrangement = SolidArrangement::table;
    int table = 1;       ///< of the report: 1, the triangle, or 2, the rectangle
    bool errata = false; ///< the table's four misprints are put right
    int rows = 7;        ///< of a rectangle
    double time_step = 1e-4;
    double gravity = 0;     ///< downward
    double disturbance = 0; ///< standard deviation of what is added to each coordinate
    std::optional<SolidBase> base;
    std::optional<PointHeating> heating;
    SolidTest test = SolidTest::average_speed;
    std::vector<int> corners; ///< particles, from 1, whose last bond is looked for
    double pressure = 0;      ///< on a bar's cold end

    std::function<double(double phi)> outline; ///< its radius over n / 2 spacings
    bool settled = true; ///< a solid on a base is laid to rest before the start
    double initial_temperature = 0; ///< of velocities that the seed chooses; 0: at rest
    std::vector<double> cell;       ///< lengths after which space repeats itself, or none
    double drag = 0;                ///< velocities fade by exp(-drag t)
    std::optional<HeatBath> bath;
    std::optional<Light> light;
    /** Times at which stages end, over whose second halves means are taken. */
    std::vector<double> stages;

    int dimension() const
    {
      return arrangement == SolidArrangement::block
                     || arrangement == SolidArrangement::ball
                 ? 3
                 : 2;
    }
  };
} // namespace meltfront::cases

#endif
