#include <cases/demand.h>
#include <cases/error.h>
#include <cases/option_binder.h>
#include <cases/run.h>
#include <cases/scene.h>
#include <cases/shape.h>
#include <particles/level_set/front_contour.h>
#include <particles/level_set/front_geometry.h>
#include <particles/level_set/front_methods.h>
#include <particles/level_set/markers/marker_run.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    using namespace level_set;

    enum class Scheme
    {
      alone,
      original,
      corrected,
      interpolative
    };

    struct Variant
    {
      Scheme scheme;
      const char *name;
      const char *summary;
    };

    constexpr Variant variants[] = {
        {Scheme::alone, "level-set",
         "A front as the zero contour of a distance on a grid: WENO differences of "
         "fifth order, Runge-Kutta steps of third, made a distance again now and then."},
        {Scheme::original, "level-set-particle",
         "A level set that escaped markers correct (Enright, Fedkiw, Ferziger, "
         "Mitchell 2002)."},
        {Scheme::corrected, "level-set-particle-corrected",
         "The same with markers' values signed by the side on which a node lies (after "
         "Wang, Yang, Stern 2009, as far as it is known)."},
        {Scheme::interpolative, "level-set-interpolative",
         "A level set that all markers correct by fits of the distances that they carry "
         "(Erickson et al. 2016)."}};

    /** The options of a scheme. */
    struct FrontOptions
    {
      explicit FrontOptions(Scheme scheme);

      void bind(cases::OptionBinder &options);

      Scheme scheme;
      TransportParameters transport;
      int band_layers = 6;
      MarkerParameters markers;
      EscapeMerge merge = EscapeMerge::smaller_magnitude;
      std::string fit = "automatic";
      bool carried = true;
      double offset_x = 0, offset_y = 0;
      long steps_at_rest = 5;
    };

    FrontOptions::FrontOptions(const Scheme scheme)
      : scheme(scheme)
    {
      transport.equal_parts = 2;
      if(scheme == Scheme::interpolative)
        return;
      markers.per_cell = 64;
      markers.reseeding = ReseedingRule::none;
    }

    void FrontOptions::bind(cases::OptionBinder &options)
    {
      options.add("cfl", transport.courant_number,
                  "CFL number: time step times the largest component of the velocity "
                  "over the spacing.",
                  0.01, 1);
      options.add("reinitialise_every", transport.reinitialise_every,
                  "Steps from one reinitialisation to the next; 0: never.", 0, 1e6);
      options.add("iterations", transport.iterations,
                  "Iterations of one reinitialisation.", 1, 1000);
      options.add("band_layers", band_layers,
                  "Layers of nodes beside the front that are computed; 0: the whole "
                  "grid.",
                  0, 1000);
      options.add("equal_parts", transport.equal_parts,
                  "Parts of the time whose ends fall on the ends of steps.", 1, 1000);
      if(scheme == Scheme::alone)
        return;
      options.add("per_cell", markers.per_cell, "Markers in each cell near the front.", 1,
                  1000);
      options.add("correct_every", markers.correct_every,
                  "Steps from one correction to the next.", 1, 1000);
      cases::Words<ReseedingRule> rules{{"none", ReseedingRule::none},
                                        {"grid", ReseedingRule::grid}};
      if(scheme == Scheme::interpolative)
        rules.emplace_back("midpoint", ReseedingRule::midpoint);
      options.add("reseeding", markers.reseeding,
                  "Where markers are added: nowhere, in cells near the front from the "
                  "grid's distance, or between markers that have moved apart (not where "
                  "the motion is rigid).",
                  rules);
      options.add("reseed_every", markers.reseed_every,
                  "Steps from one reseeding to the next.", 1, 1e6);
      options.add("offset_x", offset_x,
                  "By how many spacings the grid's front lies off at the start, which "
                  "the markers know better: a test of corrections.",
                  -3, 3);
      options.add("offset_y", offset_y,
                  "Offset of the grid's front along y, as offset_x.", -3, 3);
      options.add("steps_at_rest", steps_at_rest,
                  "Corrections where the velocity is zero.", 1, 1000);
      if(scheme == Scheme::corrected)
        options.add("merge", merge,
                    "What a node takes: the value nearest to zero among the markers' and "
                    "its own (4.15), or the markers' whatever its own.",
                    {{"minabs", EscapeMerge::smaller_magnitude},
                     {"replace", EscapeMerge::replace}});
      if(scheme != Scheme::interpolative)
        return;
      options.add("fit", fit,
                  "One quadratic through all markers about a node, only through those of "
                  "the nearest front, or the one where the motion is rigid and the other "
                  "elsewhere.",
                  cases::themselves({"automatic", "single", "clustered"}));
      options.add("distances", carried,
                  "Whether markers' distances strain with the flow, or are kept as the "
                  "report's are.",
                  {{"carried", true}, {"kept", false}});
    }

    Grid grid_of(const cases::Domain &domain, const int n)
    {
      const double spacing = domain.side() / n;
      std::array<int, 3> cells{};
      for(int d = 0; d < domain.dimension; ++d)
      {
        const double length = domain.upper[d] - domain.lower[d];
        cells[d] = static_cast<int>(std::lround(length / spacing));
        if(std::abs(cells[d] * spacing - length) > 1e-9 * length)
          throw cases::Refusal(
              fmt::format("a grid of {} cells along x does not end on the "
                          "domain's side along {}",
                          n, "xyz"[d]));
      }
      return Grid(domain.dimension, domain.lower, spacing, cells);
    }

    /** Steps that the velocity calls for, found on a grid of a few cells: as many times
     * more as cells are smaller. */
    double estimated_steps(const cases::Scene &scene, const int n,
                           const TransportParameters &transport)
    {
      constexpr int few = 16;
      const cases::Domain &domain = scene.domain;
      const double spacing = domain.side() / few;
      std::array<int, 3> cells{};
      for(int d = 0; d < domain.dimension; ++d)
        cells[d] = std::max(4, static_cast<int>(std::min(
                                   1e3, (domain.upper[d] - domain.lower[d]) / spacing)));
      const Grid grid(domain.dimension, domain.lower, spacing, cells);
      const StepCount count = count_steps(grid, *scene.interface->velocity, transport);
      return double(count.steps) * n / few;
    }

    MarkerParameters marker_parameters(const FrontOptions &options,
                                       const cases::Scene &scene,
                                       const cases::Resolution &resolution)
    {
      MarkerParameters markers;
      if(options.scheme == Scheme::original)
        markers = MarkerParameters::original();
      else if(options.scheme == Scheme::corrected)
        markers = MarkerParameters::corrected(options.merge);
      else
      {
        const bool single
            = options.fit == "single"
              || (options.fit == "automatic" && scene.interface->velocity->rigid());
        markers = MarkerParameters::interpolating(scene.domain.dimension, !single);
        markers.carry_distance = options.carried;
      }
      markers.reseeding = options.markers.reseeding;
      markers.per_cell = options.markers.per_cell;
      markers.correct_every = options.markers.correct_every;
      markers.reseed_every = options.markers.reseed_every;
      markers.seed = resolution.seed;
      markers.threads = resolution.threads;
      return markers;
    }

    MarkerRunParameters run_parameters(const Scheme scheme, const cases::Scene &scene,
                                       const cases::Resolution &resolution)
    {
      const auto options = cases::read_options(FrontOptions(scheme), resolution.options);
      MarkerRunParameters parameters;
      TransportParameters &transport = parameters.transport;
      transport = options.transport;
      transport.end_time = scene.end_time - scene.start_time;
      transport.level_set.band_layers = options.band_layers;
      transport.level_set.threads = resolution.threads;
      if(scheme == Scheme::alone)
        return parameters;
      parameters.markers = marker_parameters(options, scene, resolution);
      parameters.grid_offset = {options.offset_x, options.offset_y, 0};
      parameters.steps_at_rest = options.steps_at_rest;
      return parameters;
    }

    class FrontRun : public cases::Run
    {
    public:
      FrontRun(const Scheme scheme, const cases::Scene &scene,
               const cases::Resolution &resolution)
        : scheme(scheme)
        , scene(scene)
        , grid(grid_of(scene.domain, resolution.n))
        , parameters(run_parameters(scheme, scene, resolution))
      {
      }

      cases::RunDescription describe() const override
      {
        const StepCount count
            = count_steps(grid, *scene.interface->velocity, parameters.transport);
        cases::RunDescription result;
        result.dimension = grid.dimension();
        result.spacing = grid.spacing();
        result.time_step = count.length;
        result.unknowns
            = static_cast<long>(grid.nodes(0)) * grid.nodes(1) * grid.nodes(2);
        result.parameters.push_back({"steps", std::to_string(count.steps), ""});
        if(scheme == Scheme::interpolative)
          result.parameters.push_back({"fit",
                                       parameters.markers.fit.clustered
                                           ? "markers of the nearest front"
                                           : "all markers about a node",
                                       ""});
        return result;
      }

      cases::Cost cost() const override
      {
        return counted;
      }

    private:
      void take_steps() override
      {
        const cases::VelocityField &velocity = *scene.interface->velocity;
        const auto distance = [this](const Position &point)
        { return scene.interface->shape->signed_distance(point); };
        if(scheme == Scheme::alone)
        {
          const TransportResult result = run_level_set(
              grid, distance, velocity, parameters.transport,
              [&](const TransportStep &step) { show(step.front, step.step, step.time); });
          counted.steps = result.steps.steps;
          counted.unknowns = static_cast<long>(result.front.band().size());
          counted.work = std::lround(result.node_steps);
          return;
        }
        const MarkerResult result = run_markers(
            grid, distance, velocity, parameters,
            [&](const MarkerStep &step) { show(step.front, step.step, step.time); });
        counted.steps = result.steps.steps;
        counted.unknowns
            = static_cast<long>(result.front.band().size() + result.markers.size());
        counted.work = std::lround(result.node_steps + result.work.moved);
      }

      void show(const LevelSet &now, const long step, const double elapsed)
      {
        const double end = scene.end_time - scene.start_time;
        front = &now;
        reached(step, elapsed >= end * (1 - 1e-12) ? scene.end_time
                                                   : scene.start_time + elapsed);
      }

      cases::Snapshot snapshot(const long step, const double time) override
      {
        const int dimension = scene.domain.dimension;
        for(auto *arrays : {&points, &normals})
          for(std::vector<double> &values : *arrays)
            values.clear();
        curvatures.clear();
        for(const Position &point : front_points(*front))
        {
          const Position normal = outward_normal(*front, point);
          for(int d = 0; d < dimension; ++d)
          {
            points[d].push_back(point[d]);
            normals[d].push_back(normal[d]);
          }
          curvatures.push_back(curvature(*front, point));
        }
        cases::Snapshot snapshot;
        snapshot.step = step;
        snapshot.time = time;
        snapshot.dimension = dimension;
        for(int d = 0; d < dimension; ++d)
        {
          snapshot.front[d] = points[d];
          snapshot.front_normal[d] = normals[d];
        }
        snapshot.front_curvature = curvatures;
        snapshot.level_set
            = [this](const Position &point) { return front->value(point); };
        snapshot.heat.conservative = false;
        return snapshot;
      }

      Scheme scheme;
      const cases::Scene &scene;
      Grid grid;
      MarkerRunParameters parameters;
      const LevelSet *front = nullptr;
      cases::Cost counted;
      std::array<std::vector<double>, 3> points, normals;
      std::vector<double> curvatures;
    };

    class LevelSetMethod : public cases::Method
    {
    public:
      explicit LevelSetMethod(const Variant &variant)
        : Method(variant.name, variant.summary)
        , variant(variant)
      {
      }

      std::vector<cases::Capabilities> capabilities() const override
      {
        return {{.form = {},
                 .problems = {cases::ProblemKind::interface_advection},
                 .effects = {},
                 .shapes
                 = {{cases::DomainShape::box, {2, 3}, {cases::BoundaryKind::insulated}}},
                 .front_origins = {},
                 .most_threads = cases::any_number_of_threads}};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cases::options_of(FrontOptions(variant.scheme));
      }

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &,
                           const cases::Resolution &resolution) const override
      {
        // Nodes have values of a few stages, cells of the band their markers, as
        // measured.
        constexpr double per_node = 60, per_marker = 100, cells_across = 6;
        const cases::Domain &domain = scene.domain;
        const MarkerRunParameters parameters
            = run_parameters(variant.scheme, scene, resolution);
        const double nodes
            = cases::lattice_points(domain, domain.dimension, resolution.n);
        // A front as long or wide as the domain, a few times.
        const double of_front = 3 * nodes / resolution.n;
        const double markers
            = variant.scheme == Scheme::alone
                  ? 0
                  : of_front * cells_across * parameters.markers.per_cell;
        return {cases::program_bytes + per_node * nodes + per_marker * markers,
                estimated_steps(scene, resolution.n, parameters.transport)};
      }

      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &,
             const cases::Resolution &resolution) const override
      {
        return std::make_unique<FrontRun>(variant.scheme, scene, resolution);
      }

    private:
      Variant variant;
    };
  } // namespace

  std::vector<std::unique_ptr<cases::Method>> make_level_set_methods()
  {
    std::vector<std::unique_ptr<cases::Method>> list;
    for(const Variant &variant : variants)
      list.push_back(std::make_unique<LevelSetMethod>(variant));
    return list;
  }
} // namespace meltfront::particles
