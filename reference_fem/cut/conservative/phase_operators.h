#ifndef meltfront_reference_fem_cut_conservative_phase_operators_h
#define meltfront_reference_fem_cut_conservative_phase_operators_h

#include <cases/effect_meter.h>
#include <cases/scene.h>
#include <reference_fem/cut/conservative/line_sources.h>
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

  /** Nodal temperatures over the melting temperature, by phase; of the solid without the
   * singular part of sources. Meaningful at nodes of active triangles. */
  using Temperatures = std::array<Values, 2>;

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
   * and Zahedi 2024) for linear triangles; squares that neither front, rim nor wall
   * touches conduct as bilinear elements, which are linear on the same sides and miss a
   * third of the energy of harmonic functions that two triangles miss:
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
   */
  class PhaseAssembly
  {
  public:
    PhaseAssembly(const cases::Scene &scene, const TriangleMesh &mesh,
                  const LineSources &sources, const Constants &constants);

    /**
     * @param guess temperatures of the pass before, about which radiation is linear
     * @param follow whether g = psi (grad phi . grad theta)/|grad phi|^2 with the guess'
     * gradient follows the level set's increment psi; else g = 0
     */
    PhaseOperators assemble(Phase phase, const StepFrame &frame, const Front &front,
                            const StageTime &stage, const Temperatures &guess,
                            bool follow);

    /** Call before the terms of another time: what is released, and which triangles have
     * been cut, is kept for a stage. */
    void forget_stage();

    /** Over the melting temperature, of the solid with the singular part (K). */
    double temperature(Phase phase, unsigned int triangle, const Point &point,
                       const Temperatures &temperatures,
                       const std::vector<double> &powers) const;

    const cases::PhaseProperties &properties(Phase phase) const;

    /** Memory for what is released throughout. */
    std::size_t released_bytes() const
    {
      return released.size() * sizeof(released[0]) + released_known.size();
    }

    mutable Meters meters;

  private:
    struct Context;
    void add_bulk(const Context &context) const;
    bool conducts_as_square(const Context &context, unsigned int square) const;
    void add_square(const Context &context,
                    const std::array<unsigned int, 4> &nodes) const;
    void add_released(const Context &context);
    void add_ghost_penalty(const Context &context);
    void add_front(const Context &context) const;
    void add_source_flux(const Context &context, const CutTriangle &cut) const;
    void add_walls(const Context &context) const;
    void add_wall(const Context &context, const WallPiece &wall,
                  const Segment &segment) const;
    void add_exchange(const Context &context, const cases::Boundary &boundary,
                      const Triangle &triangle, const Point &point, double weight,
                      double given, double offset) const;
    template <typename Visit>
    void visit_source_flux(const Context &context, const Segment &segment,
                           const Gradient &normal, const Visit &visit) const;
    void hold(const Context &context, const Triangle &triangle, const Point &point,
              double weight, const Gradient &normal, double offset, double follow,
              Operator &result) const;

    const cases::Scene &scene;
    const TriangleMesh &mesh;
    const LineSources &sources;
    const Constants constants;
    std::vector<char> inner_square;              ///< neither cut by a rim nor at a wall
    std::vector<std::array<double, 3>> released; ///< by triangle, of those not cut (W/m)
    std::vector<char> released_known;
    std::array<std::vector<char>, 2> was_parted; ///< by phase and triangle
  };
} // namespace meltfront::reference_fem::cut::conservative

#endif
