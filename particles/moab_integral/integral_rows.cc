#include <cases/error.h>
#include <particles/core/neighbour_list.h>
#include <particles/moab_integral/integral_rows.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace meltfront::particles
{
  namespace
  {
    constexpr double growth = 1.1; ///< of the dilation from attempt to attempt
    constexpr std::size_t spare_particles = 3; ///< of a row, beyond its constraints
    /** Loads whose sum is a smaller share of their magnitudes cancel but for round-off.
     */
    constexpr double least_sum = 1e-10;
    constexpr std::uint32_t no_wall_particle = std::numeric_limits<std::uint32_t>::max();

    /** One row while it is made. */
    struct Row
    {
      std::vector<std::uint32_t> columns, wall_columns;
      std::vector<double> laplacian, load, flux;
      double dilation = 0, residual = 0;
      bool singular = false; ///< the loads cancel, and the row cannot be scaled
    };

    /** Outward normal of a side of a box: its direction and sign. */
    struct Normal
    {
      std::size_t direction;
      double sign;
    };

    Normal outward_normal(std::size_t side)
    {
      return {side / 2, side % 2 == 0 ? -1. : 1.};
    }

    /** Particles on walls whose flux stands in rows; by side, along it. */
    struct WallQuadrature
    {
      std::vector<WallParticle> particles;
      std::vector<std::array<std::uint32_t, 4>> number; ///< by node and side
    };

    WallQuadrature make_wall_quadrature(const NodeSet &nodes, const IntegralWalls &walls)
    {
      WallQuadrature result;
      result.number.assign(nodes.size(), {no_wall_particle, no_wall_particle,
                                          no_wall_particle, no_wall_particle});
      std::uint8_t used = 0;
      for(const std::uint8_t sides : walls.flux_sides)
        used = static_cast<std::uint8_t>(used | sides);
      const int dim = nodes.positions.dimension;
      for(std::size_t side = 0; side < static_cast<std::size_t>(2 * dim); ++side)
      {
        if((used >> side & 1) == 0)
          continue;
        std::vector<std::uint32_t> on_side;
        for(std::size_t i = 0; i < nodes.size(); ++i)
          if((nodes.sides[i] >> side & 1) != 0)
            on_side.push_back(static_cast<std::uint32_t>(i));
        const std::size_t along = 1 - side / 2;
        if(dim > 1)
          std::ranges::sort(on_side, {},
                            [&](std::uint32_t i)
                            { return nodes.positions.position[along][i]; });
        for(std::size_t k = 0; k < on_side.size(); ++k)
        {
          double length = 1;
          if(dim > 1)
          {
            const auto &x = nodes.positions.position[along];
            const std::uint32_t before = on_side[k > 0 ? k - 1 : k];
            const std::uint32_t after = on_side[k + 1 < on_side.size() ? k + 1 : k];
            length = (x[after] - x[before]) / 2;
          }
          result.number[on_side[k]][side]
              = static_cast<std::uint32_t>(result.particles.size());
          result.particles.push_back(
              {on_side[k], static_cast<cases::Side>(side), length});
        }
      }
      return result;
    }

    /** Makes rows, one after another, in arrays of its own. */
    class RowMaker
    {
    public:
      RowMaker(const NodeSet &nodes, const IntegralWalls &walls,
               const WallQuadrature &quadrature, const KernelMoments &kernel_moments,
               const IntegralParameters &parameters)
        : nodes(nodes)
        , walls(walls)
        , quadrature(quadrature)
        , kernel_moments(kernel_moments)
        , parameters(parameters)
        , dim(nodes.positions.dimension)
        , powers(monomials(dim, parameters.order))
        , powers_at_point(powers.size())
        , weights(parameters.kernel, dim, parameters.weights, parameters.order)
      {
      }

      /** @return false if there are too few neighbours, so that the row is not made, or
       * if it is singular. */
      bool make(std::uint32_t node, std::span<const std::uint32_t> neighbours,
                double dilation, Row &row)
      {
        gather(node, neighbours, dilation, row);
        const std::size_t n = row.columns.size();
        const bool separate = parameters.weights == WeightPolicy::separate;
        if(n < (separate && parameters.enlarge ? weights.n_constraints() + spare_particles
                                               : 1))
          return false;
        set_moments(node, dilation);
        set_wall_terms(node, dilation, row);
        row.laplacian.resize(n);
        row.load.resize(n);
        row.residual = weights.compute(stencil, row.laplacian, row.load);
        row.dilation = dilation;
        row.singular = !scale(row);
        return !row.singular;
      }

    private:
      void gather(std::uint32_t node, std::span<const std::uint32_t> neighbours,
                  double dilation, Row &row)
      {
        row.columns.clear();
        stencil.positions.clear();
        stencil.volumes.clear();
        const double unit_volume = dim > 1 ? dilation * dilation : dilation;
        for(const std::uint32_t other : neighbours)
        {
          std::array<double, 2> z{};
          for(int d = 0; d < dim; ++d)
          {
            const auto &x = nodes.positions.position[d];
            z[static_cast<std::size_t>(d)] = (x[other] - x[node]) / dilation;
          }
          if(z[0] * z[0] + z[1] * z[1] >= 1)
            continue;
          row.columns.push_back(other);
          stencil.positions.push_back(z);
          stencil.volumes.push_back(nodes.weights[other] / unit_volume);
        }
      }

      void set_moments(std::uint32_t node, double dilation)
      {
        const auto exponents = kernel_moments.exponents();
        stencil.moments.assign(exponents.size(), 0);
        if(!parameters.sampled_moments)
        {
          ScaledBox box;
          for(int d = 0; d < dim; ++d)
          {
            const auto e = static_cast<std::size_t>(d);
            const double x = nodes.positions.position[e][node];
            box.lower[e] = (walls.lower[e] - x) / dilation;
            box.upper[e] = (walls.upper[e] - x) / dilation;
          }
          kernel_moments.evaluate(box, stencil.moments);
          return;
        }
        const std::size_t n = stencil.positions.size();
        radii.resize(n);
        psi.resize(n);
        for(std::size_t i = 0; i < n; ++i)
          radii[i] = std::hypot(stencil.positions[i][0], stencil.positions[i][1]);
        evaluate_shape(parameters.kernel, radii, psi);
        for(std::size_t i = 0; i < n; ++i)
        {
          evaluate_monomials(exponents, stencil.positions[i], powers_at_point);
          for(std::size_t a = 0; a < exponents.size(); ++a)
            stencil.moments[a] += psi[i] * stencil.volumes[i] * powers_at_point[a];
        }
      }

      /** Integrals of psi d(z^a)/dn over the walls that the particle is on, and the same
       * of psi for the flux. */
      void set_wall_terms(std::uint32_t node, double dilation, Row &row)
      {
        row.wall_columns.clear();
        row.flux.clear();
        stencil.wall_terms.clear();
        const std::uint8_t sides = walls.flux_sides[node];
        if(sides == 0)
          return;
        stencil.wall_terms.assign(powers.size(), 0);
        for(std::size_t side = 0; side < static_cast<std::size_t>(2 * dim); ++side)
          if((sides >> side & 1) != 0)
            for(std::size_t i = 0; i < row.columns.size(); ++i)
              if(const std::uint32_t number = quadrature.number[row.columns[i]][side];
                 number != no_wall_particle)
                add_wall_particle(number, stencil.positions[i], dilation, row);
      }

      void add_wall_particle(std::uint32_t number, const std::array<double, 2> &z,
                             double dilation, Row &row)
      {
        const WallParticle &particle = quadrature.particles[number];
        const double length = dim > 1 ? particle.length / dilation : particle.length;
        const double radius = std::hypot(z[0], z[1]);
        double value = 0;
        evaluate_shape(parameters.kernel, {&radius, 1}, std::span<double>(&value, 1));
        const Normal normal = outward_normal(static_cast<std::size_t>(particle.side));
        row.wall_columns.push_back(number);
        row.flux.push_back(value * length);
        for(std::size_t a = 0; a < powers.size(); ++a)
          if(Exponents lowered = powers[a]; lowered[normal.direction] > 0)
          {
            const int factor = lowered[normal.direction]--;
            double monomial = 0;
            evaluate_monomials({&lowered, 1}, z, {&monomial, 1});
            stencil.wall_terms[a] += value * length * normal.sign * factor * monomial;
          }
      }

      /** From the dilation as unit of length to the metre, over the kernel's integral,
       * the sum of the loads.
       * @return whether that tells anything: terms of both signs may cancel */
      bool scale(Row &row) const
      {
        double integral = 0, magnitude = 0;
        for(const double load : row.load)
        {
          integral += load;
          magnitude += std::abs(load);
        }
        if(!(std::abs(integral) > least_sum * magnitude))
          return false;
        const double d = row.dilation;
        for(double &value : row.laplacian)
          value /= integral * d * d;
        for(double &value : row.load)
          value /= integral;
        for(double &value : row.flux)
          value /= integral * d;
        return true;
      }

      const NodeSet &nodes;
      const IntegralWalls &walls;
      const WallQuadrature &quadrature;
      const KernelMoments &kernel_moments;
      const IntegralParameters &parameters;
      int dim;
      std::vector<Exponents> powers;
      std::vector<double> powers_at_point, radii, psi;
      IntegralWeights weights;
      IntegralStencil stencil;
    };

    /** Rows of the pending particles at one dilation; those to be made again remain. */
    void attempt(const NodeSet &nodes, const RowMaker &prototype, double dilation,
                 const IntegralParameters &parameters,
                 std::vector<std::uint32_t> &pending, std::vector<Row> &rows, long &work)
    {
      ParticleStorage centres;
      centres.dimension = nodes.positions.dimension;
      for(const std::uint32_t node : pending)
        centres.add(nodes.point(node));
      const NeighbourList list(centres, nodes.positions, dilation);
      work += static_cast<long>(list.size());
      std::vector<char> done(pending.size());
#pragma omp parallel num_threads(parameters.threads)
      {
        RowMaker maker(prototype);
#pragma omp for schedule(static)
        for(std::size_t i = 0; i < pending.size(); ++i)
        {
          const bool made = maker.make(pending[i], list[i], dilation, rows[pending[i]]);
          done[i]
              = made
                && (!parameters.enlarge || rows[pending[i]].residual <= constraint_bound);
        }
      }
      std::size_t kept = 0;
      for(std::size_t i = 0; i < pending.size(); ++i)
        if(done[i] == 0)
          pending[kept++] = pending[i];
      pending.resize(kept);
    }

    void append(const std::vector<Row> &rows, IntegralRows &result)
    {
      std::vector<std::uint32_t> scratch;
      for(const Row &row : rows)
      {
        result.laplacian.add_row(row.columns, row.laplacian, scratch);
        result.load.add_row(row.columns, row.load, scratch);
        result.flux.add_row(row.wall_columns, row.flux, scratch);
        result.largest_dilation = std::max(result.largest_dilation, row.dilation);
        result.largest_residual = std::max(result.largest_residual, row.residual);
        result.unmet += row.residual > constraint_bound ? 1 : 0;
      }
    }
  } // namespace

  IntegralRows integral_rows(const NodeSet &nodes, const IntegralWalls &walls,
                             const IntegralParameters &parameters)
  {
    const int dim = nodes.positions.dimension;
    const WallQuadrature quadrature = make_wall_quadrature(nodes, walls);
    const KernelMoments kernel_moments(parameters.kernel, dim, parameters.order - 2);
    const RowMaker prototype(nodes, walls, quadrature, kernel_moments, parameters);
    std::vector<std::uint32_t> pending;
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(walls.fixed[i] == 0)
        pending.push_back(static_cast<std::uint32_t>(i));

    double extent = 0;
    for(std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d)
      extent = std::max(extent, walls.upper[d] - walls.lower[d]);
    double dilation = parameters.dilation * nodes.spacing;
    IntegralRows result;
    std::vector<Row> rows(nodes.size());
    attempt(nodes, prototype, dilation, parameters, pending, rows, result.work);
    if(parameters.enlarge)
    {
      result.enlarged = static_cast<long>(pending.size());
      while(!pending.empty() && dilation < extent)
      {
        dilation *= growth;
        attempt(nodes, prototype, dilation, parameters, pending, rows, result.work);
      }
    }
    if(!pending.empty())
    {
      const cases::Position at = nodes.point(pending.front());
      const Row &row = rows[pending.front()];
      const std::string reason
          = row.singular ? "the loads of its row cancel, whose sum all else is divided by"
            : row.dilation < dilation
                ? "too few particles are there"
                : fmt::format("the constraints contradict each other by {:.2g}",
                              row.residual);
      throw cases::NumericalError(
          "moab-integral", 0, 0, "weights",
          fmt::format("cannot be found at ({:.4g}, {:.4g}) with a dilation of {:.4g}: {}",
                      at[0], at[1], dilation, reason));
    }
    append(rows, result);
    result.wall_particles = quadrature.particles;
    return result;
  }
} // namespace meltfront::particles
