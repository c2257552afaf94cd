#ifndef meltfront_verification_measure_tests_measured_front_h
#define meltfront_verification_measure_tests_measured_front_h

#include <particles/level_set/front_contour.h>
#include <particles/level_set/front_geometry.h>
#include <particles/level_set/tests/shapes.h>
#include <verification/measure/formulas/interface_error.h>

namespace meltfront::particles::level_set
{
  /** Owned by somebody else. */
  template <typename T>
  std::shared_ptr<const T> borrowed(const T &object)
  {
    return {std::shared_ptr<void>(), &object};
  }

  /** A front in the unit square or cube against a shape carried along by a velocity, as
   * a run on the front's grid is measured. */
  inline verification::InterfaceErrors measured(const LevelSet &front,
                                                const cases::Shape &shape,
                                                const cases::VelocityField &velocity,
                                                double time)
  {
    const int dimension = front.grid().dimension();
    cases::Scene scene;
    scene.problem = cases::ProblemKind::interface_advection;
    scene.domain.dimension = dimension;
    scene.domain.upper = {1, 1, dimension == 3 ? 1. : 0.};
    scene.interface = cases::InterfaceAdvection{borrowed(shape), borrowed(velocity)};
    std::array<std::vector<double>, 3> points, normals;
    std::vector<double> curvatures;
    for(const Position &point : front_points(front))
    {
      const Position normal = outward_normal(front, point);
      for(int d = 0; d < dimension; ++d)
      {
        points[d].push_back(point[d]);
        normals[d].push_back(normal[d]);
      }
      curvatures.push_back(curvature(front, point));
    }
    cases::Snapshot snapshot;
    snapshot.dimension = dimension;
    snapshot.time = time;
    for(int d = 0; d < dimension; ++d)
    {
      snapshot.front[d] = points[d];
      snapshot.front_normal[d] = normals[d];
    }
    snapshot.front_curvature = curvatures;
    snapshot.level_set = [&front](const Position &p) { return front.value(p); };
    return verification::InterfaceComparison(scene, front.grid().spacing())
        .errors(snapshot);
  }

  /** The same against a shape that is at rest. */
  inline verification::InterfaceErrors measured(const LevelSet &front,
                                                const cases::Shape &shape)
  {
    return measured(front, shape, cases::RigidMotion({}, 0, {}), 0);
  }
} // namespace meltfront::particles::level_set

#endif
