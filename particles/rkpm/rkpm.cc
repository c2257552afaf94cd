#include <cases/demand.h>
#include <cases/scene.h>
#include <particles/relaxation/relax_nodes.h>
#include <particles/rkpm/rkpm.h>
#include <particles/rkpm/rkpm_problem.h>

namespace meltfront::particles
{
  namespace
  {
    using rkpm::RkpmPolicy;

    class RkpmOnNodes : public PosedProblem
    {
    public:
      RkpmOnNodes(const RkpmPolicy &policy, const cases::Scene &scene,
                  const cases::Resolution &resolution, const cases::Overshoot &overshoot)
        : policy(policy)
        , dimension(scene.domain.dimension)
        , overshoot(overshoot)
        , parameters(rkpm::read_parameters(policy, resolution.options, dimension))
        , nodes(arrange_nodes(scene, resolution.n - 1, parameters.arrangement,
                              parameters.jitter, resolution.seed, policy.name,
                              [&scene](NodeSet &set) { relax_inner_nodes(set, scene); }))
        , problem(scene, nodes, parameters, policy.name, resolution.threads)
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
        result.method = policy.name;
        result.overshoot = overshoot;
        result.run.dimension = dimension;
        result.run.spacing = nodes.spacing;
        result.run.smoothing_length = problem.mean_dilation();
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
      const RkpmPolicy &policy;
      int dimension;
      cases::Overshoot overshoot;
      rkpm::RkpmParameters parameters;
      NodeSet nodes;
      rkpm::RkpmProblem problem;
    };

    class RkpmMethod : public cases::Method
    {
    public:
      explicit RkpmMethod(const RkpmPolicy &policy)
        : Method(policy.name, policy.summary)
        , policy(policy)
      {
      }

      bool takes_inclusions() const
      {
        return policy.variant == rkpm::Variant::fixed_point
               || policy.variant == rkpm::Variant::derivative_free;
      }

      cases::Overshoot overshoot() const
      {
        return takes_inclusions() ? rkpm::overshoot_at_inclusions : rkpm::overshoot;
      }

      std::vector<cases::Capabilities> capabilities() const override
      {
        using cases::BoundaryKind, cases::DomainShape, cases::Effect;
        const std::vector<BoundaryKind> walls{
            BoundaryKind::insulated, BoundaryKind::fixed_temperature, BoundaryKind::flux,
            BoundaryKind::heat_transfer};
        std::vector<Effect> effects{Effect::volumetric_source, Effect::wall_temperature,
                                    Effect::wall_flux, Effect::robin_wall};
        // Where the kernel is differentiated, or each neighbour has a dilation of its
        // own, supports that are cut at a jump make single rows large: a steady slab was
        // wrong by up to a fifth of its span at some n, and right at the next.
        if(takes_inclusions())
          effects.push_back(Effect::inclusion);
        return {{.form = {},
                 .problems = {cases::ProblemKind::stefan, cases::ProblemKind::poisson},
                 .effects = effects,
                 .shapes
                 = {{DomainShape::slab, {1}, walls}, {DomainShape::box, {2, 3}, walls}},
                 .front_origins = {cases::FrontOrigin::none},
                 .most_threads = cases::any_number_of_threads,
                 .overshoot = overshoot()}};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cases::options_of(rkpm::RkpmOptions{.policy = policy});
      }

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &,
                           const cases::Resolution &resolution) const override
      {
        const int dimension = scene.domain.dimension;
        const rkpm::RkpmParameters parameters
            = rkpm::read_parameters(policy, resolution.options, dimension);
        const rkpm::SupportSettings &supports = parameters.supports;
        const double entries = supports.rule == rkpm::SupportRule::nearest_neighbours
                                   ? supports.neighbours
                                   : cases::points_within(dimension, supports.alpha);
        return linear_demand(
            scene, resolution,
            {.nodes = cases::lattice_points(scene.domain, dimension, resolution.n),
             .entries = entries,
             .matrices = parameters.unknowns == rkpm::Unknowns::nodal ? 4. : 6.,
             .per_node = 300});
      }

      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution) const override
      {
        return make_linear_run(
            scene, effects,
            std::make_unique<RkpmOnNodes>(policy, scene, resolution, overshoot()),
            resolution);
      }

    private:
      const RkpmPolicy &policy;
    };
  } // namespace

  std::vector<std::unique_ptr<cases::Method>> make_rkpm_methods()
  {
    std::vector<std::unique_ptr<cases::Method>> methods;
    for(const RkpmPolicy &policy : rkpm::rkpm_policies())
      methods.push_back(std::make_unique<RkpmMethod>(policy));
    return methods;
  }
} // namespace meltfront::particles
