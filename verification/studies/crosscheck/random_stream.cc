#include <verification/studies/crosscheck/random_stream.h>

#include <cmath>
#include <numeric>

namespace meltfront::verification
{
  namespace
  {
    constexpr std::uint64_t golden_gamma = 0x9e3779b97f4a7c15;

    std::uint64_t mixed(std::uint64_t z)
    {
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
      z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
      return z ^ (z >> 31);
    }
  } // namespace

  RandomStream::RandomStream(std::uint64_t seed, std::uint64_t index)
    : state(mixed(mixed(seed + golden_gamma) + (index + 1) * golden_gamma))
  {
  }

  std::uint64_t RandomStream::next()
  {
    state += golden_gamma;
    return mixed(state);
  }

  double RandomStream::uniform(double lower, double upper)
  {
    return lower + (upper - lower) * (static_cast<double>(next() >> 11) * 0x1p-53);
  }

  double RandomStream::log_uniform(double lower, double upper)
  {
    return std::exp(uniform(std::log(lower), std::log(upper)));
  }

  bool RandomStream::chance(double probability)
  {
    return uniform(0, 1) < probability;
  }

  int RandomStream::below(int count)
  {
    return static_cast<int>(uniform(0, count));
  }

  int RandomStream::weighted(std::initializer_list<double> weights)
  {
    double left = uniform(0, std::accumulate(weights.begin(), weights.end(), 0.));
    int chosen = 0;
    for(const double weight : weights)
    {
      if(left < weight)
        return chosen;
      left -= weight;
      ++chosen;
    }
    return chosen - 1;
  }
} // namespace meltfront::verification
