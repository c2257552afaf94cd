#include <cases/error.h>
#include <particles/rkpm/stability_symbol.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace meltfront::particles::rkpm
{
  namespace
  {
    using Angles = std::array<double, 3>;

    /** Weights of the Laplacian at a particle of the lattice with spacing one. */
    class LatticeStencil
    {
    public:
      LatticeStencil(const MomentSettings &settings, double alpha)
        : dimension(settings.dimension)
      {
        points.dimension = dimension;
        const int reach = static_cast<int>(std::ceil(alpha));
        const int reach_y = dimension > 1 ? reach : 0,
                  reach_z = dimension > 2 ? reach : 0;
        for(int k = -reach_z; k <= reach_z; ++k)
          for(int j = -reach_y; j <= reach_y; ++j)
            for(int i = -reach; i <= reach; ++i)
              if(i * i + j * j + k * k < alpha * alpha)
                points.add({double(i), double(j), double(k)});
        MomentSettings second = settings;
        second.derivatives = 2;
        MomentEngine engine(second);
        std::vector<std::uint32_t> all(points.size());
        std::iota(all.begin(), all.end(), 0);
        const std::vector<double> dilations(points.size(), alpha);
        determined = engine.evaluate({}, points, all, alpha, dilations);
        if(!determined)
          return;
        laplacian.assign(points.size(), 0);
        const MonomialBasis derivatives(dimension, 2);
        for(int d = 0; d < dimension; ++d)
        {
          MultiIndex twice{};
          twice[d] = 2;
          const auto weights = engine.weights(derivatives.find(twice));
          for(std::size_t i = 0; i < laplacian.size(); ++i)
            laplacian[i] += weights[i];
        }
      }

      /** -S(theta) / sum (2 - 2 cos theta_i). The weights sum to zero, and
       * 1 - cos = 2 sin^2 of the half angle loses no digits for long waves. */
      double ratio(const Angles &theta) const
      {
        double sum = 0, reference = 0;
        for(std::size_t i = 0; i < laplacian.size(); ++i)
        {
          double phase = 0;
          for(int d = 0; d < dimension; ++d)
            phase += theta[d] * points.position[d][i];
          const double sine = std::sin(phase / 2);
          sum += 2 * laplacian[i] * sine * sine;
        }
        for(int d = 0; d < dimension; ++d)
        {
          const double sine = std::sin(theta[d] / 2);
          reference += 4 * sine * sine;
        }
        return sum / reference;
      }

      int dimension;
      bool determined = false;

    private:
      ParticleStorage points;
      std::vector<double> laplacian;
    };

    /** Lower a ratio by steps along the coordinates that are halved where none helps. */
    double descend(const LatticeStencil &stencil, Angles theta, double step, double least)
    {
      while(step > 1e-4)
      {
        bool moved = false;
        for(int d = 0; d < stencil.dimension; ++d)
          for(const double sign : {-1., 1.})
          {
            Angles next = theta;
            next[d] = std::clamp(next[d] + sign * step, 0., std::numbers::pi);
            if(*std::max_element(next.begin(), next.end()) < 1e-3)
              continue;
            const double ratio = stencil.ratio(next);
            if(ratio < least)
            {
              least = ratio;
              theta = next;
              moved = true;
            }
          }
        if(!moved)
          step /= 2;
      }
      return least;
    }

    /** The least ratio over a grid of angles, by symmetry 0 <= theta_3 <= theta_2
     * <= theta_1 <= pi, and from there downhill. */
    double least_ratio(const LatticeStencil &stencil)
    {
      constexpr int intervals_of[] = {128, 48, 20};
      const int intervals = intervals_of[stencil.dimension - 1];
      const double step = std::numbers::pi / intervals;
      double least = std::numeric_limits<double>::infinity();
      Angles lowest{};
      for(int i = 1; i <= intervals; ++i)
        for(int j = 0; j <= (stencil.dimension > 1 ? i : 0); ++j)
          for(int k = 0; k <= (stencil.dimension > 2 ? j : 0); ++k)
          {
            const Angles theta{i * step, j * step, k * step};
            const double ratio = stencil.ratio(theta);
            if(ratio < least)
            {
              least = ratio;
              lowest = theta;
            }
          }
      return descend(stencil, lowest, step / 2, least);
    }
  } // namespace

  double stability_ratio(const MomentSettings &settings, double alpha)
  {
    if(!(alpha > 0 && alpha < 100))
      throw cases::InputError(fmt::format(
          "alpha, the dilation over the particle spacing, lies between 0 and 100, not at "
          "{:.6g}",
          alpha));
    const LatticeStencil stencil(settings, alpha);
    return stencil.determined ? least_ratio(stencil)
                              : std::numeric_limits<double>::quiet_NaN();
  }

  double largest_stable_alpha(const MomentSettings &settings, double first, double step,
                              double least)
  {
    if(!(step > 0 && first > 0))
      throw cases::InputError("the search for a stable alpha starts at and steps by "
                              "positive numbers");
    const double end = settings.dimension == 3 ? 5 : 8;
    double stable = 0;
    for(int i = 0; first + i * step < end + step / 2; ++i)
    {
      const double alpha = first + i * step;
      const double ratio = stability_ratio(settings, alpha);
      if(std::isnan(ratio))
        continue;
      if(ratio < least)
        break;
      stable = alpha;
    }
    return stable;
  }

  StabilityVerdict judge_stability(const MomentSettings &settings, double alpha)
  {
    StabilityVerdict verdict;
    verdict.ratio = stability_ratio(settings, alpha);
    verdict.safe = verdict.ratio >= least_stable_ratio;
    verdict.largest_alpha = largest_stable_alpha(settings, 1.05, 0.05);
    const std::string what = fmt::format(
        "the kernel '{}' with order {} in {}D at alpha = {:.4g}",
        kernel_name(settings.kernel), settings.order, settings.dimension, alpha);
    if(std::isnan(verdict.ratio))
      verdict.sentence = fmt::format("{} reaches too few particles; alpha can be up to "
                                     "{:.4g}",
                                     what, verdict.largest_alpha);
    else
      verdict.sentence = fmt::format(
          "{} {} spurious mode on a lattice (r = {:.3g}, safe from {} on); alpha is safe "
          "up to {:.4g}",
          what, verdict.safe ? "has no" : "has a", verdict.ratio, least_stable_ratio,
          verdict.largest_alpha);
    return verdict;
  }

  void require_stability(const MomentSettings &settings, double alpha)
  {
    const double ratio = stability_ratio(settings, alpha);
    if(!(ratio >= least_stable_ratio))
      throw cases::Refusal(judge_stability(settings, alpha).sentence);
  }
} // namespace meltfront::particles::rkpm
