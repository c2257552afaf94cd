#include <particles/greenspan/bonds.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Up to here looking at all pairs is faster than setting cells up. */
    constexpr std::size_t few_particles = 200;
  } // namespace

  BondGraph::BondGraph(int dimension, const std::array<std::vector<double>, 3> &position,
                       double length)
    : found(position[0].size() > few_particles
                ? find_in_cells(dimension, position, position[0].size(), length)
                : find_among_all(dimension, position, position[0].size(), length))
  {
    for(std::size_t a = 0; a < size(); ++a)
      std::sort(found[a].begin(), found[a].end());
  }

  bool BondGraph::bonded(std::size_t a, std::size_t b) const
  {
    const auto row = (*this)[a];
    return std::find(row.begin(), row.end(), b) != row.end();
  }

  std::size_t BondGraph::shared_with(const BondGraph &other) const
  {
    std::size_t shared = 0;
    for(std::size_t a = 0; a < size(); ++a)
      for(const std::uint32_t b : (*this)[a])
        shared += b > a && other.bonded(a, b);
    return shared;
  }

  std::vector<char> BondGraph::in_triangle(const std::vector<char> &eligible) const
  {
    std::vector<char> corner(size(), 0);
    for(std::size_t a = 0; a < size(); ++a)
      for(const std::uint32_t b : (*this)[a])
        if(b > a && eligible[a] && eligible[b])
          for(const std::uint32_t c : (*this)[b])
            if(c > b && eligible[c] && !(corner[a] && corner[b] && corner[c])
               && bonded(a, c))
              corner[a] = corner[b] = corner[c] = 1;
    return corner;
  }

  std::vector<char> BondGraph::in_triangle() const
  {
    return in_triangle(std::vector<char>(size(), 1));
  }

  double hexatic_order(const ParticleState &state, const BondGraph &bonds)
  {
    double sum = 0;
    for(std::size_t a = 0; a < bonds.size(); ++a)
    {
      std::complex<double> psi = 0;
      for(const std::uint32_t b : bonds[a])
        psi += std::polar(1.,
                          6
                              * std::atan2(state.position[1][b] - state.position[1][a],
                                           state.position[0][b] - state.position[0][a]));
      if(!bonds[a].empty())
        sum += std::abs(psi) / static_cast<double>(bonds[a].size());
    }
    return sum / static_cast<double>(bonds.size());
  }
} // namespace meltfront::particles::greenspan
