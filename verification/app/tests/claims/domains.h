#ifndef meltfront_verification_app_tests_claims_domains_h
#define meltfront_verification_app_tests_claims_domains_h

#include <cases/scene.h>

namespace meltfront::verification::claims
{
  /**
   * A domain of a shape: 0 <= x <= 1 of a slab and a box, which is half as deep across;
   * radius 1 of a ball; 0.4 to 1 of a shell. An outline is a disk of radius 1 where what
   * happens is round, else the rectangle of the box.
   */
  cases::Domain domain_of(cases::DomainShape shape, int dimension, bool round_outline);

  /** A scene on a domain with insulated walls; all properties one, no latent heat. */
  cases::Scene scene_on(const cases::Domain &domain);

  /** A wall of a scene, insulated until it is said otherwise. */
  cases::Boundary &wall(cases::Scene &scene, cases::Side side);

  using Value = std::function<double(const cases::Position &, double time)>;

  cases::Field field(Value value);

  cases::Boundary held_at(Value temperature);

  /** Of walls that exchange heat with their surroundings (W/(m^2 K)). */
  inline constexpr double transfer_coefficient = 3;

  /** A wall whose surroundings are as warm as they must be for it to let a flux in at its
   * temperature, by heat transfer or radiation. */
  cases::Boundary surrounded(cases::BoundaryKind kind, Value temperature, Value flux);

  /** Unit normal out of a domain at a point of its wall. */
  cases::Position normal(const cases::Domain &domain, cases::Side side,
                         const cases::Position &point);
} // namespace meltfront::verification::claims

#endif
