#ifndef meltfront_cases_exact_formula_solution_h
#define meltfront_cases_exact_formula_solution_h

#include <cases/exact_solution.h>

#include <functional>
#include <string>

namespace meltfront::cases
{
  /** A temperature without a front: what all solutions of heat conduction alone share. */
  class FrontlessSolution : public ExactSolution
  {
  public:
    explicit FrontlessSolution(Symmetry symmetry);

    Symmetry symmetry() const override;
    bool has_front() const override;

    /** On the axis x of the scene. */
    double temperature(double coordinate, double time) const override;
    double temperature(const Position &position, double time) const override = 0;

    /** NaN: there is none. */
    double front(double time) const override;

    /** NaN: without a front nothing asks for it. */
    double heat_content(double lower, double upper, double time) const override;

  private:
    Symmetry the_symmetry;
  };

  /** A temperature given as a formula of place and time, as a case file states it. */
  class FormulaSolution : public FrontlessSolution
  {
  public:
    /**
     * @param symmetry of the scene
     * @param text the formula, for the description
     */
    FormulaSolution(Symmetry symmetry, std::string text,
                    std::function<double(const Position &, double time)> formula);

    std::string description() const override;

    using FrontlessSolution::temperature;
    double temperature(const Position &position, double time) const override;

  private:
    std::string text;
    std::function<double(const Position &, double time)> formula;
  };
} // namespace meltfront::cases

#endif
