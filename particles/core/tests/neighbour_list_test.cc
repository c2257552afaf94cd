#include <cases/error.h>
#include <particles/core/arrangement.h>
#include <particles/core/neighbour_list.h>

#include <gtest/gtest.h>

#include <random>

namespace meltfront::particles
{
  namespace
  {
    enum class Arrangement
    {
      random,
      lattice,
      clustered
    };

    ParticleStorage make_particles(int dimension, Arrangement arrangement,
                                   std::uint64_t seed)
    {
      ParticleStorage particles{dimension, {}};
      if(arrangement == Arrangement::lattice)
        return arrange_in_box(dimension, {}, 1. / (dimension == 3 ? 6 : 12));
      std::mt19937_64 generator(seed);
      std::uniform_real_distribution<double> uniform(0, 1);
      for(int i = 0; i < 230; ++i)
      {
        std::array<double, 3> point{};
        for(double &x : point)
          x = arrangement == Arrangement::random ? uniform(generator)
                                                 : std::pow(uniform(generator), 4);
        particles.add(point);
      }
      return particles;
    }

    std::vector<std::uint32_t> by_brute_force(const ParticleStorage &particles,
                                              const ParticleStorage &others,
                                              std::size_t a, double radius,
                                              const Periodicity &periodicity, bool same)
    {
      std::vector<std::uint32_t> found;
      for(std::size_t b = 0; b < others.size(); ++b)
      {
        double squared = 0;
        for(int d = 0; d < particles.dimension; ++d)
        {
          // The nearest of the images to the left, in place and to the right.
          const double period = periodicity.period[d];
          const double difference = particles.position[d][a] - others.position[d][b];
          const double shortest
              = std::min({std::abs(difference), std::abs(difference - period),
                          std::abs(difference + period)});
          squared += shortest * shortest;
        }
        if(squared < radius * radius && !(same && a == b))
          found.push_back(b);
      }
      return found;
    }

    std::vector<std::uint32_t> row(const NeighbourList &list, std::size_t a)
    {
      return {list[a].begin(), list[a].end()};
    }

    TEST(NeighbourList, AgreesWithBruteForce)
    {
      for(int dimension = 1; dimension <= 3; ++dimension)
        for(unsigned directions = 0; directions < 1u << dimension; ++directions)
          for(const Arrangement arrangement :
              {Arrangement::random, Arrangement::lattice, Arrangement::clustered})
            for(const double radius : {0.04, 0.171, 0.31, 0.4999})
            {
              Periodicity periodicity;
              for(int d = 0; d < dimension; ++d)
                if(directions >> d & 1)
                  periodicity.period[d] = 1;
              const auto particles = make_particles(dimension, arrangement, 3);
              const NeighbourList list(particles, radius, periodicity);
              ASSERT_EQ(list.rows(), particles.size());
              for(std::size_t a = 0; a < particles.size(); ++a)
                ASSERT_EQ(row(list, a), by_brute_force(particles, particles, a, radius,
                                                       periodicity, true))
                    << "dimension " << dimension << ", periodic " << directions
                    << ", radius " << radius << ", row " << a;
            }
    }

    TEST(NeighbourList, FindsOtherPoints)
    {
      for(int dimension = 1; dimension <= 3; ++dimension)
        for(const double radius : {0.05, 0.3, 2.})
        {
          const auto particles = make_particles(dimension, Arrangement::random, 5);
          auto others = make_particles(dimension, Arrangement::clustered, 6);
          for(double &x : others.position[0])
            x -= 0.3; // some lie outside the particles' box
          const NeighbourList list(particles, others, radius);
          for(std::size_t a = 0; a < particles.size(); ++a)
            ASSERT_EQ(row(list, a),
                      by_brute_force(particles, others, a, radius, {}, false));
        }
    }

    TEST(NeighbourList, OfNoOtherPointsIsEmpty)
    {
      const auto particles = make_particles(2, Arrangement::lattice, 0);
      const ParticleStorage nothing{2, {}};
      EXPECT_EQ(NeighbourList(particles, nothing, 1).size(), 0u);
    }

    TEST(NeighbourList, RefusesAPeriodThatIsTooShort)
    {
      const auto particles = make_particles(2, Arrangement::lattice, 0);
      Periodicity periodicity;
      periodicity.period[1] = 1;
      EXPECT_NO_THROW(NeighbourList(particles, 0.5, periodicity));
      EXPECT_THROW(NeighbourList(particles, 0.51, periodicity), cases::InputError);
    }
  } // namespace
} // namespace meltfront::particles
