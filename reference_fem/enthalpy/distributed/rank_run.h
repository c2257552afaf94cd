#ifndef meltfront_reference_fem_enthalpy_distributed_rank_run_h
#define meltfront_reference_fem_enthalpy_distributed_rank_run_h

#include <cases/capabilities.h>
#include <cases/scene.h>
#include <cases/shared_run.h>
#include <reference_fem/enthalpy/compensated_vector.h>
#include <reference_fem/enthalpy/distributed/box_hierarchy.h>
#include <reference_fem/enthalpy/heat_sources.h>
#include <reference_fem/enthalpy/options.h>
#include <reference_fem/enthalpy/run.h>
#include <reference_fem/enthalpy/time_scheme.h>
#include <reference_fem/enthalpy/truncated_newton.h>
#include <reference_fem/enthalpy/volumetric_source.h>
#include <reference_fem/enthalpy/wall_exchange.h>
#include <reference_fem/enthalpy/wall_flux.h>
#include <reference_fem/enthalpy/wall_temperature.h>

#include <deal.II/base/mpi.h>

#include <memory>
#include <optional>
#include <vector>

namespace meltfront::reference_fem
{
  /** What fem-enthalpy takes on several ranks. */
  cases::Capabilities rank_capabilities();

  /** About how many bytes a run takes on all ranks together. */
  double rank_bytes(int dimension, double nodes, int ranks);

  /**
   * A run of fem-enthalpy on several ranks, or by the same engine on one: the scheme of
   * EnthalpyRun, on a mesh that the ranks share. All ranks make, take and end it at the
   * same time, and what it throws by its own judgement it throws on all of them.
   *
   * Its snapshots hold a rank's part: see cases::RankPart.
   */
  class RankRun : public cases::SharedRun
  {
  public:
    RankRun(const cases::Scene &scene, const cases::EffectSet &effects,
            const cases::Resolution &resolution, int ranks);

    cases::RankPart part() const override
    {
      return {enthalpy.size(), site_numbers};
    }

    bool takes_over_times() const override
    {
      return takes_over;
    }

    // In rank_report.cc:
    cases::RunDescription describe() const override;
    cases::Cost cost() const override;

    const StepStatistics &worst_of_steps() const
    {
      return statistics;
    }

  private:
    void take_steps() override;
    void require_resumable() const; // this and the next in rank_state.cc
    void save(boost::archive::binary_oarchive &state) const override;
    void restore(boost::archive::binary_iarchive &state) override;
    template <class Archive>
    void pass_common_state(Archive &state);
    std::vector<std::vector<double> *> state_of_nodes();
    cases::Snapshot snapshot(long step, double time) override; // in rank_report.cc

    /** What a quantity that is summed over time was at the last two times. */
    struct History
    {
      double now = 0, before = 0;

      template <class Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &now &before;
      }
    };

    StepProblem problem();
    StepFormula formula(double next) const;
    bool continues() const;
    StepOutcome attempt(const StepFormula &step);
    StepOutcome solve(StepFormula &step);
    void accept(const StepFormula &step);
    void require_halvable(const StepFormula &step, const StepOutcome &outcome) const;
    void check_temperatures(const StepFormula &step) const;
    bool keeps_bounds(const StepFormula &step) const;
    void check_balance();
    double sum_of_ranks(double own) const;
    /** Over all nodes of all ranks, with their volumes. */
    template <typename Value>
    double total(const Value &value) const;
    double source_heat() const;
    double nominal_step() const;
    double latent_heat(std::size_t node) const;
    std::vector<cases::EffectCost> effect_costs_of_rank() const;
    std::vector<cases::EffectCost> effect_costs() const;

    /** What this rank's part of a run cost before it was resumed. */
    struct Earlier
    {
      long work = 0, linear_iterations = 0;
      std::vector<cases::EffectCost> effects;

      template <class Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &work &linear_iterations &effects;
      }
    };
    Earlier costs_so_far() const;
    void take_costs(const Earlier &left, const Traffic &traffic_of_part,
                    unsigned int rank_of_part);

    const cases::Scene &scene;
    const cases::EffectSet &effects;
    RunOptions options;
    int n_ranks;
    MPI_Comm communicator;
    cases::TemperatureBounds bounds;
    double time, time_before;
    std::vector<double> breakpoints; ///< of the scene, at which steps end (s)
    StepQueue queue;

    Discretisation mesh;
    std::vector<std::uint64_t> site_numbers;
    std::uint64_t n_nodes = 0, n_free = 0; ///< of all ranks
    mutable Traffic traffic;
    std::vector<RankLevel> levels;
    std::vector<char> free;
    LinearSolver *linear_solver = nullptr;
    std::unique_ptr<NonlinearSolver> solver;
    std::optional<HeatSources> sources;
    std::optional<VolumetricSource> release;
    std::optional<WallTemperature> walls;
    std::optional<WallFlux> flux;
    std::optional<WallExchange> exchange;

    CompensatedVector u, u_accepted;               ///< with ghosts, W/m
    std::vector<double> u_before;                  ///< the same, rounded
    std::vector<double> enthalpy, enthalpy_before; ///< of own nodes, J/m^3
    std::vector<double> rhs, heat;                 ///< of own nodes, J
    History boundary_heat, released_heat;
    double step_flux_heat = 0;     ///< what the flux walls bring in the step under way
    double step_released_heat = 0; ///< what is released throughout the domain in it
    double initial_heat = 0;
    double defect = 0; ///< heat at hand less heat received (J)
    long step_number = 0, iterations = 0, capped_steps = 0;
    StepStatistics statistics;
    Earlier earlier;
    long parts_restored = 0;
    bool takes_over = true; ///< see takes_over_times()
    std::vector<double> site_temperature, site_solid_fraction;
  };

  template <typename Value>
  double RankRun::total(const Value &value) const
  {
    // The rest beyond a double goes along: the balance is kept to 1e-13.
    long double own = 0;
    for(std::size_t i = 0; i < mesh.volume.size(); ++i)
      own += static_cast<long double>(mesh.volume[i]) * value(i);
    std::vector<double> parts{static_cast<double>(own), 0};
    parts[1] = static_cast<double>(own - static_cast<long double>(parts[0]));
    dealii::Utilities::MPI::sum(parts, communicator, parts);
    ++traffic.reductions;
    return parts[0] + parts[1];
  }
} // namespace meltfront::reference_fem

#endif
