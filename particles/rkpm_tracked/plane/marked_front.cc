#include <particles/rkpm_tracked/plane/marked_front.h>

#include <particles/rkpm_tracked/tracking_options.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Spacings of the grid in one of the nodes: films of liquid or solid hold until they
     * are about as thin as one of the grid's. */
    constexpr int refinement = 8;

    /** Spacings of the nodes by which the grid goes on beyond the domain. */
    constexpr double margin = 4;

    /** Spacings of the grid within which phi starts as a distance: the band, its halo. */
    constexpr double distance_band = 14;

    /** Spacings that the front goes in one step of the level set. */
    constexpr double courant_number = 0.5;

    constexpr int reinitialise_every = 5;
    constexpr int iterations = 10;
    constexpr int reseed_every = 20;

    constexpr int projection_steps = 2;
    constexpr double projected_share = 0.5;

    level_set::Grid make_grid(const PlaneNodes &nodes)
    {
      const double spacing = nodes.spacing / refinement;
      const ContourGrid outline
          = contour_grid(nodes.lower, nodes.upper, margin * nodes.spacing, spacing);
      return {
          2,
          {outline.lower.x(), outline.lower.y(), 0},
          spacing,
          {static_cast<int>(outline.columns - 1), static_cast<int>(outline.rows - 1), 0}};
    }

    level_set::MarkerParameters parameters_of(int threads)
    {
      // Fronts come near each other; the extended speed keeps distances as they are.
      auto parameters = level_set::MarkerParameters::interpolating(2, true);
      parameters.carry_distance = false;
      parameters.threads = threads;
      return parameters;
    }

    /** Weights of the cubic through four values at -1, 0, 1, 2. */
    std::array<double, 4> cubic_weights(double x)
    {
      return {-x * (x - 1) * (x - 2) / 6, (x + 1) * (x - 1) * (x - 2) / 2,
              -(x + 1) * x * (x - 2) / 2, (x + 1) * x * (x - 1) / 6};
    }
  } // namespace

  MarkedFront::MarkedFront(const PlaneNodes &nodes, int threads)
    : nodes(nodes)
    , threads(threads)
    , grid(make_grid(nodes))
    , velocity(grid)
  {
  }

  void MarkedFront::seed(const PlaneFront &front, bool solid_beyond)
  {
    const FrontIndex index(front, solid_beyond, nodes.spacing);
    const auto distance = [&](const level_set::Position &place) {
      return index.signed_distance({place[0], place[1]}, distance_band * grid.spacing());
    };
    level_set::LevelSetParameters parameters;
    parameters.threads = threads;
    phi = std::make_unique<level_set::LevelSet>(grid, distance, parameters);
    markers = std::make_unique<level_set::MarkerScheme>(grid, parameters_of(threads),
                                                        method_name);
    markers->seed(distance);
    carried = 0;
  }

  /** At each node near the front the way of the nearest place on it. */
  void MarkedFront::find_velocity(const PlaneFront &front,
                                  const std::vector<PlanePoint> &ways)
  {
    const FrontIndex index(front, false, nodes.spacing);
    const std::vector<PlanePoint> along = along_polygon(front, ways);
    for(int d = 0; d < 2; ++d)
      std::ranges::fill(velocity.component(d), 0.);
    const auto runs = phi->band_with_halo().runs();
#pragma omp parallel for num_threads(threads) schedule(static)
    for(std::size_t r = 0; r < runs.size(); ++r)
      for(std::size_t node = runs[r].node; node < runs[r].node + runs[r].length; ++node)
      {
        const level_set::Position place = grid.position(node);
        const FrontPlace nearest
            = index.closest({place[0], place[1]}, 2 * distance_band * grid.spacing());
        if(nearest.vertex == FrontPlace::none)
          continue;
        const PlanePoint way = (1 - nearest.share) * along[nearest.vertex]
                               + nearest.share * along[nearest.following];
        for(int d = 0; d < 2; ++d)
          velocity.component(d)[node] = way[d];
      }
  }

  void MarkedFront::carry(const PlaneFront &front, const std::vector<PlanePoint> &ways,
                          long number, double time)
  {
    double farthest = 0;
    for(const PlanePoint &way : ways)
      farthest = std::max(farthest, way.norm());
    if(farthest == 0 || front.size() == 0)
      return;
    find_velocity(front, ways);
    const auto at_nodes = level_set::velocity_function(velocity);
    const long steps = std::max(
        1L, static_cast<long>(std::ceil(farthest / (courant_number * grid.spacing()))));
    for(long step = 0; step < steps; ++step)
    {
      const level_set::TimeStep part{number, time, 1. / static_cast<double>(steps)};
      node_steps += static_cast<double>(phi->band().size());
      marker_steps += static_cast<double>(markers->markers().size());
      advection.step(*phi, at_nodes, part);
      markers->move(velocity, part);
      markers->correct(*phi);
    }
    ++carried;
    if(carried % reinitialise_every == 0)
    {
      reinitialise(*phi, iterations);
      markers->refresh(*phi);
    }
    if(carried % reseed_every == 0)
      markers->reseed(*phi);
  }

  double MarkedFront::value(const PlanePoint &place) const
  {
    const level_set::CellPlace cell = grid.locate(position_of(place));
    const auto along_x = cubic_weights(cell.local[0]),
               along_y = cubic_weights(cell.local[1]);
    const double *first = phi->values().data() + cell.node - 1 - grid.stride(1);
    double sum = 0;
    for(int j = 0; j < 4; ++j)
      for(int i = 0; i < 4; ++i)
        sum += along_y[j] * along_x[i] * first[j * grid.stride(1) + i];
    return sum;
  }

  Contours MarkedFront::contours() const
  {
    return contours([this](const PlanePoint &place) { return value(place); });
  }

  Contours MarkedFront::contours(const PlaneLevelSet &level_set) const
  {
    ContourGrid lattice;
    lattice.spacing = grid.spacing();
    lattice.lower = {grid.origin()[0], grid.origin()[1]};
    lattice.columns = grid.nodes(0);
    lattice.rows = grid.nodes(1);
    std::vector<double> values;
    values.reserve(lattice.columns * lattice.rows);
    for(int j = 0; j < grid.nodes(1); ++j)
    {
      const double *row = phi->values().data() + grid.node(0, j);
      values.insert(values.end(), row, row + grid.nodes(0));
    }
    for(const level_set::NodeRun &run : phi->band().runs())
      for(int i = 0; i < run.length; ++i)
      {
        const long column = run.index[0] + i, number = run.index[1];
        values[number * lattice.columns + column]
            = level_set(lattice.node(column, number));
      }
    return find_contours(lattice, std::move(values), level_set);
  }

  double MarkedFront::mismatch(const PlaneFront &front) const
  {
    double largest = 0;
    for(std::size_t p = 0; p < front.size(); ++p)
      if(front.active[p])
        largest = std::max(largest, std::abs(value(front.position[p])));
    return largest;
  }

  void MarkedFront::reproject(PlaneFront &front,
                              const std::vector<PlanePoint> &ways) const
  {
    const double h = grid.spacing();
    for(std::size_t p = 0; p < front.size(); ++p)
    {
      if(!front.active[p])
        continue;
      const PlanePoint start = front.position[p], &normal = front.normal[p];
      const double limit = projected_share * ways[p].norm();
      double way = 0;
      for(int step = 0; step < projection_steps; ++step)
      {
        const PlanePoint place = start + way * normal;
        const double slope
            = (value(place + h / 2 * normal) - value(place - h / 2 * normal)) / h;
        if(slope > -0.1) // phi falls into the solid; elsewhere there is no zero to find
          break;
        way += std::clamp(-value(place) / slope, -h / 2, h / 2);
      }
      front.position[p] = start + std::clamp(way, -limit, limit) * normal;
    }
    update_geometry(front);
  }
} // namespace meltfront::particles::rkpm_tracked
