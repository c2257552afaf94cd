#include <cases/sampling.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace meltfront::cases
{
  namespace
  {
    constexpr int samples_of_outline = 8 * samples_across;

    /** Points on the faces of a mesh's wall, some hundreds at least: in the middle of
     * parts of them, and their vertices. */
    void visit_mesh_wall(const BodyMesh &mesh, unsigned int wall,
                         const PointVisitor &visit)
    {
      std::size_t faces = 0;
      for(const BodyMesh::Face &face : mesh.boundary())
        if(face.wall == static_cast<int>(wall))
        {
          ++faces;
          for(const unsigned int v : face.vertices)
            visit(mesh.vertices()[v]);
        }
      int levels = 0;
      while(faces > 0 && faces << ((mesh.dimension() - 1) * levels) < samples_of_outline)
        ++levels;
      mesh.visit_wall(wall, levels, [&](const Position &p, double) { visit(p); });
    }

    /** Points of a circle or sphere about the origin: those of the square's or cube's
     * faces about it, moved along their radius, so that no radius is too small for them.
     */
    void visit_round_wall(int dimension, double radius, int across,
                          const PointVisitor &visit)
    {
      const int layers = dimension == 3 ? across : 1;
      for(int k = 0; k < layers; ++k)
        for(int j = 0; j < across; ++j)
          for(int i = 0; i < across; ++i)
          {
            const int half = across / 2;
            const std::array<int, 3> index{i - half, j - half, layers > 1 ? k - half : 0};
            const auto on_face = [half](int d) { return std::abs(d) == half; };
            if(std::ranges::none_of(index, on_face))
              continue;
            Position p{double(index[0]), double(index[1]), double(index[2])};
            const double distance = coordinate(Symmetry::spherical, p);
            for(double &component : p)
              component *= radius / distance;
            visit(p);
          }
    }

    void visit_shell(const Domain &domain, const PointVisitor &visit)
    {
      for(int i = 0; i < samples_across; ++i)
        visit_round_wall(
            domain.dimension,
            domain.inner_radius
                + (domain.radius - domain.inner_radius) * i / (samples_across - 1),
            domain.dimension == 2 ? samples_across : samples_across / 3, visit);
    }

    bool on_side(const Domain &domain, Side side, const Position &p)
    {
      const auto d = static_cast<std::size_t>(side) / 2;
      const bool upper = static_cast<std::size_t>(side) % 2 == 1;
      return std::abs(p[d] - (upper ? domain.upper[d] : domain.lower[d]))
             < 1e-9 * domain.side();
    }
  } // namespace

  bool contains(const Domain &domain, const Position &p)
  {
    if(domain.outline)
      return domain.outline->inside(p);
    if(domain.mesh)
      return domain.mesh->cell_at(p).has_value();
    if(!domain.round())
      return true;
    const double squared = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    return squared <= domain.radius * domain.radius * (1 + 1e-12)
           && squared >= domain.inner_radius * domain.inner_radius * (1 - 1e-12);
  }

  void visit_points(const Domain &domain, const PointVisitor &visit)
  {
    if(domain.inner_radius > 0)
    {
      visit_shell(domain, visit);
      return;
    }
    const bool ball = domain.round();
    std::array<int, 3> count{1, 1, 1};
    for(int d = 0; d < domain.dimension; ++d)
      count[d] = samples_across;
    Position p{};
    for(int k = 0; k < count[2]; ++k)
      for(int j = 0; j < count[1]; ++j)
        for(int i = 0; i < count[0]; ++i)
        {
          const std::array<int, 3> index{i, j, k};
          for(int d = 0; d < domain.dimension; ++d)
          {
            const double lower = ball ? -domain.radius : domain.lower[d];
            const double upper = ball ? domain.radius : domain.upper[d];
            p[d] = lower + (upper - lower) * index[d] / (samples_across - 1);
          }
          if(contains(domain, p))
            visit(p);
        }
    if(domain.outline)
      for(const Position &point : domain.outline->points(samples_of_outline))
        visit(point);
    if(domain.mesh)
      for(const Position &vertex : domain.mesh->vertices())
        visit(vertex);
  }

  void visit_wall(const Domain &domain, Side side, const PointVisitor &visit)
  {
    if(domain.outline)
    {
      for(const Position &point : domain.outline->points(samples_of_outline))
        visit(point);
      return;
    }
    if(domain.mesh)
    {
      visit_mesh_wall(*domain.mesh, index_of_mesh_wall(side), visit);
      return;
    }
    if(domain.round())
    {
      visit_round_wall(
          domain.dimension, side == Side::inner ? domain.inner_radius : domain.radius,
          domain.dimension == 2 ? 2 * samples_across - 1 : samples_across, visit);
      return;
    }
    visit_points(domain,
                 [&](const Position &p)
                 {
                   if(on_side(domain, side, p))
                     visit(p);
                 });
  }
} // namespace meltfront::cases
