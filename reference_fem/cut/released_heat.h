#ifndef meltfront_reference_fem_cut_released_heat_h
#define meltfront_reference_fem_cut_released_heat_h

#include <cases/time_integral.h>

#include <array>
#include <cstddef>
#include <unordered_map>

namespace meltfront::reference_fem::cut
{
  /**
   * Heat released throughout the domain (W/m^3), averaged over steps at any points. What
   * was asked for in the last two steps is kept: the solves of a step ask for the same
   * points again, and formulas of two steps for those of the one before.
   */
  class ReleasedHeat
  {
  public:
    explicit ReleasedHeat(const cases::Field &density);

    /** Mean over a step; the value then where begin == end. */
    double operator()(const cases::Position &position, double begin, double end);

    bool steady() const
    {
      return mean.steady();
    }

    std::size_t bytes() const;

  private:
    struct Hash
    {
      std::size_t operator()(const cases::Position &position) const;
    };
    struct Step
    {
      double begin = 0, end = -1;
      std::unordered_map<cases::Position, double, Hash> means;
    };

    cases::TimeMean mean;
    std::array<Step, 2> steps;
    std::size_t oldest = 0;
  };
} // namespace meltfront::reference_fem::cut

#endif
