#include <reference_fem/fitted/fitted.h>

#include <cases/error.h>
#include <cases/scene.h>
#include <reference_fem/fitted/options.h>
#include <reference_fem/fitted/run.h>

#include <fmt/format.h>

namespace meltfront::reference_fem
{
  namespace
  {
    using cases::BoundaryKind, cases::DomainShape, cases::Effect, cases::FrontOrigin;

    const std::vector<BoundaryKind> walls{
        BoundaryKind::insulated, BoundaryKind::fixed_temperature, BoundaryKind::flux,
        BoundaryKind::heat_transfer, BoundaryKind::radiation};

    /** The form that follows fronts from their start to their end. */
    cases::Capabilities along_line()
    {
      return {.form = "along a line",
              .needs_symmetry = true,
              .problems = {cases::ProblemKind::stefan},
              .effects = {Effect::phase_change, Effect::phase_conductivity,
                          Effect::phase_heat_capacity, Effect::heat_sources,
                          Effect::wall_temperature, Effect::wall_flux, Effect::robin_wall,
                          Effect::radiating_wall, Effect::volumetric_source,
                          Effect::liquid_motion, Effect::metastable_phase},
              .shapes = {{DomainShape::slab, {1}, walls},
                         {DomainShape::ball, {2, 3}, walls},
                         {DomainShape::shell, {2, 3}, walls}},
              .front_origins
              = {FrontOrigin::initial_front, FrontOrigin::wall, FrontOrigin::source},
              .overshoot = fitted::overshoot};
    }

    /** The form that carries a front along that is there from the start. */
    cases::Capabilities in_more_dimensions()
    {
      std::vector<BoundaryKind> of_box = walls;
      of_box.push_back(BoundaryKind::periodic);
      return {.form = "in more dimensions",
              .problems = {cases::ProblemKind::stefan},
              .effects = {Effect::phase_change, Effect::phase_conductivity,
                          Effect::phase_heat_capacity, Effect::heat_sources,
                          Effect::wall_temperature, Effect::wall_flux, Effect::robin_wall,
                          Effect::radiating_wall, Effect::volumetric_source,
                          Effect::metastable_phase},
              .shapes = {{DomainShape::box, {2, 3}, of_box},
                         {DomainShape::ball, {2, 3}, walls},
                         {DomainShape::shell, {2, 3}, walls}},
              .front_origins = {FrontOrigin::initial_front},
              .most_fronts = 1,
              .overshoot = fitted::overshoot};
    }

    class FemFitted : public cases::Method
    {
    public:
      FemFitted()
        : Method(
            fitted::method_name,
            "Sharp front: finite elements (deal.II) on a mesh that moves with the front, "
            "in conservative form, with Newton's method for temperatures and front.")
      {
      }

      std::vector<cases::Capabilities> capabilities() const override
      {
        return {along_line(), in_more_dimensions()};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cases::options_of(fitted::RunOptions());
      }

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &,
                           const cases::Resolution &resolution) const override
      {
        return fitted::demand_of(scene, fitted::options_for(scene, resolution));
      }

    protected:
      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution) const override
      {
        const bool line = fitted::options_for(scene, resolution).dimension == 1;
        const cases::Capabilities form = line ? along_line() : in_more_dimensions();
        if(const std::string reason
           = cases::reason_unsupported(form, scene, effects, resolution.threads);
           !reason.empty())
          throw cases::Refusal(fmt::format("{}: {} it {}", name(), form.form, reason));
        return std::make_unique<fitted::FittedRun>(scene, effects, resolution);
      }
    };
  } // namespace

  std::unique_ptr<cases::Method> make_fem_fitted()
  {
    return std::make_unique<FemFitted>();
  }
} // namespace meltfront::reference_fem
