#include <cases/error.h>
#include <particles/rkpm/collocation_rows.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm
{
  namespace
  {
    /** The factor of each derivative in a row, in the order of the derivatives. */
    std::vector<double> factors_of(const RowCoefficients &row,
                                   const MonomialBasis &derivatives)
    {
      std::vector<double> factors(derivatives.size());
      for(int j = 0; j < derivatives.size(); ++j)
      {
        const MultiIndex &a = derivatives.exponents(j);
        const int degree = a[0] + a[1] + a[2];
        if(degree == 0)
          factors[j] = row.value;
        for(int d = 0; d < 3; ++d)
        {
          if(degree == 1 && a[d] == 1)
            factors[j] = row.gradient[d];
          if(a[d] == 2)
            factors[j] = row.laplacian;
        }
      }
      return factors;
    }

    void add_row(const ReproducingWeights &weights, std::size_t point,
                 std::span<const double> factors, std::span<double> row)
    {
      for(std::size_t j = 0; j < factors.size(); ++j)
      {
        if(factors[j] == 0)
          continue;
        const auto derivative = weights(static_cast<int>(j), point);
        for(std::size_t i = 0; i < row.size(); ++i)
          row[i] += factors[j] * derivative[i];
      }
    }

    /** Divide a row by its largest entry. @return what the right side is multiplied by */
    double normalise(std::span<double> row, std::size_t point)
    {
      double largest = 0;
      bool finite = true;
      for(const double entry : row)
      {
        largest = std::max(largest, std::abs(entry));
        finite = finite && std::isfinite(entry);
      }
      if(!finite || largest == 0)
        throw cases::NumericalError(
            "reproducing kernel collocation", 0, 0, fmt::format("row {}", point),
            finite ? "has no entry other than zero" : "is not finite");
      for(double &entry : row)
        entry /= largest;
      return 1 / largest;
    }
  } // namespace

  RowCoefficients conduction_row(double conductivity,
                                 const std::array<double, 3> &conductivity_gradient)
  {
    return {0, conductivity_gradient, conductivity};
  }

  RowCoefficients dirichlet_row()
  {
    return {1, {}, 0};
  }

  RowCoefficients neumann_row(double conductivity, const std::array<double, 3> &normal)
  {
    return robin_row(conductivity, 0, normal);
  }

  RowCoefficients robin_row(double conductivity, double transfer,
                            const std::array<double, 3> &normal)
  {
    return {
        transfer,
        {conductivity * normal[0], conductivity * normal[1], conductivity * normal[2]},
        0};
  }

  void CompressedRows::apply(std::span<const double> values,
                             std::span<double> result) const
  {
    for(std::size_t row = 0; row < rows(); ++row)
    {
      double sum = 0;
      for(std::size_t e = offsets[row]; e < offsets[row + 1]; ++e)
        sum += coefficients[e] * values[columns[e]];
      result[row] = sum;
    }
  }

  CompressedRows collocation_rows(const ReproducingWeights &weights,
                                  std::span<const RowCoefficients> coefficients)
  {
    const Supports &supports = weights.supports;
    if(coefficients.size() != supports.rows())
      throw cases::InputError(
          fmt::format("{} points need one set of coefficients each, there are {}",
                      supports.rows(), coefficients.size()));
    const MonomialBasis derivatives(weights.dimension, 2);
    if(weights.weights.size() != static_cast<std::size_t>(derivatives.size()))
      throw cases::InputError(
          "rows of an operator need the weights of derivatives up to order 2");
    CompressedRows rows;
    rows.offsets = supports.offsets;
    rows.columns = supports.neighbours;
    rows.coefficients.assign(supports.neighbours.size(), 0);
    rows.scale.resize(supports.rows());
    for(std::size_t point = 0; point < supports.rows(); ++point)
    {
      const std::span<double> row(rows.coefficients.data() + rows.offsets[point],
                                  rows.offsets[point + 1] - rows.offsets[point]);
      add_row(weights, point, factors_of(coefficients[point], derivatives), row);
      rows.scale[point] = normalise(row, point);
    }
    return rows;
  }
} // namespace meltfront::particles::rkpm
