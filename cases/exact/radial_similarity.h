#ifndef meltfront_cases_exact_radial_similarity_h
#define meltfront_cases_exact_radial_similarity_h

#include <cases/exact/profiles.h>
#include <cases/exact_solution.h>

namespace meltfront::cases
{
  /** What the sinks and Frank's solutions share: similarity::RadialProfile in double. */
  class RadialSimilarity : public ExactSolution
  {
  public:
    /** The front constant: front = 2 lambda sqrt(a_s t). */
    double lambda() const;

    Symmetry symmetry() const override;
    double front(double time) const override;

    using ExactSolution::temperature;

    /** At a sink itself (r = 0, t > 0) minus infinity; the far temperature at t = 0. */
    double temperature(double coordinate, double time) const override;

    /**
     * By Gauss quadrature over panels that resolve the profile, to about 1e-14; the
     * logarithm at a line sink, integrable, in closed form.
     */
    double heat_content(double lower, double upper, double time) const override;

  protected:
    RadialSimilarity(const Material &material, similarity::RadialProfile<double> profile);

    Material material;
    similarity::RadialProfile<double> profile;

  private:
    double solid_heat(double lower, double upper, double time) const;
    double liquid_heat(double lower, double upper, double time) const;
  };
} // namespace meltfront::cases

#endif
