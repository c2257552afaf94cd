#include <cases/sampling.h>

#include <cmath>

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

    bool on_side(const Domain &domain, Side side, const Position &p)
    {
      const double tolerance = 1e-9 * domain.side();
      const double distance = coordinate(
          domain.dimension == 2 ? Symmetry::cylindrical : Symmetry::spherical, p);
      if(side == Side::outer)
        return distance > domain.radius * (1 - 2. / samples_across);
      if(side == Side::inner)
        return distance < domain.inner_radius + domain.radius * 2. / samples_across;
      const int d = static_cast<int>(side) / 2;
      const bool upper = static_cast<int>(side) % 2 == 1;
      return std::abs(p[d] - (upper ? domain.upper[d] : domain.lower[d])) < tolerance;
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
    visit_points(domain,
                 [&](Position p)
                 {
                   if(!on_side(domain, side, p))
                     return;
                   if(side == Side::outer || side == Side::inner)
                   {
                     const double distance = coordinate(Symmetry::spherical, p);
                     for(double &component : p)
                       component
                           *= (side == Side::outer ? domain.radius : domain.inner_radius)
                              / distance;
                   }
                   visit(p);
                 });
  }
} // namespace meltfront::cases
