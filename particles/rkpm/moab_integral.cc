#include <cases/demand.h>
#include <cases/error.h>
#include <particles/relaxation/relax_nodes.h>
#include <particles/rkpm/integral_problem.h>
#include <particles/rkpm/moab_integral.h>
#include <particles/scattered/linear_choices.h>

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

    /** Every kernel with a Laplacian. */
    std::vector<std::string> kernels_with_laplacian()
    {
      std::vector<std::string> names = kernel_names();
      std::erase(names, kernel_name(KernelShape::hat));
      return names;
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

    IntegralParameters read_parameters(const cases::Scene &scene,
                                       const cases::Resolution &resolution)
    {
      const cases::Options &options = resolution.options;
      IntegralParameters parameters;
      parameters.kernel = kernel_shape(options.get_string("kernel"));
      parameters.weights
          = choice<WeightPolicy>(weight_policy_names(), options.get_string("weights"));
      parameters.order = static_cast<int>(options.get_integer("constraint_order"));
      parameters.dilation = options.get_double("dilation");
      if(parameters.dilation == 0)
        parameters.dilation = default_dilation(scene.domain.dimension, parameters.order,
                                               has_flux_walls(scene));
      parameters.enlarge = options.get_string("support") == "enlarged";
      parameters.sampled_moments = options.get_string("moments") == "sampled";
      parameters.threads = resolution.threads;
      return parameters;
    }

    class MoabIntegral : public cases::Method
    {
    public:
      std::string name() const override
      {
        return method_name;
      }

      std::string summary() const override
      {
        return "Conduction integrated twice by parts against a kernel, sums over "
               "particles "
               "in place of the integrals, with weights that make each sum exact for "
               "polynomials.";
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
             .effects = {Effect::heat_release, Effect::wall_temperature,
                         Effect::wall_flux, Effect::wall_transfer},
             .shapes = {{DomainShape::slab, {1}, walls}, {DomainShape::box, {2}, walls}},
             .front_origins = {cases::FrontOrigin::none},
             .most_threads = cases::any_number_of_threads,
             .overshoot = overshoot}};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override;

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &,
                           const cases::Resolution &resolution) const override
      {
        const int dimension = scene.domain.dimension;
        return linear_demand(
            scene, resolution,
            {.nodes = cases::lattice_points(scene.domain, dimension, resolution.n),
             .entries = cases::points_within(dimension,
                                             read_parameters(scene, resolution).dilation),
             .matrices = 8,
             .per_node = 500});
      }

      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution) const override;
    };

    std::vector<cases::OptionDeclaration> MoabIntegral::option_declarations() const
    {
      std::vector<cases::OptionDeclaration> options{
          {"kernel", "", std::string("wendland_c4"), "Shape of the kernel.", 0, 0,
           kernels_with_laplacian()},
          {"weights", "", std::string("separate"),
           "Weights of the particles: a set for each integral; one set with (3.13) and "
           "(3.14) of Erickson et al. 2016; one with (3.13) alone; or their volumes.",
           0, 0, weight_policy_names()},
          {"constraint_order", "1", 3L,
           "Degree of the polynomials for which rows are exact.", 3, 4},
          {"dilation", "1", 0.,
           "Radius of the kernel over the spacing; 0: 2.5 on a line; in the plane 2.6, "
           "with "
           "walls of given flux 3.5, and 3.5 and 4.5 for constraint order 4.",
           0, 20},
          {"support", "", std::string("enlarged"),
           "Enlarge the dilation where constraints cannot be met, or meet them as well "
           "as "
           "the dilation allows.",
           0, 0, std::vector<std::string>{"enlarged", "fixed"}},
          {"moments", "", std::string("exact"),
           "Moments of the kernel: integrals, or sums over the particles.", 0, 0,
           std::vector<std::string>{"exact", "sampled"}},
          {"arrangement", "", std::string("lattice"),
           "How the inner particles are arranged.", 0, 0, arrangement_names()},
          {"jitter", "1", 0.2,
           "Largest displacement of jittered particles over the spacing, in each "
           "direction.",
           0, 0.5}};
      for(const cases::OptionDeclaration &option : linear_options())
        options.push_back(option);
      return options;
    }

    class IntegralOnNodes : public PosedProblem
    {
    public:
      IntegralOnNodes(const cases::Scene &scene, const cases::Resolution &resolution)
        : dimension(scene.domain.dimension)
        , nodes(arrange_nodes(
              scene, resolution.n - 1,
              choice<NodeArrangement>(arrangement_names(),
                                      resolution.options.get_string("arrangement")),
              resolution.options.get_double("jitter"), resolution.seed, method_name,
              [&scene](NodeSet &set) { relax_inner_nodes(set, scene); }))
        , problem(scene, nodes, read_parameters(scene, resolution))
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
