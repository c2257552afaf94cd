#ifndef meltfront_cases_exact_manufactured_front_family_h
#define meltfront_cases_exact_manufactured_front_family_h

#include <cases/position.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::cases
{
  /** What a manufactured solution needs of its level set f at a place and a time. */
  struct FrontDerivatives
  {
    using Vector = std::array<double, 3>;

    double value = 0;                ///< f, m
    double rate = 0;                 ///< f_t, m/s
    double acceleration = 0;         ///< f_tt, m/s^2
    Vector gradient{};               ///< grad f
    Vector gradient_rate{};          ///< grad f_t, 1/s
    std::array<Vector, 3> hessian{}; ///< 1/m
    double laplacian = 0;            ///< 1/m
    double laplacian_rate = 0;       ///< lap f_t, 1/(m s)
    Vector laplacian_gradient{};     ///< grad lap f, 1/m^2

    /** |grad f|^2. */
    double square_of_gradient() const;

    /**
     * Curvature of the level set through the place, the sum of the principal ones: div
     * (grad f/|grad f|) = (|grad f|^2 lap f - grad f . H grad f)/|grad f|^3, 1/m,
     * positive where the solid is convex. NaN where the gradient vanishes.
     */
    double curvature() const;
  };

  /** Which front, how large and how fast. */
  struct FamilyParameters
  {
    std::string name;        ///< one of front_family_names()
    int dimension = 2;       ///< a plane has 1 to 3, a star 2, all others 2 or 3
    double period = 1;       ///< s; time enters only through time/period
    double length_scale = 1; ///< m; multiplies all lengths
    /** p of those that merge and part: about that moment the neck's square grows as
     * |t|^p. 2 lets the tips meet at a finite speed, 3 and more bring them to rest. */
    int power = 3;
  };

  /** The same curvature all over the front. */
  struct UniformCurvature
  {
    double value; ///< 1/m
    double rate;  ///< 1/(m s)
  };

  /** A field at a place and a time. */
  struct FieldDerivatives
  {
    double value = 0;
    double rate = 0; ///< its derivative in time
    std::array<double, 3> gradient{};
    double laplacian = 0;
  };

  /**
   * The curvature of the front, continued into the phases (1/m):
   *
   *   K = (|grad f|^2 lap f - grad f . H grad f)/(|grad f|^2 + kappa^2 f^2)^(3/2)
   *
   * and its change along grad f, both with their derivatives.
   */
  struct ContinuedCurvature
  {
    FieldDerivatives curvature; ///< K
    FieldDerivatives slope;     ///< grad K . grad f
  };

  /**
   * A moving front given as the zero of a smooth level set f(x, t), in metres: negative
   * in the solid, positive in the liquid. Where the gradient vanishes there is no front,
   * but for a saddle at the moment at which bodies merge or part.
   */
  class FrontFamily
  {
  public:
    explicit FrontFamily(const FamilyParameters &parameters);
    virtual ~FrontFamily() = default;

    const FamilyParameters &parameters() const;
    std::string name() const;

    /** The front and its numbers, one line. */
    std::string description() const;
    int dimension() const;
    double period() const;

    /** What times |f| is added to the square of the gradient to keep it from vanishing in
     * the denominator of the temperature (1/m). */
    virtual double kappa() const = 0;

    /** f (m). */
    virtual double level_set(const Position &position, double time) const = 0;

    /** f and its derivatives, exact to round-off. */
    virtual FrontDerivatives derivatives(const Position &position, double time) const = 0;

    /** The same of f, its gradient, Hessian and Laplacian; the rest is zero. Takes a
     * fraction of the time. */
    virtual FrontDerivatives second_derivatives(const Position &position,
                                                double time) const = 0;

    /**
     * Distance to the front (m), negative in the solid: closed for plane, disk and ball,
     * by a search for the others, see manufactured::distance_to_front().
     */
    virtual double signed_distance(const Position &position, double time) const;

    /** Volume of the solid within the domain() (m, m^2 or m^3 by the dimension). */
    virtual double solid_volume(double time) const = 0;

    /** The front's curvature where it is the same everywhere: plane, disk, ball. */
    virtual std::optional<UniformCurvature> uniform_curvature(double time) const;

    /** K is smooth where grad f and f do not vanish together: anywhere but where bodies
     * merge or part. Where the curvature is uniform K is that everywhere. */
    virtual ContinuedCurvature continued_curvature(const Position &position,
                                                   double time) const = 0;

    /** Corners of the box that the family is meant for (m); zero beyond the dimension. */
    virtual std::pair<Position, Position> domain() const = 0;

    /** Whether bodies merge and part. */
    virtual bool merges() const;

    /** The times from <= t <= to at which bodies merge or part: a quarter and three
     * quarters of each period. */
    std::vector<double> merge_times(double from, double to) const;

    /** Where they do. */
    std::optional<Position> saddle() const;

  protected:
    virtual const char *what() const = 0;

  private:
    FamilyParameters the_parameters;
  };

  /** Names that make_front_family() knows. */
  std::vector<std::string> front_family_names();

  /**
   * @throws InputError for an unknown name, a dimension that the family has not, a period
   * or length scale that is not positive, or a power below 2.
   */
  std::shared_ptr<const FrontFamily>
  make_front_family(const FamilyParameters &parameters);
} // namespace meltfront::cases

#endif
