#ifndef meltfront_particles_sph_own_particles_h
#define meltfront_particles_sph_own_particles_h

#include <particles/sph/exact_sum.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace meltfront::particles
{
  /** What processes that share a run's particles tell each other, all of them at the same
   * time. */
  class RankExchange
  {
  public:
    virtual ~RankExchange() = default;

    /** Bring an array of the particles at hand up to date where others own them. */
    virtual void refresh(std::span<double> values) = 0;

    /** Sum over all processes. */
    virtual double total(const ExactSum &own) = 0;

    /** Put in the place of each value the largest of those of all processes. */
    virtual void take_largest(std::span<double> values) = 0;

    /** Times of refresh(), and of total() and
     * take_largest(). */
    virtual long exchanges() const = 0;
    virtual long reductions() const = 0;

    /** Numbers sent by this process at each refresh(). */
    virtual std::size_t sent() const = 0;

    virtual int ranks() const = 0;
  };

  /**
   * Which of the particles at hand this process computes: all of them, unless others
   * share the run. Then these stand in a row, and before and after them copies of what
   * others own, as far as what is computed depends on it; all in the order of their
   * numbers, which do not depend on the number of processes.
   */
  struct OwnParticles
  {
    std::size_t begin = 0, end = 0; ///< of the particles at hand
    std::uint64_t first_number = 0; ///< of the first own one among all particles
    std::uint64_t all = 0;          ///< particles of all processes
    /** With the others; null where there are none. */
    std::shared_ptr<RankExchange> exchange;

    std::size_t size() const
    {
      return end - begin;
    }

    bool holds(std::size_t particle) const
    {
      return particle >= begin && particle < end;
    }

    bool shared() const
    {
      return exchange != nullptr;
    }

    void refresh(std::span<double> values) const
    {
      if(exchange)
        exchange->refresh(values);
    }

    /** Sum over all particles of what was added up over the own ones: the same bits
     * whatever the number of processes. */
    double total(const ExactSum &own) const
    {
      return exchange ? exchange->total(own) : own.value();
    }

    double total(double own) const
    {
      if(!exchange)
        return own;
      ExactSum sum;
      sum.add(own);
      return exchange->total(sum);
    }

    double largest(double own) const
    {
      take_largest({&own, 1});
      return own;
    }

    void take_largest(std::span<double> values) const
    {
      if(exchange)
        exchange->take_largest(values);
    }

    /** The part of an array that is of the own particles. */
    template <typename Value>
    std::span<Value> part(std::span<Value> values) const
    {
      return values.subspan(begin, size());
    }
  };
} // namespace meltfront::particles

#endif
