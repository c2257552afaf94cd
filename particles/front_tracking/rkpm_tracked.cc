#include <cases/error.h>
#include <cases/scene.h>
#include <particles/front_tracking/line_run.h>
#include <particles/front_tracking/plane_run.h>
#include <particles/front_tracking/rkpm_tracked.h>
#include <particles/front_tracking/tracking_options.h>

namespace meltfront::particles
{
  namespace
  {
    using namespace front_tracking;

    class RkpmTracked : public cases::Method
    {
    public:
      std::string name() const override
      {
        return method_name;
      }

      std::string summary() const override
      {
        return "Sharp front: particles on the front move with the Stefan speed, solid "
               "and liquid are collocated apart with reproducing kernels.";
      }

      std::vector<cases::Effect> supported_effects() const override
      {
        using cases::Effect;
        return {Effect::phase_change,        Effect::phase_conductivity,
                Effect::phase_heat_capacity, Effect::heat_sources,
                Effect::wall_temperature,    Effect::wall_flux,
                Effect::liquid_motion,       Effect::metastable_phase,
                Effect::heat_release,        Effect::wall_transfer,
                Effect::gibbs_thomson};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return tracking_options();
      }

      cases::Cost solve(const cases::Scene &scene, const cases::EffectSet &effects,
                        const cases::Resolution &resolution,
                        cases::Observer &observer) const override
      {
        cases::require_effects(*this, effects);
        // A run without options of its own uses the declared defaults.
        cases::Resolution complete = resolution;
        if(complete.options.declarations().empty())
          complete.options = cases::Options(option_declarations());
        switch(simulated_dimension(scene, complete.options))
        {
        case 1:
          if(effects.contains(cases::Effect::gibbs_thomson))
            throw cases::Refusal(
                "rkpm-tracked simulates curved fronts that melt at "
                "another temperature in the plane only: set dimension=2");
          if(!scene.sources.empty())
            throw cases::Refusal(
                "rkpm-tracked treats line sources in the plane only: set dimension=2");
          return solve_line(scene, effects, complete, observer);
        case 2:
          return solve_plane(scene, effects, complete, observer);
        default:
          throw cases::Refusal("rkpm-tracked follows a front along one coordinate or in "
                               "the plane");
        }
      }
    };
  } // namespace

  std::unique_ptr<cases::Method> make_rkpm_tracked()
  {
    return std::make_unique<RkpmTracked>();
  }
} // namespace meltfront::particles
