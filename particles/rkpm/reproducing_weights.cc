#include <cases/error.h>
#include <particles/rkpm/reproducing_weights.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles::rkpm
{
  namespace
  {
    constexpr int most_enlargements = 8;

    /** Finds supports and weights, again and again until no point is deficient. */
    class Builder
    {
    public:
      Builder(const ParticleStorage &points, const ParticleStorage &particles,
              const MomentSettings &how, const SupportSettings &support_settings,
              int threads)
        : points(points)
        , particles(particles)
        , how(how)
        , support_settings(support_settings)
        , threads(threads)
        , basis_size(MonomialBasis(how.dimension, how.order).size())
        , ratio(points.size())
      {
        if(points.dimension != how.dimension || particles.dimension != how.dimension)
          throw cases::InputError(fmt::format(
              "weights in {}D need points and particles in {}D, not in {}D and {}D",
              how.dimension, how.dimension, points.dimension, particles.dimension));
        if(scatters() && points.size() != particles.size())
          throw cases::InputError("the variant 'multiple_fixed' gives each particle a "
                                  "dilation: the points must be the particles");
        for(int order = 1; order <= how.order; ++order)
        {
          MomentSettings lower = how;
          lower.order = order;
          engines.emplace_back(lower);
        }
        result.dimension = how.dimension;
        result.enlargements.assign(points.size(), 0);
        result.order.assign(points.size(), how.order);
      }

      ReproducingWeights build()
      {
        find();
        for(std::vector<std::size_t> deficient = evaluate(); !deficient.empty();
            deficient = evaluate())
        {
          const std::vector<int> before = result.enlargements;
          for(const std::size_t point : deficient)
            widen_or_lower(point, before[point]);
          find();
        }
        record();
        return std::move(result);
      }

    private:
      bool scatters() const
      {
        return how.variant == Variant::multiple_fixed;
      }

      void find()
      {
        gathered = find_supports(points, particles, support_settings, basis_size,
                                 result.enlargements);
        result.supports
            = scatters() ? reach_of_neighbours(particles, gathered.dilation) : gathered;
      }

      /** Weights of all points. @return the points whose neighbours do not suffice. */
      std::vector<std::size_t> evaluate()
      {
        const Supports &supports = result.supports;
        const int n_derivatives = engines.back().n_derivatives();
        result.weights.resize(n_derivatives);
        for(auto &weights : result.weights)
          weights.resize(supports.neighbours.size());
        std::vector<char> regular(points.size());
#pragma omp parallel num_threads(threads) if(threads > 1)
        {
          std::vector<MomentEngine> own = engines;
#pragma omp for schedule(static)
          for(std::size_t point = 0; point < points.size(); ++point)
          {
            MomentEngine &engine = own[result.order[point] - 1];
            regular[point]
                = engine.evaluate(points.point(point), particles, supports[point],
                                  supports.dilation[point], gathered.dilation);
            ratio[point] = engine.rank_ratio();
            if(regular[point])
              for(int j = 0; j < n_derivatives; ++j)
                std::ranges::copy(engine.weights(j),
                                  result.weights[j].begin() + supports.offsets[point]);
          }
        }
        std::vector<std::size_t> deficient;
        for(std::size_t point = 0; point < points.size(); ++point)
          if(!regular[point])
            deficient.push_back(point);
        return deficient;
      }

      /** @param enlarged how often the support had been enlarged before this round */
      void widen_or_lower(std::size_t point, int enlarged)
      {
        if(can_widen(enlarged))
        {
          const int next = enlarged + 1;
          result.enlargements[point] = std::max(result.enlargements[point], next);
          if(scatters()) // whom a point sees is decided by its neighbours' dilations
            for(const std::uint32_t neighbour : gathered[point])
              result.enlargements[neighbour]
                  = std::max(result.enlargements[neighbour], next);
          return;
        }
        if(--result.order[point] < 1)
        {
          const auto x = points.point(point);
          throw cases::InputError(fmt::format(
              "the particles around ({:.6g}, {:.6g}, {:.6g}) m do not determine even a "
              "linear function: they are too few or lie on one line or plane",
              x[0], x[1], x[2]));
        }
      }

      bool can_widen(int enlarged) const
      {
        if(enlarged >= most_enlargements)
          return false;
        if(support_settings.rule == SupportRule::fixed_dilation)
          return true;
        const int number = support_settings.neighbours > 0 ? support_settings.neighbours
                                                           : 2 * basis_size;
        const std::size_t wanted = number + (enlarged + 1) * ((basis_size + 1) / 2);
        return wanted < particles.size();
      }

      void record()
      {
        SupportRecord &record = result.record;
        record.lowest_order = how.order;
        record.least_rank_ratio = points.size() > 0 ? ratio[0] : 0;
        for(std::size_t point = 0; point < points.size(); ++point)
        {
          record.enlarged += result.enlargements[point] > 0;
          record.lowered += result.order[point] < how.order;
          record.most_enlargements
              = std::max(record.most_enlargements, result.enlargements[point]);
          record.lowest_order = std::min(record.lowest_order, result.order[point]);
          record.least_rank_ratio = std::min(record.least_rank_ratio, ratio[point]);
        }
      }

      const ParticleStorage &points;
      const ParticleStorage &particles;
      MomentSettings how;
      SupportSettings support_settings;
      int threads;
      int basis_size;
      std::vector<MomentEngine> engines; ///< of order 1, 2, ...
      Supports gathered;
      std::vector<double> ratio;
      ReproducingWeights result;
    };
  } // namespace

  double ReproducingWeights::apply(int derivative, std::size_t point,
                                   std::span<const double> values) const
  {
    const auto neighbours = supports[point];
    const auto row = (*this)(derivative, point);
    double sum = 0;
    for(std::size_t i = 0; i < row.size(); ++i)
      sum += row[i] * values[neighbours[i]];
    return sum;
  }

  ReproducingWeights compute_weights(const ParticleStorage &points,
                                     const ParticleStorage &particles,
                                     const MomentSettings &how,
                                     const SupportSettings &support_settings, int threads)
  {
    return Builder(points, particles, how, support_settings, threads).build();
  }
} // namespace meltfront::particles::rkpm
