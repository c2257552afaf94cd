#ifndef meltfront_verification_measure_measure_h
#define meltfront_verification_measure_measure_h

#include <cases/case.h>
#include <cases/method.h>
#include <verification/measure/formulas/front_reader.h>
#include <verification/measure/formulas/interface_error.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** In which cases a quantity has a column of the convergence table. */
  enum class Shown
  {
    nowhere,       ///< nor in the CSV: it stands in run.json and may be bounded
    always,        ///< where it has a value
    when_asked,    ///< where a criterion or a printed value names it
    without_exact, ///< where there is no exact solution, or when asked
    in_time        ///< where some label refines the time step
  };

  /** What the cost of a run is told from. */
  struct RunFigures
  {
    const cases::RunDescription &description;
    const cases::Cost &cost;
    double peak_memory_mb = 0;
  };

  /** A quantity: what criteria may bound, a column of tables and CSV. */
  struct Quantity
  {
    std::string name;      ///< in criteria, run.json and the CSV
    std::string heading{}; ///< of the table
    std::string unit{};    ///< SI; `volume`: m, m^2 or m^3
    bool error = false;    ///< it has an order, and its least value is the best
    bool whole = false;    ///< a count
    Shown shown = Shown::always;
    /** Columns of the CSV stand in the order of their ranks; the first ones, of rank 0
     * and 1, are promised to its readers. */
    int csv_rank = 2;
    int digits = 3;              ///< significant, in the table
    bool from_reference = false; ///< a difference from the case's reference run
    /** Runs are held against their case's reference: with `_error` and `_bars` behind the
     * name come the difference and the same in error bars. */
    bool compared = false;
    /** Of a quantity that is told from a run's cost, else null. */
    double (*of_run)(const RunFigures &) = nullptr;
  };

  /** One that has an order. */
  Quantity error_quantity(const std::string &name, const std::string &heading,
                          const std::string &unit, Shown shown = Shown::always,
                          int csv_rank = 2);

  /** One that has none. */
  Quantity value_quantity(const std::string &name, const std::string &heading,
                          const std::string &unit, Shown shown = Shown::always,
                          int csv_rank = 2);

  /** One that has no column. */
  Quantity hidden_quantity(const std::string &name);

  /** One that is told from a run's cost. */
  Quantity told(Quantity quantity, double (*of_run)(const RunFigures &));

  /** A quantity in which runs are held against their case's reference, its difference
   * and the same in error bars. */
  std::vector<Quantity> with_differences(Quantity quantity);

  /** A run that is to be measured. */
  struct MeasuredRun
  {
    const cases::Case &the_case;
    const cases::Scene &scene; ///< as it is simulated
    double spacing = 0;        ///< m
    /** Of a front that is carried along. */
    const InterfaceComparison *carried = nullptr;
  };

  /** A state of a run, with what all measures read of it; NaN where there is no such. */
  struct Sighting
  {
    const cases::Snapshot &snapshot;
    std::vector<int> intermediate_times{}; ///< of Measurement::intermediate_times that it
                                           ///< reaches, from 1
    bool at_end = false;                   ///< of the run
    bool in_series = false;                ///< one of the equidistant samples
    bool front_counts = false;             ///< in averages of the front's error over time
    const std::vector<double> *coordinates = nullptr; ///< of the sites (x or r, m)
    FrontReading front{};
    double exact_front = 0;            ///< m
    double solid_volume = 0;           ///< in the measure of the scene (m, m^2, m^3)
    double lowest = 0, highest = 0;    ///< temperatures of the sites
    cases::TemperatureBounds bounds{}; ///< of the maximum principle

    /** `_1` for each intermediate time that it reaches, and the given one at the end. */
    std::vector<std::string> suffixes(const std::string &end) const;
  };

  /** Results by name. */
  using Results = std::map<std::string, double>;

  /** Measures quantities of one run while it goes on. */
  class Measure
  {
  public:
    explicit Measure(const MeasuredRun &run)
      : run(run)
    {
    }

    virtual ~Measure() = default;

    /** Whether it is to watch the state after every step, beside the samples. */
    virtual bool wants_every_step() const
    {
      return false;
    }

    /** Any state that the method hands out, before it is judged. */
    virtual void watch(const cases::Snapshot &)
    {
    }

    /** A sample, or a state near an intermediate time or at the end. */
    virtual void observe(const Sighting &sighting) = 0;

    /** What is known so far. */
    virtual Results results() const
    {
      return values;
    }

  protected:
    void keep_largest(const std::string &name, double value);

    MeasuredRun run;
    Results values;
  };

  /** What scenes a measure is for. */
  enum class MeasuredScenes
  {
    with_heat, ///< its quantities are NaN where it knows nothing
    in_motion, ///< without heat: particle solids, fronts that are carried along
    none       ///< it needs nothing but the finished run
  };

  /** One line of the registry. */
  struct MeasureKind
  {
    std::vector<Quantity> quantities; ///< in the order of their columns
    MeasuredScenes scenes = MeasuredScenes::none;
    /** Begins to measure a run; null where the case asks for nothing of it. */
    std::unique_ptr<Measure> (*start)(const MeasuredRun &run) = nullptr;
  };

  /** @tparam Kind may have a function asked_for(run), else it is for all runs */
  template <typename Kind>
  std::unique_ptr<Measure> start(const MeasuredRun &run)
  {
    if constexpr(requires { Kind::asked_for(run); })
      if(!Kind::asked_for(run))
        return nullptr;
    return std::make_unique<Kind>(run);
  }

  /** All of them, in the order of the convergence table's columns. */
  const std::vector<MeasureKind> &measures();

  /** The measures of a run in scenes of a kind. */
  std::vector<std::unique_ptr<Measure>> measures_for(MeasuredScenes scenes,
                                                     const MeasuredRun &run);

  /** The quantities of all measures, in their order. */
  const std::vector<Quantity> &all_quantities();

  /** @throws InputError naming the nearest quantity where there is none of that name. */
  void require_quantity(const std::string &name);
} // namespace meltfront::verification

#endif
