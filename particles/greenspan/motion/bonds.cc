#include <particles/greenspan/motion/bonds.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** psi_6 of each particle: exp(6 i angle) = ((x + i y) / r)^6, averaged. */
    std::vector<std::complex<double>> sixfold_order(const ParticleState &state,
                                                    const BondGraph &bonds)
    {
      const NearestImage along_x(state.period[0]), along_y(state.period[1]);
      std::vector<std::complex<double>> result(bonds.size(), 0);
      for(std::size_t a = 0; a < bonds.size(); ++a)
      {
        for(const std::uint32_t b : bonds[a])
        {
          const std::complex<double> way(
              along_x(state.position[0][b] - state.position[0][a]),
              along_y(state.position[1][b] - state.position[1][a]));
          const std::complex<double> cube = way * way * way;
          result[a] += cube * cube / std::norm(cube);
        }
        if(!bonds[a].empty())
          result[a] /= static_cast<double>(bonds[a].size());
      }
      return result;
    }
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

  BondGraph::BondGraph(const ParticleState &state, double length)
    : found(repeats(state.period)
                ? find_in_periodic_space(state.dimension, state.position, state.size(),
                                         length, state.period,
                                         state.size() <= few_particles)
                : BondGraph(state.dimension, state.position, length).found)
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

  std::pair<double, double> bond_lengths(const ParticleState &state,
                                         const BondGraph &bonds)
  {
    double shortest = std::nan(""), longest = shortest;
    for(std::size_t a = 0; a < bonds.size(); ++a)
      for(const std::uint32_t b : bonds[a])
      {
        const double length = distance(state, a, b);
        shortest = std::fmin(shortest, length);
        longest = std::fmax(longest, length);
      }
    return {shortest, longest};
  }

  double hexatic_order(const ParticleState &state, const BondGraph &bonds)
  {
    double sum = 0;
    for(const std::complex<double> &psi : sixfold_order(state, bonds))
      sum += std::abs(psi);
    return sum / static_cast<double>(bonds.size());
  }

  std::vector<double> order_of_surroundings(const ParticleState &state,
                                            const BondGraph &bonds)
  {
    const std::vector<std::complex<double>> psi = sixfold_order(state, bonds);
    std::vector<double> result;
    for(std::size_t a = 0; a < psi.size(); ++a)
    {
      std::complex<double> sum = psi[a];
      for(const std::uint32_t b : bonds[a])
        sum += psi[b];
      result.push_back(std::abs(sum) / static_cast<double>(1 + bonds[a].size()));
    }
    return result;
  }

  std::vector<double> lattice_order(const ParticleState &state, const BondGraph &bonds)
  {
    std::vector<double> result;
    for(const std::complex<double> &psi : sixfold_order(state, bonds))
      result.push_back(psi.real());
    return result;
  }
} // namespace meltfront::particles::greenspan
