#include <particles/greenspan/motion/periodic_space.h>

namespace meltfront::particles::greenspan
{
  namespace
  {
    using Places = std::array<std::vector<double>, 3>;

    /** Particles inside one period, and behind them images of those near its ends. */
    struct Images
    {
      Places position;
      std::vector<std::uint32_t> owner; ///< particle that a place belongs to
    };

    Images wrap(int dimension, const Places &position, std::size_t n,
                const Period &period)
    {
      Images images;
      for(int d = 0; d < dimension; ++d)
        for(std::size_t i = 0; i < n; ++i)
          images.position[d].push_back(wrapped(position[d][i], period[d]));
      for(std::size_t i = 0; i < n; ++i)
        images.owner.push_back(static_cast<std::uint32_t>(i));
      return images;
    }

    /** Repeat what lies within the margin of an end beyond the other one. */
    void add_images(Images &images, int dimension, int direction, double period,
                    double margin)
    {
      const std::size_t so_far = images.owner.size();
      for(std::size_t i = 0; i < so_far; ++i)
      {
        const double coordinate = images.position[direction][i];
        for(const double shift : {period, -period})
        {
          const double image = coordinate + shift;
          if(image < -margin || image > period + margin)
            continue;
          for(int d = 0; d < dimension; ++d)
            images.position[d].push_back(d == direction ? image : images.position[d][i]);
          images.owner.push_back(images.owner[i]);
        }
      }
    }

    /** Of the rows of the n particles keep what is near by the rule that is the same for
     * both particles of a pair. */
    FoundRows owners_near(const FoundRows &found, const Images &images, int dimension,
                          const Places &position, std::size_t n, double radius,
                          const Period &period)
    {
      FoundRows result{std::vector<std::size_t>(n), std::vector<std::uint32_t>(n), {}};
      result.entries.reserve(found.entries.size());
      const std::array<NearestImage, 3> nearest{
          NearestImage(period[0]), NearestImage(period[1]), NearestImage(period[2])};
      for(std::size_t a = 0; a < n; ++a)
      {
        result.first[a] = result.entries.size();
        for(const std::uint32_t place : found[a])
        {
          const std::uint32_t b = images.owner[place];
          double squared = 0;
          for(int d = 0; d < dimension; ++d)
          {
            const double apart = nearest[d](position[d][a] - position[d][b]);
            squared += apart * apart;
          }
          if(squared < radius * radius)
            result.entries.push_back(b);
        }
        result.length[a]
            = static_cast<std::uint32_t>(result.entries.size() - result.first[a]);
      }
      return result;
    }
  } // namespace

  double wrapped(double coordinate, double period)
  {
    return period > 0 ? coordinate - period * std::floor(coordinate / period)
                      : coordinate;
  }

  FoundRows find_in_periodic_space(int dimension,
                                   const std::array<std::vector<double>, 3> &position,
                                   std::size_t n, double radius, const Period &period,
                                   bool among_all)
  {
    // Wrapping rounds: what is near to the last bit must not be missed.
    const double margin = radius * (1 + 1e-9);
    Images images = wrap(dimension, position, n, period);
    for(int d = 0; d < dimension; ++d)
      if(period[d] > 0)
        add_images(images, dimension, d, period[d], margin);
    const std::size_t all = images.owner.size();
    const FoundRows found = among_all
                                ? find_among_all(dimension, images.position, all, margin)
                                : find_in_cells(dimension, images.position, all, margin);
    return owners_near(found, images, dimension, position, n, radius, period);
  }
} // namespace meltfront::particles::greenspan
