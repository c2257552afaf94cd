#include <cases/error.h>
#include <cases/velocity_field.h>

#include <boost/numeric/odeint.hpp>
#include <fmt/format.h>

#include <numbers>
#include <utility>
#include <vector>

namespace meltfront::cases
{
  namespace
  {
    using std::numbers::pi;

    double square(const double x)
    {
      return x * x;
    }

    void require_period(const double period)
    {
      if(!(period > 0) || !std::isfinite(period))
        throw Refusal(fmt::format("a period of {} s: it must be above zero", period));
    }
  } // namespace

  Position VelocityField::velocity(const Position &point, const double time,
                                   const int dimension) const
  {
    Position result{};
    PointArrays points;
    std::array<std::span<double>, 3> components;
    for(int i = 0; i < dimension; ++i)
    {
      points[i] = {&point[i], 1};
      components[i] = {&result[i], 1};
    }
    velocities(points, time, components);
    return result;
  }

  Position VelocityField::carried(const Position &point, const double from,
                                  const double to, const int dimension) const
  {
    namespace odeint = boost::numeric::odeint;
    if(from == to)
      return point;
    // not Position: the compiler warns of the stepper's arrays, copied before their use
    using State = std::vector<double>;
    State state(point.begin(), point.end());
    const auto rate = [&](const State &at, State &result, const double time)
    {
      const Position value = velocity({at[0], at[1], at[2]}, time, dimension);
      result.assign(value.begin(), value.end());
    };
    odeint::integrate_adaptive(
        odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(1e-12, 1e-10),
        rate, state, from, to, (to - from) / 50);
    return {state[0], state[1], state[2]};
  }

  RigidMotion::RigidMotion(const Position &translation, const double angular_velocity,
                           const Position &centre)
    : translation(translation)
    , angular_velocity(angular_velocity)
    , centre(centre)
  {
  }

  std::string RigidMotion::description() const
  {
    return fmt::format("rigid motion: ({}, {}, {}) m/s, {} 1/s about ({}, {})",
                       translation[0], translation[1], translation[2], angular_velocity,
                       centre[0], centre[1]);
  }

  bool RigidMotion::rigid() const
  {
    return true;
  }

  void RigidMotion::velocities(const PointArrays &points, double,
                               const std::array<std::span<double>, 3> &velocity) const
  {
    for(std::size_t p = 0; p < points[0].size(); ++p)
    {
      velocity[0][p] = translation[0] - angular_velocity * (points[1][p] - centre[1]);
      velocity[1][p] = translation[1] + angular_velocity * (points[0][p] - centre[0]);
    }
    for(double &component : velocity[2])
      component = translation[2];
  }

  void RigidMotion::gradients(const PointArrays &points, double,
                              const std::array<std::span<double>, 9> &gradient) const
  {
    for(std::span<double> entries : gradient)
      for(double &entry : entries)
        entry = 0;
    for(std::size_t p = 0; p < points[0].size(); ++p)
    {
      gradient[1][p] = -angular_velocity;
      gradient[3][p] = angular_velocity;
    }
  }

  SingleVortex::SingleVortex(const double period)
    : period(period)
  {
    require_period(period);
  }

  std::string SingleVortex::description() const
  {
    return fmt::format("single vortex, back after {} s", period);
  }

  void SingleVortex::velocities(const PointArrays &points, const double time,
                                const std::array<std::span<double>, 3> &velocity) const
  {
    const double g = std::cos(pi * time / period);
    for(std::size_t p = 0; p < points[0].size(); ++p)
    {
      const double sx = std::sin(pi * points[0][p]), cx = std::cos(pi * points[0][p]);
      const double sy = std::sin(pi * points[1][p]), cy = std::cos(pi * points[1][p]);
      velocity[0][p] = -2 * g * sx * sx * sy * cy;
      velocity[1][p] = 2 * g * sx * cx * sy * sy;
    }
  }

  void SingleVortex::gradients(const PointArrays &points, const double time,
                               const std::array<std::span<double>, 9> &gradient) const
  {
    const double g = std::cos(pi * time / period);
    for(std::size_t p = 0; p < points[0].size(); ++p)
    {
      const double sx = std::sin(pi * points[0][p]), cx = std::cos(pi * points[0][p]);
      const double sy = std::sin(pi * points[1][p]), cy = std::cos(pi * points[1][p]);
      const double shear = 4 * pi * g * sx * cx * sy * cy;
      gradient[0][p] = -shear;
      gradient[1][p] = -2 * pi * g * sx * sx * (cy * cy - sy * sy);
      gradient[3][p] = 2 * pi * g * (cx * cx - sx * sx) * sy * sy;
      gradient[4][p] = shear;
    }
  }

  CubeDeformation::CubeDeformation(const double period)
    : period(period)
  {
    require_period(period);
  }

  std::string CubeDeformation::description() const
  {
    return fmt::format("deformation of the cube, back after {} s", period);
  }

  void CubeDeformation::velocities(const PointArrays &points, const double time,
                                   const std::array<std::span<double>, 3> &velocity) const
  {
    const double g = std::cos(pi * time / period);
    for(std::size_t p = 0; p < points[0].size(); ++p)
    {
      std::array<double, 3> squared{}, doubled{}; // sin^2(pi x_i), sin(2 pi x_i)
      for(int i = 0; i < 3; ++i)
      {
        squared[i] = square(std::sin(pi * points[i][p]));
        doubled[i] = std::sin(2 * pi * points[i][p]);
      }
      velocity[0][p] = 2 * g * squared[0] * doubled[1] * doubled[2];
      velocity[1][p] = -g * doubled[0] * squared[1] * doubled[2];
      velocity[2][p] = -g * doubled[0] * doubled[1] * squared[2];
    }
  }

  void CubeDeformation::gradients(const PointArrays &points, const double time,
                                  const std::array<std::span<double>, 9> &gradient) const
  {
    const double g = std::cos(pi * time / period);
    for(std::size_t p = 0; p < points[0].size(); ++p)
    {
      // squared' = pi doubled, doubled' = 2 pi cos(2 pi x)
      std::array<double, 3> squared{}, doubled{}, slope{};
      for(int i = 0; i < 3; ++i)
      {
        squared[i] = square(std::sin(pi * points[i][p]));
        doubled[i] = std::sin(2 * pi * points[i][p]);
        slope[i] = 2 * pi * std::cos(2 * pi * points[i][p]);
      }
      for(int i = 0; i < 3; ++i)
        for(int j = 0; j < 3; ++j)
        {
          double product = i == 0 ? 2 * g : -g;
          for(int k = 0; k < 3; ++k)
            if(k == i)
              product *= k == j ? pi * doubled[k] : squared[k];
            else
              product *= k == j ? slope[k] : doubled[k];
          gradient[3 * i + j][p] = product;
        }
    }
  }

  FormulaVelocity::FormulaVelocity(std::string text, std::array<Formula, 3> components,
                                   const double length)
    : text(std::move(text))
    , components(std::move(components))
    , length(length)
  {
  }

  std::string FormulaVelocity::description() const
  {
    return "velocity (" + text + ") m/s";
  }

  void FormulaVelocity::velocities(const PointArrays &points, const double time,
                                   const std::array<std::span<double>, 3> &velocity) const
  {
    for(std::size_t p = 0; p < points[0].size(); ++p)
    {
      Position at{};
      for(int i = 0; i < 3; ++i)
        if(!points[i].empty())
          at[i] = points[i][p];
      for(int i = 0; i < 3; ++i)
        if(!velocity[i].empty())
          velocity[i][p] = components[i](at, time);
    }
  }

  void FormulaVelocity::gradients(const PointArrays &points, const double time,
                                  const std::array<std::span<double>, 9> &gradient) const
  {
    // the cube root of the machine's accuracy balances round-off and truncation
    const double distance = 6e-6 * length;
    for(std::size_t p = 0; p < points[0].size(); ++p)
      for(int j = 0; j < 3; ++j)
      {
        if(points[j].empty())
          continue;
        Position low{}, high{};
        for(int i = 0; i < 3; ++i)
          if(!points[i].empty())
            low[i] = high[i] = points[i][p];
        low[j] -= distance;
        high[j] += distance;
        for(int i = 0; i < 3; ++i)
          if(!points[i].empty())
            gradient[3 * i + j][p]
                = (components[i](high, time) - components[i](low, time)) / (2 * distance);
      }
  }
} // namespace meltfront::cases
