#include <reference_fem/fitted/sites.h>

#include <algorithm>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    /** Corners of the sub-cells into which the nodes divide a cell of the surface, each
     * in lexicographic order. */
    std::vector<std::vector<unsigned int>> parts(const FrontSurface &surface,
                                                 const std::vector<unsigned int> &rays)
    {
      if(surface.tangents == 0)
        return {rays};
      std::vector<std::vector<unsigned int>> result;
      const int degree = surface.degree, row = degree + 1;
      for(int j = 0; j < (surface.tangents == 2 ? degree : 1); ++j)
        for(int i = 0; i < degree; ++i)
        {
          std::vector<unsigned int> corners{rays[i + row * j], rays[i + 1 + row * j]};
          if(surface.tangents == 2)
            corners.insert(corners.end(),
                           {rays[i + row * (j + 1)], rays[i + 1 + row * (j + 1)]});
          result.push_back(corners);
        }
      return result;
    }
  } // namespace

  Sites::Sites(const FittedProblem &problem)
    : problem(problem)
  {
    const RayMesh &mesh = problem.mesh();
    std::size_t n_sites = mesh.n_nodes();
    for(unsigned int l = 0; l < mesh.layers.size(); ++l)
      n_sites += problem.tables(l).n_points() * mesh.surface.cells.size();
    for(auto &coordinate : positions)
      coordinate.assign(n_sites, 0);
    for(auto &coordinate : front)
      coordinate.assign(mesh.n_fronts() * mesh.surface.n_rays(), 0);
    weights.assign(n_sites, 0);
    temperature.resize(n_sites);
    solid_fraction.resize(n_sites);
    make_cells();
  }

  void Sites::make_cells()
  {
    const RayMesh &mesh = problem.mesh();
    for(const auto &surface_cell : mesh.surface.cells)
      for(const auto &corners : parts(mesh.surface, surface_cell))
        for(unsigned int level = 0; level + 1 < mesh.n_levels(); ++level)
          for(const unsigned int ray : corners)
          {
            cells.push_back(mesh.node(ray, level));
            cells.push_back(mesh.node(ray, level + 1));
          }
  }

  void Sites::set_position(std::size_t site, const cases::Position &position)
  {
    for(int d = 0; d < 3; ++d)
      positions[d][site] = position[d];
  }

  void Sites::read_nodes(double time, const dealii::Vector<double> &u)
  {
    const RayMesh &mesh = problem.mesh();
    const double melting = problem.physics().melting_temperature;
    for(unsigned int ray = 0; ray < mesh.surface.n_rays(); ++ray)
      for(unsigned int level = 0; level < mesh.n_levels(); ++level)
      {
        const unsigned int node = mesh.node(ray, level);
        const double r = problem.coordinate(ray, level, u);
        const cases::Position position = mesh.position(ray, r);
        set_position(node, position);
        if(const unsigned int k = mesh.front_at(level); k != RayMesh::none)
        {
          temperature[node] = melting;
          solid_fraction[node] = 0.5;
          for(int d = 0; d < 3; ++d)
            front[d][k * mesh.surface.n_rays() + ray] = position[d];
          continue;
        }
        const unsigned int interval = mesh.interval_of(level);
        // For pictures: the centre of a source shows the temperature half way to its
        // neighbour.
        const double shown = r > 0 ? r : 0.5 * problem.coordinate(ray, 1, u);
        temperature[node]
            = melting + u[node] + problem.source(interval, time).value(shown);
        solid_fraction[node] = problem.phase(interval).solid ? 1 : 0;
      }
  }

  void Sites::read_points(double time, const dealii::Vector<double> &u)
  {
    const RayMesh &mesh = problem.mesh();
    const dealii::Vector<double> rate(u.size());
    std::size_t site = mesh.n_nodes();
    for(unsigned int l = 0; l < mesh.layers.size(); ++l)
    {
      const CellPhysics physics = problem.cell_physics(l, time);
      const CellTables &tables = problem.tables(l);
      for(unsigned int s = 0; s < mesh.surface.cells.size(); ++s)
      {
        const CellState state = problem.cell_state(s, l, time, u, rate);
        const CellIntegrals cell(tables, s, mesh.layers[l], mesh.surface, physics, state);
        const std::size_t across = tables.line.points.size();
        for(Eigen::Index q = 0; q < cell.r.size(); ++q, ++site)
        {
          const SurfacePoint &point = problem.surface_points(s)[q / across];
          cases::Position position{};
          for(int d = 0; d < 3; ++d)
            position[d] = point.base[d] + cell.r[q] * point.direction[d];
          set_position(site, position);
          weights[site] = cell.weight[q];
          temperature[site] = problem.physics().melting_temperature + cell.excess[q];
          solid_fraction[site] = physics.phase.solid ? 1 : 0;
        }
      }
    }
  }

  void Sites::read(double time, const dealii::Vector<double> &u,
                   cases::Snapshot &snapshot)
  {
    read_nodes(time, u);
    read_points(time, u);
    snapshot.time = time;
    snapshot.dimension = problem.mesh().surface.tangents + 1;
    for(int d = 0; d < snapshot.dimension; ++d)
    {
      snapshot.positions[d] = positions[d];
      snapshot.front[d] = front[d];
    }
    snapshot.weights = weights;
    snapshot.temperature = temperature;
    snapshot.solid_fraction = solid_fraction;
    snapshot.cells = cells;
    snapshot.obeys_maximum_principle = false;
  }
} // namespace meltfront::reference_fem::fitted
