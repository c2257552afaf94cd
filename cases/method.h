#ifndef meltfront_cases_method_h
#define meltfront_cases_method_h

#include <cases/capabilities.h>
#include <cases/effects.h>
#include <cases/options.h>
#include <cases/snapshot.h>

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace meltfront::cases
{
  class Run;
  struct Scene;
  enum class Side;

  /** How finely, and with which values of its options, a method is to solve a scene. */
  struct Resolution
  {
    int n = 40; ///< particles or cells along the domain's side
    Options options;
    std::uint64_t seed = 1; ///< for jittered or random arrangements
    int threads = 1;
    /** Most memory that the run may take (bytes); what is estimated to take more is
     * refused. */
    double memory_limit = std::numeric_limits<double>::infinity();
  };

  /** What a run is going to take, estimated before anything is allocated. */
  struct Demand
  {
    double bytes = 0; ///< memory at its peak; 0: not known
    double steps = 0; ///< time steps; 0: not known
  };

  /** Steps beyond these are refused. The shortest take some microseconds: so many are
   * minutes of the smallest run, and weeks of one with ten thousand unknowns. */
  inline constexpr double most_steps = 5e7;

  /** A parameter that a run used, as the report prints it. */
  struct Parameter
  {
    std::string name;
    std::string value;
    std::string unit;
  };

  /** What a run is going to do, known once its set-up is complete. */
  struct RunDescription
  {
    int dimension = 1; ///< in which the scene is simulated
    double spacing
        = 0; ///< particle spacing or cell size (m): the h of convergence tables
    double resolved_width
        = 0; ///< of the narrowest walls that finer cells resolve (m), 0: the spacing
    double node_distance
        = 0; ///< largest of neighbouring nodes in a cell (m), 0: the spacing
    double smoothing_length = 0; ///< of the particles' kernel (m), 0 for a mesh
    double time_step = 0;        ///< of a full step (s)
    long unknowns = 0;
    std::vector<Parameter> parameters; ///< the scheme in words and numbers
  };

  /** Keeps states of a run, so that it can be taken up where it was left. */
  class StateKeeper
  {
  public:
    virtual ~StateKeeper() = default;

    /** The state that the run is to go on from, as offer() was given it; null: it begins
     * at its start. */
    virtual std::unique_ptr<std::istream> state_to_resume() = 0;

    /** Called after every step but the last. @param save writes the state reached */
    virtual void offer(long step, double time,
                       const std::function<void(std::ostream &)> &save)
        = 0;
  };

  /** Who receives snapshots. */
  class Observer
  {
  public:
    virtual ~Observer() = default;

    /** Called once, after set-up and before the first snapshot. */
    virtual void begin(const RunDescription &)
    {
    }

    /**
     * Whether a snapshot is wanted of the state after a step (step 0 is the initial
     * state). Methods ask after every step, at the step's own time, and assemble a
     * snapshot only when told to.
     */
    virtual bool wants(long step, double time) = 0;

    /** The times of which snapshots are wanted whatever the steps are (s), ascending, the
     * start and the end among them: for a method that has to name its times beforehand.
     * Empty: of the start and the end. */
    virtual std::vector<double> wanted_times() const
    {
      return {};
    }

    virtual void observe(const Snapshot &snapshot) = 0;

    /** Something that happened between snapshots, at its own time (s): a phase appeared
     * or vanished, a mesh was made anew. One clause. */
    virtual void note(double time, const std::string &event)
    {
      static_cast<void>(time);
      static_cast<void>(event);
    }

    /**
     * What only the method could count: when the first bond of a particle solid broke,
     * how many markers were seeded. It becomes a quantity of the run.
     * @param name one of reported_scalars(), cases/reported_scalars.h
     */
    virtual void report(const std::string &name, double value)
    {
      static_cast<void>(name);
      static_cast<void>(value);
    }

    /** Who keeps states of the run, or null. */
    virtual StateKeeper *state_keeper()
    {
      return nullptr;
    }
  };

  /** What one effect cost in a run. */
  struct EffectCost
  {
    Effect effect;
    long calls = 0;     ///< times that its code was entered
    long bytes = 0;     ///< memory allocated for it
    double seconds = 0; ///< wall time spent in it, set-up and stepping
  };

  /** What a run cost. Times exclude the observer's. */
  struct Cost
  {
    double setup_wall = 0;    ///< s
    double setup_cpu = 0;     ///< s, all threads
    double stepping_wall = 0; ///< s
    double stepping_cpu = 0;  ///< s, all threads
    long steps = 0;
    long unknowns = 0;
    long work = 0; ///< interactions or matrix entries touched; deterministic
    long solver_iterations
        = 0; ///< nonlinear or linear iterations, as the method's README says
    long most_iterations = 0;        ///< nonlinear iterations of the step with the most
    long capped_steps = 0;           ///< steps whose solver met its iteration limit
    std::vector<EffectCost> effects; ///< of the effects that are on
    /** What a method counted of its own doings, by a name in plain words: `steps divided
     * in two`, `steps that fell back to backward Euler`. */
    std::map<std::string, double> evidence;
  };

  /** An algorithm that solves scenes. */
  class Method
  {
  public:
    virtual ~Method() = default;

    /** The word that a user types. */
    const std::string &name() const
    {
      return its_name;
    }

    /** One sentence. */
    const std::string &summary() const
    {
      return its_summary;
    }

    /** Name of the method of which this is the form as published (`sph` for `sph-2005`),
     * or empty. */
    const std::string &corrected_form() const
    {
      return its_corrected_form;
    }

    /** What the method takes: one entry, or one for each of its forms, of which the first
     * that takes a scene is meant. All else is refused. */
    virtual std::vector<Capabilities> capabilities() const = 0;

    /**
     * The same of a method whose options tell what it takes; capabilities() are then
     * none.
     * @param options all of the method's, or none at all: the defaults
     */
    virtual std::vector<Capabilities> capabilities_with(const Options &options) const
    {
      static_cast<void>(options);
      return capabilities();
    }

    virtual std::vector<OptionDeclaration> option_declarations() const = 0;

    /** What a run depends on beside the program, the scene and the options themselves, by
     * a name: the hash of a file that an option names. */
    virtual std::map<std::string, std::string>
    further_provenance(const Options &options) const
    {
      static_cast<void>(options);
      return {};
    }

    /**
     * Solve a scene from its start to its end time, handing snapshots to the observer:
     * the initial state (step 0), any step that the observer wants, and the end (reached
     * exactly). Of a steady scene there is one snapshot: step 1, at the end time.
     *
     * The scene comes from simulated_scene(); `effects` is the set it was made with. A
     * resolution without options gets the declared defaults.
     *
     * @throws Refusal if the scene is not within the method's capabilities, if the run
     * would take more memory or steps than there may be, or if the method cannot treat an
     * option's value correctly,
     * @throws NumericalError at the step where a value is not finite or breaks a bound.
     */
    Cost solve(const Scene &scene, const EffectSet &effects, const Resolution &resolution,
               Observer &observer) const;

    /** Memory and steps that a run is going to take, at least in order of magnitude; by
     * default nothing is known. Allocates nothing. */
    virtual Demand demand(const Scene &scene, const EffectSet &effects,
                          const Resolution &resolution) const;

    /**
     * Distance along a wall (m) of the nodes or particles that take what it gives: what
     * jumps there comes to them as its mean over that distance (with_means_of_jumps()).
     * By default the domain's side over n.
     */
    virtual double spacing_along_wall(const Scene &scene, Side side,
                                      const Resolution &resolution) const;

  protected:
    Method(std::string name, std::string summary, std::string corrected_form = {})
      : its_name(std::move(name))
      , its_summary(std::move(summary))
      , its_corrected_form(std::move(corrected_form))
    {
    }

    /** A run of a scene within the capabilities, with all options, which the scene,
     * effects and resolution outlive. A method builds only what these effects need. */
    virtual std::unique_ptr<Run> set_up(const Scene &scene, const EffectSet &effects,
                                        const Resolution &resolution) const = 0;

  private:
    std::string its_name, its_summary, its_corrected_form;
  };

  /** The capabilities of the form of a method that takes a scene.
   * @param options of the method; none at all: the defaults
   * @throws Refusal in one sentence if none does. */
  Capabilities require_capable(const Method &method, const Scene &scene,
                               const EffectSet &effects, int threads,
                               const Options &options = {});

  /** @throws Refusal with the estimate if a run takes more than it may. */
  void require_affordable(const Method &method, const Demand &demand,
                          double memory_limit);
} // namespace meltfront::cases

#endif
