#include <reference_fem/enthalpy/enthalpy.h>

#include <cases/demand.h>
#include <cases/scene.h>
#include <cases/shared_run.h>
#include <reference_fem/enthalpy/distributed/rank_run.h>
#include <reference_fem/enthalpy/options.h>
#include <reference_fem/enthalpy/run.h>
#include <reference_fem/enthalpy/shaped_triangulation.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    class FemEnthalpy : public cases::Method, public cases::SharedMethod
    {
    public:
      FemEnthalpy()
        : Method("fem-enthalpy",
                 "Enthalpy method with linear finite elements (deal.II): the exact "
                 "enthalpy graph, solved by truncated nonsmooth Newton steps.")
      {
      }

      std::vector<cases::Capabilities> capabilities() const override
      {
        using cases::BoundaryKind, cases::DomainShape, cases::Effect, cases::FrontOrigin;
        const std::vector<BoundaryKind> of_box{
            BoundaryKind::insulated,     BoundaryKind::fixed_temperature,
            BoundaryKind::flux,          BoundaryKind::periodic,
            BoundaryKind::heat_transfer, BoundaryKind::radiation};
        const std::vector<BoundaryKind> walls{
            BoundaryKind::insulated, BoundaryKind::fixed_temperature, BoundaryKind::flux,
            BoundaryKind::heat_transfer, BoundaryKind::radiation};
        return {{.form = {},
                 .problems = {cases::ProblemKind::stefan},
                 .effects
                 = {Effect::phase_change, Effect::phase_conductivity,
                    Effect::phase_heat_capacity, Effect::heat_sources,
                    Effect::wall_temperature, Effect::wall_flux, Effect::solute,
                    Effect::solute_diffusion, Effect::eutectic, Effect::volumetric_source,
                    Effect::inclusion, Effect::robin_wall, Effect::radiating_wall,
                    Effect::variable_conductivity, Effect::variable_heat_capacity,
                    Effect::melting_range, Effect::moving_source},
                 .shapes = {{DomainShape::slab, {1}, walls},
                            {DomainShape::box, {2, 3}, of_box},
                            {DomainShape::ball, {2, 3}, walls},
                            {DomainShape::shell, {2, 3}, walls},
                            {DomainShape::outline, {2}, walls},
                            {DomainShape::mesh, {2, 3}, walls},
                            {DomainShape::axisymmetric, {2}, walls}},
                 .front_origins
                 = {FrontOrigin::none, FrontOrigin::initial_front,
                    FrontOrigin::partly_melted, FrontOrigin::wall, FrontOrigin::source},
                 .overshoot = overshoot},
                {.form = "where liquid is displaced",
                 .problems = {cases::ProblemKind::stefan},
                 .effects = {Effect::phase_change, Effect::phase_conductivity,
                             Effect::phase_heat_capacity, Effect::wall_temperature,
                             Effect::wall_flux, Effect::robin_wall,
                             Effect::radiating_wall, Effect::liquid_motion},
                 .shapes = {{DomainShape::slab, {1}, walls}},
                 .front_origins = {FrontOrigin::initial_front, FrontOrigin::wall},
                 .most_fronts = 1}};
      }

      std::vector<cases::Capabilities>
      capabilities_with(const cases::Options &options) const override
      {
        return shares_on_one(options) ? std::vector{rank_capabilities()} : capabilities();
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cases::options_of(RunOptions());
      }

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &effects,
                           const cases::Resolution &resolution) const override
      {
        // Of mesh, matrix, preconditioner and snapshots together, as measured.
        constexpr double per_node[] = {0, 1000, 1600, 2500};
        const RunOptions options = options_for(scene, resolution);
        if(options.distributed)
          return demand_on_ranks(scene, effects, resolution, 1);
        double nodes
            = cases::lattice_points(scene.domain, options.dimension, resolution.n);
        if(scene.domain.shape == cases::DomainShape::slab)
          nodes *= std::pow(strip_width, options.dimension - 1);
        if(options.refine_at_front)
        {
          // As measured of fronts that are about as large as the domain.
          constexpr double times_boundary = 40;
          nodes = std::min(nodes,
                           times_boundary * std::pow(nodes, 1 - 1. / options.dimension));
        }
        return {cases::program_bytes + nodes * per_node[options.dimension],
                double(options.steps)};
      }

      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution) const override
      {
        if(options_for(scene, resolution).distributed)
          return set_up_on_ranks(scene, effects, resolution, 1);
        return std::make_unique<EnthalpyRun>(scene, effects, resolution);
      }

      double spacing_along_wall(const cases::Scene &scene, cases::Side side,
                                const cases::Resolution &resolution) const override
      {
        return reference_fem::spacing_along_wall(scene, side, resolution.n);
      }

      cases::Capabilities capabilities_on_ranks() const override
      {
        return rank_capabilities();
      }

      bool shares_on_one(const cases::Options &options) const override
      {
        return !options.declarations().empty()
               && options.get_string("engine") == "distributed";
      }

      cases::Demand demand_on_ranks(const cases::Scene &scene, const cases::EffectSet &,
                                    const cases::Resolution &resolution,
                                    int ranks) const override
      {
        const RunOptions options = options_for(scene, resolution);
        return {rank_bytes(
                    options.dimension,
                    cases::lattice_points(scene.domain, options.dimension, resolution.n),
                    ranks),
                double(options.steps)};
      }

      std::unique_ptr<cases::SharedRun>
      set_up_on_ranks(const cases::Scene &scene, const cases::EffectSet &effects,
                      const cases::Resolution &resolution, int ranks) const override
      {
        return std::make_unique<RankRun>(scene, effects, resolution, ranks);
      }
    };
  } // namespace

  std::unique_ptr<cases::Method> make_fem_enthalpy()
  {
    return std::make_unique<FemEnthalpy>();
  }
} // namespace meltfront::reference_fem
