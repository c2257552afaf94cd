#include <particles/greenspan/force_sweep.h>
#include <particles/greenspan/pair_powers.h>

#include <cstring>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Sums of the rows of a slice, in registers. */
    class LaneSums
    {
    public:
      void add(const double *terms)
      {
        Half low, high;
        std::memcpy(&low, terms, sizeof(low));
        std::memcpy(&high, terms + lanes / 2, sizeof(high));
        first += low;
        second += high;
      }

      void store(double *result) const
      {
        std::memcpy(result, &first, sizeof(first));
        std::memcpy(result + lanes / 2, &second, sizeof(second));
      }

    private:
      using Half [[gnu::vector_size(lanes / 2 * sizeof(double))]] = double;
      Half first{}, second{};
    };

    template <int dimension, typename Powers>
    class PairSweep : public ForceSweep
    {
    public:
      explicit PairSweep(const PairForce &force)
        : powers(force)
        , squared_cutoff(force.cutoff * force.cutoff)
      {
      }

      void kick(const NeighbourRows &rows, const Coordinates &position,
                Coordinates &velocity, const KickSize &size, int threads) const override
      {
        const auto slices = static_cast<std::ptrdiff_t>(rows.slices());
        if(threads == 1)
          for(std::ptrdiff_t slice = 0; slice < slices; ++slice)
            kick_slice(rows, slice, position, velocity, size);
        else
        {
#pragma omp parallel for schedule(static) num_threads(threads)
          for(std::ptrdiff_t slice = 0; slice < slices; ++slice)
            kick_slice(rows, slice, position, velocity, size);
        }
      }

    private:
      /** The compiler makes vectors of the loops over lanes. */
      void kick_slice(const NeighbourRows &rows, std::size_t slice,
                      const Coordinates &position, Coordinates &velocity,
                      const KickSize &size) const
      {
        const Powers pair = powers; // a copy's members stay in registers
        const double cutoff = squared_cutoff, time_step = size.time_step,
                     left = size.left;
        const std::size_t row = slice * lanes;
        const double *x[dimension];
        for(int d = 0; d < dimension; ++d)
          x[d] = position[d].data();
        const std::uint32_t *neighbour = rows.entries() + rows.offset(slice);
        const std::uint32_t *const end = rows.entries() + rows.offset(slice + 1);
        LaneSums sums[dimension];
        for(; neighbour != end; neighbour += lanes)
        {
          double term[dimension][lanes];
#pragma omp simd
          for(std::size_t lane = 0; lane < lanes; ++lane)
          {
            double difference[dimension], squared = 0;
            for(int d = 0; d < dimension; ++d)
            {
              difference[d] = x[d][row + lane] - x[d][neighbour[lane]];
              squared += difference[d] * difference[d];
            }
            const double factor = squared <= cutoff ? pair(squared) : 0;
            for(int d = 0; d < dimension; ++d)
              term[d][lane] = factor * difference[d];
          }
          for(int d = 0; d < dimension; ++d)
            sums[d].add(term[d]);
        }
        for(int d = 0; d < dimension; ++d)
        {
          double acceleration[lanes];
          sums[d].store(acceleration);
          double *v = velocity[d].data() + row;
          const double weight = d == 1 ? size.gravity : 0;
#pragma omp simd
          for(std::size_t lane = 0; lane < lanes; ++lane)
            v[lane] = left * (v[lane] + time_step * (acceleration[lane] - weight));
        }
      }

      Powers powers;
      double squared_cutoff;
    };

    template <int dimension>
    std::unique_ptr<ForceSweep> make(const PairForce &force)
    {
      const auto is = [&force](double alpha, double beta)
      {
        return force.compiled_exponents && force.repulsion_exponent == alpha
               && force.attraction_exponent == beta;
      };
      if(is(6, 4))
        return std::make_unique<PairSweep<dimension, CompiledPowers<6, 4>>>(force);
      if(is(10, 7))
        return std::make_unique<PairSweep<dimension, CompiledPowers<10, 7>>>(force);
      if(is(13, 7)) // of Lennard and Jones
        return std::make_unique<PairSweep<dimension, CompiledPowers<13, 7>>>(force);
      return std::make_unique<PairSweep<dimension, GeneralPowers>>(force);
    }
  } // namespace

  std::unique_ptr<ForceSweep> make_force_sweep(const PairForce &force, int dimension)
  {
    return dimension == 2 ? make<2>(force) : make<3>(force);
  }
} // namespace meltfront::particles::greenspan
