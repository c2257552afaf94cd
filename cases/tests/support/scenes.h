#ifndef meltfront_cases_tests_support_scenes_h
#define meltfront_cases_tests_support_scenes_h

#include <cases/scene.h>

#include <functional>
#include <memory>

/** Scenes that tests of all methods share. */
namespace meltfront::test_support
{
  using ExactPointer = std::shared_ptr<const cases::ExactSolution>;

  /** All ones, melting at `melting_temperature`. */
  cases::Material unit_material(double melting_temperature = 0);

  /** Water and ice as in Monaghan et al. (2005), ice with its own heat capacity and the
   * density of water, degrees Celsius. */
  cases::Material water();

  cases::Boundary fixed_wall(double temperature);
  cases::Boundary varying_wall(std::function<double(double time)> temperature);
  cases::Boundary exact_wall(const ExactPointer &exact);
  cases::Boundary flux_wall(double flux);
  cases::Boundary periodic_wall();

  void set_boundary(cases::Scene &scene, cases::Side side,
                    const cases::Boundary &boundary);

  /** A field that does not change with time. */
  cases::Field field_of(std::function<double(const cases::Position &)> value);

  /** A field that jumps along x, as its expression says. */
  cases::Field step_along_x(double at, double below, double above);

  /** How the front moves where solid and liquid of two temperatures touch, both without
   * end, their properties one and melting at 0: the number in x = 2 number sqrt(t)
   * (Carslaw and Jaeger 1959, chapter XI). */
  double speed_of_contact(double solid, double liquid);

  /** Solid below x = at and liquid above, in an insulated box one long. */
  cases::Scene bodies_in_contact(double at, double height, double solid, double liquid,
                                 double end);

  /** An insulated slab 0 <= x <= length at a uniform temperature. */
  cases::Scene slab(const cases::Material &material, double length, double temperature,
                    double start, double end);

  /** A slab between two walls, from t = 0 on. */
  cases::Scene slab(const cases::Material &material, double length, double temperature,
                    double end, const cases::Boundary &left,
                    const cases::Boundary &right);

  /** An insulated disk or ball at a uniform temperature. */
  cases::Scene ball(const cases::Material &material, int dimension, double radius,
                    double temperature, double end);

  /** An insulated box at a uniform temperature. */
  cases::Scene box(const cases::Material &material, int dimension,
                   const cases::Position &lower, const cases::Position &upper,
                   double temperature, double end);

  /** A steady unit box, in one dimension a slab, without latent heat; its walls hold a
   * field. */
  cases::Scene steady_box(int dimension, const cases::Field &wall);

  /** Take initial state and, where they prescribe a temperature, walls from a solution.
   */
  void start_from(cases::Scene &scene, const ExactPointer &exact);

  /** A sink that draws the same power all the time (W, W/m). */
  cases::PointSource steady_sink(const cases::Position &place, double strength);
} // namespace meltfront::test_support

#endif
