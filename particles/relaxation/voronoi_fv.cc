#include <cases/demand.h>
#include <cases/error.h>
#include <cases/overshoot.h>
#include <cases/scene.h>
#include <particles/relaxation/cell_conduction.h>
#include <particles/relaxation/relax_nodes.h>
#include <particles/relaxation/voronoi_fv.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    using cases::Effect;

    const std::string method_name = "voronoi-fv";

    /** Of Crank-Nicolson and BDF2. */
    constexpr cases::Overshoot allowed_overshoot{0.01, 1};

    /** How the particles inside were placed, with what the relaxation says of itself. */
    struct Arranged
    {
      NodeSet nodes;
      std::vector<cases::Parameter> parameters;
    };

    void describe(const Descent &descent, const LennardJonesRelaxation &relaxation,
                  double length, std::vector<cases::Parameter> &parameters)
    {
      const double scale = relaxation.potential.energy;
      const auto add = [&](const char *name, const std::string &value, const char *unit) {
        parameters.push_back({name, value, unit});
      };
      add("length of the potential", fmt::format("{:.6g}", length), "m");
      add("iterations of the relaxation", std::to_string(descent.iterations), "1");
      add("evaluations of its energy", std::to_string(descent.evaluations), "1");
      add("relaxation", descent.converged ? "converged" : "stopped", "");
      add("surrogate energy at the start, over epsilon",
          fmt::format("{:.4g}", descent.energy_before / scale), "1");
      add("surrogate energy at the end, over epsilon",
          fmt::format("{:.8g}", descent.energy / scale), "1");
      add("largest force at the end, over epsilon / sigma",
          fmt::format("{:.3g}", descent.largest_force * length / scale), "1");
    }

    NodeArrangement start_of(const std::string &arrangement)
    {
      if(arrangement == "lattice")
        return NodeArrangement::lattice;
      return arrangement == "jittered" ? NodeArrangement::jittered
                                       : NodeArrangement::random;
    }

    Arranged arrange(const cases::Scene &scene, const cases::Resolution &resolution)
    {
      const cases::Options &options = resolution.options;
      const std::string &arrangement = options.get_string("arrangement");
      // A conductivity that jumps is met by the cells, not by moving particles onto it.
      cases::Scene uniform = scene;
      uniform.inclusion.reset();
      Arranged result;
      result.nodes
          = arrange_nodes(uniform, resolution.n + 1, start_of(arrangement),
                          options.get_double("jitter"), resolution.seed, method_name);
      result.parameters.push_back({"arrangement", arrangement, ""});
      if(arrangement == "relaxed")
      {
        LennardJonesRelaxation relaxation;
        relaxation.threads = resolution.threads;
        relaxation.tolerance = options.get_double("relaxation_tolerance");
        relaxation.least_fall = options.get_double("relaxation_fall");
        relaxation.most_iterations = options.get_integer("relaxation_iterations");
        const double factor = options.get_double("length_over_spacing");
        const Descent descent
            = relax_inner_nodes(result.nodes, scene.domain, relaxation, factor);
        describe(descent, relaxation, factor * result.nodes.spacing, result.parameters);
      }
      if(arrangement == "lloyd")
      {
        const long sweeps = options.get_integer("sweeps");
        lloyd(result.nodes.positions, result.nodes.inner, coordinate_box(scene.domain),
              static_cast<int>(sweeps));
        result.parameters.push_back({"Lloyd sweeps", std::to_string(sweeps), "1"});
      }
      return result;
    }

    std::vector<cases::OptionDeclaration> arrangement_options()
    {
      return {
          {"arrangement",
           "",
           std::string("relaxed"),
           "Where the n particles along a side inside the walls are (spacing 1/(n + 1) "
           "of the side): on a lattice, displaced from it, at random, or moved from "
           "there to a minimum of the Lennard-Jones energy or by Lloyd's sweeps.",
           0,
           0,
           {"lattice", "jittered", "random", "relaxed", "lloyd"}},
          {"jitter", "1", 0.2,
           "Largest displacement from the lattice over its spacing, if jittered.", 0,
           0.5},
          {"length_over_spacing", "1", 1.,
           "Length sigma of the Lennard-Jones potential over the spacing of the "
           "lattice; below 0.95 voids remain.",
           0.5, 2},
          {"relaxation_tolerance", "1", 1e-12,
           "Relative change of the Lennard-Jones energy in an iteration at which the "
           "relaxation stops.",
           1e-16, 1},
          {"relaxation_fall", "1", LennardJonesRelaxation().least_fall,
           "Fall of the Lennard-Jones energy per particle in 100 iterations, over "
           "epsilon, below which the relaxation stops too; 0: not.",
           0, 1},
          {"relaxation_iterations", "1", 200000L,
           "Most iterations of the relaxation by conjugate gradients.", 0, 1e9},
          {"sweeps", "1", 20L, "Lloyd's sweeps.", 0, 1e6},
          {"source",
           "",
           std::string("centroid"),
           "Where the heat released in a cell is evaluated: at its particle (as "
           "published) or at its centroid.",
           0,
           0,
           {"particle", "centroid"}}};
    }

    class CellsOnNodes : public PosedProblem
    {
    public:
      CellsOnNodes(const cases::Scene &scene, const cases::Resolution &resolution)
        : dimension(scene.domain.dimension)
        , source(resolution.options.get_string("source"))
        , arranged(arrange(scene, resolution))
        , conduction(
              scene, arranged.nodes,
              voronoi_cells(arranged.nodes.positions, coordinate_box(scene.domain)),
              source == "particle" ? SourcePoint::particle : SourcePoint::centroid)
        , problem(conduction.problem())
      {
      }

      const LinearProblem &linear() const override
      {
        return problem;
      }

      LinearSites sites() const override
      {
        return sites_of(arranged.nodes, dimension, conduction.weights());
      }

      LinearDescription description() const override
      {
        LinearDescription result;
        result.method = method_name;
        result.run.dimension = dimension;
        result.run.spacing = arranged.nodes.spacing;
        result.run.parameters = arranged.parameters;
        result.run.parameters.push_back({"heat release at", source, ""});
        result.obeys_maximum_principle = true;
        result.overshoot = allowed_overshoot;
        result.setup_work = static_cast<long>(problem.operator_rows.size());
        return result;
      }

      std::vector<cases::EffectCost>
      effect_costs(const cases::EffectSet &effects) const override
      {
        return conduction.effect_costs(effects);
      }

    private:
      int dimension;
      std::string source;
      Arranged arranged;
      CellConduction conduction;
      LinearProblem problem;
    };

    class VoronoiFv : public cases::Method
    {
    public:
      std::string name() const override
      {
        return method_name;
      }

      std::string summary() const override
      {
        return "Finite volumes on the Voronoi cells of n particles along a side inside "
               "the "
               "walls, relaxed by a Lennard-Jones surrogate energy (Erickson et al. "
               "2016, "
               "chapter 5).";
      }

      std::vector<cases::Capabilities> capabilities() const override
      {
        using cases::BoundaryKind, cases::DomainShape, cases::Effect;
        const std::vector<BoundaryKind> walls{
            BoundaryKind::insulated, BoundaryKind::fixed_temperature, BoundaryKind::flux,
            BoundaryKind::heat_transfer};
        return {{.form = {},
                 .problems = {cases::ProblemKind::stefan, cases::ProblemKind::poisson},
                 .effects = {Effect::heat_release, Effect::wall_temperature,
                             Effect::wall_flux, Effect::wall_transfer, Effect::inclusion},
                 .shapes
                 = {{DomainShape::slab, {1}, walls}, {DomainShape::box, {2, 3}, walls}},
                 .front_origins = {cases::FrontOrigin::none},
                 .most_threads = cases::any_number_of_threads,
                 .overshoot = allowed_overshoot}};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        std::vector<cases::OptionDeclaration> result = arrangement_options();
        std::ranges::move(linear_options(), std::back_inserter(result));
        return result;
      }

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &,
                           const cases::Resolution &resolution) const override
      {
        const int dimension = scene.domain.dimension;
        // A cell, its neighbours and the faces between them.
        constexpr double entries[] = {0, 3, 7, 16};
        return linear_demand(
            scene, resolution,
            {.nodes = cases::lattice_points(scene.domain, dimension, resolution.n),
             .entries = entries[dimension],
             .matrices = 4,
             .per_node = 1000});
      }

    private:
      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution) const override
      {
        return make_linear_run(scene, effects,
                               std::make_unique<CellsOnNodes>(scene, resolution),
                               resolution);
      }
    };
  } // namespace

  std::unique_ptr<cases::Method> make_voronoi_fv()
  {
    return std::make_unique<VoronoiFv>();
  }
} // namespace meltfront::particles
