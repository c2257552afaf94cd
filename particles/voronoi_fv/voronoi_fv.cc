#include <cases/demand.h>
#include <cases/error.h>
#include <cases/overshoot.h>
#include <cases/scene.h>
#include <particles/relaxation/relax_nodes.h>
#include <particles/voronoi_fv/cell_conduction.h>
#include <particles/voronoi_fv/voronoi_fv.h>

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

    struct VoronoiOptions
    {
      void bind(cases::OptionBinder &options);

      std::string arrangement = "relaxed";
      double jitter = 0.2;
      double length_over_spacing = 1;
      LennardJonesRelaxation relaxation;
      long sweeps = 20;
      std::string source = "centroid";
      LinearOptions linear;
    };

    void VoronoiOptions::bind(cases::OptionBinder &options)
    {
      options.add(
          "arrangement", arrangement,
          "Where the n particles along a side inside the walls are (spacing 1/(n + 1) "
          "of the side): on a lattice, displaced from it, at random, or moved from "
          "there to a minimum of the Lennard-Jones energy or by Lloyd's sweeps.",
          cases::themselves({"lattice", "jittered", "random", "relaxed", "lloyd"}));
      options.add("jitter", jitter,
                  "Largest displacement from the lattice over its spacing, if jittered.",
                  0, 0.5);
      options.add("length_over_spacing", length_over_spacing,
                  "Length sigma of the Lennard-Jones potential over the spacing of the "
                  "lattice; below 0.95 voids remain.",
                  0.5, 2);
      options.add("relaxation_tolerance", relaxation.tolerance,
                  "Relative change of the Lennard-Jones energy in an iteration at which "
                  "the relaxation stops.",
                  1e-16, 1);
      options.add("relaxation_fall", relaxation.least_fall,
                  "Fall of the Lennard-Jones energy per particle in 100 iterations, over "
                  "epsilon, below which the relaxation stops too; 0: not.",
                  0, 1);
      options.add("relaxation_iterations", relaxation.most_iterations,
                  "Most iterations of the relaxation by conjugate gradients.", 0, 1e9);
      options.add("sweeps", sweeps, "Lloyd's sweeps.", 0, 1e6);
      options.add("source", source,
                  "Where the heat released in a cell is evaluated: at its particle (as "
                  "published) or at its centroid.",
                  cases::themselves({"particle", "centroid"}));
      linear.bind(options);
    }

    NodeArrangement start_of(const std::string &arrangement)
    {
      if(arrangement == "lattice")
        return NodeArrangement::lattice;
      return arrangement == "jittered" ? NodeArrangement::jittered
                                       : NodeArrangement::random;
    }

    Arranged arrange(const cases::Scene &scene, const VoronoiOptions &options,
                     const cases::Resolution &resolution)
    {
      // A conductivity that jumps is met by the cells, not by moving particles onto it.
      cases::Scene uniform = scene;
      uniform.inclusion.reset();
      Arranged result;
      result.nodes
          = arrange_nodes(uniform, resolution.n + 1, start_of(options.arrangement),
                          options.jitter, resolution.seed, method_name);
      result.parameters.push_back({"arrangement", options.arrangement, ""});
      if(options.arrangement == "relaxed")
      {
        LennardJonesRelaxation relaxation = options.relaxation;
        relaxation.threads = resolution.threads;
        const double factor = options.length_over_spacing;
        const Descent descent
            = relax_inner_nodes(result.nodes, scene.domain, relaxation, factor);
        describe(descent, relaxation, factor * result.nodes.spacing, result.parameters);
      }
      if(options.arrangement == "lloyd")
      {
        lloyd(result.nodes.positions, result.nodes.inner, coordinate_box(scene.domain),
              static_cast<int>(options.sweeps));
        result.parameters.push_back(
            {"Lloyd sweeps", std::to_string(options.sweeps), "1"});
      }
      return result;
    }

    class CellsOnNodes : public PosedProblem
    {
    public:
      CellsOnNodes(const cases::Scene &scene, const cases::Resolution &resolution)
        : dimension(scene.domain.dimension)
        , options(cases::read_options(VoronoiOptions(), resolution.options))
        , arranged(arrange(scene, options, resolution))
        , conduction(
              scene, arranged.nodes,
              voronoi_cells(arranged.nodes.positions, coordinate_box(scene.domain)),
              options.source == "particle" ? SourcePoint::particle
                                           : SourcePoint::centroid)
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
        result.run.parameters.push_back({"volumetric source at", options.source, ""});
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
      VoronoiOptions options;
      Arranged arranged;
      CellConduction conduction;
      LinearProblem problem;
    };

    class VoronoiFv : public cases::Method
    {
    public:
      VoronoiFv()
        : Method(method_name, "Finite volumes on the Voronoi cells of n particles along "
                              "a side inside the walls, relaxed by a Lennard-Jones "
                              "surrogate energy (Erickson et al. 2016, chapter 5).")
      {
      }

      std::vector<cases::Capabilities> capabilities() const override
      {
        using cases::BoundaryKind, cases::DomainShape, cases::Effect;
        const std::vector<BoundaryKind> walls{
            BoundaryKind::insulated, BoundaryKind::fixed_temperature, BoundaryKind::flux,
            BoundaryKind::heat_transfer};
        return {{.form = {},
                 .problems = {cases::ProblemKind::stefan, cases::ProblemKind::poisson},
                 .effects = {Effect::volumetric_source, Effect::wall_temperature,
                             Effect::wall_flux, Effect::robin_wall, Effect::inclusion},
                 .shapes
                 = {{DomainShape::slab, {1}, walls}, {DomainShape::box, {2, 3}, walls}},
                 .front_origins = {cases::FrontOrigin::none},
                 .most_threads = cases::any_number_of_threads,
                 .overshoot = allowed_overshoot}};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cases::options_of(VoronoiOptions());
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
