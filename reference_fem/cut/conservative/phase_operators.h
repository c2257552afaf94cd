#ifndef meltfront_reference_fem_cut_conservative_phase_operators_h
#define meltfront_reference_fem_cut_conservative_phase_operators_h

#include <cases/effect_meter.h>
#include <cases/scene.h>
#include <reference_fem/cut/conservative/curvature.h>
#include <reference_fem/cut/conservative/line_sources.h>
#include <reference_fem/cut/conservative/square_element.h>
#include <reference_fem/cut/conservative/step_frame.h>

#include <array>
#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  /** Factors of the terms that hold and stabilise, without units. Every one has a plateau
   * of a decade, see README.md. */
  struct Constants
  {
    double nitsche = 20, ghost = 0.03, smoothing = 1;
  };

  /** The time at which the terms of a stage are taken. */
  struct StageTime
  {
    double begin;               ///< of the step (s)
    double time;                ///< s
    std::vector<double> powers; ///< of line sources (W/m)
  };

  /** What the terms cost that effects call for. */
  struct Meters
  {
    cases::EffectMeter front, sources, released;
    std::array<cases::EffectMeter, cases::n_boundary_kinds> walls;
  };

  /** The terms of a phase's heat, by hat (J/m, W/m). */
  struct PhaseOperators
  {
    explicit PhaseOperators(std::size_t nodes);

    Operator mass;      ///< heat that a hat holds
    Operator interior;  ///< conduction, stabilisation, and as constant what is released
    Operator wall;      ///< through walls, without what sources' singular part carries
    Operator front;     ///< through the front, again without it
    Values source_flux; ///< that part of what goes through the front
    double source_wall_power = 0; ///< and through walls (W/m)
  };

  /**
   * Assembles the terms of CutFEM in each phase (Hansbo, Larson and Zahedi 2016; Myrbaeck
   * and Zahedi 2024) for linear triangles, and a compact scheme of fourth order on
   * squares that neither front, rim nor wall touches (SquareElement):
   *
   *   M(theta, w) = int_p rho c theta w
   *   S(theta, w) = - int_p k grad theta . grad w + N(theta, g; w) + int_p q w
   *                 - gamma_g k h sum_faces int [d_n theta][d_n w]
   *   N(theta, g; w) = int_front (k d_n theta - beta (theta - g)) w + k d_n w (theta - g)
   *
   * with beta = gamma_N k/h. Held walls have the same N. A face is between active
   * triangles of which one is not wholly in the phase, now or in a pass before: with the
   * faces of the pass alone the terms would jump where the front passes a node, and
   * passes would go to and fro about it. Sums over all w: S(theta, 1) is what crosses
   * front and walls and is released.
   *
   * In triangles theta stands for the linear function plus the parabola that this misses
   * (Remainder), with second derivatives from the guess: a correction that lags by a
   * pass. Without it a strip of linear triangles along the front makes fluxes too large
   * by h^2/8 int |D^2 T|^2/int |grad T|^2, of which the strip's share is of third order.
   */
  class PhaseAssembly
  {
  public:
    PhaseAssembly(const cases::Scene &scene, const TriangleMesh &mesh,
                  const LineSources &sources, const Constants &constants);

    /**
     * @param guess temperatures of the pass before, about which radiation is linear and
     * which tell second derivatives
     * @param follow whether g = psi (grad phi . grad theta)/|grad phi|^2 with the guess'
     * gradient follows the level set's increment psi; else g = 0
     */
    PhaseOperators assemble(Phase phase, const StepFrame &frame, const Front &front,
                            const StageTime &stage, const Guess &guess, bool follow);

    /** Call before the terms of another time: what is released, and which triangles have
     * been cut, is kept for a stage. */
    void forget_stage();

    /** Over the melting temperature, of the solid with the singular part (K). */
    double temperature(Phase phase, unsigned int triangle, const Point &point,
                       const Temperatures &temperatures,
                       const std::vector<double> &powers) const;

    /** Second derivatives of a phase's temperature; refers to the guess. */
    CurvatureFit curvature_fit(Phase phase, const Guess &guess) const;

    const cases::PhaseProperties &properties(Phase phase) const;

    /** Memory for what is released throughout. */
    std::size_t released_bytes() const
    {
      return released.size() * sizeof(released[0]) + released_known.size();
    }

    mutable Meters meters;

  private:
    struct Context;
    std::vector<Curvature> curvatures(const Context &context) const;
    std::vector<FrontSample> front_samples(Phase phase, const Guess &guess) const;
    bool at_contact(const StepFrame &frame, const Triangle &triangle) const;
    Remainder remainder(const Context &context, unsigned int triangle) const;
    void mark_parted(Phase phase, const Front &front);
    bool has_ghost_penalty(const Context &context, const InnerEdge &edge) const;
    void add_bulk(const Context &context) const;
    void add_triangle(const Context &context, unsigned int number) const;
    void add_singular_heat(const Context &context, unsigned int triangle) const;
    unsigned int open_sides(const Context &context, unsigned int square) const;
    double laplacian(unsigned int square, const Values &values) const;
    void add_square(const Context &context, unsigned int square) const;
    void add_released(const Context &context);
    void add_ghost_penalty(const Context &context);
    void add_front(const Context &context) const;
    void add_source_flux(const Context &context, const CutTriangle &cut) const;
    bool beside_held_corner(const Point &point) const;
    void add_walls(const Context &context) const;
    void add_wall(const Context &context, const WallPiece &wall,
                  const Segment &segment) const;
    void add_exchange(const Context &context, const cases::Boundary &boundary,
                      unsigned int triangle, const Point &point, double weight,
                      double given, double offset) const;
    template <typename Visit>
    void visit_source_flux(const Context &context, const Segment &segment,
                           const Gradient &normal, const Visit &visit) const;
    void hold(const Context &context, unsigned int triangle, const Point &point,
              double weight, const Gradient &normal, double offset, double follow,
              Operator &result) const;

    const cases::Scene &scene;
    const TriangleMesh &mesh;
    const LineSources &sources;
    const Constants constants;
    std::vector<char> inner_square;              ///< neither cut by a rim nor at a wall
    std::vector<char> inside;                    ///< by node: in a triangle that is whole
    std::vector<char> beside_wall;               ///< by node: of a triangle at a wall
    std::vector<SquareElement> square_elements;  ///< by open sides, bit by bit
    std::vector<std::array<double, 3>> released; ///< by triangle, of those not cut (W/m)
    std::vector<char> released_known;
    std::array<std::vector<char>, 2> was_parted; ///< by phase and triangle
  };
} // namespace meltfront::reference_fem::cut::conservative

#endif
