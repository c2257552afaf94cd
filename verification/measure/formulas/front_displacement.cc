#include <verification/measure/formulas/front_displacement.h>
#include <verification/measure/formulas/front_shape.h>
#include <verification/measure/formulas/site_coordinates.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** Visit the middles of the parts of a cube that is divided along each direction. */
    template <typename Visit>
    void visit_parts(const cases::Position &centre, double width, int dimension,
                     int parts, const Visit &visit)
    {
      const auto offset = [&](int part) { return width * ((part + 0.5) / parts - 0.5); };
      for(int i = 0; i < parts; ++i)
        for(int j = 0; j < (dimension > 1 ? parts : 1); ++j)
          for(int k = 0; k < (dimension > 2 ? parts : 1); ++k)
          {
            cases::Position p = centre;
            p[0] += offset(i);
            if(dimension > 1)
              p[1] += offset(j);
            if(dimension > 2)
              p[2] += offset(k);
            visit(p);
          }
    }

    /** Share of a cube's parts that is solid. */
    double solid_share(const cases::ExactSolution &exact, const cases::Position &centre,
                       double width, int dimension, int parts, double time)
    {
      int solid = 0, all = 0;
      visit_parts(centre, width, dimension, parts,
                  [&](const cases::Position &p)
                  {
                    solid += exact.solid_fraction(p, time) > 0.5;
                    ++all;
                  });
      return static_cast<double>(solid) / all;
    }

    double exact_solid_fraction(const cases::ExactSolution &exact,
                                const cases::Position &centre, double width,
                                int dimension, double time)
    {
      // Corners of a cube twice as wide: a front that only grazes the site is seen.
      const double share = solid_share(exact, centre, 4 * width, dimension, 2, time);
      if(share == 0 || share == 1)
        return share;
      return solid_share(exact, centre, width, dimension, dimension > 2 ? 8 : 16, time);
    }
  } // namespace

  FrontDisplacement front_displacement(const cases::Snapshot &snapshot,
                                       const cases::ExactSolution &exact)
  {
    const double time = snapshot.time, area = exact.front_area(time);
    const int dimension = snapshot.dimension;
    double mismatch = 0;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
    {
      const double weight = snapshot.weights[i];
      const double width = dimension == 2   ? std::sqrt(weight)
                           : dimension == 3 ? std::cbrt(weight)
                                            : weight;
      mismatch += weight
                  * std::abs(snapshot.solid_fraction[i]
                             - exact_solid_fraction(exact, site_position(snapshot, i),
                                                    width, dimension, time));
    }
    return {(solid_volume(snapshot) - exact.solid_volume(time)) / area, mismatch / area};
  }
} // namespace meltfront::verification
