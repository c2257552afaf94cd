#include <cases/demand.h>
#include <cases/error.h>
#include <particles/moab_integral/integral_problem.h>
#include <particles/moab_integral/moab_integral.h>
#include <particles/relaxation/relax_nodes.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles
{
  namespace
  {
    constexpr const char *method_name = "moab-integral";

    /** Beside a jump at a wall that no kernel resolves yet: 0.21, 0.012, 3e-11 at n = 10,
     * 20, 40 in a slab whose wall is switched from 0 to 1, 0.07, 0.06 at n = 20, 32 where
     * heat is exchanged with an ambient temperature far off. */
    constexpr cases::Overshoot overshoot{0.16, 0.5};

    struct IntegralOptions
    {
      void bind(cases::OptionBinder &options);

      IntegralParameters parameters{.dilation = 0};
      NodeArrangement arrangement = NodeArrangement::lattice;
      double jitter = 0.2;
      LinearOptions linear{};
    };

    /** Every kernel with a Laplacian. */
    cases::Words<KernelShape> kernels_with_laplacian()
    {
      cases::Words<KernelShape> words;
      for(const std::string &name : kernel_names())
        if(name != kernel_name(KernelShape::hat))
          words.emplace_back(name, kernel_shape(name));
      return words;
    }

    void IntegralOptions::bind(cases::OptionBinder &options)
    {
      options.add("kernel", parameters.kernel, "Shape of the kernel.",
                  kernels_with_laplacian());
      options.add(
          "weights", parameters.weights,
          "Weights of the particles: a set for each integral; one set with (3.13) and "
          "(3.14) of Erickson et al. 2016; one with (3.13) alone; or their volumes.",
          cases::in_order<WeightPolicy>(weight_policy_names()));
      options.add("constraint_order", parameters.order,
                  "Degree of the polynomials for which rows are exact.", 3, 4);
      options.add("dilation", parameters.dilation,
                  "Radius of the kernel over the spacing; 0: 2.5 on a line; in the plane "
                  "2.6, with walls of given flux 3.5, and 3.5 and 4.5 for constraint "
                  "order 4.",
                  0, 20);
      options.add("support", parameters.enlarge,
                  "Enlarge the dilation where constraints cannot be met, or meet them as "
                  "well as the dilation allows.",
                  {{"enlarged", true}, {"fixed", false}});
      options.add("moments", parameters.sampled_moments,
                  "Moments of the kernel: integrals, or sums over the particles.",
                  {{"exact", false}, {"sampled", true}});
      options.add("arrangement", arrangement, "How the inner particles are arranged.",
                  cases::in_order<NodeArrangement>(arrangement_names()));
      options.add("jitter", jitter,
                  "Largest displacement of jittered particles over the spacing, in each "
                  "direction.",
                  0, 0.5);
      linear.bind(options);
    }

    /** The smallest that is good on displaced particles, too, measured; rows at walls
     * whose flux is given see half a disk and need more. */
    double default_dilation(int dimension, int order, bool with_flux)
    {
      if(dimension == 1)
        return 2.5;
      return (order < 4 ? 2.6 : 3.5) + (with_flux ? order < 4 ? 0.9 : 1 : 0);
    }

    bool has_flux_walls(const cases::Scene &scene)
    {
      return std::ranges::any_of(scene.sides(),
                                 [&](cases::Side side) {
                                   return scene.boundary(side).kind
                                          != cases::BoundaryKind::fixed_temperature;
                                 });
    }

    IntegralOptions options_for(const cases::Scene &scene,
                                const cases::Resolution &resolution)
    {
      auto options = cases::read_options(IntegralOptions(), resolution.options);
      IntegralParameters &parameters = options.parameters;
      if(parameters.dilation == 0)
        parameters.dilation = default_dilation(scene.domain.dimension, parameters.order,
                                               has_flux_walls(scene));
      parameters.threads = resolution.threads;
      return options;
    }

    class MoabIntegral : public cases::Method
    {
    public:
      MoabIntegral()
        : Method(method_name, "Conduction integrated twice by parts against a kernel, "
                              "sums over particles in place of the integrals, with "
                              "weights that make each sum exact for polynomials.")
      {
      }

      std::vector<cases::Capabilities> capabilities() const override
      {
        using cases::BoundaryKind, cases::DomainShape, cases::Effect;
        const std::vector<BoundaryKind> walls{
            BoundaryKind::insulated, BoundaryKind::fixed_temperature, BoundaryKind::flux,
            BoundaryKind::heat_transfer};
        return {
            {.form = {},
             .problems = {cases::ProblemKind::stefan, cases::ProblemKind::poisson},
             .effects = {Effect::volumetric_source, Effect::wall_temperature,
                         Effect::wall_flux, Effect::robin_wall},
             .shapes = {{DomainShape::slab, {1}, walls}, {DomainShape::box, {2}, walls}},
             .front_origins = {cases::FrontOrigin::none},
             .most_threads = cases::any_number_of_threads,
             .overshoot = overshoot}};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cases::options_of(IntegralOptions());
      }

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &,
                           const cases::Resolution &resolution) const override
      {
        const int dimension = scene.domain.dimension;
        return linear_demand(
            scene, resolution,
            {.nodes = cases::lattice_points(scene.domain, dimension, resolution.n),
             .entries = cases::points_within(
                 dimension, options_for(scene, resolution).parameters.dilation),
             .matrices = 8,
             .per_node = 500});
      }

      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution) const override;
    };

    class IntegralOnNodes : public PosedProblem
    {
    public:
      IntegralOnNodes(const cases::Scene &scene, const cases::Resolution &resolution)
        : dimension(scene.domain.dimension)
        , options(options_for(scene, resolution))
        , nodes(arrange_nodes(scene, resolution.n - 1, options.arrangement,
                              options.jitter, resolution.seed, method_name,
                              [&scene](NodeSet &set) { relax_inner_nodes(set, scene); }))
        , problem(scene, nodes, options.parameters)
      {
      }

      const LinearProblem &linear() const override
      {
        return problem.linear();
      }

      LinearSites sites() const override
      {
        return sites_of(nodes, dimension, nodes.weights);
      }

      LinearDescription description() const override
      {
        LinearDescription result;
        result.method = method_name;
        result.overshoot = overshoot;
        result.run.dimension = dimension;
        result.run.spacing = nodes.spacing;
        result.run.smoothing_length = problem.dilation();
        result.run.parameters = problem.describe();
        result.setup_work = problem.work();
        return result;
      }

      std::vector<cases::EffectCost>
      effect_costs(const cases::EffectSet &effects) const override
      {
        return problem.effect_costs(effects);
      }

    private:
      int dimension;
      IntegralOptions options;
      NodeSet nodes;
      IntegralProblem problem;
    };

    std::unique_ptr<cases::Run>
    MoabIntegral::set_up(const cases::Scene &scene, const cases::EffectSet &effects,
                         const cases::Resolution &resolution) const
    {
      return make_linear_run(scene, effects,
                             std::make_unique<IntegralOnNodes>(scene, resolution),
                             resolution);
    }
  } // namespace

  std::unique_ptr<cases::Method> make_moab_integral()
  {
    return std::make_unique<MoabIntegral>();
  }
} // namespace meltfront::particles
