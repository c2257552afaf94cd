#include <particles/core/relaxation.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles
{
  namespace
  {
    constexpr int most_sweeps = 300;
    constexpr int watched_sweeps = 10; ///< over which the spread has to fall
    constexpr double least_gain = 0.01;
    constexpr double longest_move = 0.05; ///< in spacings

    /** Unit integral of (1 - r)^3 in 1, 2 and 3 dimensions. */
    constexpr double spike_norm[] = {2, 10 / std::numbers::pi, 15 / std::numbers::pi};

    using Vector = std::array<double, 3>;

    /** Sweeps over particles within their bounds. */
    class Relaxer
    {
    public:
      Relaxer(ParticleStorage &particles, const SmoothingKernel &kernel, double spacing,
              const RelaxationBounds &bounds)
        : particles(particles)
        , kernel(kernel)
        , spacing(spacing)
        , volume(1)
        , bounds(bounds)
        , shift(particles.size())
        , moment(particles.size())
      {
        for(int d = 0; d < particles.dimension; ++d)
          volume *= spacing;
        for(std::size_t a = 0; a < particles.size(); ++a)
          moves.push_back(!bounds.movable || bounds.movable(particles.point(a)));
      }

      /** Sum what the particles around do to each. @return spread of the moments. */
      double look_around()
      {
        const ParticleStorage others = surroundings();
        const NeighbourList near(particles, others, kernel.support(), bounds.periodicity);
        for(std::size_t a = 0; a < particles.size(); ++a)
        {
          shift[a] = {};
          moment[a] = 0;
          for(const std::uint32_t b : near[a])
            add_pair(a, others, b);
        }
        return spread();
      }

      /** Follow the sums, and stay within the mirrors. */
      void move()
      {
        const double h = kernel.smoothing_length();
        for(std::size_t a = 0; a < particles.size(); ++a)
        {
          if(!moves[a])
            continue;
          const auto [x, y, z] = shift[a];
          const double length = 0.5 * h * h * std::hypot(x, y, z);
          const double factor
              = 0.5 * h * h
                * std::min(1., longest_move * spacing / std::max(length, 1e-300));
          for(int d = 0; d < particles.dimension; ++d)
            particles.position[d][a] -= factor * shift[a][d];
          for(const MirrorPlane &mirror : bounds.mirrors)
          {
            double &own = particles.position[mirror.direction][a];
            if(mirror.upper ? own > mirror.coordinate : own < mirror.coordinate)
              own = 2 * mirror.coordinate - own;
          }
        }
      }

    private:
      /** The particles, their images near mirrors, corners among them, and those that
       * stay. */
      ParticleStorage surroundings() const
      {
        ParticleStorage all = particles;
        for(int d = 0; d < particles.dimension; ++d)
        {
          const std::size_t so_far = all.size();
          for(const MirrorPlane &mirror : bounds.mirrors)
            for(std::size_t i = 0; i < so_far && mirror.direction == d; ++i)
            {
              const double depth = std::abs(all.position[d][i] - mirror.coordinate);
              // A particle on the mirror is its own image.
              if(depth >= kernel.support() || depth < 1e-6 * spacing)
                continue;
              auto image = all.point(i);
              image[d] = 2 * mirror.coordinate - image[d];
              all.add(image);
            }
        }
        for(std::size_t i = 0; i < bounds.fixed.size(); ++i)
          all.add(bounds.fixed.point(i));
        return all;
      }

      void add_pair(std::size_t a, const ParticleStorage &others, std::size_t b)
      {
        Vector difference{};
        double squared = 0;
        for(int d = 0; d < particles.dimension; ++d)
        {
          difference[d] = bounds.periodicity.shortest(d, particles.position[d][a]
                                                             - others.position[d][b]);
          squared += difference[d] * difference[d];
        }
        const double distance = std::sqrt(squared);
        const double support = kernel.support();
        const double rest = std::max(0., 1 - distance / support);
        const double spike = -3 * spike_norm[particles.dimension - 1] * rest * rest
                             / (support * std::max(distance, 1e-6 * spacing));
        double cells = 1; // of the support's side
        for(int d = 0; d < particles.dimension; ++d)
          cells *= spacing / support;
        for(int d = 0; d < particles.dimension; ++d)
          shift[a][d] += cells * spike * difference[d];
        moment[a] -= volume * kernel.radial_derivative_over_distance(distance) * squared
                     / particles.dimension;
      }

      double spread() const
      {
        double sum = 0, squares = 0;
        for(const double mu : moment)
        {
          sum += mu;
          squares += (mu - 1) * (mu - 1);
        }
        const double count = static_cast<double>(moment.size());
        const double mean = sum / count;
        return std::sqrt(std::max(0., squares / count - (mean - 1) * (mean - 1))) / mean;
      }

      ParticleStorage &particles;
      const SmoothingKernel &kernel;
      double spacing;
      double volume;
      const RelaxationBounds &bounds;
      std::vector<bool> moves;
      std::vector<Vector> shift; ///< gradient of the concentration (1/m)
      std::vector<double> moment;
    };
  } // namespace

  Relaxation relax(ParticleStorage &particles, const SmoothingKernel &kernel,
                   double spacing, const RelaxationBounds &bounds)
  {
    if(particles.size() == 0)
      return {};
    Relaxer relaxer(particles, kernel, spacing, bounds);
    std::vector<double> spreads{relaxer.look_around()};
    for(int sweep = 1; sweep <= most_sweeps; ++sweep)
    {
      relaxer.move();
      spreads.push_back(relaxer.look_around());
      if(sweep >= watched_sweeps
         && spreads.back() > (1 - least_gain) * spreads[sweep - watched_sweeps])
        break;
    }
    return {static_cast<int>(spreads.size()) - 1, spreads.front(), spreads.back()};
  }
} // namespace meltfront::particles
