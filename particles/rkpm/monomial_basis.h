#ifndef meltfront_particles_rkpm_monomial_basis_h
#define meltfront_particles_rkpm_monomial_basis_h

#include <array>
#include <cstddef>
#include <vector>

namespace meltfront::particles::rkpm
{
  /** Exponents of a monomial in x, y, z, or how often to differentiate in each. */
  using MultiIndex = std::array<int, 3>;

  /** Highest order of a basis. */
  inline constexpr int highest_order = 5;

  /** Most functions of a basis: order 5 in 3D. */
  inline constexpr int most_functions = 56;

  /**
   * All monomials z^a with |a| <= order, by ascending degree and within a degree x first:
   * 1, x, y, x^2, xy, y^2, ...
   *
   * Derivatives are numbered likewise: derivative j of the value, gradient and second
   * derivatives is exponents(j) of the basis of order 2.
   */
  class MonomialBasis
  {
  public:
    /** @throws cases::InputError for a dimension other than 1, 2, 3 or an order that is
     * negative or above the highest. */
    MonomialBasis(int dimension, int order);

    int size() const
    {
      return static_cast<int>(monomials.size());
    }

    int dimension() const
    {
      return dim;
    }

    int order() const
    {
      return highest;
    }

    const MultiIndex &exponents(int function) const
    {
      return monomials[function];
    }

    /** The number of the function with these exponents, -1 if there is none. */
    int find(const MultiIndex &exponents) const;

    /** The function from which a multiplication with one coordinate makes this one; -1
     * for the constant. */
    int parent(int function) const
    {
      return parents[function];
    }

    /** The direction of that coordinate. */
    int parent_direction(int function) const
    {
      return directions[function];
    }

    /** The function z^(a - e_i), -1 if the derivative of z^a in direction i vanishes. */
    int lowered(int function, int direction) const
    {
      return lower[direction][function];
    }

    /** The derivative of z^a at z, a product of powers. */
    double derivative(int function, const MultiIndex &times,
                      const std::array<double, 3> &z) const;

  private:
    int dim;
    int highest;
    std::vector<MultiIndex> monomials;
    std::vector<int> parents, directions;
    std::array<std::vector<int>, 3> lower;
  };
} // namespace meltfront::particles::rkpm

#endif
