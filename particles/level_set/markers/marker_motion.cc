#include <cases/error.h>
#include <particles/level_set/markers/marker_motion.h>

#include <fmt/format.h>

#include <utility>

namespace meltfront::particles::level_set
{
  namespace
  {
    constexpr std::size_t block_size = 256;

    using Block = std::array<double, block_size>;

    /** Markers of a block, and what belongs to them during a step. */
    struct BlockWork
    {
      std::array<Block, 3> stage, velocity, normal;
      std::array<Block, 9> gradient;
    };

    template <std::size_t arrays>
    std::array<std::span<double>, arrays> spans(std::array<Block, arrays> &blocks,
                                                std::size_t used, std::size_t size)
    {
      std::array<std::span<double>, arrays> result;
      for(std::size_t i = 0; i < used; ++i)
        result[i] = {blocks[i].data(), size};
      return result;
    }

    /** Where gradients go: entry 3 i + j of a dimension. */
    std::array<std::span<double>, 9> gradient_spans(std::array<Block, 9> &blocks,
                                                    int dimension, std::size_t size)
    {
      std::array<std::span<double>, 9> result;
      for(int i = 0; i < dimension; ++i)
        for(int j = 0; j < dimension; ++j)
          result[3 * i + j] = {blocks[3 * i + j].data(), size};
      return result;
    }

    template <int dim>
    cases::PointArrays places(const std::array<Block, 3> &stage, std::size_t size)
    {
      cases::PointArrays result;
      for(int i = 0; i < dim; ++i)
        result[i] = {stage[i].data(), size};
      return result;
    }

    /**
     * result = start - interval (I - m m^T) G^T m, of unit length; m is the normal
     * `middle`. Returns nothing; stretch is m . G m.
     */
    template <int dim>
    void turn(const std::array<Block, 9> &gradient,
              const std::array<const double *, 3> start,
              const std::array<Block, 3> &middle, double interval, std::size_t size,
              const std::array<double *, 3> result, Block &stretch)
    {
      for(std::size_t p = 0; p < size; ++p)
      {
        std::array<double, dim> rate{}, turned{};
        double along = 0, square = 0;
        for(int j = 0; j < dim; ++j)
          for(int i = 0; i < dim; ++i)
            rate[j] += gradient[3 * i + j][p] * middle[i][p];
        for(int j = 0; j < dim; ++j)
          along += rate[j] * middle[j][p];
        for(int j = 0; j < dim; ++j)
        {
          turned[j] = start[j][p] - interval * (rate[j] - along * middle[j][p]);
          square += turned[j] * turned[j];
        }
        const double scale = 1 / std::sqrt(square);
        for(int j = 0; j < dim; ++j)
          result[j][p] = scale * turned[j];
        stretch[p] = along;
      }
    }

    template <int dim>
    class BlockStep
    {
    public:
      BlockStep(Markers &markers, const cases::VelocityField &velocity, double time,
                double time_step, Carried carried)
        : markers(markers)
        , velocity(velocity)
        , time(time)
        , time_step(time_step)
        , carried(carried)
      {
      }

      /** Returns whether all places are finite afterwards. */
      bool operator()(std::size_t begin, std::size_t size)
      {
        for(int i = 0; i < dim; ++i)
          for(std::size_t p = 0; p < size; ++p)
            work.stage[i][p] = markers.position[i][begin + p];
        if(carried != Carried::position)
          half_turn(begin, size);
        stage(begin, size, time, 0, 1);
        stage(begin, size, time + time_step, 0.75, 0.25);
        if(carried != Carried::position)
          whole_turn(begin, size);
        stage(begin, size, time + time_step / 2, 1. / 3, 2. / 3);
        double sum = 0;
        for(int i = 0; i < dim; ++i)
          for(std::size_t p = 0; p < size; ++p)
          {
            markers.position[i][begin + p] = work.stage[i][p];
            sum += 0 * work.stage[i][p];
          }
        return sum == 0;
      }

    private:
      /** stage = old share * position + new share * (stage + time step * velocity). */
      void stage(std::size_t begin, std::size_t size, double at, double old_share,
                 double new_share)
      {
        velocity.velocities(places<dim>(work.stage, size), at,
                            spans(work.velocity, dim, size));
        for(int i = 0; i < dim; ++i)
          for(std::size_t p = 0; p < size; ++p)
            work.stage[i][p]
                = old_share * markers.position[i][begin + p]
                  + new_share * (work.stage[i][p] + time_step * work.velocity[i][p]);
      }

      void half_turn(std::size_t begin, std::size_t size)
      {
        velocity.gradients(places<dim>(work.stage, size), time,
                           gradient_spans(work.gradient, dim, size));
        std::array<const double *, 3> start{};
        std::array<double *, 3> result{};
        for(int i = 0; i < dim; ++i)
        {
          std::copy_n(&markers.normal[i][begin], size, work.normal[i].begin());
          start[i] = &markers.normal[i][begin];
          result[i] = work.normal[i].data();
        }
        turn<dim>(work.gradient, start, work.normal, time_step / 2, size, result,
                  stretch);
      }

      /** The second stage is where markers are at half the step. */
      void whole_turn(std::size_t begin, std::size_t size)
      {
        velocity.gradients(places<dim>(work.stage, size), time + time_step / 2,
                           gradient_spans(work.gradient, dim, size));
        std::array<const double *, 3> start{};
        std::array<double *, 3> result{};
        for(int i = 0; i < dim; ++i)
        {
          start[i] = &markers.normal[i][begin];
          result[i] = &markers.normal[i][begin];
        }
        turn<dim>(work.gradient, start, work.normal, time_step, size, result, stretch);
        if(carried == Carried::distance_normal)
          for(std::size_t p = 0; p < size; ++p)
            markers.distance[begin + p] *= std::exp(time_step * stretch[p]);
      }

      Markers &markers;
      const cases::VelocityField &velocity;
      const double time, time_step;
      const Carried carried;
      BlockWork work{};
      Block stretch{};
    };

    template <int dim>
    bool step_all(Markers &markers, const cases::VelocityField &velocity, double time,
                  double time_step, Carried carried, int threads)
    {
      const std::size_t blocks = (markers.size() + block_size - 1) / block_size;
      bool finite = true;
#pragma omp parallel num_threads(threads) reduction(&& : finite)
      {
        BlockStep<dim> block_step(markers, velocity, time, time_step, carried);
#pragma omp for schedule(static)
        for(std::size_t block = 0; block < blocks; ++block)
        {
          const std::size_t begin = block * block_size;
          finite
              = block_step(begin, std::min(block_size, markers.size() - begin)) && finite;
        }
      }
      return finite;
    }
  } // namespace

  MarkerMotion::MarkerMotion(std::string name, const int threads)
    : name(std::move(name))
    , threads(threads)
  {
  }

  void MarkerMotion::step(Markers &markers, const cases::VelocityField &velocity,
                          const double time, const double time_step,
                          const Carried carried, const long number)
  {
    if(carried != Carried::position && !markers.with_normals() && markers.size() > 0)
      throw cases::InputError("markers that carry their distance need normals");
    const bool finite
        = markers.dimension == 2
              ? step_all<2>(markers, velocity, time, time_step, carried, threads)
              : step_all<3>(markers, velocity, time, time_step, carried, threads);
    if(!finite)
      throw cases::NumericalError(name, number, time, "place of a marker",
                                  "is not finite");
  }
} // namespace meltfront::particles::level_set
