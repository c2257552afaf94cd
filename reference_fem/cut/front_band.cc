#include <reference_fem/cut/front_band.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    /** From a point to a rectangle, squared; zero inside (m^2). */
    double distance_square(const Point &point, const Point &lower, const Gradient &size)
    {
      double sum = 0;
      for(int d = 0; d < dim; ++d)
      {
        const double beside
            = std::max({lower[d] - point[d], 0., point[d] - lower[d] - size[d]});
        sum += beside * beside;
      }
      return sum;
    }

    bool holds(const Point &lower, const Gradient &size, const Point &point)
    {
      return distance_square(point, lower, size) == 0;
    }

    void add_sign_changes(const Cell &cell, int pieces, const PointFunction &function,
                          std::vector<Point> &result)
    {
      const auto place = [&](int i, int j) {
        return cell.real(
            {static_cast<double>(i) / pieces, static_cast<double>(j) / pieces});
      };
      std::vector<char> below, row(pieces + 1);
      for(int j = 0; j <= pieces; ++j, below = row)
        for(int i = 0; i <= pieces; ++i)
        {
          row[i] = function(place(i, j)) < 0;
          if((i > 0 && row[i] != row[i - 1]) || (j > 0 && row[i] != below[i]))
            result.push_back(place(i, j));
        }
    }
  } // namespace

  std::vector<Point> points_of_front(const BackgroundMesh &mesh,
                                     const CutGeometry &geometry)
  {
    std::vector<Point> result;
    for(const CutCell &cut : geometry.cut_cells)
      if(!cut.front.empty())
        result.push_back(mesh.cells[cut.cell].real(cut.front[cut.front.size() / 2].unit));
    return result;
  }

  std::vector<Point> points_of_front(const BackgroundMesh &mesh,
                                     const PointFunction &function)
  {
    std::vector<Point> result;
    for(std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      if(mesh.place[cell] != Place::outside)
        add_sign_changes(
            mesh.cells[cell],
            static_cast<int>(std::lround(2 * mesh.cells[cell].width() / mesh.spacing)),
            function, result);
    return result;
  }

  RefinementCriterion refined_about(std::vector<Point> front, const BackgroundMesh &mesh,
                                    const BandWidths &widths)
  {
    std::vector<std::pair<Point, double>> rim;
    for(const CurvedBoundaryCell &cell : mesh.curved_boundary_cells)
      rim.emplace_back(mesh.cells[cell.cell].real({0.5, 0.5}),
                       mesh.cells[cell.cell].width());
    return [front = std::move(front), rim = std::move(rim), spacing = mesh.spacing,
            widths](const Point &lower, const Gradient &size)
    {
      const double width = std::min(size[0], size[1]);
      const double reach
          = widths.finest * spacing + widths.grading * (width - 2 * spacing);
      return std::ranges::any_of(
                 front, [&](const Point &point)
                 { return distance_square(point, lower, size) < reach * reach; })
             || std::ranges::any_of(
                 rim, [&](const auto &cell)
                 { return width > 1.5 * cell.second && holds(lower, size, cell.first); });
    };
  }

  bool leaves_band(const BackgroundMesh &mesh, const CutGeometry &geometry,
                   const Values &level_set, double reach)
  {
    for(unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
      if(!mesh.finest(cell) && geometry.location[cell] != Location::outside)
        for(const unsigned int dof : mesh.cells[cell].level_set_dofs)
          if(std::abs(level_set[dof]) < reach * mesh.spacing)
            return true;
    return false;
  }
} // namespace meltfront::reference_fem::cut
