#include <cases/demand.h>
#include <cases/scene.h>
#include <cases/stopwatch.h>
#include <particles/relaxation/relax_nodes.h>
#include <particles/rkpm/rkpm.h>
#include <particles/rkpm/rkpm_problem.h>

namespace meltfront::particles
{
  namespace
  {
    using rkpm::RkpmPolicy;

    class RkpmMethod : public cases::Method
    {
    public:
      explicit RkpmMethod(const RkpmPolicy &policy)
        : policy(policy)
      {
      }

      std::string name() const override
      {
        return policy.name;
      }

      std::string summary() const override
      {
        return policy.summary;
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
        std::vector<Effect> effects{Effect::heat_release, Effect::wall_temperature,
                                    Effect::wall_flux, Effect::wall_transfer};
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
        return rkpm::rkpm_options(policy);
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

      cases::Cost run(const cases::Scene &scene, const cases::EffectSet &effects,
                      const cases::Resolution &resolution,
                      cases::Observer &observer) const override
      {
        const cases::Stopwatch watch;
        const rkpm::RkpmParameters parameters
            = rkpm::read_parameters(policy, resolution.options, scene.domain.dimension);
        const NodeSet nodes
            = arrange_nodes(scene, resolution.n - 1, parameters.arrangement,
                            parameters.jitter, resolution.seed, policy.name,
                            [&scene](NodeSet &set) { relax_inner_nodes(set, scene); });
        const rkpm::RkpmProblem problem(scene, nodes, parameters, policy.name,
                                        resolution.threads);
        LinearDescription description;
        description.method = policy.name;
        description.overshoot = overshoot();
        description.run.dimension = scene.domain.dimension;
        description.run.spacing = nodes.spacing;
        description.run.smoothing_length = problem.mean_dilation();
        description.run.parameters = problem.describe();
        description.setup_work = problem.work();
        const cases::Stopwatch::Seconds setup = watch.elapsed();
        description.setup_wall = setup.wall;
        description.setup_cpu = setup.cpu;
        LinearSites sites{scene.domain.dimension, {}, nodes.weights};
        for(int d = 0; d < scene.domain.dimension; ++d)
          sites.positions[d] = nodes.positions.position[d];
        cases::Cost cost = run_linear_problem(scene, problem.linear(), sites, description,
                                              resolution, observer);
        cost.effects = problem.effect_costs(effects);
        return cost;
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
