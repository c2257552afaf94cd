#include <cases/error.h>
#include <cases/exact/manufactured/formulas.h>
#include <cases/exact/manufactured/front_family.h>
#include <cases/exact/manufactured/jet.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <functional>
#include <map>

namespace meltfront::cases
{
  namespace
  {
    using manufactured::Jet;
    using manufactured::Monomials;
    using manufactured::TimeJet;

    /** Jets of level sets, and those from which the curvature's derivatives follow. */
    template <int dim>
    using FrontJet = Jet<Monomials<dim>>;
    template <int dim>
    using CurvatureJet = Jet<Monomials<dim, 5, 3>>;
    /** At one time, up to second derivatives. */
    template <int dim>
    using StillJet = Jet<Monomials<dim, 2, -1>>;

    /** Where the coefficients stand of x_i x_j^n dt^time. */
    template <typename Terms, int dim>
    constexpr auto places(int n, int time)
    {
      std::array<std::array<std::size_t, dim>, dim> table{};
      for(int i = 0; i < dim; ++i)
        for(int j = 0; j < dim; ++j)
        {
          std::array<int, 3> exponents{};
          exponents[i] = 1;
          exponents[j] += n;
          table[i][j] = Terms::index({exponents, time});
        }
      return table;
    }

    template <int dim, typename Terms>
    FrontDerivatives second_derivatives_of(const Jet<Terms> &f)
    {
      static constexpr auto second = places<Terms, dim>(1, 0);
      FrontDerivatives result;
      result.value = f.c[0];
      for(int i = 0; i < dim; ++i)
      {
        result.gradient[i] = f.c[1 + i];
        result.laplacian += 2 * f.c[second[i][i]];
        for(int j = 0; j < dim; ++j)
          result.hessian[i][j] = (i == j ? 2 : 1) * f.c[second[i][j]];
      }
      return result;
    }

    template <int dim>
    FrontDerivatives derivatives_of(const FrontJet<dim> &f)
    {
      using Terms = Monomials<dim>;
      static constexpr auto second_rate = places<Terms, dim>(1, 1),
                            third = places<Terms, dim>(2, 0);
      FrontDerivatives result = second_derivatives_of<dim>(f);
      result.rate = f.c[Terms::timeless];
      result.acceleration = 2 * f.c[Terms::count - 1];
      for(int i = 0; i < dim; ++i)
      {
        result.gradient_rate[i] = f.c[Terms::timeless + 1 + i];
        result.laplacian_rate += 2 * f.c[second_rate[i][i]];
        for(int j = 0; j < dim; ++j)
          result.laplacian_gradient[i] += (i == j ? 6 : 2) * f.c[third[i][j]];
      }
      return result;
    }

    template <int dim>
    FieldDerivatives field_of(const CurvatureJet<dim> &a)
    {
      using Terms = Monomials<dim, 5, 3>;
      FieldDerivatives field;
      field.value = a.c[0];
      field.rate = a.c[Terms::timeless];
      for(int i = 0; i < dim; ++i)
      {
        field.gradient[i] = a.c[1 + i];
        field.laplacian += derivative(derivative(a, i), i).c[0];
      }
      return field;
    }

    template <int dim>
    ContinuedCurvature curvature_of(const CurvatureJet<dim> &f, double kappa)
    {
      std::array<CurvatureJet<dim>, dim> gradient;
      CurvatureJet<dim> square, laplacian, along, slope;
      for(int i = 0; i < dim; ++i)
      {
        gradient[i] = derivative(f, i);
        square = square + gradient[i] * gradient[i];
      }
      for(int i = 0; i < dim; ++i)
      {
        laplacian = laplacian + derivative(gradient[i], i);
        along = along + 0.5 * (gradient[i] * derivative(square, i));
      }
      const CurvatureJet<dim> curvature
          = (square * laplacian - along) * power(square + kappa * kappa * (f * f), -1.5);
      for(int i = 0; i < dim; ++i)
        slope = slope + derivative(curvature, i) * gradient[i];
      return {field_of<dim>(curvature), field_of<dim>(slope)};
    }

    /** A formula in its lengths and times, seen in metres and seconds; dim is that of the
     * formula, which for a slab is more than the family's. */
    template <typename Formula, int dim>
    class FormulaFamily : public FrontFamily
    {
    public:
      FormulaFamily(const FamilyParameters &parameters, const Formula &formula)
        : FrontFamily(parameters)
        , formula(formula)
        , scale(parameters.length_scale)
      {
      }

      double kappa() const override
      {
        return Formula::kappa / scale;
      }

      double level_set(const Position &position, double time) const override
      {
        std::array<double, dim> x;
        for(int d = 0; d < dim; ++d)
          x[d] = position[d] / scale;
        return scale * formula(x, time / period());
      }

      FrontDerivatives derivatives(const Position &position, double time) const override
      {
        return derivatives_of<dim>(expansion<FrontJet<dim>>(position, time));
      }

      FrontDerivatives second_derivatives(const Position &position,
                                          double time) const override
      {
        return second_derivatives_of<dim>(expansion<StillJet<dim>>(position, time));
      }

      double signed_distance(const Position &position, double time) const override
      {
        if constexpr(has_place)
          return position[0] - scale * formula.place(time / period());
        else if constexpr(has_uniform_curvature)
          return std::hypot(position[0], position[1], dim == 3 ? position[2] : 0)
                 - scale * formula.radius(time / period());
        else
          return FrontFamily::signed_distance(position, time);
      }

      double solid_volume(double time) const override
      {
        const double unscaled = formula.solid_volume(time / period(), dimension());
        return unscaled * (dimension() == 1 ? scale : scale * scale)
               * (dimension() == 3 ? scale : 1);
      }

      std::optional<UniformCurvature> uniform_curvature(double time) const override
      {
        if constexpr(has_place)
          return UniformCurvature{0, 0};
        else if constexpr(has_uniform_curvature)
        {
          const TimeJet k
              = TimeJet(dim - 1) / (TimeJet(scale) * formula.radius(tau(time)));
          return UniformCurvature{k.c[0], k.c[1]};
        }
        else
          return FrontFamily::uniform_curvature(time);
      }

      ContinuedCurvature continued_curvature(const Position &position,
                                             double time) const override
      {
        if(const auto uniform = uniform_curvature(time))
          return {{uniform->value, uniform->rate, {}, 0}, {}};
        return curvature_of<dim>(expansion<CurvatureJet<dim>>(position, time), kappa());
      }

      std::pair<Position, Position> domain() const override
      {
        std::pair<Position, Position> box{};
        for(int d = 0; d < dimension(); ++d)
        {
          box.first[d] = scale * Formula::lower[d];
          box.second[d] = scale * Formula::upper[d];
        }
        return box;
      }

      bool merges() const override
      {
        return has_saddle;
      }

    protected:
      const char *what() const override
      {
        return Formula::what;
      }

    private:
      static constexpr bool has_place = std::is_same_v<Formula, manufactured::Plane>;
      static constexpr bool has_uniform_curvature
          = std::is_same_v<Formula, manufactured::Disk>;
      static constexpr bool has_saddle
          = std::is_same_v<
                Formula,
                manufactured::TwoDisks> || std::is_same_v<Formula, manufactured::Finger>;

      Formula formula;
      double scale;

      template <typename Number>
      Number expansion(const Position &position, double time) const
      {
        std::array<Number, dim> x;
        for(int d = 0; d < dim; ++d)
          x[d] = Number::variable(d, position[d] / scale, 1 / scale);
        return scale * formula(x, tau(time));
      }

      TimeJet tau(double time) const
      {
        return {time / period(), 1 / period(), 0};
      }
    };

    using Family = std::shared_ptr<const FrontFamily>;

    template <typename Formula>
    Family in_two_or_three(const FamilyParameters &parameters, const Formula &formula)
    {
      if(parameters.dimension == 3)
        return std::make_shared<FormulaFamily<Formula, 3>>(parameters, formula);
      return std::make_shared<FormulaFamily<Formula, 2>>(parameters, formula);
    }

    struct Entry
    {
      int least_dimension, greatest_dimension;
      std::function<Family(const FamilyParameters &)> make;
    };

    const std::map<std::string, Entry> &families()
    {
      using namespace manufactured;
      using Parameters = FamilyParameters;
      static const std::map<std::string, Entry> all{
          {"plane",
           {1, 3, [](const Parameters &p) { return in_two_or_three(p, Plane()); }}},
          {"disk",
           {2, 3, [](const Parameters &p) { return in_two_or_three(p, Disk()); }}},
          {"star-3",
           {2, 2,
            [](const Parameters &p) {
              return std::make_shared<FormulaFamily<Star, 2>>(p, three_pointed_star());
            }}},
          {"star-5",
           {2, 2,
            [](const Parameters &p) {
              return std::make_shared<FormulaFamily<Star, 2>>(p, five_pointed_star());
            }}},
          {"ellipse",
           {2, 3, [](const Parameters &p) { return in_two_or_three(p, Ellipse()); }}},
          {"two-disks",
           {2, 3,
            [](const Parameters &p) { return in_two_or_three(p, TwoDisks{p.power}); }}},
          {"finger", {2, 3, [](const Parameters &p) {
                        return in_two_or_three(p, Finger{p.power});
                      }}}};
      return all;
    }

    void require_positive(double value, const std::string &name, const char *what)
    {
      if(!(value > 0) || !std::isfinite(value))
        throw InputError(fmt::format("moving front '{}': the {} must be positive, not {}",
                                     name, what, value));
    }
  } // namespace

  std::vector<std::string> front_family_names()
  {
    std::vector<std::string> names;
    for(const auto &[name, entry] : families())
      names.push_back(name);
    return names;
  }

  std::shared_ptr<const FrontFamily> make_front_family(const FamilyParameters &parameters)
  {
    const std::string &name = parameters.name;
    const auto found = families().find(name);
    if(found == families().end())
      throw InputError(fmt::format("no moving front is named '{}', only {}", name,
                                   fmt::join(front_family_names(), ", ")));
    const Entry &entry = found->second;
    if(parameters.dimension < entry.least_dimension
       || parameters.dimension > entry.greatest_dimension)
      throw InputError(fmt::format(
          "moving front '{}': the dimension must be from {} to {}, not {}", name,
          entry.least_dimension, entry.greatest_dimension, parameters.dimension));
    require_positive(parameters.period, name, "period");
    require_positive(parameters.length_scale, name, "length scale");
    if(parameters.power < 2)
      throw InputError(fmt::format(
          "moving front '{}': the power of the merge must be at least 2, not {}", name,
          parameters.power));
    return entry.make(parameters);
  }
} // namespace meltfront::cases
