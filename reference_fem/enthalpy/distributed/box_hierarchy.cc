#include <reference_fem/enthalpy/distributed/box_hierarchy.h>
#include <reference_fem/enthalpy/distributed/node_shares.h>
#include <reference_fem/enthalpy/integrals_about_corners.h>

#include <cases/error.h>

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>

namespace meltfront::reference_fem
{
  namespace
  {
    using cases::BoundaryKind, cases::Position, cases::Side;
    using Place = BoxLattice::Place;

    /** The part of a cell that a point of a quadrature stands for. */
    struct CellPoint
    {
      Position unit{};
      double weight = 1;
      unsigned int nearest = 0; ///< corner
    };

    std::vector<CellPoint> cell_points(const dealii::Quadrature<1> &line, int dimension)
    {
      std::vector<CellPoint> points{CellPoint{}};
      for(int d = 0; d < dimension; ++d)
      {
        std::vector<CellPoint> next;
        for(unsigned int q = 0; q < line.size(); ++q)
          for(CellPoint point : points)
          {
            point.unit[d] = line.point(q)[0];
            point.weight *= line.weight(q);
            point.nearest |= (point.unit[d] > 0.5 ? 1u : 0u) << d;
            next.push_back(point);
          }
        points = std::move(next);
      }
      return points;
    }

    class BoxOfRank : public Mesh
    {
    public:
      BoxOfRank(const cases::Scene &scene, const RankLevel &level)
        : scene(scene)
        , level(level)
        , lattice(level.lattice)
        , n_own(static_cast<unsigned int>(level.n_own()))
      {
      }

      Discretisation discretise() const override;
      Shares shares(const Position &point) const override;
      void expect_many_points() override
      {
      }
      bool anywhere(bool here) const override
      {
        return dealii::Utilities::MPI::max(here ? 1 : 0, level.communicator) > 0;
      }
      std::vector<double>
      node_averages(const std::function<double(const Position &)> &function,
                    const std::function<bool(const Position &)> &solid,
                    bool jumps) const override;

    private:
      using Corners = std::array<unsigned int, 8>;

      /** Visit the cells that have own nodes: the place, the rank's numbers of the
       * corners. */
      template <typename Visit>
      void visit_cells(const Visit &visit) const
      {
        for(unsigned int i = 0; i < level.n_with_ghosts(); ++i)
        {
          const Place cell = level.place(i);
          if(!lattice.begins_cell(cell))
            continue;
          Corners corners;
          bool has_own = false;
          for(unsigned int a = 0; a < lattice.n_corners(); ++a)
          {
            corners[a] = level.local(BoxLattice::corner(cell, a));
            has_own = has_own || corners[a] < n_own;
          }
          if(has_own)
            visit(cell, corners);
        }
      }

      Position point_in(const Place &cell, const Position &unit) const
      {
        Position result = lattice.position(cell);
        for(int d = 0; d < lattice.dimension; ++d)
          result[lattice.coordinate(d)] += unit[d] * lattice.spacing(d);
        return result;
      }

      void find_walls(Discretisation &result) const;
      void place_sites(Discretisation &result) const;

      const cases::Scene &scene;
      const RankLevel &level;
      const BoxLattice &lattice;
      unsigned int n_own;
    };

    Discretisation BoxOfRank::discretise() const
    {
      Discretisation result;
      result.dimension = lattice.dimension;
      result.spacing = scene.domain.side() / lattice.cells[lattice.coordinate(0)];
      result.conduction = level.conduction.expanded();
      result.volume.reserve(n_own);
      result.positions.reserve(n_own);
      for(unsigned int i = 0; i < n_own; ++i)
      {
        const Place node = level.place(i);
        result.volume.push_back(lattice.measure(node));
        result.positions.push_back(lattice.position(node));
      }
      find_walls(result);
      place_sites(result);
      return result;
    }

    void BoxOfRank::find_walls(Discretisation &result) const
    {
      for(unsigned int i = 0; i < n_own; ++i)
      {
        const Place node = level.place(i);
        for(int d = 0; d < lattice.dimension; ++d)
          for(const bool upper : {false, true})
            if(upper ? lattice.at_upper(node, d) : lattice.at_lower(node, d))
              result.walls[2 * lattice.coordinate(d) + upper].push_back(
                  {i, lattice.measure(node, d) / lattice.spacing(d),
                   result.positions[i]});
      }
    }

    /** Own nodes, then ghosts, so that the number of a site is that of its node. Own
     * cells are those whose lower corner is an own node. */
    void BoxOfRank::place_sites(Discretisation &result) const
    {
      const std::size_t n_sites = level.n_with_ghosts();
      result.site_weights.resize(n_sites);
      std::ranges::copy(result.volume, result.site_weights.begin());
      for(int d = 0; d < lattice.dimension; ++d)
        result.site_positions[d].resize(n_sites);
      for(unsigned int i = 0; i < n_sites; ++i)
      {
        const Position position = lattice.position(level.place(i));
        for(int d = 0; d < lattice.dimension; ++d)
          result.site_positions[d][i] = position[d];
      }
      result.cells.reserve(std::size_t(n_own) * lattice.n_corners());
      for(unsigned int i = 0; i < n_own; ++i)
        if(const Place cell = level.place(i); lattice.begins_cell(cell))
          for(unsigned int a = 0; a < lattice.n_corners(); ++a)
            result.cells.push_back(
                level.local(BoxLattice::corner(cell, lattice.bits_of_corner(a))));
    }

    /** Those of the own nodes. */
    Shares BoxOfRank::shares(const Position &point) const
    {
      Place cell{};
      std::array<double, 3> unit{};
      for(int d = 0; d < lattice.dimension; ++d)
      {
        constexpr double round_off = 1e-10;
        const int c = lattice.coordinate(d);
        const double place = (point[c] - lattice.lower[c]) / lattice.spacing(d);
        if(!(place >= -round_off && place <= lattice.cells[d] + round_off))
          throw cases::InputError(fmt::format(
              "the source at ({:.6g}, {:.6g}, {:.6g}) lies outside of the domain",
              point[0], point[1], point[2]));
        const double inside = std::clamp(place, 0., double(lattice.cells[d]));
        cell[d] = std::min(static_cast<unsigned int>(inside), lattice.cells[d] - 1);
        unit[d] = inside - cell[d];
      }
      Shares own;
      double sum = 0;
      for(unsigned int a = 0; a < lattice.n_corners(); ++a)
      {
        double value = 1;
        for(int d = 0; d < lattice.dimension; ++d)
          value *= a >> d & 1 ? unit[d] : 1 - unit[d];
        // A source on a vertex is found there up to round-off only.
        if(value <= 1e-12)
          continue;
        sum += value;
        if(const unsigned int node = level.local(BoxLattice::corner(cell, a));
           node < n_own)
          own.emplace_back(node, value);
      }
      for(auto &[node, share] : own)
        share /= sum;
      return own;
    }

    std::vector<double>
    BoxOfRank::node_averages(const std::function<double(const Position &)> &function,
                             const std::function<bool(const Position &)> &solid,
                             bool jumps) const
    {
      const std::vector<CellPoint> rule
          = cell_points(dealii::QIterated<1>(dealii::QGauss<1>(2), 2), lattice.dimension);
      constexpr unsigned int is_solid = 1, is_liquid = 2;
      std::vector<double> phases(level.n_with_ghosts());
      const auto found_at
          = [&](unsigned int node) { return static_cast<unsigned int>(phases[node]); };
      visit_cells(
          [&](const Place &cell, const Corners &corners)
          {
            unsigned int found = 0;
            for(const CellPoint &point : rule)
              found |= solid(point_in(cell, point.unit)) ? is_solid : is_liquid;
            for(unsigned int a = 0; a < lattice.n_corners(); ++a)
              phases[corners[a]] = found_at(corners[a]) | found;
          });
      // Of a ghost only the rank that has it knows all cells.
      Traffic of_set_up;
      level.exchange(phases, of_set_up);
      std::vector<double> sum(n_own), measure(n_own);
      visit_cells(
          [&](const Place &cell, const Corners &corners)
          {
            unsigned int found = 0;
            for(unsigned int a = 0; a < lattice.n_corners(); ++a)
              found |= found_at(corners[a]);
            const bool may_jump = jumps || found == (is_solid | is_liquid);
            const auto weight_at = [&](const Position &place)
            { return lattice.about_axis ? place[0] : 1.; };
            const double usual = may_jump ? function(point_in(cell, {0.5, 0.5, 0.5})) : 0;
            for(const CellPoint &point : rule)
              if(const unsigned int i = corners[point.nearest]; i < n_own)
              {
                const Position place = point_in(cell, point.unit);
                const double weight = point.weight * weight_at(place);
                sum[i] += weight * (may_jump ? usual : function(place));
                measure[i] += weight;
              }
            if(!may_jump)
              return;
            // Lines of points run as in a mesh of one process, where the lattice may have
            // another order of coordinates.
            const auto excess_at = [&](const Position &in_order)
            {
              Position unit{};
              for(int d = 0; d < lattice.dimension; ++d)
                unit[d] = in_order[lattice.coordinate(d)];
              const Position place = point_in(cell, unit);
              return weight_at(place) * (function(place) - usual);
            };
            const std::vector<double> excess
                = integrals_about_corners(excess_at, lattice.dimension);
            for(unsigned int a = 0; a < lattice.n_corners(); ++a)
            {
              unsigned int in_order = 0;
              for(int d = 0; d < lattice.dimension; ++d)
                in_order |= (a >> d & 1) << lattice.coordinate(d);
              if(const unsigned int i = corners[a]; i < n_own)
                sum[i] += excess[in_order];
            }
          });
      for(unsigned int i = 0; i < n_own; ++i)
        sum[i] /= measure[i];
      return sum;
    }

    /** How often all numbers of cells are halved, so that the coarse mesh is small, but
     * for a direct solver, where it is easily done. */
    int halvings_of(const BoxLattice &lattice)
    {
      constexpr double few_cells = 64, most_coarse_cells = 4096;
      int possible = 31;
      for(int d = 0; d < lattice.dimension; ++d)
        possible = std::min(possible, std::countr_zero(lattice.cells[d]));
      const auto count = [&](int halvings)
      {
        double product = 1;
        for(int d = 0; d < lattice.dimension; ++d)
          product *= lattice.cells[d] >> halvings;
        return product;
      };
      const unsigned int n = lattice.cells[lattice.coordinate(0)];
      int halvings = 0;
      while(halvings < possible && count(halvings + 1) >= few_cells)
        ++halvings;
      if(count(halvings) > most_coarse_cells)
        throw cases::Refusal(
            fmt::format("fem-enthalpy on several ranks joins cells to a coarse mesh of "
                        "at most {:g}, and from {} cells along the side that is not "
                        "possible: take an n such as {}",
                        most_coarse_cells, n, std::max(64u, (n + 32) / 64 * 64)));
      return halvings;
    }

    BoxLattice lattice_of(const cases::Domain &domain, int n)
    {
      BoxLattice lattice;
      lattice.dimension = domain.dimension;
      lattice.about_axis = domain.shape == cases::DomainShape::axisymmetric;
      const double spacing = domain.side() / n;
      for(int d = 0; d < domain.dimension; ++d)
      {
        lattice.lower[d] = domain.lower[d];
        lattice.upper[d] = domain.upper[d];
        lattice.cells[lattice.coordinate(d)] = static_cast<unsigned int>(
            std::max(1L, std::lround((domain.upper[d] - domain.lower[d]) / spacing)));
      }
      lattice.cells[lattice.coordinate(0)] = static_cast<unsigned int>(n);
      constexpr auto most = std::numeric_limits<dealii::types::global_dof_index>::max();
      if(lattice.n_nodes() >= most)
        throw cases::Refusal(
            fmt::format("fem-enthalpy on several ranks numbers less than {} nodes, and "
                        "{} cells along the side make {}: take a smaller n",
                        most, n, lattice.n_nodes()));
      return lattice;
    }
  } // namespace

  std::vector<RankLevel> make_rank_levels(const cases::Scene &scene, int n,
                                          MPI_Comm communicator)
  {
    dealii::MultithreadInfo::set_thread_limit(1);
    if(scene.domain.shape != cases::DomainShape::box
       && scene.domain.shape != cases::DomainShape::axisymmetric)
      throw cases::Refusal(
          "fem-enthalpy meshes boxes and half sections about an axis only "
          "on several ranks");
    for(const Side side : scene.sides())
      if(scene.boundary(side).kind == BoundaryKind::periodic)
        throw cases::Refusal("fem-enthalpy joins no periodic sides on several ranks");
    BoxLattice lattice = lattice_of(scene.domain, n);
    const int halvings = halvings_of(lattice);
    std::vector<RankLevel> levels;
    levels.reserve(halvings + std::size_t(1));
    levels.emplace_back(scene, lattice, own_nodes(lattice, communicator), nullptr,
                        communicator);
    for(int l = 0; l < halvings; ++l)
    {
      lattice = lattice.coarser();
      levels.emplace_back(scene, lattice, levels.back().own_on_coarser(), &levels.back(),
                          communicator);
    }
    return levels;
  }

  std::unique_ptr<Mesh> make_rank_mesh(const cases::Scene &scene, const RankLevel &finest)
  {
    return std::make_unique<BoxOfRank>(scene, finest);
  }
} // namespace meltfront::reference_fem
