#include <particles/core/neighbour_list.h>
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
    : begin(1, 0)
  {
    const std::size_t n = position[0].size();
    if(n > few_particles)
    {
      const ParticleStorage storage{dimension, position};
      const NeighbourList list(storage, length);
      for(std::size_t a = 0; a < n; ++a)
      {
        partners.insert(partners.end(), list[a].begin(), list[a].end());
        begin.push_back(partners.size());
      }
      return;
    }
    for(std::size_t a = 0; a < n; ++a)
    {
      for(std::size_t b = 0; b < n; ++b)
      {
        double squared = 0;
        for(int d = 0; d < dimension; ++d)
        {
          const double apart = position[d][a] - position[d][b];
          squared += apart * apart;
        }
        if(squared < length * length && a != b)
          partners.push_back(b);
      }
      begin.push_back(partners.size());
    }
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
