#include <reference_fem/fitted/events/approach.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using dealii::Vector;

    /** The share of a ray, at its centre of the volume, at which a phase is dropped: less
     * than that is lost in the rounding of the heat of all. */
    constexpr double thinnest = 1e-9;

    /** A crossing of a wall whose phase is about to vanish is believed in steps of at
     * most this share of the time left to that. */
    constexpr double believed = 0.2;
  } // namespace

  Approach approach_of(const FittedProblem &problem, const unsigned int interval,
                       const Vector<double> &u, const Vector<double> &rate)
  {
    const RayMesh &mesh = problem.mesh();
    Approach result{interval, mesh.outer - mesh.inner};
    if(!mesh.has_front())
      return result;
    const bool first = interval == 0, last = interval == mesh.n_fronts();
    const unsigned int lower = first ? 0 : mesh.front_node(0, interval - 1),
                       upper = last ? 0 : mesh.front_node(0, interval);
    result.thickness = (last ? mesh.outer : u[upper]) - (first ? mesh.inner : u[lower]);
    const double growth = (last ? 0 : rate[upper]) - (first ? 0 : rate[lower]);
    if(growth < 0)
      result.remaining = result.thickness / -growth;
    // To a centre it is the volume within that shrinks evenly, or faster.
    if(first && mesh.has_centre())
      result.remaining /= mesh.surface.exponent + 1;
    return result;
  }

  Approach soonest(const FittedProblem &problem, const Vector<double> &u,
                   const Vector<double> &rate)
  {
    Approach result = approach_of(problem, 0, u, rate);
    for(unsigned int interval = 1; interval <= problem.mesh().n_fronts(); ++interval)
      if(const Approach other = approach_of(problem, interval, u, rate);
         other.remaining < result.remaining)
        result = other;
    return result;
  }

  bool has_vanished(const RayMesh &mesh, const Approach &approach)
  {
    const double share = approach.interval == 0 && mesh.has_centre()
                             ? std::pow(thinnest, 1. / (mesh.surface.exponent + 1))
                             : thinnest;
    return approach.thickness < share * (mesh.outer - mesh.inner);
  }

  /** Whether a wall passes the melting temperature when the phase at it may already
   * have vanished: the step was too long to tell. */
  bool doubtful(const FittedProblem &problem, const std::vector<WallCrossing> &crossings,
                const Vector<double> &u, const Vector<double> &rate, const double step)
  {
    return std::ranges::any_of(
        crossings,
        [&](const WallCrossing &crossing)
        {
          const unsigned int interval = crossing.inner ? 0 : problem.mesh().n_fronts();
          return step > believed * approach_of(problem, interval, u, rate).remaining;
        });
  }
} // namespace meltfront::reference_fem::fitted
