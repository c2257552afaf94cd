#include <cases/error.h>
#include <cases/exact/manufactured/distance_to_front.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::cases::manufactured
{
  namespace
  {
    /** A search from one place for the nearest point of the front. */
    class Search
    {
    public:
      Search(const FrontFamily &family, const Position &origin, double time)
        : family(family)
        , origin(origin)
        , time(time)
        , negative(family.level_set(origin, time) < 0)
      {
        const auto [lower, upper] = family.domain();
        diameter
            = std::hypot(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]);
      }

      double nearest()
      {
        descend();
        for(const Position &direction : directions(family.dimension()))
          walk(direction);
        if(!std::isfinite(best))
          throw NumericalError("manufactured front", 0, time, "distance to the front",
                               "is not found within the domain's diameter");
        return negative ? -best : best;
      }

    private:
      const FrontFamily &family;
      const Position &origin;
      double time;
      bool negative;
      double diameter;
      double best = std::numeric_limits<double>::infinity();

      static const std::vector<Position> &directions(int dimension);

      Position moved(const Position &direction, double distance) const
      {
        return {origin[0] + distance * direction[0], origin[1] + distance * direction[1],
                origin[2] + distance * direction[2]};
      }

      double distance_from_origin(const Position &y) const
      {
        return std::hypot(y[0] - origin[0], y[1] - origin[1], y[2] - origin[2]);
      }

      /** Newton's method along the gradient in steps that do not leap over bodies. */
      void descend()
      {
        const int most_steps = 100;
        const double longest = diameter / 30;
        Position y = origin;
        for(int n = 0; n < most_steps; ++n)
        {
          const FrontDerivatives f = family.derivatives(y, time);
          const double slope = std::sqrt(f.square_of_gradient());
          if(slope == 0)
            return;
          const double step = std::clamp(f.value / slope, -longest, longest);
          for(int d = 0; d < 3; ++d)
            y[d] -= step * f.gradient[d] / slope;
          if(std::abs(step) < 1e-12 * diameter)
            return accept(y);
        }
      }

      /** Look along a ray for a sign change nearer than the best so far. */
      void walk(const Position &direction)
      {
        const double stride = diameter / 60;
        const double farthest = std::min(best, diameter);
        double inside = 0;
        while(inside < farthest)
        {
          double outside = std::min(inside + stride, farthest);
          if(differs(moved(direction, outside)))
          {
            const int halvings = 30;
            for(int n = 0; n < halvings; ++n)
            {
              const double middle = (inside + outside) / 2;
              (differs(moved(direction, middle)) ? outside : inside) = middle;
            }
            return accept(moved(direction, outside));
          }
          inside = outside;
        }
      }

      bool differs(const Position &y) const
      {
        return (family.level_set(y, time) < 0) != negative;
      }

      /** A foot on the front, and the nearest one around it if it can be had. */
      void accept(const Position &foot)
      {
        best = std::min({best, distance_from_origin(foot), refined(foot)});
      }

      /** Newton's method for y - origin + mu grad f = 0, f = 0; infinite where it does
       * not converge. */
      double refined(Position y) const
      {
        FrontDerivatives f = family.derivatives(y, time);
        const double square = f.square_of_gradient();
        if(square == 0)
          return std::numeric_limits<double>::infinity();
        double mu = 0;
        for(int d = 0; d < 3; ++d)
          mu -= (y[d] - origin[d]) * f.gradient[d] / square;

        const int most_steps = 12;
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
          const Eigen::Vector4d step = matrix.partialPivLu().solve(residual);
          const double length = step.head<3>().norm();
          // Also where the matrix is singular and the step not a number.
          if(!(length < diameter / 4))
            break;
          for(int d = 0; d < 3; ++d)
            y[d] -= step[d];
          mu -= step[3];
          if(length < 1e-13 * diameter)
            return distance_from_origin(y);
          f = family.derivatives(y, time);
        }
        return std::numeric_limits<double>::infinity();
      }
    };

    std::vector<Position> sixteen_in_the_plane()
    {
      std::vector<Position> all;
      for(int n = 0; n < 16; ++n)
        all.push_back(
            {std::cos(n * std::numbers::pi / 8), std::sin(n * std::numbers::pi / 8), 0});
      return all;
    }

    /** To the neighbours of a cube's centre. */
    std::vector<Position> twenty_six_in_space()
    {
      std::vector<Position> all;
      for(const int i : {-1, 0, 1})
        for(const int j : {-1, 0, 1})
          for(const int k : {-1, 0, 1})
            if(const int square = i * i + j * j + k * k; square > 0)
              all.push_back(
                  {i / std::sqrt(square), j / std::sqrt(square), k / std::sqrt(square)});
      return all;
    }

    const std::vector<Position> &Search::directions(int dimension)
    {
      static const std::vector<Position> plane = sixteen_in_the_plane(),
                                         space = twenty_six_in_space();
      return dimension == 3 ? space : plane;
    }
  } // namespace

  double distance_to_front(const FrontFamily &family, const Position &position,
                           double time)
  {
    return Search(family, position, time).nearest();
  }
} // namespace meltfront::cases::manufactured
