#include <reference_fem/cut/cut.h>

#include <cases/demand.h>
#include <cases/error.h>
#include <cases/scene.h>
#include <reference_fem/cut/conservative/conservative_run.h>
#include <reference_fem/cut/options.h>
#include <reference_fem/cut/run.h>

#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    class FemCut : public cases::Method
    {
    public:
      FemCut()
        : Method("fem-cut", "Sharp front that cuts a fixed mesh (deal.II): level set, "
                            "Nitsche's condition, ghost penalty; fronts merge and split.")
      {
      }

      std::vector<cases::Capabilities> capabilities() const override
      {
        return capabilities_with({});
      }

      std::vector<cases::Capabilities>
      capabilities_with(const cases::Options &given) const override
      {
        using cases::BoundaryKind, cases::DomainShape, cases::Effect, cases::FrontOrigin;
        const std::vector<BoundaryKind> walls{
            BoundaryKind::insulated, BoundaryKind::fixed_temperature, BoundaryKind::flux,
            BoundaryKind::heat_transfer, BoundaryKind::radiation};
        const cut::RunOptions options
            = given.declarations().empty()
                  ? cut::RunOptions()
                  : cases::read_options(cut::RunOptions(), given);
        std::vector<FrontOrigin> origins{FrontOrigin::initial_front, FrontOrigin::source};
        if(cut::chosen_scheme(options).scheme == cut::Scheme::conservative)
          origins.push_back(FrontOrigin::wall);
        return {
            {.form = {},
             .problems = {cases::ProblemKind::stefan},
             .effects = {Effect::phase_change, Effect::phase_conductivity,
                         Effect::phase_heat_capacity, Effect::heat_sources,
                         Effect::wall_temperature, Effect::wall_flux, Effect::robin_wall,
                         Effect::radiating_wall, Effect::volumetric_source},
             .shapes = {{DomainShape::box, {2}, walls},
                        {DomainShape::ball, {2}, walls},
                        {DomainShape::shell, {2}, walls}},
             .front_origins = origins,
             .overshoot = cut::overshoot,
             .conserves_heat = false}};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cases::options_of(cut::RunOptions());
      }

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &,
                           const cases::Resolution &resolution) const override
      {
        const auto options = cut::options_for(scene, resolution);
        // As measured: of three states on a mesh, geometry and factors; of the
        // conservative scheme, from n = 32 to 64, mostly of UMFPACK's factors.
        const double per_cell
            = cut::chosen_scheme(options).scheme == cut::Scheme::conservative ? 9000
                                                                              : 3000;
        const double n = resolution.n;
        double cells = cases::lattice_points(scene.domain, cut::dim, n);
        if(options.refinement > 0)
          // A front as long as the domain, a few times, in its band; coarse cells else.
          cells = cells / std::pow(4, options.refinement)
                  + std::min(cells, 3 * n * (2 * options.widths.finest));
        return {cases::program_bytes + cells * per_cell * options.degree * options.degree,
                double(options.fewest_steps)};
      }

      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution) const override
      {
        const auto options = cases::read_options(cut::RunOptions(), resolution.options);
        if(cut::chosen_scheme(options).scheme == cut::Scheme::conservative)
          return std::make_unique<cut::conservative::ConservativeRun>(scene, effects,
                                                                      resolution);
        if(options.start == cut::StartFrom::enthalpy)
          throw cases::Refusal("fem-cut starts from fem-enthalpy (start = enthalpy) with "
                               "scheme = conservative only");
        return std::make_unique<cut::CutRun>(scene, effects, resolution);
      }
    };
  } // namespace

  std::unique_ptr<cases::Method> make_fem_cut()
  {
    return std::make_unique<FemCut>();
  }
} // namespace meltfront::reference_fem
