#include <cases/scene.h>
#include <cases/shared_run.h>
#include <particles/sph/demand.h>
#include <particles/sph/mass_coordinates.h>
#include <particles/sph/ranks/share_among_ranks.h>
#include <particles/sph/sph.h>
#include <particles/sph/sph_run.h>

namespace meltfront::particles
{
  namespace
  {
    /** Along a line, with solid at rest at x_min. */
    cases::Capabilities
    where_liquid_is_displaced(const std::vector<cases::BoundaryKind> &walls)
    {
      using cases::Effect, cases::FrontOrigin;
      return {.form = "where liquid is displaced",
              .problems = {cases::ProblemKind::stefan},
              .effects
              = {Effect::phase_change, Effect::phase_conductivity,
                 Effect::phase_heat_capacity, Effect::wall_temperature, Effect::wall_flux,
                 Effect::robin_wall, Effect::radiating_wall, Effect::liquid_motion},
              .shapes = {{cases::DomainShape::slab, {1}, walls}},
              .front_origins = {FrontOrigin::initial_front, FrontOrigin::wall},
              .most_fronts = 1,
              .most_threads = cases::any_number_of_threads};
    }

    /** Liquid leaves through x_max or the outer wall. */
    cases::Capabilities where_liquid_flows(const std::vector<cases::BoundaryKind> &walls)
    {
      cases::Capabilities result = where_liquid_is_displaced(walls);
      result.form = "where liquid flows";
      result.shapes = {{cases::DomainShape::box, {2, 3}, walls},
                       {cases::DomainShape::ball, {2, 3}, walls},
                       {cases::DomainShape::shell, {2, 3}, walls}};
      result.most_fronts = 0;
      return result;
    }

    /** Sources there have a radius: they release heat throughout. */
    cases::Capabilities about_an_axis(const std::vector<cases::BoundaryKind> &walls)
    {
      using cases::Effect, cases::FrontOrigin;
      return {.form = "about an axis",
              .problems = {cases::ProblemKind::stefan},
              .effects = {Effect::phase_change, Effect::phase_conductivity,
                          Effect::phase_heat_capacity, Effect::wall_temperature,
                          Effect::wall_flux, Effect::robin_wall, Effect::radiating_wall,
                          Effect::volumetric_source, Effect::variable_conductivity,
                          Effect::variable_heat_capacity, Effect::melting_range},
              .shapes = {{cases::DomainShape::axisymmetric, {2}, walls}},
              .front_origins = {FrontOrigin::none, FrontOrigin::initial_front,
                                FrontOrigin::partly_melted, FrontOrigin::wall},
              .most_threads = cases::any_number_of_threads};
    }

    class SphMethod : public cases::Method
    {
    public:
      explicit SphMethod(const SphPolicy &policy)
        : Method(policy.name, policy.summary, policy.corrected_form)
        , policy(policy)
      {
      }

      /** As published, particles lie on the walls and exchange no heat with surroundings.
       */
      std::vector<cases::Capabilities> capabilities() const override
      {
        using cases::BoundaryKind, cases::DomainShape, cases::Effect, cases::FrontOrigin;
        std::vector<BoundaryKind> round{
            BoundaryKind::insulated, BoundaryKind::fixed_temperature, BoundaryKind::flux};
        std::vector<Effect> effects{
            Effect::phase_change,        Effect::phase_conductivity,
            Effect::phase_heat_capacity, Effect::heat_sources,
            Effect::wall_temperature,    Effect::wall_flux,
            Effect::volumetric_source,   Effect::inclusion};
        if(policy.corrected_form.empty())
        {
          round.insert(round.end(),
                       {BoundaryKind::heat_transfer, BoundaryKind::radiation});
          effects.insert(effects.end(),
                         {Effect::robin_wall, Effect::radiating_wall,
                          Effect::variable_conductivity, Effect::variable_heat_capacity,
                          Effect::melting_range, Effect::moving_source});
        }
        std::vector<BoundaryKind> of_box = round, of_outline = round;
        if(!policy.corrected_form.empty())
          of_outline = {BoundaryKind::insulated};
        of_box.push_back(BoundaryKind::periodic);
        std::vector<cases::Capabilities> forms{
            {.form = {},
             .problems = {cases::ProblemKind::stefan},
             .effects = effects,
             .shapes = {{DomainShape::slab, {1}, of_box},
                        {DomainShape::box, {2, 3}, of_box},
                        {DomainShape::ball, {2, 3}, round},
                        {DomainShape::shell, {2, 3}, round},
                        {DomainShape::outline, {2}, of_outline}},
             .front_origins
             = {FrontOrigin::none, FrontOrigin::initial_front, FrontOrigin::partly_melted,
                FrontOrigin::wall, FrontOrigin::source},
             .most_threads = cases::any_number_of_threads}};
        if(policy.corrected_form.empty())
          forms.insert(forms.end(),
                       {about_an_axis(round), where_liquid_is_displaced(round),
                        where_liquid_flows(round)});
        return forms;
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cases::options_of(SphOptions(policy));
      }

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &effects,
                           const cases::Resolution &resolution) const override
      {
        constexpr SphMemory memory{.per_particle = 400, .per_neighbour = 40};
        SphParameters parameters = resolve_parameters(policy, scene, resolution);
        if(!effects.contains(cases::Effect::liquid_motion))
          return sph_demand(parameters, scene, memory);
        if(parameters.dimension > 1)
        {
          constexpr SphMemory with_flow{.per_particle = 1000, .per_neighbour = 80};
          return sph_demand(parameters, scene, with_flow);
        }
        const MassCoordinates moving(scene, parameters);
        parameters.n = moving.particles;
        return sph_demand(parameters, moving.at_rest, memory);
      }

      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution) const override
      {
        return make_sph_run(policy, scene, effects, resolution);
      }

    protected:
      const SphPolicy &policy;
    };

    class SharedSph : public SphMethod, public cases::SharedMethod
    {
    public:
      using SphMethod::SphMethod;

      cases::Capabilities capabilities_on_ranks() const override
      {
        return particles::capabilities_on_ranks();
      }

      cases::Demand demand_on_ranks(const cases::Scene &scene,
                                    const cases::EffectSet &effects,
                                    const cases::Resolution &resolution,
                                    int ranks) const override
      {
        cases::Demand result = demand(scene, effects, resolution);
        result.bytes += bytes_of_ranks(resolve_parameters(policy, scene, resolution),
                                       scene, ranks);
        return result;
      }

      std::unique_ptr<cases::SharedRun>
      set_up_on_ranks(const cases::Scene &scene, const cases::EffectSet &effects,
                      const cases::Resolution &resolution, int ranks) const override
      {
        return make_shared_sph_run(policy, scene, effects, resolution, ranks);
      }
    };
  } // namespace

  std::unique_ptr<cases::Method> make_sph()
  {
    return std::make_unique<SharedSph>(corrected_policy());
  }

  std::unique_ptr<cases::Method> make_sph_2005()
  {
    return std::make_unique<SphMethod>(published_policy());
  }
} // namespace meltfront::particles
