#include <reference_fem/cut/conservative/polygon.h>

namespace meltfront::reference_fem::cut::conservative
{
  double Polygon::area() const
  {
    double sum = 0;
    integrate(*this, [&sum](const Point &, double weight) { sum += weight; });
    return sum;
  }

  Split split(const Polygon &polygon, const LinearFunction &function)
  {
    Split result;
    int crossings = 0;
    for(const Point *corner = polygon.begin(); corner < polygon.end(); ++corner)
    {
      const Point &next = corner + 1 < polygon.end() ? corner[1] : *polygon.begin();
      const double here = function(*corner), there = function(next);
      (here < 0 ? result.negative : result.positive).add(*corner);
      if((here < 0) == (there < 0))
        continue;
      // From the negative end, so that neighbours that share the edge agree.
      const Point zero = here < 0 ? *corner + here / (here - there) * (next - *corner)
                                  : next + there / (there - here) * (*corner - next);
      result.negative.add(zero);
      result.positive.add(zero);
      (crossings++ == 0 ? result.line.begin : result.line.end) = zero;
    }
    result.crossed = crossings == 2;
    return result;
  }
} // namespace meltfront::reference_fem::cut::conservative
