#include <cases/error.h>
#include <particles/rkpm/monomial_basis.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles::rkpm
{
  MonomialBasis::MonomialBasis(int dimension, int order)
    : dim(dimension)
    , highest(order)
  {
    if(dim < 1 || dim > 3)
      throw cases::InputError(
          fmt::format("a basis has 1, 2 or 3 dimensions, not {}", dim));
    if(order < 0 || order > highest_order)
      throw cases::InputError(fmt::format("the order of a basis lies between 0 and {}, "
                                          "not at {}",
                                          highest_order, order));
    for(int degree = 0; degree <= order; ++degree)
      for(int i = degree; i >= 0; --i)
        for(int j = degree - i; j >= 0; --j)
        {
          const MultiIndex a{i, j, degree - i - j};
          if((dim > 1 || a[1] == 0) && (dim > 2 || a[2] == 0))
            monomials.push_back(a);
        }
    for(int function = 0; function < size(); ++function)
    {
      int parent = -1, direction = 0;
      for(int d = 0; d < 3; ++d)
      {
        MultiIndex a = monomials[function];
        --a[d];
        lower[d].push_back(find(a));
        if(lower[d].back() >= 0)
        {
          parent = lower[d].back();
          direction = d;
        }
      }
      parents.push_back(parent);
      directions.push_back(direction);
    }
  }

  int MonomialBasis::find(const MultiIndex &exponents) const
  {
    const auto found = std::find(monomials.begin(), monomials.end(), exponents);
    return found == monomials.end() ? -1 : static_cast<int>(found - monomials.begin());
  }

  double MonomialBasis::derivative(int function, const MultiIndex &times,
                                   const std::array<double, 3> &z) const
  {
    double result = 1;
    for(int d = 0; d < dim; ++d)
    {
      const int exponent = monomials[function][d];
      for(int t = 0; t < times[d]; ++t)
        result *= exponent - t;
      for(int e = times[d]; e < exponent; ++e)
        result *= z[d];
    }
    return result;
  }
} // namespace meltfront::particles::rkpm
