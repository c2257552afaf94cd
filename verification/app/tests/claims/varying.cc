#include <verification/app/tests/claims/domains.h>
#include <verification/app/tests/claims/varying.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace meltfront::verification::claims
{
  namespace
  {
    using cases::Effect, cases::Position, cases::Side;

    std::shared_ptr<const cases::PropertyCurve> line(double from, double at_from,
                                                     double to, double at_to)
    {
      return std::make_shared<cases::PropertyCurve>(std::vector<double>{from, to},
                                                    std::vector<double>{at_from, at_to},
                                                    "a line of the claim");
    }

    Trial in_slab(double end)
    {
      Trial trial;
      trial.scene = scene_on(domain_of(cases::DomainShape::slab, 1, false));
      trial.scene.material.melting_temperature = -100; // no phase changes near it
      trial.scene.end_time = end;
      trial.n = 40;
      return trial;
    }

    /** Of T + b T^2/2, at the middle between T = 0 and T = 1. */
    double at_middle(double b, double share)
    {
      const double value = share * (1 + b / 2);
      return 2 * value / (1 + std::sqrt(1 + 2 * b * value));
    }

    /** k = 1 + b T, between walls at 0 and 1. */
    Trial conducting(double b)
    {
      Trial trial = in_slab(1);
      for(cases::PhaseProperties *phase :
          {&trial.scene.material.solid, &trial.scene.material.liquid})
        phase->conductivity_curve = line(0, 1, 1, 1 + b);
      trial.scene.initial.temperature
          = field([](const Position &p, double) { return p[0]; });
      wall(trial.scene, Side::x_min)
          = held_at([](const Position &, double) { return 0.; });
      wall(trial.scene, Side::x_max)
          = held_at([](const Position &, double) { return 1.; });
      trial.judge
          = temperature_judge([b](const Position &p) { return at_middle(b, p[0]); });
      return trial;
    }

    /** One half at a temperature, the other at another. */
    cases::Field halves(double left, double right)
    {
      return field([left, right](const Position &p, double)
                   { return p[0] < 0.5 ? left : right; });
    }

    /** c = 1 + b T; heat spreads so fast that the end is uniform. */
    Trial storing(double b)
    {
      Trial trial = in_slab(1);
      for(cases::PhaseProperties *phase :
          {&trial.scene.material.solid, &trial.scene.material.liquid})
      {
        phase->conductivity = 8;
        phase->heat_capacity_curve = line(0, 1, 1, 1 + b);
      }
      trial.scene.initial.temperature = halves(0, 1);
      trial.judge
          = temperature_judge([b](const Position &) { return at_middle(b, 0.5); });
      return trial;
    }

    /** Halves at -1 and 1 of a material with c = L = 1 that melts over 0.4. */
    Trial melting(double solidus)
    {
      constexpr double width = 0.4;
      Trial trial = in_slab(3);
      cases::Material &material = trial.scene.material;
      material.latent_heat = 1;
      material.melting_temperature = solidus;
      material.melting_range = std::make_shared<cases::MeltingRange>(cases::MeltingRange{
          solidus, solidus + width, line(solidus, 1, solidus + width, 0), "linear"});
      material.update_curves();
      trial.scene.initial.temperature = halves(-1, 1);
      const double enthalpy = ((-1 - solidus) + (1 + 1 - solidus)) / 2;
      const double molten = enthalpy / (1 + width);
      trial.judge = temperature_judge(
          [=](const Position &) { return solidus + width * molten; }, 1 - molten);
      return trial;
    }

    constexpr double off = 0.035, end = 0.05, from = 0.2, strength = 15;

    /** Gives off 15 for a while, then what it has left spreads. */
    Trial passing(double speed)
    {
      Trial trial = in_slab(end);
      trial.scene.initial.temperature = cases::Field::uniform(0);
      cases::PointSource source;
      source.position = {from, 0, 0};
      source.expression = "of the claim";
      source.power = [](double time) { return time < off ? strength : 0.; };
      source.energy = [](double time) { return strength * std::min(time, off); };
      if(speed > 0)
        source.path = cases::Path{"of the claim", [speed](double time) {
                                    return Position{from + speed * time, 0, 0};
                                  }};
      trial.scene.sources = {source};
      trial.judge = temperature_judge(
          [speed](const Position &p)
          {
            double sum = strength * off;
            for(int n = 1; n < 200; ++n)
            {
              const double k = n * std::numbers::pi, decay = k * k * end;
              const std::complex<double> rate(k * k, k * speed);
              sum += 2 * strength * std::cos(k * p[0])
                     * (std::polar(1., k * from)
                        * (std::exp(rate * off - decay) - std::exp(-decay)) / rate)
                           .real();
            }
            return sum;
          });
      return trial;
    }
  } // namespace

  std::optional<EffectTrials> varying_trials(Effect effect)
  {
    switch(effect)
    {
    case Effect::variable_conductivity:
      return EffectTrials{conducting(-0.9), conducting(9)};
    case Effect::variable_heat_capacity:
      return EffectTrials{storing(-0.9), storing(9)};
    case Effect::melting_range:
      return EffectTrials{melting(-0.4), melting(0)};
    case Effect::moving_source:
      return EffectTrials{passing(0), passing(15)};
    default:
      return {};
    }
  }
} // namespace meltfront::verification::claims
