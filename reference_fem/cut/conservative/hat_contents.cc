#include <reference_fem/cut/conservative/enthalpy_start.h>

#include <array>
#include <cmath>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
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
} // namespace meltfront::reference_fem::cut::conservative
