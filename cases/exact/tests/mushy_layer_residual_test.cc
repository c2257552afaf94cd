// The mushy layer against the equations it is to solve, with more digits than it is used
// with, and against a difference scheme that knows nothing of it.

#include <cases/exact/tests/salt_water.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <vector>

namespace meltfront::cases
{
  namespace
  {
    using FiftyDigits = boost::multiprecision::cpp_bin_float_50;
    using similarity::DiffusingMush;
    using similarity::LeverRuleMush;
    using similarity::Mush;

    /** (K x')' - 2 eta H', relative to the second, by differences of the fields. */
    template <typename Real, typename Layer>
    Real heat_residual(const Layer &layer, const Mush<Real> &mush, const Real &eta,
                       const Real &step)
    {
      const auto between = [&](const Real &from, const Real &to)
      {
        const Real middle = (from + to) / 2;
        return mush.conductivity(layer.at(middle).liquid)
               * (layer.at(to).depth - layer.at(from).depth) / (to - from);
      };
      const Real left = eta - step, right = eta + step;
      const Real conduction = (between(eta, right) - between(left, eta)) / step;
      const Real warming
          = eta * (layer.at(right).enthalpy - layer.at(left).enthalpy) / step;
      return (conduction - warming) / warming;
    }

    /** 2 eta (f x)' + eps (f x')', relative to the first. */
    template <typename Real>
    Real solute_residual(const DiffusingMush<Real> &layer, const Mush<Real> &mush,
                         const Real &eta, const Real &step)
    {
      const auto between = [&](const Real &from, const Real &to)
      {
        return layer.at((from + to) / 2).liquid
               * (layer.at(to).depth - layer.at(from).depth) / (to - from);
      };
      const Real left = eta - step, right = eta + step;
      const Real diffusion
          = mush.diffusion * (between(eta, right) - between(left, eta)) / step;
      const Real change
          = eta * (layer.at(right).composition - layer.at(left).composition) / step;
      return (diffusion + change) / change;
    }

    /** Cell averages of enthalpy and of solute in a slab, advanced by small steps. */
    class DifferenceScheme
    {
    public:
      DifferenceScheme(const Alloy &alloy, double length, int cells)
        : diagram(salt_water(), alloy)
        , diffusivity(alloy.solutes[0].diffusivity)
        , width(length / cells)
        , enthalpy(cells, diagram.enthalpy(14.7, 0.14))
        , solute(cells, 0.14)
        , state(cells)
      {
        equilibrate();
      }

      void run(double end)
      {
        const double limit = width * width * 1097 * 2006 / (2 * 2.408);
        const int steps = static_cast<int>(std::ceil(end / (0.9 * limit)));
        for(int i = 0; i < steps; ++i)
          step(end / steps);
      }

      double temperature(double y) const
      {
        return at(y, [this](std::size_t i) { return state[i].temperature; });
      }

      double concentration(double y) const
      {
        return at(y, [this](std::size_t i) { return solute[i]; });
      }

    private:
      /** Between the centres of cells, linearly. */
      template <typename Value>
      double at(double y, const Value &value) const
      {
        const double place = y / width - 0.5;
        const auto i = static_cast<std::size_t>(place);
        return value(i) + (place - static_cast<double>(i)) * (value(i + 1) - value(i));
      }

      void equilibrate()
      {
        for(std::size_t i = 0; i < state.size(); ++i)
          state[i] = diagram.equilibrium(enthalpy[i], solute[i]);
      }

      void step(double dt)
      {
        const double mass = 1097 * width;
        const auto conductivity = [this](std::size_t i)
        { return diagram.conductivity(1 - state[i].liquid_fraction); };
        const double wall = conductivity(0) * (state[0].temperature + 16.5) / (width / 2);
        enthalpy[0] -= dt / mass * wall;
        for(std::size_t i = 0; i + 1 < state.size(); ++i)
        {
          const double heat = 0.5 * (conductivity(i) + conductivity(i + 1))
                              * (state[i + 1].temperature - state[i].temperature) / width;
          enthalpy[i] += dt / mass * heat;
          enthalpy[i + 1] -= dt / mass * heat;
          const double left = state[i].liquid_fraction,
                       right = state[i + 1].liquid_fraction;
          if(diffusivity == 0 || left <= 0 || right <= 0)
            continue;
          const double flow = dt / width * diffusivity * 2 * left * right / (left + right)
                              * (solute[i + 1] / right - solute[i] / left) / width;
          solute[i] += flow;
          solute[i + 1] -= flow;
        }
        equilibrate();
      }

      PhaseDiagram diagram;
      double diffusivity;
      double width;
      std::vector<double> enthalpy, solute;
      std::vector<PhaseState> state;
    };

    /** Largest error of a scheme's temperature and of its concentration. */
    std::pair<double, double> scheme_errors(const Alloy &alloy, int cells)
    {
      const MushyLayer layer(salt_water(), alloy, {0.14}, -16.5, 14.7);
      const double time = 91800;
      DifferenceScheme scheme(alloy, 0.6, cells);
      scheme.run(time);
      double temperature = 0, concentration = 0;
      for(double y = 0.02; y < 0.2; y += 0.01)
      {
        temperature = std::max(
            temperature, std::abs(scheme.temperature(y) - layer.temperature(y, time)));
        concentration = std::max(concentration, std::abs(scheme.concentration(y)
                                                         - layer.concentration(y, time)));
      }
      return {temperature, concentration};
    }
  } // namespace

  TEST(MushyLayerResidual, HeatWithFiftyDigits)
  {
    for(const char set : {'A', 'B', 'C', 'D'})
    {
      const auto mush = equations_of<FiftyDigits>(set);
      const LeverRuleMush<FiftyDigits> layer(mush, FiftyDigits(0.45), 100);
      for(const double share : {0.13, 0.41, 0.72, 0.97})
      {
        const FiftyDigits eta = layer.edge() + share * (FiftyDigits(0.45) - layer.edge());
        EXPECT_LT(abs(heat_residual<FiftyDigits>(layer, mush, eta, 1e-10)), 1e-14)
            << set << " " << share;
      }
      const auto front = layer.at(FiftyDigits(0.45));
      EXPECT_LT(abs(front.depth / mush.composition - 1), 1e-30);
      EXPECT_LT(abs(front.liquid - 1), 1e-30);
    }
  }

  TEST(MushyLayerResidual, HeatAndSoluteWhereItDiffuses)
  {
    using Real = long double;
    auto mush = equations_of<Real>('B');
    mush.diffusion = Real(6.8e-7L) * 4180 / Real(0.498L);
    const Real lambda = 0.466043019L;
    const DiffusingMush<Real> layer(mush, lambda, 64);
    EXPECT_NEAR(static_cast<double>(layer.solid_layer()->at(0).depth), 16.5, 1e-7);
    for(const Real share : {0.03L, 0.13L, 0.41L, 0.72L, 0.97L})
    {
      const Real eta = layer.edge() + share * (lambda - layer.edge());
      EXPECT_LT(std::abs(heat_residual<Real>(layer, mush, eta, 1e-5L)), 1e-6) << share;
      EXPECT_LT(std::abs(solute_residual<Real>(layer, mush, eta, 1e-5L)), 1e-6) << share;
    }
  }

  TEST(MushyLayerResidual, TheFrontConstantIsGoodToRoundOff)
  {
    for(const char set : {'A', 'B', 'C', 'D'})
    {
      const auto mush = equations_of<long double>(set);
      const long double lambda = similarity::decreasing_root<long double>(
          [&](long double x) -> similarity::Balance<long double> {
            return {-LeverRuleMush<long double>(mush, x, 64).edge(), x};
          },
          "lambda");
      expect_relative(data_set(set).lambda(), static_cast<double>(lambda), 2e-15);
    }
  }

  TEST(MushyLayerResidual, ADifferenceSchemeConvergesToIt)
  {
    const Alloy still = sodium_nitrate(917);
    const double coarse = scheme_errors(still, 60).first;
    const double fine = scheme_errors(still, 240).first;
    EXPECT_LT(fine, 0.02);
    EXPECT_LT(fine, coarse / 6);
    const Alloy diffusing = sodium_nitrate(0, salt_diffusivity);
    const auto [coarse_t, coarse_c] = scheme_errors(diffusing, 60);
    const auto [fine_t, fine_c] = scheme_errors(diffusing, 240);
    EXPECT_LT(fine_t, 0.02);
    EXPECT_LT(fine_t, coarse_t / 5);
    // Ahead of the front the salt's layer ends in a kink.
    EXPECT_LT(fine_c, 7e-4);
    EXPECT_LT(fine_c, coarse_c / 2);
  }
} // namespace meltfront::cases
