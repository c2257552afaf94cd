#include <reference_fem/enthalpy/distributed/rank_run.h>
#include <reference_fem/enthalpy/state_archive.h>

#include <cases/error.h>

#include <boost/serialization/array_wrapper.hpp>

namespace meltfront::reference_fem
{
  namespace
  {
    /** A number of a rank's nodes with that of a part of a state. */
    struct NodeOfPart
    {
      unsigned int node, in_part;
    };
  } // namespace

  /** All that steps depend on and that set-up does not make, but for what nodes have: the
   * same on all ranks. */
  template <class Archive>
  void RankRun::pass_common_state(Archive &state)
  {
    state &time &time_before &step_number &queue;
    state &boundary_heat &released_heat &initial_heat &defect;
    state &iterations &capped_steps &statistics;
  }

  /** What nodes have, of the own ones first. */
  std::vector<std::vector<double> *> RankRun::state_of_nodes()
  {
    std::vector<std::vector<double> *> result{&enthalpy, &enthalpy_before, &u_before};
    for(CompensatedVector *vector : {&u, &u_accepted})
      for(std::vector<double> *part : vector->parts())
        result.push_back(part);
    return result;
  }

  /** The rank's part: common state, counts, the numbers of its own nodes and what these
   * have. */
  void RankRun::save(boost::archive::binary_oarchive &state) const
  {
    const Earlier left = costs_so_far();
    const double scale = solver->temperature_scale();
    const auto rank = dealii::Utilities::MPI::this_mpi_process(communicator);
    // Boost's archives exchange by reference whichever way they go.
    auto &run = const_cast<RankRun &>(*this);
    run.pass_common_state(state);
    state << scale << rank << left << traffic << levels.front().own_numbers();
    for(const std::vector<double> *values : run.state_of_nodes())
      state << boost::serialization::make_array(values->data(), enthalpy.size());
  }

  void RankRun::restore(boost::archive::binary_iarchive &state)
  {
    double scale = 0;
    unsigned int rank_of_part = 0;
    Earlier left;
    Traffic traffic_of_part;
    dealii::IndexSet numbers;
    pass_common_state(state);
    state >> scale >> rank_of_part >> left >> traffic_of_part >> numbers;
    solver->set_temperature_scale(scale);
    const RankLevel &finest = levels.front();
    std::vector<NodeOfPart> here;
    for(unsigned int i = 0; i < finest.n_with_ghosts(); ++i)
      if(const auto found = numbers.index_within_set(
             static_cast<dealii::types::global_dof_index>(finest.number(i)));
         found != dealii::numbers::invalid_dof_index)
        here.push_back({i, found});
    std::vector<double> part(numbers.n_elements());
    for(std::vector<double> *values : state_of_nodes())
    {
      state >> boost::serialization::make_array(part.data(), part.size());
      for(const NodeOfPart &node : here)
        if(node.node < values->size())
          (*values)[node.node] = part[node.in_part];
    }
    // Ghosts that this part does not have. All ranks read as many parts.
    Traffic of_set_up;
    for(std::vector<double> *values : state_of_nodes())
      if(values->size() > enthalpy.size())
        finest.exchange(*values, of_set_up);
    take_costs(left, traffic_of_part, rank_of_part);
  }

  /** Counts that are alike on all ranks are taken by all, those that are summed up over
   * them by one. */
  void RankRun::take_costs(const Earlier &left, const Traffic &traffic_of_part,
                           unsigned int rank_of_part)
  {
    takes_over = rank_of_part % static_cast<unsigned int>(n_ranks)
                 == dealii::Utilities::MPI::this_mpi_process(communicator);
    traffic.exchanges = traffic_of_part.exchanges;
    traffic.reductions = traffic_of_part.reductions;
    earlier.linear_iterations = left.linear_iterations;
    earlier.effects.resize(left.effects.size());
    for(std::size_t e = 0; e < left.effects.size(); ++e)
    {
      earlier.effects[e].effect = left.effects[e].effect;
      earlier.effects[e].calls = left.effects[e].calls;
      earlier.effects[e].seconds += takes_over ? left.effects[e].seconds : 0;
    }
    if(parts_restored++ == 0)
      traffic.sent = 0; // of setting up
    traffic.sent += takes_over ? traffic_of_part.sent : 0;
    earlier.work += takes_over ? left.work : 0;
  }

  void RankRun::require_resumable() const
  {
    if(options.checkpoint > 0 && !keeps_states())
      throw cases::Refusal(checkpoints_are_of_single_runs);
  }
} // namespace meltfront::reference_fem
