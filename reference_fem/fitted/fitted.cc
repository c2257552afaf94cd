#include <reference_fem/fitted/fitted.h>

#include <cases/scene.h>
#include <reference_fem/fitted/options.h>
#include <reference_fem/fitted/run.h>

namespace meltfront::reference_fem
{
  namespace
  {
    class FemFitted : public cases::Method
    {
    public:
      std::string name() const override
      {
        return "fem-fitted";
      }

      std::string summary() const override
      {
        return "Sharp front: finite elements (deal.II) on a mesh that moves with the "
               "front, "
               "in conservative form, with Newton's method for temperatures and front.";
      }

      std::vector<cases::Capabilities> capabilities() const override
      {
        using cases::BoundaryKind, cases::DomainShape, cases::Effect, cases::FrontOrigin;
        const std::vector<BoundaryKind> walls{
            BoundaryKind::insulated, BoundaryKind::fixed_temperature, BoundaryKind::flux};
        std::vector<BoundaryKind> of_box = walls;
        of_box.push_back(BoundaryKind::periodic);
        return {{.form = {},
                 .problems = {cases::ProblemKind::stefan},
                 .effects = {Effect::phase_change, Effect::phase_conductivity,
                             Effect::phase_heat_capacity, Effect::heat_sources,
                             Effect::wall_temperature, Effect::wall_flux,
                             Effect::liquid_motion, Effect::metastable_phase},
                 .shapes = {{DomainShape::slab, {1}, walls},
                            {DomainShape::box, {2, 3}, of_box},
                            {DomainShape::ball, {2, 3}, walls},
                            {DomainShape::shell, {2, 3}, walls}},
                 .front_origins
                 = {FrontOrigin::initial_front, FrontOrigin::wall, FrontOrigin::source},
                 .most_fronts = 1,
                 .overshoot = fitted::overshoot}};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return fitted::fitted_options();
      }

      cases::Cost run(const cases::Scene &scene, const cases::EffectSet &effects,
                      const cases::Resolution &resolution,
                      cases::Observer &observer) const override
      {
        return fitted::FittedRun(scene, effects, resolution).run(observer);
      }
    };
  } // namespace

  std::unique_ptr<cases::Method> make_fem_fitted()
  {
    return std::make_unique<FemFitted>();
  }
} // namespace meltfront::reference_fem
