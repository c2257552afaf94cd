#include <reference_fem/cut/conservative/enthalpy_start.h>

#include <cases/error.h>
#include <reference_fem/cut/conservative/initial_front.h>
#include <reference_fem/enthalpy/enthalpy.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Of the run up to the handing over: what it takes for a front that sets out like
     * the root of time to be followed from its first cell on. */
    constexpr long steps_of_growth = 64;
    constexpr long most_steps = 2000;

    /** Of a run that looks for the time of the handing over. */
    constexpr long steps_of_search = 32;

    /** Its ends are so many times as late each. */
    constexpr double later = 4;

    /** Times the depth that is asked for everywhere: so deep somewhere is deep enough. */
    constexpr double deep_somewhere = 3;

    /** Times that depth: how near a place has to be to where it is deeper, so that it is
     * the rim of a body and not its depth; and by how many spacings deeper. */
    constexpr double near = 1.5, deeper = 0.5;

    class Watch : public cases::Observer
    {
    public:
      explicit Watch(const std::function<void(const cases::Snapshot &)> &visit)
        : visit(visit)
      {
      }

      bool wants(long, double) override
      {
        return true;
      }

      void observe(const cases::Snapshot &snapshot) override
      {
        visit(snapshot);
      }

    private:
      const std::function<void(const cases::Snapshot &)> &visit;
    };
  } // namespace

  Values distances_by_shares(const TriangleMesh &mesh, const HatContents &contents,
                             double reach)
  {
    const std::size_t nodes = mesh.nodes.size();
    Values solid(nodes), volume(nodes), values(nodes, 1);
    for(const Triangle &triangle : mesh.triangles)
      if(!triangle.part.empty())
      {
        double of_solid = 0, of_both = 0;
        for(const unsigned int node : triangle.nodes)
        {
          of_solid += contents.solid_area[node];
          of_both += contents.volume[node];
        }
        for(const unsigned int node : triangle.nodes)
        {
          solid[node] += of_solid;
          volume[node] += of_both;
        }
      }
    for(std::size_t node = 0; node < nodes; ++node)
      if(volume[node] > 0)
        values[node] = 0.5 - solid[node] / volume[node];
    values = without_zeros(std::move(values), mesh.spacing);
    return distances(mesh, segments_of(Front(mesh, values)), values, reach);
  }

  namespace
  {
    /** An area as debt of the front, evenly along it. */
    void add_debt_along(const Front &front, double area, Values &debt)
    {
      double length = 0;
      for(const Segment &segment : segments_of(front))
        length += segment.length();
      for(const CutTriangle &cut : front.cut)
        if(cut.crossed)
          integrate(cut.segment,
                    [&](const Point &point, double weight)
                    {
                      for(int i = 0; i < 3; ++i)
                        debt[cut.place->nodes[static_cast<std::size_t>(i)]]
                            += area * weight / length * cut.place->hat(i, point);
                    });
    }
  } // namespace

  FrontState front_of_areas(const TriangleMesh &mesh, const HatContents &contents,
                            double latent_heat, double reach)
  {
    /** Of the smoothing, alike in all directions: along the front, what the enthalpy
     * method's nodes know of it from one to the next is evened out over some cells. */
    constexpr double isotropic = 1;
    /** Spacings from the front: what melts or freezes beyond it is not the front's. */
    constexpr double of_front = 2;
    const StepFrame frame(mesh, distances_by_shares(mesh, contents, reach), 1, isotropic);
    if(!frame.has_front())
      throw std::runtime_error("there is no front to hand over");
    // What a hat is of, in this mesh and in the other one.
    const Values whole = volume_of_hats(mesh);
    Values solid = frame.front.solid_area, elsewhere(mesh.nodes.size());
    for(std::size_t node = 0; node < solid.size(); ++node)
      if(contents.volume[node] > 0)
      {
        const double found
            = contents.solid_area[node] * (whole[node] / contents.volume[node]);
        const bool near_front = std::abs(frame.level_set[node]) < of_front * mesh.spacing;
        elsewhere[node] = near_front ? 0 : found - solid[node];
        if(near_front)
          solid[node] = found;
      }
    // Beside a rim a hat of this mesh is not of the volume that it holds of the other.
    const double missing = sum(contents.solid_area) - sum(solid) - sum(elsewhere);
    FrontState result = fitted_front(mesh, frame, solid, reach);
    add_debt_along(Front(mesh, result.level_set), missing, result.debt);
    result.heat = contents.heat;
    for(std::size_t node = 0; node < elsewhere.size(); ++node)
      result.heat[result.level_set[node] < 0 ? 0 : 1][node]
          -= latent_heat * elsewhere[node];
    return result;
  }

  namespace
  {
    struct Depths
    {
      bool present = false;       ///< there is such a phase
      double least = 0, most = 0; ///< of the places where it is deepest around (m)
    };

    /** How deep a phase is where there was the other one at the start: the one that there
     * is less of, if there was only one. */
    Depths depths(const TriangleMesh &mesh, const cases::Domain &domain,
                  const cases::Material &material, const cases::Snapshot &snapshot,
                  const Values &at_start, double asked)
    {
      const HatContents contents = contents_of_hats(mesh, domain, material, snapshot);
      const double reach = (deep_somewhere + 1) * asked;
      const Values distance = distances_by_shares(mesh, contents, reach);
      const Front front(mesh, distance);
      Depths result;
      const double less = front.area(Phase::solid) < front.area(Phase::liquid) ? -1 : 1;
      // Nodes beyond a rim tell of no depth: where a layer begins, the front is there,
      // too.
      std::vector<char> inside(mesh.nodes.size(), false);
      for(const Triangle &triangle : mesh.triangles)
        for(const unsigned int node : triangle.nodes)
          inside[node] = inside[node] || (triangle.whole && !triangle.part.empty());
      result.least = reach;
      for(unsigned int node = 0; node < mesh.nodes.size(); ++node)
      {
        const double sign = at_start.empty() ? less : std::copysign(1., -at_start[node]);
        const double depth = sign * distance[node];
        if(!inside[node] || depth <= 0)
          continue;
        bool rim = false;
        if(depth < asked)
          mesh.visit_nodes_near(mesh.nodes[node], near * asked,
                                [&](unsigned int other)
                                {
                                  rim = rim
                                        || (inside[other]
                                            && sign * distance[other]
                                                   > depth + deeper * mesh.spacing);
                                });
        if(rim)
          continue;
        result.present = true;
        result.least = std::min(result.least, depth);
        result.most = std::max(result.most, depth);
      }
      return result;
    }
  } // namespace

  EnthalpyStart::EnthalpyStart(const cases::Scene &scene, const cases::EffectSet &effects,
                               const cases::Resolution &resolution,
                               const TriangleMesh &mesh,
                               const EnthalpyStartOptions &options)
    : scene(scene)
    , effects(effects)
    , resolution(resolution)
    , mesh(mesh)
    , options(options)
  {
    cells = options.refinement * resolution.n;
    // It meshes disks with powers of two only.
    if(scene.domain.shape == cases::DomainShape::ball)
      for(cells = 4; cells < options.refinement * resolution.n;)
        cells *= 2;
  }

  void EnthalpyStart::until_smooth()
  {
    const double width = options.depth * mesh.spacing;
    const double duration = width * width
                            / (4
                               * std::min(scene.material.solid.diffusivity(),
                                          scene.material.liquid.diffusivity()));
    if(!(duration < scene.end_time - scene.start_time))
      throw cases::Refusal(fmt::format(
          "fem-cut does not resolve what jumps at the start: it takes {:.3g} s to be "
          "smooth over {:g} cells, longer than the run: take more cells, a later end, or "
          "fem-enthalpy",
          duration, options.depth));
    time = scene.start_time + duration;
    steps = steps_of_growth;
  }

  void EnthalpyStart::until_deep(Values level_set)
  {
    at_start = std::move(level_set);
    const double whole = scene.end_time - scene.start_time;
    const double fastest = std::max(scene.material.solid.diffusivity(),
                                    scene.material.liquid.diffusivity());
    double appeared = scene.start_time;
    bool found = false;
    for(double duration = std::min(whole, mesh.spacing * mesh.spacing / fastest); !found;
        duration = std::min(whole, later * duration))
    {
      found = search(duration < whole ? scene.start_time + duration : scene.end_time,
                     appeared);
      if(!found && !(duration < whole))
        throw cases::Refusal(fmt::format(
            "fem-cut does not resolve the front: by fem-enthalpy, from which it would "
            "start, the new phase is nowhere {:g} cells deep before the end, or there is "
            "none: take more cells, a later end, or fem-enthalpy",
            options.depth));
    }
    const double growth = (time - appeared) / (time - scene.start_time);
    steps = std::min(most_steps, std::lround(double(steps_of_growth) / growth));
  }

  /** @return whether the front is deep enough before an end */
  bool EnthalpyStart::search(double end, double &appeared)
  {
    const double asked = options.depth * mesh.spacing;
    bool found = false, present = false;
    double before = scene.start_time;
    const std::function<void(const cases::Snapshot &)> look
        = [&](const cases::Snapshot &snapshot)
    {
      if(found || snapshot.time == scene.start_time || snapshot.time == scene.end_time)
        return;
      const Depths depth
          = depths(mesh, scene.domain, scene.material, snapshot, at_start, asked);
      if(depth.present && !std::exchange(present, depth.present))
        appeared = before;
      before = snapshot.time;
      found = depth.present
              && (depth.least >= asked || depth.most >= deep_somewhere * asked);
      if(found)
      {
        time = snapshot.time;
        least_depth = depth.least / mesh.spacing;
        most_depth = depth.most / mesh.spacing;
      }
    };
    const int n = scene.domain.shape == cases::DomainShape::ball ? cells : resolution.n;
    search_work += run_until(end, n, steps_of_search, look).work;
    return found;
  }

  cases::Cost EnthalpyStart::run_until(
      double end, int n, long of_steps,
      const std::function<void(const cases::Snapshot &)> &visit) const
  {
    const auto method = make_fem_enthalpy();
    cases::Scene sooner = scene;
    sooner.end_time = end;
    cases::Resolution finer = resolution;
    finer.n = n;
    finer.options = cases::Options(method->option_declarations());
    finer.options.set("dimension", fmt::format("{}", dim));
    finer.options.set("steps", fmt::format("{}", of_steps));
    Watch watch(visit);
    return method->solve(sooner, effects, finer, watch);
  }

  cases::Cost
  EnthalpyStart::run(const std::function<void(const cases::Snapshot &)> &visit) const
  {
    return run_until(time, cells, steps, visit);
  }
} // namespace meltfront::reference_fem::cut::conservative
