#include <reference_fem/enthalpy/refinable_box.templates.h>

#include <cases/error.h>
#include <reference_fem/enthalpy/box_tree.h>
#include <reference_fem/enthalpy/integrals_about_corners.h>

#include <deal.II/grid/grid_generator.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    /** The coarsest cells: see make_refinable_mesh. */
    int halvings_of(const std::vector<unsigned int> &cells, int n)
    {
      int halvings = static_cast<int>(std::log2(std::sqrt(n) / 2));
      for(const unsigned int along : cells)
        while(halvings > 0 && along % (1u << halvings) != 0)
          --halvings;
      if(halvings < 1)
        throw cases::Refusal(fmt::format(
            "fem-enthalpy refines at the front (refinement = front) from cells twice as "
            "large at least: n is to be 16 or more, and the cells along every side an "
            "even number, not {}",
            n < 16 ? static_cast<unsigned int>(n)
                   : *std::ranges::find_if(cells, [](unsigned int along)
                                           { return along % 2 != 0; })));
      return halvings;
    }
  } // namespace

  template <int dim>
  RefinableBox<dim>::RefinableBox(const cases::Scene &scene, int n)
    : scene(scene)
    , spacing(scene.domain.side() / n)
  {
    const cases::Domain &domain = scene.domain;
    std::vector<unsigned int> cells(dim, n);
    dealii::Point<dim> upper;
    for(int d = 0; d < dim; ++d)
    {
      lower[d] = domain.lower[d];
      upper[d] = domain.upper[d];
      if(d > 0)
        cells[d]
            = std::max(1, static_cast<int>(std::lround((upper[d] - lower[d]) / spacing)));
      sizes[d] = (upper[d] - lower[d]) / cells[d];
    }
    most_halvings = halvings_of(cells, n);
    for(unsigned int &along : cells)
      along >>= most_halvings;
    // deal.II numbers the sides of a block in the order of cases::Side.
    dealii::GridGenerator::subdivided_hyper_rectangle(local.triangulation, cells, lower,
                                                      upper, true);
    number();
  }

  template <int dim>
  typename RefinableBox<dim>::Cell
  RefinableBox<dim>::find(const cases::Position &point) const
  {
    const double tolerance = 1e-12 * scene.domain.side();
    for(const auto &cell : local.triangulation.active_cell_iterators())
    {
      const auto &least = cell->vertex(0), &greatest = cell->vertex(n_corners - 1);
      bool inside = true;
      for(int d = 0; d < dim; ++d)
        inside &= point[d] >= least[d] - tolerance && point[d] <= greatest[d] + tolerance;
      if(inside)
        return cell;
    }
    throw cases::InputError(
        fmt::format("the source at ({:.6g}, {:.6g}, {:.6g}) lies outside of the domain",
                    point[0], point[1], point[2]));
  }

  template <int dim>
  std::size_t RefinableBox<dim>::cell_at(const cases::Position &point) const
  {
    return find(point)->active_cell_index();
  }

  template <int dim>
  Shares RefinableBox<dim>::shares(const cases::Position &point) const
  {
    const Cell cell = find(point);
    const auto &least = cell->vertex(0), &greatest = cell->vertex(n_corners - 1);
    Shares result;
    double sum = 0;
    for(unsigned int a = 0; a < n_corners; ++a)
    {
      double value = 1;
      for(int d = 0; d < dim; ++d)
      {
        const double x
            = std::clamp((point[d] - least[d]) / (greatest[d] - least[d]), 0., 1.);
        value *= a >> d & 1 ? x : 1 - x;
      }
      // A source on a vertex is found there up to round-off only.
      if(value > 1e-12)
        visit_nodes(cell->vertex_index(a), value,
                    [&](unsigned int node, double share)
                    {
                      result.emplace_back(node, share);
                      sum += share;
                    });
    }
    for(auto &share : result)
      share.second /= sum;
    return result;
  }

  template <int dim>
  typename RefinableBox<dim>::PlaceInCell
  RefinableBox<dim>::place_in(const Cell &cell, const cases::Position &unit) const
  {
    const auto &least = cell->vertex(0), &greatest = cell->vertex(n_corners - 1);
    PlaceInCell result;
    for(int d = 0; d < dim; ++d)
    {
      result.position[d] = least[d] + unit[d] * (greatest[d] - least[d]);
      result.volume *= greatest[d] - least[d];
    }
    if(scene.domain.shape == cases::DomainShape::axisymmetric)
      result.volume *= 2 * std::numbers::pi * result.position[0];
    return result;
  }

  /** Visit points of a cell, with their measures and the corners nearest to them. */
  template <int dim>
  template <typename Visit>
  void RefinableBox<dim>::visit_points(const Cell &cell,
                                       const dealii::Quadrature<dim> &points,
                                       const Visit &visit) const
  {
    for(unsigned int q = 0; q < points.size(); ++q)
    {
      cases::Position unit{};
      unsigned int nearest = 0;
      for(int d = 0; d < dim; ++d)
      {
        unit[d] = points.point(q)[d];
        nearest |= (unit[d] > 0.5 ? 1u : 0u) << d;
      }
      const PlaceInCell place = place_in(cell, unit);
      visit(place.position, points.weight(q) * place.volume, nearest);
    }
  }

  template <int dim>
  std::vector<double> RefinableBox<dim>::node_averages(
      const std::function<double(const cases::Position &)> &function,
      const std::function<bool(const cases::Position &)> &solid, bool jumps) const
  {
    const dealii::QIterated<dim> rule(dealii::QGauss<1>(2), 2);
    constexpr char is_solid = 1, is_liquid = 2, both = 3;
    std::vector<char> phases(masters.size());
    for(const auto &cell : local.triangulation.active_cell_iterators())
    {
      char found = 0;
      visit_points(cell, rule,
                   [&](const cases::Position &p, double, unsigned int)
                   { found |= solid(p) ? is_solid : is_liquid; });
      for(unsigned int a = 0; a < n_corners; ++a)
        phases[cell->vertex_index(a)] |= found;
    }
    std::vector<double> sum(n_nodes), measure_of(n_nodes);
    for(const auto &cell : local.triangulation.active_cell_iterators())
    {
      char found = 0;
      for(unsigned int a = 0; a < n_corners; ++a)
        found |= phases[cell->vertex_index(a)];
      const bool may_jump = jumps || found == both;
      const double usual
          = may_jump ? function(place_in(cell, {0.5, 0.5, 0.5}).position) : 0;
      visit_points(cell, rule,
                   [&](const cases::Position &p, double measure, unsigned int nearest)
                   {
                     const double value = may_jump ? usual : function(p);
                     visit_nodes(cell->vertex_index(nearest), measure,
                                 [&](unsigned int node, double part)
                                 {
                                   sum[node] += part * value;
                                   measure_of[node] += part;
                                 });
                   });
      if(!may_jump)
        continue;
      const auto excess_at = [&](const cases::Position &unit)
      {
        const PlaceInCell place = place_in(cell, unit);
        return place.volume * (function(place.position) - usual);
      };
      const std::vector<double> excess = integrals_about_corners(excess_at, dim);
      for(unsigned int a = 0; a < n_corners; ++a)
        visit_nodes(cell->vertex_index(a), excess[a],
                    [&](unsigned int node, double part) { sum[node] += part; });
    }
    for(unsigned int i = 0; i < n_nodes; ++i)
      sum[i] /= measure_of[i];
    return sum;
  }

  template <int dim>
  std::vector<int> RefinableBox<dim>::halvings_left() const
  {
    std::vector<int> result;
    for(const auto &cell : local.triangulation.active_cell_iterators())
      result.push_back(most_halvings - cell->level());
    return result;
  }

  template <int dim>
  std::vector<double> RefinableBox<dim>::jumps(const std::vector<double> &values) const
  {
    const auto &cells = local.triangulation;
    const auto size = [this](const auto &cell, int d)
    { return std::ldexp(sizes[d], most_halvings - cell->level()); };
    std::vector<std::array<double, dim>> gradient(cells.n_active_cells());
    for(const auto &cell : cells.active_cell_iterators())
      for(int d = 0; d < dim; ++d)
      {
        double sum = 0;
        for(unsigned int a = 0; a < n_corners; ++a)
          sum += (a >> d & 1u ? 1 : -1) * values[site_of_vertex[cell->vertex_index(a)]];
        gradient[cell->active_cell_index()][d] = sum / (n_corners / 2) / size(cell, d);
      }
    std::vector<double> result(cells.n_active_cells());
    for(const auto &cell : cells.active_cell_iterators())
      for(const auto face : cell->face_indices())
      {
        if(cell->at_boundary(face) || cell->neighbor(face)->has_children())
          continue;
        const auto neighbour = cell->neighbor(face);
        const int d = static_cast<int>(face / 2);
        const auto here = cell->active_cell_index(),
                   there = neighbour->active_cell_index();
        const double jump = std::abs(gradient[here][d] - gradient[there][d]);
        result[here] = std::max(result[here], size(cell, d) * jump);
        result[there] = std::max(result[there], size(neighbour, d) * jump);
      }
    return result;
  }

  template <int dim>
  std::vector<NestedLevel>
  RefinableBox<dim>::levels(const ConductionMatrix &network) const
  {
    std::vector<BoxTree::Cell> cells;
    cells.reserve(local.triangulation.n_active_cells());
    for(const auto &cell : local.triangulation.active_cell_iterators())
    {
      BoxTree::Cell box{{}, 1u << (most_halvings - cell->level())};
      for(int d = 0; d < dim; ++d)
        box.corner[d] = static_cast<std::uint32_t>(
            std::lround((cell->vertex(0)[d] - lower[d]) / sizes[d]));
      cells.push_back(box);
    }
    return nested_levels({dim, 1u << most_halvings, std::move(cells)}, dim, network);
  }

  template <int dim>
  bool RefinableBox<dim>::adapt(const std::vector<Wish> &wishes,
                                const std::vector<std::vector<double> *> &fields)
  {
    std::vector<Wish> possible = wishes;
    const std::vector<int> left = halvings_left();
    for(std::size_t c = 0; c < possible.size(); ++c)
      if(possible[c] == Wish::halve && left[c] == 0)
        possible[c] = Wish::keep;
    std::vector<double> volume(masters.size());
    {
      const std::vector<double> by_node = volumes();
      for(unsigned int v = 0; v < volume.size(); ++v)
        if(node_of_vertex[v] != nowhere)
          volume[v] = by_node[node_of_vertex[v]];
    }
    std::vector<std::vector<double>> values;
    for(const std::vector<double> *field : fields)
      values.push_back(by_vertex(*field));
    if(!local.adapt(possible, volume, values))
      return false;
    number();
    for(std::size_t f = 0; f < fields.size(); ++f)
    {
      fields[f]->resize(n_nodes);
      for(unsigned int v = 0; v < values[f].size(); ++v)
        if(node_of_vertex[v] != nowhere)
          (*fields[f])[node_of_vertex[v]] = values[f][v];
    }
    return true;
  }

  template <int dim>
  void RefinableBox<dim>::save(boost::archive::binary_oarchive &state) const
  {
    local.triangulation.save(state, 0);
  }

  template <int dim>
  void RefinableBox<dim>::restore(boost::archive::binary_iarchive &state)
  {
    local.triangulation.load(state, 0);
    number();
  }

  std::unique_ptr<RefinableMesh> make_refinable_mesh(const cases::Scene &scene,
                                                     int dimension, int n)
  {
    const bool of_boxes = scene.domain.shape == cases::DomainShape::box
                          || scene.domain.shape == cases::DomainShape::axisymmetric;
    if(!of_boxes || dimension < 2 || scene.domain.outline)
      throw cases::Refusal(fmt::format(
          "fem-enthalpy refines at the front (refinement = front) in boxes and half "
          "sections of axisymmetric bodies, not in a domain of the shape {}",
          cases::to_string(scene.domain.shape)));
    for(const cases::Side side : scene.sides())
      if(scene.boundary(side).kind == cases::BoundaryKind::periodic)
        throw cases::Refusal(
            fmt::format("fem-enthalpy refines at the front (refinement = front) where no "
                        "side is periodic, and {} is",
                        cases::to_string(side)));
    if(dimension == 2)
      return std::make_unique<RefinableBox<2>>(scene, n);
    return std::make_unique<RefinableBox<3>>(scene, n);
  }
} // namespace meltfront::reference_fem
