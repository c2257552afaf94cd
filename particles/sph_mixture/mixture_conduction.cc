#include <cases/numbers.h>
#include <particles/sph_mixture/mixture_conduction.h>

#include <algorithm>

namespace meltfront::particles
{
  namespace
  {
    using cases::infinity;

    ConductionForm choose(const AlloySubstance &substance, MeanConductivity mean,
                          bool uniform)
    {
      if(substance.material.solid.conductivity == substance.material.liquid.conductivity)
        return ConductionForm::uniform;
      if(mean == MeanConductivity::harmonic)
        return ConductionForm::harmonic;
      if(mean == MeanConductivity::arithmetic || !substance.diagram.straight())
        return ConductionForm::arithmetic;
      return uniform ? ConductionForm::transformed : ConductionForm::integral;
    }
  } // namespace

  MixtureConduction::MixtureConduction(const AlloySubstance &substance,
                                       MeanConductivity mean, bool uniform,
                                       std::size_t particles, std::size_t padded)
    : substance(substance)
    , path(substance)
    , n(particles)
    , used_form(choose(substance, mean, uniform))
    , liquid_conductivity(substance.material.liquid.conductivity)
    , difference(substance.material.solid.conductivity - liquid_conductivity)
  {
    for(auto *array : {&excess, &liquid, &depression, &value})
      array->resize(padded);
    if(used_form == ConductionForm::integral)
      for(auto *array : {&above_eutectic, &logarithm, &constant, &own})
        array->resize(padded);
  }

  template <typename Equilibrium>
  Extremes MixtureConduction::find_equilibrium(const Equilibrium &equilibrium,
                                               int threads)
  {
    double lowest = infinity, highest = -infinity, zero = 0;
    double *x = excess.data(), *f = liquid.data();
    const double melting = substance.material.melting_temperature;
#pragma omp parallel for schedule(static) num_threads(threads) if(threads > 1)           \
    reduction(min : lowest) reduction(max : highest) reduction(+ : zero)
    for(std::size_t a = 0; a < n; ++a)
    {
      const cases::PhaseState state = equilibrium(a);
      x[a] = state.temperature - melting;
      f[a] = state.liquid_fraction;
      lowest = std::min(lowest, state.temperature);
      highest = std::max(highest, state.temperature);
      zero += state.temperature * 0;
    }
    return {lowest, highest, zero == 0};
  }

  void MixtureConduction::set_depression(int threads)
  {
    const cases::PhaseDiagram &diagram = substance.diagram;
    double *p = depression.data();
    const std::span<const double> first = concentrations[0], second = concentrations[1];
    if(second.empty())
#pragma omp parallel for schedule(static) num_threads(threads) if(threads > 1)
      for(std::size_t a = 0; a < n; ++a)
        p[a] = diagram.depression(first[a]);
    else
#pragma omp parallel for schedule(static) num_threads(threads) if(threads > 1)
      for(std::size_t a = 0; a < n; ++a)
        p[a] = diagram.depression(first[a], second[a]);
  }

  Extremes
  MixtureConduction::follow(std::span<const double> enthalpy,
                            std::span<const std::span<const double>> concentration,
                            int threads)
  {
    const cases::PhaseDiagram &diagram = substance.diagram;
    std::copy(concentration.begin(), concentration.end(), concentrations.begin());
    if(!concentration.empty())
      set_depression(threads);
    const double *h = enthalpy.data(), *p = depression.data();
    Extremes extremes;
    if(diagram.straight())
      extremes = find_equilibrium([&diagram, h, p](std::size_t a)
                                  { return diagram.on_straight(h[a], p[a]); },
                                  threads);
    else
      extremes = find_equilibrium([&diagram, h, c = concentrations[0]](std::size_t a)
                                  { return diagram.equilibrium(h[a], c[a]); },
                                  threads);
    prepare_exchange(threads);
    return extremes;
  }

  void MixtureConduction::prepare_exchange(int threads)
  {
    const double *x = excess.data(), *f = liquid.data(), *p = depression.data();
    double *v = value.data();
    const double k = liquid_conductivity, d = difference;
    switch(used_form)
    {
    case ConductionForm::uniform:
#pragma omp parallel for simd schedule(static) num_threads(threads) if(threads > 1)
      for(std::size_t a = 0; a < n; ++a)
        v[a] = k * x[a];
      break;
    case ConductionForm::transformed:
#pragma omp parallel for schedule(static) num_threads(threads) if(threads > 1)
      for(std::size_t a = 0; a < n; ++a)
        v[a] = k * x[a] + d * path.whole(x[a], p[a]);
      break;
    case ConductionForm::integral:
#pragma omp parallel for schedule(static) num_threads(threads) if(threads > 1)
      for(std::size_t a = 0; a < n; ++a)
      {
        const SolidPath::Point point = path.point(x[a]);
        const double rest = x[a] < point.excess ? path.below_eutectic(x[a]) : 0.;
        v[a] = k * x[a] + d * rest;
        above_eutectic[a] = point.excess;
        logarithm[a] = point.logarithm;
        constant[a] = SolidPath::constant(p[a]);
        own[a] = path.integral(point.excess, point.logarithm, p[a], constant[a]);
      }
      break;
    default:
#pragma omp parallel for schedule(static) num_threads(threads) if(threads > 1)
      for(std::size_t a = 0; a < n; ++a)
        v[a] = substance.diagram.conductivity(1 - f[a]);
    }
  }

  void MixtureConduction::conduct(const ParticleOperator &rows, std::span<double> flow,
                                  int threads) const
  {
    with_pair([&](const auto &pair) { rows.apply_pairs(pair, flow, threads); });
  }

  double MixtureConduction::from_wall(std::size_t row, double wall) const
  {
    const double own = excess[row];
    switch(used_form)
    {
    case ConductionForm::uniform:
      return liquid_conductivity * (wall - own);
    case ConductionForm::transformed:
    case ConductionForm::integral:
      return liquid_conductivity * (wall - own)
             + difference
                   * (path.whole(wall, depression[row])
                      - path.whole(own, depression[row]));
    case ConductionForm::arithmetic:
      return ArithmeticMeanPair::between(value[row], own, wall_conductivity(row, wall),
                                         wall);
    default:
      return HarmonicMeanPair::between(value[row], own, wall_conductivity(row, wall),
                                       wall);
    }
  }

  double MixtureConduction::wall_conductivity(std::size_t row, double wall) const
  {
    const cases::PhaseDiagram &diagram = substance.diagram;
    return diagram.conductivity(
        diagram.solid_fraction(substance.material.melting_temperature + wall,
                               composition(0, row), composition(1, row)));
  }

  cases::HeatThroughLayer
  MixtureConduction::from_surroundings(std::size_t row, const cases::Boundary &wall,
                                       double ambient, double depth) const
  {
    if(used_form == ConductionForm::transformed || used_form == ConductionForm::integral)
      return through_equilibrium(row, wall, ambient, depth);
    return cases::heat_through_layer(wall, ambient,
                                     substance.material.melting_temperature + excess[row],
                                     depth / conductivity(row));
  }

  cases::HeatThroughLayer
  MixtureConduction::through_equilibrium(std::size_t row, const cases::Boundary &wall,
                                         double ambient, double depth) const
  {
    constexpr int most_iterations = 100;
    constexpr double settled = 1e-14;
    const double melting = substance.material.melting_temperature, own = excess[row];
    const double coldest = std::min(own, ambient - melting);
    const double warmest = std::max(own, ambient - melting);
    double lower = coldest, upper = warmest, at_wall = own, slope = 1;
    cases::HeatThroughWall through;
    for(int i = 0; i < most_iterations; ++i)
    {
      through = cases::heat_through(wall, ambient, melting + at_wall);
      // Rises with the wall's temperature.
      const double surplus = from_wall(row, at_wall) - depth * through.flux;
      slope = wall_conductivity(row, at_wall) - depth * through.slope;
      (surplus > 0 ? upper : lower) = at_wall;
      double next = std::clamp(at_wall - surplus / slope, coldest, warmest);
      if(next < lower || next > upper)
        next = 0.5 * (lower + upper);
      const double change = std::abs(next - at_wall);
      if(change <= settled * (std::abs(melting + at_wall) + std::abs(ambient)))
        break;
      at_wall = next;
    }
    return {through.flux, through.slope * conductivity(row) / slope, 0};
  }

  std::size_t MixtureConduction::bytes() const
  {
    return sizeof(double)
           * (excess.size() + liquid.size() + depression.size() + value.size()
              + above_eutectic.size() + logarithm.size() + constant.size() + own.size());
  }
} // namespace meltfront::particles
