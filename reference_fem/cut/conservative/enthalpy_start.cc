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

    /** A quarter of a cell, next to one of its corners. */
    struct Quarter
    {
      std::array<Point, 4> corners; ///< lexicographic

      Point place; ///< of its first corner in the unit cell

      /** Call visit(centre, area, centre in the unit cell) for its halves, cut as squares
       * of the mesh are. */
      template <typename Visit>
      void visit_halves(const Visit &visit) const
      {
        for(const std::size_t other : {1, 2})
        {
          const Gradient a = corners[other] - corners[0], b = corners[3] - corners[0];
          visit(corners[0] + (a + b) / 3, std::abs(a[0] * b[1] - a[1] * b[0]) / 2,
                place
                    + (other == 1 ? Gradient({1. / 3, 1. / 6})
                                  : Gradient({1. / 6, 1. / 3})));
        }
      }
    };

    std::array<Quarter, 4> quarters(const std::array<Point, 4> &cell)
    {
      std::array<std::array<Point, 3>, 3> lattice;
      for(std::size_t j = 0; j < 3; ++j)
        for(std::size_t i = 0; i < 3; ++i)
        {
          const double x = double(i) / 2, y = double(j) / 2;
          Point &point = lattice[j][i];
          for(std::size_t corner = 0; corner < 4; ++corner)
            point += (corner % 2 == 1 ? x : 1 - x) * (corner / 2 == 1 ? y : 1 - y)
                     * cell[corner];
        }
      std::array<Quarter, 4> result;
      for(std::size_t q = 0; q < 4; ++q)
      {
        for(std::size_t corner = 0; corner < 4; ++corner)
          result[q].corners[corner] = lattice[q / 2 + corner / 2][q % 2 + corner % 2];
        result[q].place = Point(double(q % 2) / 2, double(q / 2) / 2);
      }
      return result;
    }

    /** The triangle of the domain that holds a point, or one on the way to the middle
     * between its rims where the point lies beyond the mesh's polygon. */
    unsigned int triangle_of_domain(const TriangleMesh &mesh, const cases::Domain &domain,
                                    Point &point)
    {
      constexpr int most_moves = 100;
      const double middle = (domain.radius + domain.inner_radius) / 2;
      unsigned int t = mesh.triangle_at(point);
      for(int i = 0; mesh.triangles[t].part.empty() && i < most_moves; ++i)
      {
        const double radius = point.norm();
        point *= 1 + std::copysign(mesh.spacing / 10, middle - radius) / radius;
        t = mesh.triangle_at(point);
      }
      return t;
    }

    Point position_of(const cases::Snapshot &snapshot, unsigned int site)
    {
      return Point(snapshot.positions[0][site], snapshot.positions[1][site]);
    }

    /**
     * Sensible heat in a cell of the enthalpy method (J/m^3). Within a phase it is linear
     * between the nodes: of what nodes stand for alone, hats on a wall would hold as much
     * as if the wall's temperature reached into the domain. Cells at the front have no
     * such line; there each node's is that of its quarter.
     */
    struct CellHeat
    {
      CellHeat(const cases::Snapshot &snapshot, std::size_t first,
               const cases::Material &material)
      {
        for(std::size_t i = 0; i < 4; ++i)
        {
          const unsigned int site = snapshot.cells[first + i];
          const double excess = snapshot.temperature[site] - material.melting_temperature;
          const bool solid = excess < 0;
          phase[i] = solid ? Phase::solid : Phase::liquid;
          of_corner[i]
              = (solid ? material.solid : material.liquid).volumetric_heat_capacity()
                * excess;
          linear = linear && phase[i] == phase[0]
                   && snapshot.solid_fraction[site] == (solid ? 1 : 0);
        }
      }

      /** In a corner's quarter, at a place of the unit cell. */
      double at(std::size_t corner, const Point &place) const
      {
        const double x = place[0], y = place[1];
        return linear ? (1 - y) * ((1 - x) * of_corner[0] + x * of_corner[1])
                            + y * ((1 - x) * of_corner[2] + x * of_corner[3])
                      : of_corner[corner];
      }

      std::array<Phase, 4> phase;
      std::array<double, 4> of_corner;
      bool linear = true;
    };

    /** Nodes of a snapshot, by site. */
    Values volumes_of_quarters(const cases::Snapshot &snapshot)
    {
      Values result(snapshot.weights.size());
      for(std::size_t c = 0; c < snapshot.cells.size(); c += 4)
      {
        std::array<Point, 4> cell;
        for(std::size_t i = 0; i < 4; ++i)
          cell[i] = position_of(snapshot, snapshot.cells[c + i]);
        const auto parts = quarters(cell);
        for(std::size_t i = 0; i < 4; ++i)
          parts[i].visit_halves([&](const Point &, double area, const Point &)
                                { result[snapshot.cells[c + i]] += area; });
      }
      return result;
    }
  } // namespace

  HatContents contents_of_hats(const TriangleMesh &mesh, const cases::Domain &domain,
                               const cases::Material &material,
                               const cases::Snapshot &snapshot)
  {
    const Values nothing(mesh.nodes.size());
    HatContents result{nothing, nothing, {nothing, nothing}};
    const Values of_quarters = volumes_of_quarters(snapshot);
    for(std::size_t c = 0; c < snapshot.cells.size(); c += 4)
    {
      const CellHeat heat(snapshot, c, material);
      std::array<Point, 4> cell;
      for(std::size_t i = 0; i < 4; ++i)
        cell[i] = position_of(snapshot, snapshot.cells[c + i]);
      const auto parts = quarters(cell);
      double missing = 0, volume_of_cell = 0;
      const auto visit_pieces = [&](const auto &visit)
      {
        for(std::size_t i = 0; i < 4; ++i)
        {
          const unsigned int site = snapshot.cells[c + i];
          const double share = snapshot.weights[site] / of_quarters[site];
          parts[i].visit_halves([&](const Point &point, double area, const Point &place)
                                { visit(i, point, share * area, place); });
        }
      };
      visit_pieces(
          [&](std::size_t i, const Point &, double volume, const Point &place)
          {
            missing += (heat.of_corner[i] - heat.at(i, place)) * volume;
            volume_of_cell += volume;
          });
      visit_pieces(
          [&](std::size_t i, Point point, double volume, const Point &place)
          {
            const double density = heat.at(i, place) + missing / volume_of_cell;
            const double solid = snapshot.solid_fraction[snapshot.cells[c + i]];
            const Triangle &triangle
                = mesh.triangles[triangle_of_domain(mesh, domain, point)];
            for(int k = 0; k < 3; ++k)
            {
              const unsigned int node = triangle.nodes[static_cast<std::size_t>(k)];
              const double part = volume * triangle.hat(k, point);
              result.volume[node] += part;
              result.solid_area[node] += solid * part;
              result.heat[index(heat.phase[i])][node] += density * part;
            }
          });
    }
    return result;
  }

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
                               const EnthalpyStartOptions &options, Values at_start)
    : scene(scene)
    , effects(effects)
    , resolution(resolution)
    , mesh(mesh)
    , options(options)
    , at_start(std::move(at_start))
  {
    cells = options.refinement * resolution.n;
    // It meshes disks with powers of two only.
    if(scene.domain.shape == cases::DomainShape::ball)
      for(cells = 4; cells < options.refinement * resolution.n;)
        cells *= 2;
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
