#include <cases/tests/support/scenes.h>
#include <verification/app/tests/random_slabs.h>

#include <cmath>
#include <numbers>
#include <random>

namespace meltfront::verification::tests
{
  namespace
  {
    using cases::BoundaryKind;

    class Numbers
    {
    public:
      explicit Numbers(std::uint64_t seed)
        : generator(seed)
      {
        generator.discard(8);
      }

      double between(double lower, double upper)
      {
        return lower + (upper - lower) * static_cast<double>(generator()) * 0x1p-64;
      }

      double about_one(double factor)
      {
        return std::pow(factor, between(-1, 1));
      }

      int below(int n)
      {
        return static_cast<int>(between(0, n));
      }

    private:
      std::mt19937_64 generator;
    };

    /** A value that is constant, swings or jumps, about a mean. */
    cases::Field random_course(Numbers &numbers, double mean, double swing, double end)
    {
      const int kind = numbers.below(3);
      const double amplitude = numbers.between(-swing, swing),
                   rate = 2 * std::numbers::pi * numbers.between(0.5, 3) / end,
                   phase = numbers.between(0, 2 * std::numbers::pi),
                   jump = numbers.between(0.1, 0.9) * end;
      if(kind == 0)
        return cases::Field::uniform(mean);
      cases::Field result;
      result.expression = "random";
      if(kind == 1)
        result.value = [=](const cases::Position &, double time)
        { return mean + amplitude * std::sin(rate * time + phase); };
      else
      {
        result.value = [=](const cases::Position &, double time)
        { return time < jump ? mean : mean + 2 * amplitude; };
        result.breakpoints = {jump};
      }
      return result;
    }

    cases::Boundary random_wall(Numbers &numbers, double end)
    {
      cases::Boundary wall;
      const double mean = numbers.between(-1, 1);
      switch(numbers.below(5))
      {
      case 0:
        break;
      case 1:
        wall.kind = BoundaryKind::fixed_temperature;
        wall.value = random_course(numbers, mean, 1.5, end);
        break;
      case 2:
        wall.kind = BoundaryKind::flux;
        wall.value = random_course(numbers, 3 * mean, 4, end);
        break;
      case 3:
        wall.kind = BoundaryKind::heat_transfer;
        wall.heat_transfer_coefficient = 3 * numbers.about_one(3);
        wall.value = random_course(numbers, mean, 1.5, end);
        break;
      default:
        wall.kind = BoundaryKind::radiation;
        wall.emission_coefficient = 0.1 * numbers.about_one(3);
        wall.absolute_zero = -3;
        wall.value = random_course(numbers, mean, 1.5, end);
      }
      return wall;
    }
  } // namespace

  cases::Scene random_slab(std::uint64_t number)
  {
    Numbers numbers(number);
    cases::Material material = test_support::unit_material();
    for(cases::PhaseProperties *phase : {&material.solid, &material.liquid})
    {
      phase->conductivity = numbers.about_one(2);
      phase->specific_heat_capacity = numbers.about_one(2);
    }
    material.latent_heat = numbers.about_one(3);
    const double end = 0.3 * numbers.about_one(3);
    cases::Scene scene = test_support::slab(material, 1, 0, 0, end);
    const double mean = numbers.between(-0.6, 0.6), swing = numbers.between(-0.6, 0.6);
    const int waves = numbers.below(4); // of half a length; 0: uniform
    scene.initial.temperature.constant = false;
    scene.initial.temperature.value = [=](const cases::Position &p, double) {
      return waves == 0 ? mean : mean + swing * std::cos(waves * std::numbers::pi * p[0]);
    };
    for(const cases::Side side : {cases::Side::x_min, cases::Side::x_max})
      test_support::set_boundary(scene, side, random_wall(numbers, end));
    return scene;
  }
} // namespace meltfront::verification::tests
