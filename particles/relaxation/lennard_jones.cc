#include <cases/error.h>
#include <particles/relaxation/lennard_jones.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles
{
  namespace
  {
    constexpr double skin = 0.4;      ///< over sigma
    constexpr double stiffness = 100; ///< of a particle among others, epsilon / sigma^2

    void require_positive(double value, const char *what)
    {
      if(!(value > 0) || !std::isfinite(value))
        throw cases::InputError(fmt::format(
            "the {} of a Lennard-Jones potential is {:.6g}, but it has to be positive",
            what, value));
    }

    void require_inside(const ParticleStorage &moving, const CoordinateBox &box)
    {
      for(int d = 0; d < box.dimension; ++d)
        for(const double coordinate : moving.position[d])
          if(!(coordinate >= box.lower[d] && coordinate <= box.upper[d]))
            throw cases::InputError(
                fmt::format("a particle to be relaxed is at {} = {:.6g}, outside of the "
                            "box from {:.6g} to {:.6g}",
                            "xyz"[d], coordinate, box.lower[d], box.upper[d]));
    }

    /** Sorted along x, particles on one another stand next to each other. */
    void require_apart(const ParticleStorage &moving, const ParticleStorage &fixed)
    {
      std::vector<std::array<double, 3>> points;
      for(std::size_t i = 0; i < moving.size(); ++i)
        points.push_back(moving.point(i));
      for(std::size_t i = 0; i < fixed.size(); ++i)
        points.push_back(fixed.point(i));
      std::ranges::sort(points);
      const auto twin = std::ranges::adjacent_find(points);
      if(twin != points.end())
        throw cases::InputError(
            fmt::format("two particles to be relaxed are at the same place, ({:.6g}, "
                        "{:.6g}, {:.6g}): no force tells them where to go",
                        (*twin)[0], (*twin)[1], (*twin)[2]));
    }

    CoordinateBox shrunk(CoordinateBox box, double margin)
    {
      for(int d = 0; d < box.dimension; ++d)
      {
        box.lower[d] += margin;
        box.upper[d] -= margin;
        if(!(box.lower[d] < box.upper[d]))
          throw cases::InputError(
              "a box in which particles are to be relaxed has no room "
              "between its walls");
      }
      return box;
    }
  } // namespace

  LennardJonesEnergy::LennardJonesEnergy(int dimension, const ParticleStorage &fixed,
                                         const LennardJones &potential, int threads)
    : dimension(dimension)
    , potential(potential)
    , threads(threads)
    , fixed(fixed)
  {
    require_positive(potential.length, "length");
    require_positive(potential.energy, "energy");
    require_positive(potential.cutoff, "cutoff");
  }

  double LennardJonesEnergy::operator()(const Coordinates &places, Coordinates &gradient)
  {
    update_neighbours(places);
    const std::size_t moving = places[0].size();
    switch(dimension)
    {
    case 1:
      return evaluate<1>(moving, gradient);
    case 2:
      return evaluate<2>(moving, gradient);
    default:
      return evaluate<3>(moving, gradient);
    }
  }

  void LennardJonesEnergy::update_neighbours(const Coordinates &places)
  {
    const std::size_t moving = places[0].size();
    const double reach = 0.5 * skin * potential.length;
    bool near = neighbours.has_value() && listed[0].size() == moving;
    for(std::size_t i = 0; near && i < moving; ++i)
    {
      double moved = 0;
      for(int d = 0; d < dimension; ++d)
        moved += (places[d][i] - listed[d][i]) * (places[d][i] - listed[d][i]);
      near = moved < reach * reach;
    }
    all.dimension = dimension;
    for(int d = 0; d < dimension; ++d)
    {
      all.position[d].resize(moving + fixed.size());
      std::ranges::copy(places[d], all.position[d].begin());
      if(!near)
        std::ranges::copy(fixed.position[d],
                          all.position[d].begin() + static_cast<long>(moving));
    }
    if(near)
      return;
    neighbours.emplace(all, (potential.cutoff + skin) * potential.length);
    listed = places;
    ++builds;
  }

  template <int Dimension>
  double LennardJonesEnergy::evaluate(std::size_t moving, Coordinates &gradient) const
  {
    const double squared_length = potential.length * potential.length;
    const double squared_cutoff = potential.cutoff * potential.cutoff * squared_length;
    const double shift
        = potential.pair_energy(potential.cutoff * potential.length) / potential.energy;
    std::array<const double *, 3> x{};
    for(int d = 0; d < Dimension; ++d)
      x[d] = all.position[d].data();
    row_energy.resize(moving);
#pragma omp parallel for schedule(static) num_threads(threads) if(threads > 1)
    for(std::size_t a = 0; a < moving; ++a)
    {
      const std::span<const std::uint32_t> row = (*neighbours)[a];
      const std::uint32_t *others = row.data();
      const std::size_t count = row.size();
      const double xa = x[0][a], ya = Dimension > 1 ? x[1][a] : 0,
                   za = Dimension > 2 ? x[2][a] : 0;
      double sum = 0, gx = 0, gy = 0, gz = 0;
#pragma omp simd reduction(+ : sum, gx, gy, gz)
      for(std::size_t e = 0; e < count; ++e)
      {
        const std::uint32_t b = others[e];
        const double dx = xa - x[0][b];
        const double dy = Dimension > 1 ? ya - x[1][b] : 0;
        const double dz = Dimension > 2 ? za - x[2][b] : 0;
        const double squared = dx * dx + dy * dy + dz * dz;
        const double inverse = 1 / squared;
        const double ratio = squared_length * inverse;
        const double sixth = ratio * ratio * ratio;
        const bool near = squared < squared_cutoff;
        // Two moving particles share their energy.
        const double share = b < moving ? 0.5 : 1;
        sum += near ? share * (sixth * sixth - sixth - shift) : 0;
        const double slope = near ? (6 - 12 * sixth) * sixth * inverse : 0;
        gx += slope * dx;
        gy += slope * dy;
        gz += slope * dz;
      }
      row_energy[a] = sum;
      const std::array<double, 3> total{gx, gy, gz};
      for(int d = 0; d < Dimension; ++d)
        gradient[d][a] = potential.energy * total[d];
    }
    double result = 0;
    for(const double energy : row_energy)
      result += energy;
    return potential.energy * result;
  }

  Descent relax_by_lennard_jones(ParticleStorage &moving, const ParticleStorage &fixed,
                                 const CoordinateBox &box,
                                 const LennardJonesRelaxation &parameters)
  {
    if(moving.size() == 0)
      return {.converged = true};
    const LennardJones &potential = parameters.potential;
    LennardJonesEnergy energy(box.dimension, fixed, potential, parameters.threads);
    require_inside(moving, box);
    require_apart(moving, fixed);
    // Particles near each other in space come near each other in memory.
    const std::vector<std::uint32_t> order
        = order_along_curve(moving, potential.cutoff * potential.length);
    ParticleStorage sorted = moving;
    reorder(sorted, order);
    const Descent result = conjugate_gradients(
        [&energy](const Coordinates &places, Coordinates &gradient)
        { return energy(places, gradient); },
        sorted.position, shrunk(box, parameters.wall_distance * potential.length),
        {.longest_step = parameters.longest_step * potential.length,
         .stiffness
         = stiffness * potential.energy / (potential.length * potential.length),
         .tolerance = parameters.tolerance,
         .least_fall
         = parameters.least_fall * potential.energy * static_cast<double>(moving.size()),
         .most_iterations = parameters.most_iterations});
    for(int d = 0; d < box.dimension; ++d)
      for(std::size_t i = 0; i < order.size(); ++i)
        moving.position[d][order[i]] = sorted.position[d][i];
    return result;
  }
} // namespace meltfront::particles
