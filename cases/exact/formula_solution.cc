#include <cases/exact/formula_solution.h>

#include <limits>

namespace meltfront::cases
{
  FrontlessSolution::FrontlessSolution(Symmetry symmetry)
    : the_symmetry(symmetry)
  {
  }

  Symmetry FrontlessSolution::symmetry() const
  {
    return the_symmetry;
  }

  bool FrontlessSolution::has_front() const
  {
    return false;
  }

  double FrontlessSolution::temperature(double coordinate, double time) const
  {
    return temperature(Position{coordinate, 0, 0}, time);
  }

  double FrontlessSolution::front(double) const
  {
    return std::numeric_limits<double>::quiet_NaN();
  }

  double FrontlessSolution::heat_content(double, double, double) const
  {
    return std::numeric_limits<double>::quiet_NaN();
  }

  FormulaSolution::FormulaSolution(
      Symmetry symmetry, std::string text,
      std::function<double(const Position &, double time)> formula)
    : FrontlessSolution(symmetry)
    , text(std::move(text))
    , formula(std::move(formula))
  {
  }

  std::string FormulaSolution::description() const
  {
    return "closed form: T = " + text;
  }

  double FormulaSolution::temperature(const Position &position, double time) const
  {
    return formula(position, time);
  }
} // namespace meltfront::cases
