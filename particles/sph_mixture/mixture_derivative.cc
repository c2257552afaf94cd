#include <particles/sph_mixture/mixture_derivative.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    bool mean_of_two(ConductionForm form)
    {
      return form == ConductionForm::arithmetic || form == ConductionForm::harmonic;
    }
  } // namespace

  MixtureDerivative::MixtureDerivative(const AlloySubstance &substance,
                                       const MixtureConduction &conduction,
                                       std::size_t particles)
    : substance(substance)
    , conduction(conduction)
    , n(particles)
    , branches(particles)
  {
    const std::size_t size = conduction.temperature_excess().size();
    for(auto *array : {&slope, &change_of_value, &diagonal})
      array->resize(size);
    if(mean_of_two(conduction.form()))
      for(auto *array : {&k, &k_slope, &change_of_k})
        array->resize(size);
    if(conduction.form() == ConductionForm::integral)
      for(auto *array : {&linear, &weight, &inverse, &own})
        array->resize(size);
  }

  template <typename Visit>
  void MixtureDerivative::with_derivative(const Visit &visit) const
  {
    const double *excess = conduction.temperature_excess().data();
    switch(conduction.form())
    {
    case ConductionForm::integral:
      visit(IntegralMeanDerivative{linear.data(), weight.data(), inverse.data(),
                                   own.data(), conduction.depressions().data(),
                                   substance.expansion});
      break;
    case ConductionForm::arithmetic:
      visit(ArithmeticMeanDerivative{excess, k.data()});
      break;
    case ConductionForm::harmonic:
      visit(HarmonicMeanDerivative{excess, k.data()});
      break;
    default:
      visit(DifferenceDerivative());
    }
  }

  void MixtureDerivative::linearise_integral(std::size_t row)
  {
    const double excess = conduction.temperature_excess()[row];
    const double difference
        = substance.material.solid.conductivity - substance.material.liquid.conductivity;
    const bool frozen = excess < substance.eutectic_excess;
    linear[row] = substance.material.liquid.conductivity
                  + (frozen ? difference * std::min(substance.expansion, 1.) : 0.);
    weight[row] = frozen || excess >= 0 ? 0. : 0.5 * difference;
    inverse[row] = excess < 0 ? 1 / std::min(excess, -1e-300) : 0.;
    own[row] = std::clamp(
        substance.expansion * (1 + conduction.depressions()[row] * inverse[row]), 0., 1.);
  }

  void MixtureDerivative::find_slopes_of(
      std::span<const double> enthalpy,
      std::span<const std::span<const double>> concentration)
  {
    const ConductionForm form = conduction.form();
    const double difference
        = substance.material.solid.conductivity - substance.material.liquid.conductivity;
    for(std::size_t a = 0; a < n; ++a)
    {
      const double first = concentration.empty() ? 0. : concentration[0][a];
      const double second = concentration.size() < 2 ? 0. : concentration[1][a];
      const double liquid = conduction.liquid_fraction()[a];
      branches[a] = find_branches(substance, first, second);
      const EquilibriumSlopes slopes
          = find_slopes(substance, branches[a], enthalpy[a],
                        conduction.temperature_excess()[a], liquid, first);
      slope[a] = slopes.temperature;
      if(form == ConductionForm::uniform || form == ConductionForm::transformed)
        slope[a] *= conduction.conductivity(a);
      else if(form == ConductionForm::integral)
        linearise_integral(a);
      else
      {
        const bool full = substance.expansion * (1 - liquid) > 1;
        k[a] = conduction.conductivity(a);
        k_slope[a]
            = full ? 0. : -difference * substance.expansion * slopes.liquid_fraction;
      }
    }
  }

  void MixtureDerivative::linearise(
      const ParticleOperator &rows, std::span<const double> enthalpy,
      std::span<const std::span<const double>> concentration, int threads)
  {
    find_slopes_of(enthalpy, concentration);
    const double *v = slope.data();
    if(!mean_of_two(conduction.form()))
    {
      with_derivative(
          [&](const auto &derivative)
          {
            rows.apply_pairs(
                [derivative, v](std::size_t a, std::size_t b) {
                  return derivative(a, b, {v[a], 0., 0., 0.});
                },
                diagonal, threads);
          });
      return;
    }
    const double *c = k_slope.data();
    with_derivative(
        [&](const auto &derivative)
        {
          rows.apply_pairs(
              [derivative, v, c](std::size_t a, std::size_t b) {
                return derivative(a, b, {v[a], 0., c[a], 0.});
              },
              diagonal, threads);
        });
  }

  void MixtureDerivative::apply(const ParticleOperator &rows,
                                std::span<const double> change,
                                std::span<double> flow_change, int threads)
  {
    for(std::size_t a = 0; a < n; ++a)
      change_of_value[a] = slope[a] * change[a];
    const double *v = change_of_value.data();
    if(!mean_of_two(conduction.form()))
    {
      with_derivative(
          [&](const auto &derivative)
          {
            rows.apply_pairs(
                [derivative, v](std::size_t a, std::size_t b) {
                  return derivative(a, b, {v[a], v[b], 0., 0.});
                },
                flow_change, threads);
          });
      return;
    }
    for(std::size_t a = 0; a < n; ++a)
      change_of_k[a] = k_slope[a] * change[a];
    const double *c = change_of_k.data();
    with_derivative(
        [&](const auto &derivative)
        {
          rows.apply_pairs(
              [derivative, v, c](std::size_t a, std::size_t b) {
                return derivative(a, b, {v[a], v[b], c[a], c[b]});
              },
              flow_change, threads);
        });
  }

  double MixtureDerivative::from_wall(std::size_t row, double wall) const
  {
    const double own_excess = conduction.temperature_excess()[row];
    switch(conduction.form())
    {
    case ConductionForm::uniform:
    case ConductionForm::transformed:
      return -slope[row];
    case ConductionForm::integral:
      return -slope[row] * conduction.conductivity(row);
    case ConductionForm::arithmetic:
      return ArithmeticMeanDerivative::between(k[row], own_excess,
                                               conduction.wall_conductivity(row, wall),
                                               wall, {slope[row], 0., k_slope[row], 0.});
    default:
      return HarmonicMeanDerivative::between(k[row], own_excess,
                                             conduction.wall_conductivity(row, wall),
                                             wall, {slope[row], 0., k_slope[row], 0.});
    }
  }

  double MixtureDerivative::from_surroundings(std::size_t row,
                                              const cases::Boundary &wall, double ambient,
                                              double depth) const
  {
    const cases::HeatThroughLayer through
        = conduction.from_surroundings(row, wall, ambient, depth);
    switch(conduction.form())
    {
    case ConductionForm::uniform:
    case ConductionForm::transformed:
      return through.slope * slope[row] / conduction.conductivity(row);
    case ConductionForm::integral:
      return through.slope * slope[row];
    default:
      return through.slope * slope[row]
             - through.by_resistance * depth / (k[row] * k[row]) * k_slope[row];
    }
  }

  void MixtureDerivative::correct(std::span<const double> correction,
                                  std::span<double> enthalpy) const
  {
    for(std::size_t a = 0; a < n; ++a)
      if(std::isfinite(correction[a]))
        enthalpy[a] = stop_at_kink(branches[a], enthalpy[a], enthalpy[a] + correction[a],
                                   substance.material.latent_heat);
  }
} // namespace meltfront::particles
