#ifndef meltfront_reference_fem_enthalpy_distributed_sharing_ranks_h
#define meltfront_reference_fem_enthalpy_distributed_sharing_ranks_h

#include <reference_fem/enthalpy/compensated_vector.h>
#include <reference_fem/enthalpy/conduction_matrix.h>
#include <reference_fem/enthalpy/distributed/rank_correction.h>

#include <memory>
#include <vector>

namespace meltfront::reference_fem
{
  /** What StepNewton and TruncatedNewton ask of the processes that share a mesh: ghosts
   * brought up to date, and sums and maxima over all ranks, so that all ranks decide
   * alike. */
  class SharingRanks
  {
  public:
    /** @param conduction of the finest mesh, ghosts in its columns */
    SharingRanks(const std::vector<RankLevel> &levels, const ConductionMatrix &conduction,
                 Traffic &traffic);

    void update(std::vector<double> &values) const
    {
      levels.front().exchange(values, traffic);
    }

    void update(CompensatedVector &values) const
    {
      for(std::vector<double> *part : values.parts())
        update(*part);
    }

    bool anywhere(bool here) const;

    /** A distance that is not a number on one rank is infinite on all. */
    void agree(double &distance, double &largest, bool &settled) const;

    void add_up(double &one, double &other) const;

    double lowest(KinkedDerivative &own) const
    {
      return lowest_of_all(own, levels.front().communicator, traffic);
    }

    bool has_coarser_meshes(const StepProblem &) const
    {
      return levels.size() > 1;
    }

    template <class Graph>
    std::unique_ptr<FrontMover> front_mover(const StepProblem &problem,
                                            const Graph &graph) const
    {
      return std::make_unique<RankCorrection<Graph>>(levels, problem.volume, graph,
                                                     traffic);
    }

    /** See StepNewton. */
    template <typename Visit>
    void update_marks(std::vector<char> &marked, const Visit &mark_around);

  private:
    const std::vector<RankLevel> &levels;
    Traffic &traffic;
    std::vector<unsigned int> border;              ///< own nodes beside ghosts
    std::vector<std::vector<unsigned int>> beside; ///< of each ghost, own nodes
    std::vector<double> marks;
  };

  template <typename Visit>
  void SharingRanks::update_marks(std::vector<char> &marked, const Visit &mark_around)
  {
    for(const unsigned int i : border)
      marks[i] = marked[i];
    update(marks);
    for(std::size_t ghost = 0; ghost < beside.size(); ++ghost)
      if(const std::size_t i = levels.front().n_own() + ghost; marks[i] > 0 && !marked[i])
      {
        marked[i] = 1;
        for(const unsigned int neighbour : beside[ghost])
          mark_around(neighbour);
      }
  }
} // namespace meltfront::reference_fem

#endif
