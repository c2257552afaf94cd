#include <cases/expression_words.h>
#include <cases/initial_level.h>
#include <cases/mean_with_jumps.h>
#include <particles/sph/initial_state.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    /** Mean enthalpy of a cell of a planar scene, from the exact heat within it. */
    double planar_mean(const Discretisation &dis, const cases::Position &position)
    {
      const cases::Scene &scene = dis.scene;
      const double half = 0.5 * dis.cell[0];
      const double lower = std::max(position[0] - half, scene.domain.lower[0]);
      const double upper = std::min(position[0] + half, scene.domain.upper[0]);
      return scene.initial.exact->heat_content(lower, upper, scene.start_time)
             / ((upper - lower) * scene.material.solid.density);
    }

    /** Part of a cell in which a level set is negative, by points on a fine grid in the
     * cell. */
    double negative_fraction(const Discretisation &dis, const cases::Position &centre,
                             const cases::Field &level)
    {
      const int points = dis.dimension == 2 ? 32 : 12;
      const int points_z = dis.dimension > 2 ? points : 1;
      int negative = 0;
      for(int k = 0; k < points_z; ++k)
        for(int j = 0; j < points; ++j)
          for(int i = 0; i < points; ++i)
          {
            cases::Position p = centre;
            p[0] += ((i + 0.5) / points - 0.5) * dis.cell[0];
            p[1] += ((j + 0.5) / points - 0.5) * dis.cell[1];
            p[2] += ((k + 0.5) / points_z - 0.5) * (points_z > 1 ? dis.cell[2] : 0);
            negative += level(p, dis.scene.start_time) < 0;
          }
      return double(negative) / (points * points * points_z);
    }

    double half_diagonal(const Discretisation &dis)
    {
      double squared = 0;
      for(int d = 0; d < dis.dimension; ++d)
        squared += dis.cell[d] * dis.cell[d];
      return 0.5 * std::sqrt(squared);
    }

    double from_exact(const Discretisation &dis, const cases::Position &position)
    {
      const cases::Scene &scene = dis.scene;
      const cases::ExactSolution &exact = *scene.initial.exact;
      if(exact.symmetry() == cases::Symmetry::planar)
        return planar_mean(dis, position);
      const double distance = exact.signed_distance(position, scene.start_time);
      double inner = 0;
      if(std::abs(distance) <= half_diagonal(dis))
        inner = negative_fraction(dis, position,
                                  {"", [&exact](const cases::Position &p, double time)
                                   { return exact.signed_distance(p, time); }});
      if(inner == 0 || inner == 1)
        return scene.material.enthalpy(exact.temperature(position, scene.start_time),
                                       scene.initial.solid_fraction_at_melting);
      const double solid = exact.solid_at_origin() ? inner : 1 - inner;
      return scene.material.enthalpy(scene.material.melting_temperature, solid);
    }

    /** Whether a level set changes its sign between a cell's centre and its corners. */
    bool cuts(const Discretisation &dis, const cases::Position &centre,
              const cases::Field &level)
    {
      const double time = dis.scene.start_time;
      const bool negative = level(centre, time) < 0;
      for(int corner = 0; corner < 1 << dis.dimension; ++corner)
      {
        cases::Position p = centre;
        for(int d = 0; d < dis.dimension; ++d)
          p[d] += (corner >> d & 1 ? 0.5 : -0.5) * dis.cell[d];
        if((level(p, time) < 0) != negative)
          return true;
      }
      return false;
    }

    /** Mean enthalpy of a cell of a slab, each phase integrated up to the front. */
    double mean_along_line(const Discretisation &dis, double centre,
                           const cases::Field &level)
    {
      const cases::Scene &scene = dis.scene;
      const double time = scene.start_time;
      const auto is_solid = [&](double x) { return level({x, 0, 0}, time) < 0; };
      const double lower = centre - 0.5 * dis.spacing, upper = centre + 0.5 * dis.spacing;
      double split = upper;
      if(is_solid(lower) != is_solid(upper))
      {
        double other = lower;
        for(int k = 0; k < 50; ++k)
        {
          const double middle = (other + split) / 2;
          (is_solid(middle) == is_solid(lower) ? other : split) = middle;
        }
      }
      const auto heat = [&](double from, double to)
      {
        const bool solid = is_solid((from + to) / 2);
        return from == to ? 0
                          : boost::math::quadrature::gauss<double, 7>::integrate(
                              [&](double x) {
                                return scene.material.enthalpy(
                                    scene.initial.temperature({x, 0, 0}, time), solid);
                              },
                              from, to);
      };
      return (heat(lower, split) + heat(split, upper)) / dis.spacing;
    }

    /** Mean enthalpy of a cell in which the temperature may jump: one that it jumps in is
     * not at the melting temperature, and none has the temperature of its middle. */
    double mean_over_cell(const Discretisation &dis, const cases::Position &centre,
                          const cases::Field &level)
    {
      constexpr int parts = 2, halvings = 6;
      const cases::Scene &scene = dis.scene;
      cases::Position from = centre, to = centre;
      for(int d = 0; d < dis.dimension; ++d)
      {
        from[d] -= 0.5 * dis.cell[d];
        to[d] += 0.5 * dis.cell[d];
      }
      return cases::mean_over_box(
          [&](const cases::Position &p)
          {
            const double temperature = scene.initial.temperature(p, scene.start_time);
            return scene.material.enthalpy(
                temperature,
                temperature == scene.material.melting_temperature && !scene.initial.front
                    ? scene.initial.solid_fraction_at_melting
                    : double(level(p, scene.start_time) < 0));
          },
          centre, from, to, dis.dimension, parts, halvings);
    }

    /** A level set decides on the phase; a cell of the plane or of space that it cuts is
     * at the melting temperature. */
    double from_front(const Discretisation &dis, const cases::Position &position,
                      const cases::Field &level)
    {
      const cases::Scene &scene = dis.scene;
      // A material that melts over a range has no front to cut a cell.
      const bool cut = !scene.material.melting_range && cuts(dis, position, level);
      if(cut && dis.dimension == 1)
        return mean_along_line(dis, position[0], level);
      if(!cut && !scene.initial.front)
        return scene.material.enthalpy(
            scene.initial.temperature(position, scene.start_time),
            scene.initial.solid_fraction_at_melting);
      const double solid = cut ? negative_fraction(dis, position, level)
                               : double(level(position, scene.start_time) < 0);
      return scene.material.enthalpy(
          cut ? scene.material.melting_temperature
              : scene.initial.temperature(position, scene.start_time),
          solid);
    }
  } // namespace

  std::vector<double> initial_enthalpy(const Discretisation &dis)
  {
    const cases::Scene &scene = dis.scene;
    const cases::Field level = cases::initial_level(scene);
    std::vector<double> enthalpy(dis.particles.size());
    const bool jumps = cases::may_jump_with(scene.initial.temperature.expression, "xyz");
    for(std::size_t i = 0; i < enthalpy.size(); ++i)
    {
      const cases::Position position = dis.particles.point(i);
      enthalpy[i] = scene.initial.exact ? from_exact(dis, position)
                    : jumps             ? mean_over_cell(dis, position, level)
                                        : from_front(dis, position, level);
    }
    return enthalpy;
  }
} // namespace meltfront::particles
