#ifndef meltfront_cases_capabilities_h
#define meltfront_cases_capabilities_h

#include <cases/effects.h>

#include <string>
#include <vector>

namespace meltfront::cases
{
  struct Scene;
  enum class BoundaryKind;
  enum class DomainShape;
  enum class ProblemKind;

  /** How fronts come to be in a scene. */
  enum class FrontOrigin
  {
    none,          ///< no latent heat is exchanged: there is no front
    initial_front, ///< both phases are there at the start
    partly_melted, ///< material at the melting point is partly solid at the start
    wall,          ///< a wall's temperature freezes the liquid or melts the solid at it
    source         ///< a sink freezes the liquid, a source melts the solid around it
  };
  inline constexpr std::size_t n_front_origins = 5;

  /** The words for it in tables, `initial front` and so on. */
  const char *to_string(FrontOrigin origin);

  /**
   * The ways in which fronts are certain to come to be in a scene that conducts heat, in
   * the order of the enumeration; empty where the scene's data do not tell (a wall that
   * gives off heat may or may not freeze what it borders). An alloy, or a material with a
   * melting range, has a mush and no front: none is named.
   */
  std::vector<FrontOrigin> front_origins(const Scene &scene);

  /** Least number of fronts that a scene is certain to have in the course of time, as far
   * as front_origins() tells; fronts that meet count as two. */
  int least_number_of_fronts(const Scene &scene);

  /** A shape of the domain that a method takes. */
  struct ShapeCapability
  {
    DomainShape shape;
    std::vector<int> dimensions; ///< of the domain, Domain::dimension
    std::vector<BoundaryKind> walls;
  };

  /**
   * By how much temperatures of a method may pass the bounds of the maximum principle,
   * over the bounds' span: at_twenty (20 h / side)^order with the spacing h. Zero: by
   * round-off only.
   */
  struct Overshoot
  {
    double at_twenty = 0;
    double order = 0;
  };

  /**
   * What a method takes, or one of its forms (along a line, in the plane). Whatever is
   * not named here is refused before the method sees it, also what is added to the
   * language of cases later.
   */
  struct Capabilities
  {
    std::string form{}; ///< `along a line`; empty for a method that has one form only
    bool needs_symmetry = false; ///< simulates the one coordinate of a symmetry alone
    bool needs_particle_solid = false; ///< as the matter of scenes that conduct heat
    std::vector<ProblemKind> problems{};
    std::vector<Effect> effects{};
    std::vector<ShapeCapability> shapes{};
    std::vector<FrontOrigin> front_origins{}; ///< of scenes that conduct heat
    int most_fronts = 0;                      ///< 0: any number
    int most_threads = 1;
    Overshoot overshoot{};
    bool conserves_heat = true; ///< up to round-off, whatever the spacing

    bool takes(Effect effect) const;
    bool takes(FrontOrigin origin) const;
    bool takes(DomainShape shape) const;
  };

  /** Any number of threads that a user may ask for. */
  inline constexpr int any_number_of_threads = 1024;

  /**
   * Why a form of a method does not take a scene, in one clause that follows the method's
   * name, `takes no walls of the kind 'periodic' (y_min)`; empty if it takes it.
   */
  std::string reason_unsupported(const Capabilities &capabilities, const Scene &scene,
                                 const EffectSet &effects, int threads);
} // namespace meltfront::cases

#endif
