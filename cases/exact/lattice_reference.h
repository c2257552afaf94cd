#ifndef meltfront_cases_exact_lattice_reference_h
#define meltfront_cases_exact_lattice_reference_h

#include <cases/exact/formula_solution.h>

#include <array>
#include <functional>
#include <vector>

namespace meltfront::cases
{
  /** A steady rectangle to be solved on a fine lattice. */
  struct LatticeProblem
  {
    Position lower{}, upper{};                                 ///< corners (m)
    double conductivity = 1;                                   ///< W/(m K)
    std::function<double(const Position &)> volumetric_source; ///< W/m^3
    std::function<double(const Position &)> wall_temperature;
    int intervals = 101; ///< of the lattice along each side
  };

  /**
   * The temperature of the five-point scheme on a fine lattice,
   *
   *   k [(4 T_ij - T_i-1,j - T_i+1,j - T_i,j-1 - T_i,j+1)/h^2] = heat released at (i, j),
   *
   * interpolated between its points by cubics in both directions: what a paper measured
   * against that had no closed form (Erickson et al. 2016, SAND2016-9800, section 5.4).
   * It is itself off by O(h^2).
   */
  class LatticeReference : public FrontlessSolution
  {
  public:
    /** @throws InputError for fewer than four intervals or a rectangle whose cells would
     * not be squares. */
    explicit LatticeReference(const LatticeProblem &problem);

    std::string description() const override;

    using FrontlessSolution::temperature;
    double temperature(const Position &position, double time) const override;

  private:
    std::array<double, 4> weights(double coordinate, std::size_t &first) const;

    Position lower;
    double spacing;
    std::size_t points; ///< along a side
    std::vector<double> value;
  };
} // namespace meltfront::cases

#endif
