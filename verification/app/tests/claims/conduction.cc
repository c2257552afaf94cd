#include <verification/app/tests/claims/conduction.h>
#include <verification/app/tests/claims/domains.h>

#include <cmath>
#include <numbers>

namespace meltfront::verification::claims
{
  namespace
  {
    using cases::BoundaryKind, cases::DomainShape, cases::Effect, cases::Position,
        cases::Side;
    using std::numbers::pi;

    cases::PhaseProperties material()
    {
      return {.conductivity = 2, .specific_heat_capacity = 0.8, .density = 1.5};
    }

    cases::Scene scene_without_front(const cases::Domain &domain)
    {
      cases::Scene scene = scene_on(domain);
      scene.material.solid = scene.material.liquid = material();
      scene.material.melting_temperature = -100; // no phase changes near it
      return scene;
    }

    /** A solution of the heat equation. */
    struct Wave
    {
      std::function<double(const Position &)> profile;
      std::function<Position(const Position &)> gradient;
      double wave_number_squared = 0;

      double at(const Position &p, double time) const
      {
        return decay(time) * profile(p);
      }

      double decay(double time) const
      {
        return std::exp(-material().diffusivity() * wave_number_squared * time);
      }
    };

    struct Factor
    {
      double wave_number, phase;
    };

    Wave product_of_sines(const std::vector<Factor> &factors)
    {
      Wave wave;
      for(const Factor &factor : factors)
        wave.wave_number_squared += factor.wave_number * factor.wave_number;
      wave.profile = [factors](const Position &p)
      {
        double product = 1;
        for(std::size_t d = 0; d < factors.size(); ++d)
          product *= std::sin(factors[d].wave_number * p[d] + factors[d].phase);
        return product;
      };
      wave.gradient = [factors](const Position &p)
      {
        Position result{};
        for(std::size_t i = 0; i < factors.size(); ++i)
        {
          result[i] = 1;
          for(std::size_t d = 0; d < factors.size(); ++d)
          {
            const double argument = factors[d].wave_number * p[d] + factors[d].phase;
            result[i] *= d == i ? factors[d].wave_number * std::cos(argument)
                                : std::sin(argument);
          }
        }
        return result;
      };
      return wave;
    }

    /** J_0 in the plane, sin(k r)/(k r) in space, with a zero slope at r = 1. */
    Wave round_wave(int dimension)
    {
      const double k = dimension == 2 ? 3.83170597020751232 : 4.49340945790906418;
      Wave wave;
      wave.wave_number_squared = k * k;
      wave.profile = [k, dimension](const Position &p)
      {
        const double z = k * std::hypot(p[0], p[1], p[2]);
        return dimension == 2 ? std::cyl_bessel_j(0., z) : std::sph_bessel(0u, z);
      };
      return wave;
    }

    /** Factors along x that satisfy the wall, along y and z any that do. */
    std::vector<Factor> factors_of(const cases::Domain &domain, BoundaryKind kind,
                                   bool held)
    {
      std::vector<Factor> factors{{2, 0.5}, {2.5, 0.8}, {1.5, 0.6}};
      if(kind == BoundaryKind::periodic)
        factors[0] = {2 * pi, 0.7};
      if(kind == BoundaryKind::insulated)
        factors[0] = {pi, pi / 2};
      if(!held)
        factors[1] = {pi / (domain.upper[1] - domain.lower[1]), pi / 2};
      factors.resize(domain.dimension);
      return factors;
    }

    cases::Boundary boundary_of(const Wave &wave, const cases::Domain &domain, Side side,
                                BoundaryKind kind)
    {
      if(kind == BoundaryKind::insulated || kind == BoundaryKind::periodic)
        return {.kind = kind, .value = {}};
      if(kind == BoundaryKind::fixed_temperature)
        return held_at([wave](const Position &p, double time)
                       { return wave.at(p, time); });
      const auto flux = [wave, domain, side](const Position &p, double time)
      {
        const Position outward = normal(domain, side, p), slope = wave.gradient(p);
        double sum = 0;
        for(int d = 0; d < 3; ++d)
          sum += outward[d] * slope[d];
        return material().conductivity * wave.decay(time) * sum;
      };
      if(kind == BoundaryKind::flux)
        return {.kind = kind, .value = field(flux)};
      return surrounded(
          kind, [wave](const Position &p, double time) { return wave.at(p, time); },
          flux);
    }

    int resolution_of(int dimension)
    {
      return dimension == 1 ? 40 : dimension == 2 ? 24 : 14;
    }

    /** Conduction through a slab; its walls are held at 0. */
    Trial steady_slab(TemperatureAt temperature, double scale)
    {
      Trial trial;
      trial.scene = scene_without_front(domain_of(DomainShape::slab, 1, false));
      trial.scene.problem = cases::ProblemKind::poisson;
      for(const Side side : {Side::x_min, Side::x_max})
        wall(trial.scene, side) = held_at([](const Position &, double) { return 0.; });
      trial.scene.initial.temperature = cases::Field::uniform(0);
      trial.judge = temperature_judge(std::move(temperature));
      trial.n = resolution_of(1);
      trial.scale = scale;
      return trial;
    }

    /** With x_max as given, so that the temperature is slope x. */
    Trial linear_slab(double slope, const cases::Boundary &at_x_max)
    {
      Trial trial = steady_slab([slope](const Position &p) { return slope * p[0]; }, 1);
      wall(trial.scene, Side::x_max) = at_x_max;
      return trial;
    }

    Trial released(double power)
    {
      const double k = material().conductivity;
      Trial trial = steady_slab([power, k](const Position &p)
                                { return power * p[0] * (1 - p[0]) / (2 * k); },
                                1. / 8);
      if(power != 0)
        trial.scene.volumetric_source = cases::Field::uniform(power);
      return trial;
    }

    TemperatureAt composite(double inside)
    {
      const double outside = material().conductivity;
      const double flux = 1 / (0.5 / inside + 0.5 / outside);
      return [=](const Position &p)
      { return p[0] < 0.5 ? flux * p[0] / inside : 1 - flux * (1 - p[0]) / outside; };
    }

    cases::Inclusion left_half(double conductivity)
    {
      return {field([](const Position &p, double) { return p[0] - 0.5; }), conductivity};
    }

    Trial steady_composite(double inside)
    {
      Trial trial = steady_slab(composite(inside), 1);
      wall(trial.scene, Side::x_max)
          = held_at([](const Position &, double) { return 1.; });
      trial.scene.inclusion = left_half(inside);
      return trial;
    }
  } // namespace

  Trial heat_wave(DomainShape shape, int dimension, BoundaryKind kind, bool held)
  {
    Trial trial;
    const cases::Domain domain = domain_of(shape, dimension, false);
    trial.scene = scene_without_front(domain);
    const bool round_one = domain.round() && kind == BoundaryKind::insulated;
    const Wave wave = round_one ? round_wave(dimension)
                                : product_of_sines(factors_of(domain, kind, held));
    for(const Side side : trial.scene.sides())
    {
      const bool chosen = side == Side::x_min || side == Side::x_max
                          || side == Side::outer || (side == Side::inner && !round_one);
      const BoundaryKind other
          = held ? BoundaryKind::fixed_temperature : BoundaryKind::insulated;
      wall(trial.scene, side) = boundary_of(wave, domain, side, chosen ? kind : other);
    }
    trial.scene.end_time = 0.02;
    trial.scene.initial.temperature
        = field([wave](const Position &p, double) { return wave.profile(p); });
    trial.judge = temperature_judge([wave, end = trial.scene.end_time](const Position &p)
                                    { return wave.at(p, end); });
    trial.n = resolution_of(dimension);
    return trial;
  }

  Trial dissolved(Trial trial)
  {
    cases::Solute solute;
    solute.name = "solute";
    solute.liquidus_slope = 1;
    trial.scene.alloy = cases::Alloy{.solutes = {solute}};
    trial.scene.initial.concentration = {cases::Field::uniform(0.1)};
    trial.scene.material.latent_heat = 1;
    return trial;
  }

  std::optional<EffectTrials> steady_trials(Effect effect)
  {
    const double k = material().conductivity, h = transfer_coefficient;
    switch(effect)
    {
    case Effect::wall_temperature:
    {
      // Surroundings at 0 beyond x_max make the solution unique without the Dirichlet
      // wall, too.
      const auto held = [k, h](double temperature)
      {
        const double slope = -h * temperature / (k + h);
        Trial trial = steady_slab(
            [=](const Position &p) { return temperature + slope * p[0]; }, 1);
        wall(trial.scene, Side::x_min)
            = held_at([temperature](const Position &, double) { return temperature; });
        wall(trial.scene, Side::x_max) = {.kind = BoundaryKind::heat_transfer,
                                          .value = cases::Field::uniform(0),
                                          .exact = false,
                                          .heat_transfer_coefficient = h};
        return trial;
      };
      return EffectTrials{held(0.5), held(1)};
    }
    case Effect::wall_flux:
    {
      const auto heated = [k](double slope)
      {
        return linear_slab(slope, {.kind = BoundaryKind::flux,
                                   .value = cases::Field::uniform(k * slope)});
      };
      return EffectTrials{heated(0), heated(1)};
    }
    case Effect::robin_wall:
    {
      const auto surrounded = [k, h](double ambient)
      {
        return linear_slab(h * ambient / (k + h),
                           {.kind = BoundaryKind::heat_transfer,
                            .value = cases::Field::uniform(ambient),
                            .exact = false,
                            .heat_transfer_coefficient = h});
      };
      return EffectTrials{surrounded(0.5), surrounded(1)};
    }
    case Effect::volumetric_source:
      return EffectTrials{released(0), released(2)};
    case Effect::inclusion:
      return EffectTrials{steady_composite(k), steady_composite(5 * k)};
    default:
      return {};
    }
  }

  EffectTrials inclusion_trials()
  {
    const auto settled = [](double inside)
    {
      Trial trial = steady_composite(inside);
      trial.scene.problem = cases::ProblemKind::stefan;
      trial.scene.initial.temperature
          = field([](const Position &p, double) { return p[0]; });
      trial.scene.end_time = 0.5; // when exp(-pi^2 a t) = 3e-4 is left
      trial.n = 16;
      return trial;
    };
    return {settled(material().conductivity), settled(5 * material().conductivity)};
  }
} // namespace meltfront::verification::claims
