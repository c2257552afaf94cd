#include <cases/error.h>
#include <cases/exact/manufactured/distance_to_front.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meltfront::cases::manufactured
{
  namespace
  {
    /** Unit vectors all around, and which of them are next to each. */
    struct Directions
    {
      std::vector<Position> units;
      std::vector<std::vector<std::size_t>> neighbours;

      Directions(std::vector<Position> all, double cosine_of_reach)
        : units(std::move(all))
        , neighbours(units.size())
      {
        for(std::size_t i = 0; i < units.size(); ++i)
          for(std::size_t j = 0; j < units.size(); ++j)
          {
            const Position &a = units[i], &b = units[j];
            if(i != j && a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > cosine_of_reach)
              neighbours[i].push_back(j);
          }
      }
    };

    Directions around_in_the_plane()
    {
      const int count = 32;
      const double angle = 2 * std::numbers::pi / count;
      std::vector<Position> all;
      for(int n = 0; n < count; ++n)
        all.push_back({std::cos(n * angle), std::sin(n * angle), 0});
      return {all, std::cos(1.5 * angle)};
    }

    /** Evenly spread along a spiral by the golden angle. */
    Directions around_in_space()
    {
      const int count = 128;
      const double golden = std::numbers::pi * (3 - std::sqrt(5.));
      std::vector<Position> all;
      for(int n = 0; n < count; ++n)
      {
        const double z = 1 - (2 * n + 1.) / count, r = std::sqrt(1 - z * z);
        all.push_back({r * std::cos(n * golden), r * std::sin(n * golden), z});
      }
      // The share of each is a patch of radius 2/sqrt(count).
      return {all, std::cos(4.5 / std::sqrt(count))};
    }

    const Directions &directions(int dimension)
    {
      static const Directions plane = around_in_the_plane(), space = around_in_space();
      return dimension == 3 ? space : plane;
    }

    /** A search from one place for the nearest point of the front. */
    class Search
    {
    public:
      Search(const FrontFamily &family, const Position &origin, double time)
        : family(family)
        , origin(origin)
        , time(time)
        , side(family.level_set(origin, time) < 0 ? -1 : 1)
      {
        const auto [lower, upper] = family.domain();
        diameter
            = std::hypot(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]);
      }

      double nearest()
      {
        descend(origin);
        for(double radius = diameter / 60; !std::isfinite(best) && radius < 4 * diameter;
            radius *= 1.2)
          look_around(radius);
        const int most_rounds = 4;
        double before = 2 * best;
        for(int n = 0; n < most_rounds && best < 0.999 * before; ++n)
        {
          before = best;
          look_around(best);
        }
        if(!std::isfinite(best))
          throw NumericalError("manufactured front", 0, time, "distance to the front",
                               "is not found within four diameters of the domain");
        return side * best;
      }

    private:
      const FrontFamily &family;
      const Position &origin;
      double time;
      int side;
      double diameter;
      double best = std::numeric_limits<double>::infinity();
      Position best_foot{};

      static double distance(const Position &a, const Position &b)
      {
        return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      }

      /** Newton's method along the gradient, in steps that do not leap over bodies, from
       * a place to the front and on to the nearest place around there. */
      void descend(Position y)
      {
        const int most_steps = 100;
        const double longest = diameter / 30;
        for(int n = 0; n < most_steps; ++n)
        {
          const FrontDerivatives f = family.second_derivatives(y, time);
          const double slope = std::sqrt(f.square_of_gradient());
          if(slope == 0)
            return;
          const double step = std::clamp(f.value / slope, -longest, longest);
          for(int d = 0; d < 3; ++d)
            y[d] -= step * f.gradient[d] / slope;
          if(std::abs(step) < 1e-12 * diameter)
          {
            const Position foot = refined(slid(y));
            accept(std::isfinite(foot[0]) ? foot : y);
            return;
          }
        }
      }

      /** Go down to the front from where, on a sphere, the level set is closest to the
       * other phase or beyond it. */
      void look_around(double radius)
      {
        const Directions &all = directions(family.dimension());
        std::vector<Position> places(all.units.size());
        std::vector<double> height(all.units.size());
        for(std::size_t n = 0; n < places.size(); ++n)
        {
          for(int d = 0; d < 3; ++d)
            places[n][d] = origin[d] + radius * all.units[n][d];
          height[n] = side * family.level_set(places[n], time);
        }
        for(std::size_t n = 0; n < places.size(); ++n)
        {
          const auto &near = all.neighbours[n];
          const bool lowest = std::none_of(near.begin(), near.end(),
                                           [&](std::size_t neighbour)
                                           { return height[neighbour] < height[n]; });
          const bool known = distance(places[n], best_foot) < 0.3 * radius;
          if(lowest && !known)
            descend(places[n]);
        }
      }

      void accept(const Position &foot)
      {
        const double length = distance(foot, origin);
        if(!(length < best))
          return;
        best = length;
        best_foot = foot;
      }

      /** Slide along the front as a string that pulls towards the origin would: unlike
       * Newton's method this cannot end in a place that is the farthest around. */
      Position slid(Position y) const
      {
        const int most_steps = 60;
        for(int n = 0; n < most_steps; ++n)
        {
          const FrontDerivatives f = family.second_derivatives(y, time);
          const double square = f.square_of_gradient();
          if(square == 0)
            return y;
          double along_gradient = 0, bending = 0;
          for(int d = 0; d < 3; ++d)
            along_gradient += (origin[d] - y[d]) * f.gradient[d] / square;
          for(const auto &row : f.hessian)
            bending += row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
          // No longer than where the distance may begin to grow again.
          const double share = 1 / (1 + std::abs(along_gradient) * std::sqrt(bending));
          Position pull{};
          for(int d = 0; d < 3; ++d)
          {
            pull[d] = origin[d] - y[d] - along_gradient * f.gradient[d];
            y[d] += share * pull[d] - f.value / square * f.gradient[d];
          }
          // The rest is Newton's.
          if(std::hypot(pull[0], pull[1], pull[2]) < 1e-4 * distance(y, origin))
            return y;
        }
        return y;
      }

      /** The place on the front around y that is nearest to the origin: Newton's method
       * for y - origin + mu grad f = 0, f = 0. Infinitely far where it does not converge.
       */
      Position refined(Position y) const
      {
        const double infinity = std::numeric_limits<double>::infinity();
        const Position nowhere{infinity, infinity, infinity};
        FrontDerivatives f = family.second_derivatives(y, time);
        const double square = f.square_of_gradient();
        if(square == 0)
          return nowhere;
        double mu = 0;
        for(int d = 0; d < 3; ++d)
          mu -= (y[d] - origin[d]) * f.gradient[d] / square;

        const int most_steps = 20;
        for(int n = 0; n < most_steps; ++n)
        {
          Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
          Eigen::Vector4d residual;
          for(int i = 0; i < 3; ++i)
          {
            for(int j = 0; j < 3; ++j)
              matrix(i, j) = (i == j) + mu * f.hessian[i][j];
            matrix(i, 3) = matrix(3, i) = f.gradient[i];
            residual[i] = y[i] - origin[i] + mu * f.gradient[i];
          }
          residual[3] = f.value;
          const Eigen::Vector4d step = matrix.fullPivLu().solve(residual);
          const double length = step.head<3>().norm();
          // Also where the matrix is singular and the step not a number.
          if(!(length < diameter))
            return nowhere;
          const double share = std::min(1., diameter / 10 / length);
          for(int d = 0; d < 3; ++d)
            y[d] -= share * step[d];
          mu -= share * step[3];
          if(length < 1e-13 * diameter)
            return y;
          f = family.second_derivatives(y, time);
        }
        return nowhere;
      }
    };
  } // namespace

  double distance_to_front(const FrontFamily &family, const Position &position,
                           double time)
  {
    return Search(family, position, time).nearest();
  }
} // namespace meltfront::cases::manufactured
