#ifndef meltfront_verification_measure_tests_fixtures_h
#define meltfront_verification_measure_tests_fixtures_h

#include <cases/scene.h>
#include <cases/snapshot.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace meltfront::verification::tests
{
  /** A front at 0.5 sqrt(t) between solid (T < 0) and liquid; T is linear in the
   * coordinate. */
  class LinearProfile : public cases::ExactSolution
  {
  public:
    explicit LinearProfile(cases::Symmetry symmetry, bool solid_inside = true)
      : kind(symmetry)
      , solid_inside(solid_inside)
    {
    }

    std::string description() const override
    {
      return "a linear temperature profile";
    }

    cases::Symmetry symmetry() const override
    {
      return kind;
    }

    double temperature(double coordinate, double time) const override
    {
      return (solid_inside ? 1 : -1) * (coordinate - front(time));
    }

    double front(double time) const override
    {
      return 0.5 * std::sqrt(time);
    }

    double heat_content(double, double, double) const override
    {
      return 0;
    }

    bool solid_at_origin() const override
    {
      return solid_inside;
    }

  private:
    cases::Symmetry kind;
    bool solid_inside;
  };

  /** Half solid up to 0.5 sqrt(t), where the liquid holds 0.2, and liquid with 0.1
   * beyond. */
  class HalfFrozen : public LinearProfile
  {
  public:
    HalfFrozen()
      : LinearProfile(cases::Symmetry::planar)
    {
    }

    bool mushy() const override
    {
      return true;
    }

    double solid_fraction(double coordinate, double time) const override
    {
      return coordinate < front(time) ? 0.5 : 0;
    }

    double concentration(double, double) const override
    {
      return 0.1;
    }

    double solid_volume(double lower, double upper, double time) const override
    {
      return 0.5 * (std::min(front(time), upper) - lower);
    }
  };

  /** A state that owns what a snapshot views; books no heat unless told to. */
  struct State
  {
    State()
    {
      snapshot.heat.conservative = false;
    }

    cases::Snapshot snapshot;
    std::array<std::vector<double>, 3> positions;
    std::vector<double> weights, temperature, solid_fraction;
    std::array<std::vector<double>, cases::most_solutes> concentration;

    /** Book the heat of the sites of a substance of which all properties are 1 and that
     * melts at 0. What it held at the start apart, all has come through the walls. */
    void book(double initial)
    {
      cases::HeatBudget &heat = snapshot.heat;
      heat = {.initial = initial};
      for(std::size_t i = 0; i < weights.size(); ++i)
      {
        heat.stored += weights[i] * temperature[i];
        heat.latent += weights[i] * (1 - solid_fraction[i]);
      }
      heat.boundary = heat.stored + heat.latent - initial;
    }

    const cases::Snapshot &view(int dimension, double time)
    {
      snapshot.dimension = dimension;
      snapshot.time = time;
      for(int d = 0; d < 3; ++d)
        snapshot.positions[d] = positions[d];
      snapshot.weights = weights;
      snapshot.temperature = temperature;
      snapshot.solid_fraction = solid_fraction;
      for(std::size_t s = 0; s < concentration.size(); ++s)
        snapshot.concentration[s] = concentration[s];
      return snapshot;
    }
  };

  /** A slab of unit length, or a box or ball centred on the origin. */
  inline cases::Scene scene_of(cases::DomainShape shape, int dimension,
                               cases::Symmetry symmetry)
  {
    cases::Scene scene;
    scene.symmetry = symmetry;
    scene.domain.shape = shape;
    scene.domain.dimension = dimension;
    if(shape == cases::DomainShape::slab)
      scene.domain.upper = {1, 0, 0};
    for(int d = 0; shape == cases::DomainShape::box && d < dimension; ++d)
    {
      scene.domain.lower[d] = -0.5;
      scene.domain.upper[d] = 0.5;
    }
    scene.domain.radius = 0.5;
    scene.initial.temperature = cases::Field::uniform(1);
    if(shape == cases::DomainShape::slab)
      for(const cases::Side side : {cases::Side::x_min, cases::Side::x_max})
        scene.boundaries[static_cast<std::size_t>(side)] = cases::Boundary{};
    return scene;
  }
} // namespace meltfront::verification::tests

#endif
