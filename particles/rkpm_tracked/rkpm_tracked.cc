#include <cases/demand.h>
#include <cases/error.h>
#include <cases/scene.h>
#include <particles/rkpm_tracked/line/run.h>
#include <particles/rkpm_tracked/plane/run.h>
#include <particles/rkpm_tracked/rkpm_tracked.h>
#include <particles/rkpm_tracked/tracking_options.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    using namespace rkpm_tracked;

    using cases::BoundaryKind, cases::DomainShape, cases::Effect, cases::FrontOrigin;

    const std::vector<BoundaryKind> walls{
        BoundaryKind::insulated, BoundaryKind::fixed_temperature, BoundaryKind::flux,
        BoundaryKind::heat_transfer, BoundaryKind::radiation};

    cases::Capabilities along_line()
    {
      return {.form = "along a line",
              .needs_symmetry = true,
              .problems = {cases::ProblemKind::stefan},
              .effects
              = {Effect::phase_change, Effect::phase_conductivity,
                 Effect::phase_heat_capacity, Effect::wall_temperature, Effect::wall_flux,
                 Effect::liquid_motion, Effect::metastable_phase,
                 Effect::volumetric_source, Effect::robin_wall, Effect::radiating_wall},
              .shapes = {{DomainShape::slab, {1}, walls},
                         {DomainShape::ball, {2, 3}, walls},
                         {DomainShape::shell, {2, 3}, walls}},
              .front_origins = {FrontOrigin::initial_front, FrontOrigin::wall},
              .overshoot = overshoot_along_line,
              .conserves_heat = false};
    }

    cases::Capabilities in_plane()
    {
      return {.form = "in the plane",
              .problems = {cases::ProblemKind::stefan},
              .effects
              = {Effect::phase_change, Effect::phase_conductivity,
                 Effect::phase_heat_capacity, Effect::heat_sources,
                 Effect::wall_temperature, Effect::wall_flux, Effect::metastable_phase,
                 Effect::volumetric_source, Effect::robin_wall, Effect::radiating_wall,
                 Effect::gibbs_thomson},
              .shapes = {{DomainShape::box, {2}, walls},
                         {DomainShape::ball, {2}, walls},
                         {DomainShape::shell, {2}, walls},
                         {DomainShape::outline, {2}, walls}},
              .front_origins
              = {FrontOrigin::initial_front, FrontOrigin::wall, FrontOrigin::source},
              .most_threads = cases::any_number_of_threads,
              .overshoot = overshoot_in_plane,
              .conserves_heat = false};
    }

    /** What a run takes: nodes with the stencils about them and, in the plane, the
     * factors of the matrix of both phases; as measured. */
    cases::Demand demand_of(const cases::Scene &scene,
                            const cases::Resolution &resolution)
    {
      constexpr double per_line_node = 3000, per_plane_node = 1500, per_entry = 60,
                       per_particle = 1000; // of sph, where that goes ahead
      const TrackingParameters parameters = read_tracking_parameters(scene, resolution);
      const int dimension = simulated_dimension(scene, resolution.options);
      const double nodes
          = cases::lattice_points(scene.domain, dimension, parameters.cells);
      const double entries = cases::points_within(dimension, parameters.dilation);
      const double per_node
          = dimension == 1
                ? per_line_node
                : per_plane_node
                      + per_entry * entries * cases::fill_of_factors(dimension, nodes)
                      + (starts_from_one_phase(scene) || may_start_with_jumps(scene)
                             ? per_particle * std::pow(parameters.start_refinement, 2)
                             : 0);
      return {cases::program_bytes + nodes * per_node, double(parameters.steps)};
    }

    class RkpmTracked : public cases::Method
    {
    public:
      RkpmTracked()
        : Method(method_name,
                 "Sharp front: particles on the front move with the Stefan speed, solid "
                 "and liquid are solved for apart with reproducing kernels.")
      {
      }

      std::vector<cases::Capabilities> capabilities() const override
      {
        return {along_line(), in_plane()};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cases::options_of(TrackingParameters());
      }

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &,
                           const cases::Resolution &resolution) const override
      {
        return demand_of(scene, resolution);
      }

    protected:
      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution) const override
      {
        const bool line = simulated_dimension(scene, resolution.options) == 1;
        const cases::Capabilities form = line ? along_line() : in_plane();
        if(const std::string reason
           = cases::reason_unsupported(form, scene, effects, resolution.threads);
           !reason.empty())
          throw cases::Refusal(fmt::format(
              "{}: {} it {}{}", method_name, form.form, reason,
              line && scene.domain.dimension == 2 ? "; dimension=2 may be right" : ""));
        return line ? make_line_run(scene, effects, resolution)
                    : make_plane_run(scene, effects, resolution);
      }
    };
  } // namespace

  std::unique_ptr<cases::Method> make_rkpm_tracked()
  {
    return std::make_unique<RkpmTracked>();
  }
} // namespace meltfront::particles
