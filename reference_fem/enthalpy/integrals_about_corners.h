#ifndef meltfront_reference_fem_enthalpy_integrals_about_corners_h
#define meltfront_reference_fem_enthalpy_integrals_about_corners_h

#include <cases/mean_with_jumps.h>

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Integrals over the halves, quarters or eighths of a unit cell nearest to each corner,
   * whose bits are its coordinates, of a function that may jump within.
   * @param value of a Position in the unit cell
   */
  template <typename Function>
  std::vector<double> integrals_about_corners(const Function &value, int dimension)
  {
    // In search of what jumps; in space each halving costs twice as much.
    const int parts = 2, halvings = dimension < 3 ? 6 : 3;
    // Off places where what jumps often is, on which round-off decides: vertices,
    // middles.
    constexpr double inwards_from = 1e-12, inwards_to = 3e-12;
    std::vector<double> result(1u << dimension);
    for(unsigned int corner = 0; corner < result.size(); ++corner)
    {
      cases::Position from{}, to{};
      for(int d = 0; d < dimension; ++d)
      {
        const double least = 0.5 * (corner >> d & 1);
        from[d] = least + inwards_from;
        to[d] = least + 0.5 - inwards_to;
      }
      result[corner]
          = cases::mean_over_box(value, from, from, to, dimension, parts, halvings)
            / static_cast<double>(result.size());
    }
    return result;
  }
} // namespace meltfront::reference_fem

#endif
