#include <cases/error.h>
#include <particles/rkpm/collocation_rows.h>

#include <fmt/format.h>

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

    void check(std::span<const double> row, std::size_t point)
    {
      bool finite = true, effective = false;
      for(const double entry : row)
      {
        finite = finite && std::isfinite(entry);
        effective = effective || entry != 0;
      }
      if(!finite || !effective)
        throw cases::NumericalError(
            "reproducing kernel collocation", 0, 0, fmt::format("row {}", point),
            finite ? "has no entry other than zero" : "is not finite");
    }
  } // namespace

  RowCoefficients robin_row(double conductivity, double transfer,
                            const std::array<double, 3> &normal)
  {
    return {
        transfer,
        {conductivity * normal[0], conductivity * normal[1], conductivity * normal[2]},
        0};
  }

  void collect_row(const ReproducingWeights &weights, std::size_t point,
                   const RowCoefficients &coefficients,
                   std::vector<std::uint32_t> &columns, std::vector<double> &values)
  {
    const MonomialBasis derivatives(weights.dimension, 2);
    const std::vector<double> factors = factors_of(coefficients, derivatives);
    const std::span<const std::uint32_t> neighbours = weights.supports[point];
    columns.insert(columns.end(), neighbours.begin(), neighbours.end());
    values.resize(columns.size(), 0.);
    const std::span<double> row(values.data() + values.size() - neighbours.size(),
                                neighbours.size());
    for(std::size_t j = 0; j < factors.size(); ++j)
    {
      if(factors[j] == 0)
        continue;
      const std::span<const double> derivative = weights(static_cast<int>(j), point);
      for(std::size_t i = 0; i < row.size(); ++i)
        row[i] += factors[j] * derivative[i];
    }
    check(row, point);
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
    std::vector<std::uint32_t> columns, scratch;
    std::vector<double> values;
    for(std::size_t point = 0; point < supports.rows(); ++point)
    {
      columns.clear();
      values.clear();
      collect_row(weights, point, coefficients[point], columns, values);
      rows.add_row(columns, values, scratch);
    }
    return rows;
  }
} // namespace meltfront::particles::rkpm
