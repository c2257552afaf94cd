#include <particles/core/lane_sums.h>
#include <particles/greenspan/motion/force_sweep.h>
#include <particles/greenspan/motion/pair_powers.h>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Space that does not repeat itself. */
    struct OpenSpace
    {
      explicit OpenSpace(const Period &)
      {
      }

      double operator()(int, double difference) const
      {
        return difference;
      }
    };

    /** One that repeats itself along y only, or in any direction. */
    template <bool along_y_only>
    class RepeatedSpace
    {
    public:
      explicit RepeatedSpace(const Period &period)
        : nearest{NearestImage(period[0]), NearestImage(period[1]),
                  NearestImage(period[2])}
      {
      }

      double operator()(int direction, double difference) const
      {
        return !along_y_only || direction == 1 ? nearest[direction](difference)
                                               : difference;
      }

    private:
      std::array<NearestImage, 3> nearest;
    };

    template <int dimension, typename Powers, typename Space>
    class PairSweep : public ForceSweep
    {
    public:
      PairSweep(const PairForce &force, const Period &period)
        : powers(force)
        , space(period)
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
        const Space from = space;
        const double cutoff = squared_cutoff, time_step = size.time_step,
                     left = size.left;
        const std::size_t row = slice * lanes;
        const double *x[dimension];
        for(int d = 0; d < dimension; ++d)
          x[d] = position[d].data();
        const std::uint32_t *neighbour = rows.entries() + rows.offset(slice);
        const std::uint32_t *const end = rows.entries() + rows.offset(slice + 1);
        LaneSums<lanes> sums[dimension];
        for(; neighbour != end; neighbour += lanes)
        {
          double term[dimension][lanes];
#pragma omp simd
          for(std::size_t lane = 0; lane < lanes; ++lane)
          {
            double difference[dimension], squared = 0;
            for(int d = 0; d < dimension; ++d)
            {
              difference[d] = from(d, x[d][row + lane] - x[d][neighbour[lane]]);
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
      Space space;
      double squared_cutoff;
    };

    template <int dimension, typename Powers, typename Space>
    std::unique_ptr<ForceSweep> make_shifted(const PairForce &force, const Period &period)
    {
      return std::make_unique<PairSweep<dimension, ShiftedPowers<Powers>, Space>>(force,
                                                                                  period);
    }

    template <int dimension, typename Space>
    std::unique_ptr<ForceSweep> make(const PairForce &force, const Period &period)
    {
      const auto is = [&force](double alpha, double beta)
      {
        return force.compiled_exponents && force.repulsion_exponent == alpha
               && force.attraction_exponent == beta;
      };
      if(force.shifted)
        return is(6, 4)
                   ? make_shifted<dimension, CompiledPowers<6, 4>, Space>(force, period)
                   : make_shifted<dimension, GeneralPowers, Space>(force, period);
      if(is(6, 4))
        return std::make_unique<PairSweep<dimension, CompiledPowers<6, 4>, Space>>(
            force, period);
      if(is(10, 7))
        return std::make_unique<PairSweep<dimension, CompiledPowers<10, 7>, Space>>(
            force, period);
      if(is(13, 7)) // of Lennard and Jones
        return std::make_unique<PairSweep<dimension, CompiledPowers<13, 7>, Space>>(
            force, period);
      return std::make_unique<PairSweep<dimension, GeneralPowers, Space>>(force, period);
    }
  } // namespace

  std::unique_ptr<ForceSweep> make_force_sweep(const PairForce &force, int dimension,
                                               const Period &period)
  {
    if(dimension == 2 && period[0] == 0 && period[1] > 0)
      return make<2, RepeatedSpace<true>>(force, period);
    if(repeats(period))
      return dimension == 2 ? make<2, RepeatedSpace<false>>(force, period)
                            : make<3, RepeatedSpace<false>>(force, period);
    return dimension == 2 ? make<2, OpenSpace>(force, period)
                          : make<3, OpenSpace>(force, period);
  }
} // namespace meltfront::particles::greenspan
