#ifndef meltfront_cases_property_curve_h
#define meltfront_cases_property_curve_h

#include <functional>
#include <string>
#include <vector>

namespace meltfront::cases
{
  /**
   * A property of a material as a function of temperature: linear between the points of a
   * table, and equal to the first (last) value beyond it. A table of a case file is
   * taken as it is; an expression is tabulated closely enough for any method
   * (samples_of_expression intervals).
   *
   * Temperatures are those of the scene (K or degrees Celsius); values have the unit of
   * the property.
   */
  class PropertyCurve
  {
  public:
    static constexpr int samples_of_expression = 4096;

    /**
     * @param temperatures of the points, ascending
     * @param values there
     * @param words what a user gave
     * @throws InputError unless there are two points or more, ascending and finite
     */
    PropertyCurve(std::vector<double> temperatures, std::vector<double> values,
                  std::string words);

    /** A function between two temperatures, tabulated at equal distances. @throws
     * InputError where it is not finite */
    static PropertyCurve tabulated(const std::function<double(double)> &function,
                                   double lowest, double highest, std::string words);

    double operator()(double temperature) const;

    const std::vector<double> &temperatures() const
    {
      return knots;
    }

    const std::vector<double> &values() const
    {
      return ordinates;
    }

    /** The expression or the table, as a user gave it. */
    const std::string &words() const
    {
      return text;
    }

  private:
    std::vector<double> knots, ordinates;
    std::string text;
  };
} // namespace meltfront::cases

#endif
