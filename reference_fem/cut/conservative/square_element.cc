#include <reference_fem/cut/conservative/square_element.h>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** A side's nodes, and those across the square from them. */
    struct Corners
    {
      std::array<std::size_t, 2> at, across;
    };

    constexpr std::array<Corners, 4> corners_of_side{
        {{{0, 2}, {1, 3}}, {{1, 3}, {0, 2}}, {{0, 1}, {2, 3}}, {{2, 3}, {0, 1}}}};

    void add_difference(SquareElement::Matrix &matrix, std::size_t row, std::size_t plus,
                        std::size_t minus, double value)
    {
      matrix[row][plus] += value;
      matrix[row][minus] -= value;
    }
  } // namespace

  SquareElement::SquareElement(const Gradient &size, const std::array<bool, 4> &open)
    : bubble(size[0] * size[1] / 12)
  {
    const double area = size[0] * size[1], slope = size[1] / size[0];
    const std::array<double, 3> mass_by_shifts{area / 6, area / 24, 0};
    // Along a side: the second difference of the mass is 1/12 of a square.
    const auto slopes = [](bool same) { return same ? 1. : -1.; };
    const auto values = [](bool same) { return same ? 5. / 12 : 1. / 12; };
    for(std::size_t i = 0; i < 4; ++i)
      for(std::size_t j = 0; j < 4; ++j)
      {
        const bool x = i % 2 == j % 2, y = i / 2 == j / 2;
        conduction[i][j] = slope * slopes(x) * values(y) + values(x) * slopes(y) / slope;
        const double on_diagonal = i == 0 || i == 3 ? 1 : -1;
        mass[i][j] = mass_by_shifts[std::size_t(!x) + std::size_t(!y)]
                     + on_diagonal * bubble / 4;
      }
    for(std::size_t side = 0; side < 4; ++side)
    {
      if(!open[side])
        continue;
      const auto &[at, across] = corners_of_side[side];
      const bool upright = side < 2;
      const double twist = (upright ? 1 / slope : slope) / 12;
      for(std::size_t k = 0; k < 2; ++k)
      {
        add_difference(mass, at[k], across[k], at[k], area / 36);
        add_difference(mass, at[k], across[1 - k], at[1 - k], area / 72);
        const double sense = k == 1 ? twist : -twist;
        add_difference(conduction, at[k], across[1], across[0], sense);
        add_difference(conduction, at[k], at[0], at[1], sense);
      }
    }
  }
} // namespace meltfront::reference_fem::cut::conservative
