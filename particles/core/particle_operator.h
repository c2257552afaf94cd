#ifndef meltfront_particles_core_particle_operator_h
#define meltfront_particles_core_particle_operator_h

#include <particles/core/lane_sums.h>
#include <particles/core/neighbour_list.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * A sparse operator on particles: rows of neighbours and coefficients,
   *
   *   result_a = sum_b coefficient_ab pair(value_a, value_b),
   *
   * by default with pair = value_b - value_a.
   *
   * Eight rows stand together in a slice, entry by entry (sliced ELLPACK: Monakov et al.
   * 2010), so that eight rows advance with one instruction. Each row is summed in the
   * order of its neighbour list whatever the number of threads: where coefficients are
   * symmetric and the pair function is antisymmetric, what a pair exchanges cancels to
   * the last bit.
   */
  class ParticleOperator
  {
  public:
    static constexpr std::size_t lanes = 8;

    ParticleOperator() = default;

    /** @param coefficients one per entry of the list, in its order. */
    ParticleOperator(const NeighbourList &neighbours,
                     std::span<const double> coefficients);

    /** Take new coefficients for the same neighbours. */
    void refresh(const NeighbourList &neighbours, std::span<const double> coefficients);

    std::size_t rows() const
    {
      return n_rows;
    }

    /** Length that arrays handed to the operator must have: rows() in full slices. */
    std::size_t padded_rows() const
    {
      return slices() * lanes;
    }

    std::size_t slices() const
    {
      return slice_begin.empty() ? 0 : slice_begin.size() - 1;
    }

    /** Entries of all rows, without the padding. */
    std::size_t interactions() const
    {
      return n_interactions;
    }

    /** Entries of the rows of one slice, without the padding. */
    std::size_t interactions(std::size_t slice) const
    {
      return slice_interactions[slice];
    }

    /** Memory of the operator. */
    std::size_t bytes() const;

    /** result = sum of coefficient * (value_b - value_a), for all rows. */
    void apply(std::span<const double> value, std::span<double> result,
               int threads) const;

    /**
     * Overwrite the rows of some slices with the sum of another pair function, given the
     * numbers of the row and of its neighbour.
     */
    template <typename Pair>
    void apply_to_slices(std::span<const std::uint32_t> chosen, const Pair &pair,
                         std::span<double> result) const
    {
      for(const std::uint32_t slice : chosen)
        apply_to_slice(slice, pair, result.data());
    }

    /** Another pair function in all rows. */
    template <typename Pair>
    void apply_pairs(const Pair &pair, std::span<double> result, int threads) const
    {
      double *sums = result.data();
#pragma omp parallel for schedule(static) num_threads(threads) if(threads > 1)
      for(std::size_t slice = 0; slice < slices(); ++slice)
        apply_to_slice(slice, pair, sums);
    }

    /**
     * Two pair functions over the same coefficients in one sweep, which reads the
     * operator once: what a pair exchanges of two substances, as of heat and a solute.
     */
    template <typename First, typename Second>
    void apply_pairs(const First &first, const Second &second,
                     std::span<double> first_result, std::span<double> second_result,
                     int threads) const
    {
      double *first_sums = first_result.data(), *second_sums = second_result.data();
#pragma omp parallel for schedule(static) num_threads(threads) if(threads > 1)
      for(std::size_t slice = 0; slice < slices(); ++slice)
        apply_to_slice(slice, first, second, first_sums, second_sums);
    }

    /** Call a function with each neighbour of a row and its coefficient, padding left
     * out. */
    template <typename Visit>
    void visit_row(std::size_t row, const Visit &visit) const
    {
      const std::size_t slice = row / lanes;
      for(std::size_t e = slice_begin[slice] + row % lanes; e < slice_begin[slice + 1];
          e += lanes)
        if(neighbours_of[e] != row)
          visit(neighbours_of[e], coefficient[e]);
    }

    /** A coefficient by its row and its neighbour. */
    struct Entry
    {
      std::uint32_t row, neighbour;
      double coefficient;
    };

    /**
     * The coefficients of another operator on the same neighbours minus this one's, where
     * they differ: by rows, ascending, each pair once, from its lower number.
     */
    std::vector<Entry> differing_pairs(const ParticleOperator &other) const;

    /**
     * For each slice the slices that hold neighbours of its rows, itself included:
     * ascending, flat, with offsets.
     */
    void slice_adjacency(std::vector<std::size_t> &offsets,
                         std::vector<std::uint32_t> &adjacent) const;

  private:
    template <typename Pair>
    void apply_to_slice(std::size_t slice, const Pair &given, double *result) const
    {
      const Pair pair = given; // a copy's members stay in registers
      const std::size_t row = slice * lanes;
      LaneSums<lanes> sums;
      for(std::size_t e = slice_begin[slice]; e < slice_begin[slice + 1]; e += lanes)
      {
        const std::uint32_t *neighbour = neighbours_of.data() + e;
        const double *factor = coefficient.data() + e;
        double term[lanes];
#pragma omp simd
        for(std::size_t lane = 0; lane < lanes; ++lane)
          term[lane] = factor[lane] * pair(row + lane, neighbour[lane]);
        sums.add(term);
      }
      sums.store(result + row);
    }

    template <typename First, typename Second>
    void apply_to_slice(std::size_t slice, const First &first_given,
                        const Second &second_given, double *first_result,
                        double *second_result) const
    {
      const First first = first_given;
      const Second second = second_given;
      const std::size_t row = slice * lanes;
      LaneSums<lanes> first_sums, second_sums;
      for(std::size_t e = slice_begin[slice]; e < slice_begin[slice + 1]; e += lanes)
      {
        const std::uint32_t *neighbour = neighbours_of.data() + e;
        const double *factor = coefficient.data() + e;
        double first_term[lanes], second_term[lanes];
#pragma omp simd
        for(std::size_t lane = 0; lane < lanes; ++lane)
        {
          first_term[lane] = factor[lane] * first(row + lane, neighbour[lane]);
          second_term[lane] = factor[lane] * second(row + lane, neighbour[lane]);
        }
        first_sums.add(first_term);
        second_sums.add(second_term);
      }
      first_sums.store(first_result + row);
      second_sums.store(second_result + row);
    }

    std::size_t n_rows = 0;
    std::size_t n_interactions = 0;
    std::vector<std::size_t> slice_begin;          ///< entries, padding included
    std::vector<std::uint32_t> slice_interactions; ///< entries, padding left out
    std::vector<std::uint32_t> neighbours_of; ///< padded with the row itself, so that
    std::vector<double> coefficient;          ///< value_b - value_a = 0 there
  };
} // namespace meltfront::particles

#endif
