#include <cases/error.h>
#include <cases/scene.h>
#include <particles/core/particle_operator.h>
#include <particles/sph/effective_conductivity.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace meltfront::particles
{
  namespace
  {
    constexpr double largest_deviation = 0.05;
    constexpr double solver_tolerance = 1e-4;

    /** From the nearest wall, or end of the domain along x (m). */
    double depth(const Discretisation &dis, std::size_t a)
    {
      const cases::Position place = dis.particles.point(a);
      double least = std::numeric_limits<double>::infinity();
      if(dis.periodicity.period[0] > 0)
        least = std::min(place[0] - dis.scene.domain.lower[0],
                         dis.scene.domain.upper[0] - place[0]);
      for(const PlaneWall &wall : dis.walls)
        least = std::min(least, std::abs(place[wall.direction] - wall.coordinate));
      for(const RoundWall &wall : dis.round_walls)
        least = std::min(least, wall.depth(std::hypot(place[0], place[1], place[2])));
      if(dis.scene.domain.outline)
        least = std::min(least, dis.scene.domain.outline->distance(place));
      return least;
    }

    constexpr int held = -1;
  } // namespace

  double effective_conductivity(const Discretisation &dis, const ParticleOperator &rows)
  {
    std::vector<int> number(dis.particles.size(), held);
    int unknowns = 0;
    for(std::size_t a = 0; a < number.size(); ++a)
      if(depth(dis, a) > dis.kernel.support())
        number[a] = unknowns++;
    if(unknowns == 0)
      return 1;
    std::vector<double> u = dis.particles.position[0];
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd flow = Eigen::VectorXd::Zero(unknowns);
    for(std::size_t a = 0; a < number.size(); ++a)
      if(number[a] != held)
        rows.visit_row(a,
                       [&](std::uint32_t b, double g)
                       {
                         flow[number[a]] += g * (u[b] - u[a]);
                         entries.emplace_back(number[a], number[a], g);
                         if(number[b] != held)
                           entries.emplace_back(number[a], number[b], -g);
                       });
    Eigen::SparseMatrix<double, Eigen::RowMajor> network(unknowns, unknowns);
    network.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double, Eigen::RowMajor>,
                             Eigen::Lower | Eigen::Upper>
        solver(network);
    solver.setTolerance(solver_tolerance);
    const Eigen::VectorXd change = solver.solve(flow);
    for(std::size_t a = 0; a < number.size(); ++a)
      if(number[a] != held)
        u[a] += change[number[a]];
    double dissipation = 0;
    for(std::size_t a = 0; a < number.size(); ++a)
      if(number[a] != held)
        rows.visit_row(a, [&](std::uint32_t b, double g)
                       { dissipation += g * (u[b] - u[a]) * (u[b] - u[a]) / 2; });
    return dissipation / (unknowns * dis.particle_volume);
  }

  void require_true_conductivity(const Discretisation &dis, const ParticleOperator &rows)
  {
    if(!dis.displaced || dis.scene.inclusion) // whose own conductivity the rows hold
      return;
    const double share = effective_conductivity(dis, rows);
    if(!(std::abs(share - 1) <= largest_deviation))
      throw cases::Refusal(fmt::format(
          "the particles conduct {:.3g} times what their material does, whatever n, "
          "because they are so disordered: {:g} of it may be missing; arrangement = "
          "relaxed, moment_correction = true or a larger smoothing_length help",
          share, largest_deviation));
  }
} // namespace meltfront::particles
