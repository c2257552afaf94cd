#include <cases/exact/manufactured/distance_to_front.h>
#include <cases/exact/manufactured/front_family.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace meltfront::cases
{
  double FrontDerivatives::square_of_gradient() const
  {
    return gradient[0] * gradient[0] + gradient[1] * gradient[1]
           + gradient[2] * gradient[2];
  }

  double FrontDerivatives::curvature() const
  {
    const double square = square_of_gradient();
    if(square == 0)
      return std::numeric_limits<double>::quiet_NaN();
    double along = 0;
    for(int i = 0; i < 3; ++i)
      for(int j = 0; j < 3; ++j)
        along += gradient[i] * hessian[i][j] * gradient[j];
    return (laplacian - along / square) / std::sqrt(square);
  }

  FrontFamily::FrontFamily(const FamilyParameters &parameters)
    : the_parameters(parameters)
  {
  }

  const FamilyParameters &FrontFamily::parameters() const
  {
    return the_parameters;
  }

  std::string FrontFamily::name() const
  {
    return the_parameters.name;
  }

  std::string FrontFamily::description() const
  {
    return fmt::format("{} ({}), {}D, period {:.12g} s, length scale {:.12g} m{}", name(),
                       what(), dimension(), period(), the_parameters.length_scale,
                       merges() ? fmt::format(", power {}", the_parameters.power) : "");
  }

  int FrontFamily::dimension() const
  {
    return the_parameters.dimension;
  }

  double FrontFamily::period() const
  {
    return the_parameters.period;
  }

  double FrontFamily::signed_distance(const Position &position, double time) const
  {
    return manufactured::distance_to_front(*this, position, time);
  }

  std::optional<UniformCurvature> FrontFamily::uniform_curvature(double) const
  {
    return std::nullopt;
  }

  bool FrontFamily::merges() const
  {
    return false;
  }

  std::vector<double> FrontFamily::merge_times(double from, double to) const
  {
    std::vector<double> times;
    if(!merges())
      return times;
    const double half = period() / 2;
    for(double n = std::ceil(from / half - 0.5); half * (n + 0.5) <= to; ++n)
      times.push_back(half * (n + 0.5));
    return times;
  }

  std::optional<Position> FrontFamily::saddle() const
  {
    return merges() ? std::optional(Position{0, 0, 0}) : std::nullopt;
  }
} // namespace meltfront::cases
