#ifndef meltfront_reference_fem_fitted_run_h
#define meltfront_reference_fem_fitted_run_h

#include <cases/run.h>
#include <reference_fem/fitted/events/timeline.h>
#include <reference_fem/fitted/fitted_problem.h>
#include <reference_fem/fitted/setup.h>
#include <reference_fem/fitted/sites.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** A run of `fem-fitted`; in one dimension also from one phase, and on to the end of
   * one. */
  class FittedRun : public cases::Run
  {
  public:
    FittedRun(const cases::Scene &scene, const cases::EffectSet &effects,
              const cases::Resolution &resolution);

    cases::RunDescription describe() const override; // in run_report.cc
    cases::Cost cost() const override;               // in run_report.cc

  private:
    void take_steps() override;
    cases::Snapshot snapshot(long step, double time) override; // in run_report.cc
    IntegrationOptions integration_options() const;
    void enter(const RunSegment &segment);
    double clock_step() const;
    void check_temperatures(long step, double time, const dealii::Vector<double> &u);
    std::vector<double> front_coordinates(const dealii::Vector<double> &u) const;
    void refuse_unresolved_layer(double time, const dealii::Vector<double> &u) const;
    /** Add what the present problem counted of each effect. */
    void add_effect_costs();
    std::map<std::string, double> evidence() const;

    const cases::Scene &scene;
    const cases::EffectSet &effects;
    const cases::Resolution &resolution;
    RunOptions options;
    cases::TemperatureBounds bounds;
    std::shared_ptr<FittedProblem> problem;
    std::unique_ptr<Sites> sites;
    dealii::Vector<double> initial_state;
    double initial_heat = 0;
    HeatContent before;                          ///< of meshes before the present one
    std::vector<cases::EffectCost> effect_costs; ///< of the effects that are on
    long events = 0;
    long most_unknowns = 0;
    IntegrationCost integration;
    double highest_mode = 0;    ///< of a cell at the end; see highest_modes()
    double front_before = 0;    ///< time of the state checked last (s)
    std::vector<double> fronts; ///< then, by front and ray (m)
    const dealii::Vector<double> *shown = nullptr; ///< the state to take a snapshot of
  };
} // namespace meltfront::reference_fem::fitted

#endif
