#ifndef meltfront_verification_measure_formulas_exact_region_h
#define meltfront_verification_measure_formulas_exact_region_h

#include <cases/scene.h>
#include <cases/shape.h>
#include <verification/measure/formulas/exact_front.h>

#include <array>
#include <optional>
#include <vector>

namespace meltfront::verification
{
  /** A map of places that keeps distances: r -> matrix r + shift. */
  struct RigidMap
  {
    std::array<cases::Position, 3> columns{
        cases::Position{1, 0, 0}, cases::Position{0, 1, 0}, cases::Position{0, 0, 1}};
    cases::Position shift{};

    cases::Position operator()(const cases::Position &point) const;

    /** A direction turned back, by the transpose. */
    cases::Position turned_back(const cases::Position &direction) const;
  };

  /**
   * Where things at a time were at the start, if the velocity moves them rigidly or has
   * brought them back by then (64 points throughout the domain are within 1e-8 of its
   * side); else nothing.
   */
  std::optional<RigidMap> way_back(const cases::Scene &scene, double time);

  /** The inside of closed lines in the plane, asked for along rows of equal height. */
  class EnclosedRows
  {
  public:
    /**
     * @param pieces of closed lines, in any order
     * @param first height of the first row (m); @param step from row to row (m)
     */
    EnclosedRows(const std::vector<FrontPiece> &pieces, double first, double step,
                 int rows);

    /** Whether the lines are closed: every row leaves them as often as it enters. */
    bool closed() const;

    bool inside(int row, double x) const;

  private:
    std::vector<std::vector<double>> crossings; ///< of each row, ascending
  };
} // namespace meltfront::verification

#endif
