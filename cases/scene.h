#ifndef meltfront_cases_scene_h
#define meltfront_cases_scene_h

#include <cases/alloy.h>
#include <cases/body_mesh.h>
#include <cases/effects.h>
#include <cases/exact_solution.h>
#include <cases/material.h>
#include <cases/outline.h>
#include <cases/particle_solid.h>
#include <cases/position.h>

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::cases
{
  class Shape;
  class VelocityField;

  /** A value that may vary in space and time, with the words it was given by. */
  struct Field
  {
    std::string expression;
    std::function<double(const Position &, double time)> value;
    bool constant = false; ///< neither space nor time matters
    /** Times at which the value may jump or bend (s), ascending; as far as the expression
     * tells. */
    std::vector<double> breakpoints{};

    double operator()(const Position &position, double time) const
    {
      return value(position, time);
    }

    static Field uniform(double value);
  };

  /** Shape of the domain. */
  enum class DomainShape
  {
    slab,    ///< planar: 0 <= x <= length, unbounded (periodic) across
    box,     ///< lower <= (x, y, z) <= upper in `dimension` dimensions
    ball,    ///< distance from the origin <= radius: a disk in 2D, a ball in 3D
    shell,   ///< inner radius <= distance from the origin <= radius: an annulus in 2D
    outline, ///< what a closed curve bounds in the plane
    axisymmetric, ///< a body about an axis, nothing varies around it: lower <= (x, y) <=
                  ///< upper, x the distance from the axis and y along it; volumes and
                  ///< walls are those of the whole body
    mesh          ///< the cells of a mesh file
  };

  /** The word for a shape in case files. */
  const char *to_string(DomainShape shape);

  struct Domain
  {
    DomainShape shape = DomainShape::slab;
    int dimension = 1; ///< of the shape: 1 for a slab, 2 or 3 for the others
    Position lower{};  ///< corner of a box or of the half section of an axisymmetric
                       ///< body; (left end, 0, 0) for a slab (m)
    Position upper{};  ///< opposite corner; (right end, 0, 0) for a slab (m)
    double radius = 0; ///< of a ball or a shell (m)
    double inner_radius = 0; ///< of a shell (m)
    /** Of an outline, whose bounding box lies between `lower` and `upper`; else null. */
    std::shared_ptr<const Outline> outline{};
    /** Of a mesh, whose bounding box lies between `lower` and `upper`; else null. */
    std::shared_ptr<const BodyMesh> mesh{};
    double reference_length = 0; ///< of an outline; of a mesh the longest side of its box
                                 ///< (m)

    /** A ball or a shell. */
    bool round() const;

    /** A slab, a box, or the rectangle that is the half section of an axisymmetric body.
     */
    bool rectangular() const;

    /** Neither bounded by planes nor by circles: an outline or a mesh. */
    bool irregular() const;

    /** The length that a resolution n divides: slab length, box side along x, outer
     * diameter, or the reference length of an outline; the longest side of a mesh's box,
     * where n divides the cells' edges (m). */
    double side() const;
  };

  enum class BoundaryKind
  {
    insulated,
    fixed_temperature, ///< `value` is the temperature; constant, an expression, or the
                       ///< exact solution
    flux,              ///< `value` is the heat flux into the domain, W/m^2
    periodic,
    heat_transfer, ///< the flux into the domain is the coefficient times the difference
                   ///< of `value`, the ambient temperature, from the wall's (Robin)
    radiation      ///< the same of the fourth powers of the absolute temperatures
  };
  inline constexpr std::size_t n_boundary_kinds = 6;

  /** The words for it in case files, `heat transfer`. */
  const char *to_string(BoundaryKind kind);

  struct Boundary
  {
    BoundaryKind kind = BoundaryKind::insulated;
    Field value;        ///< temperature, flux or ambient temperature, empty otherwise
    bool exact = false; ///< `value` is taken from the exact solution
    double heat_transfer_coefficient = 0; ///< of BoundaryKind::heat_transfer, W/(m^2 K)
    /** Of BoundaryKind::radiation: emissivity times the constant of Stefan and Boltzmann
     * (W/(m^2 K^4)), and absolute zero on the scene's scale of temperature. */
    double emission_coefficient = 0;
    double absolute_zero = 0;
  };

  /** Names of the sides of a slab or a box; a ball and an outline have the one side
   * `outer`, a shell `inner` and `outer`. The walls of a mesh follow, see mesh_wall(). */
  enum class Side
  {
    x_min,
    x_max,
    y_min,
    y_max,
    z_min,
    z_max,
    outer,
    inner
  };
  inline constexpr std::size_t n_named_sides = 8;
  inline constexpr std::size_t most_mesh_walls = 24;
  inline constexpr std::size_t n_sides = n_named_sides + most_mesh_walls;

  /** The side that is a wall of a mesh, by its index in BodyMesh::walls(). */
  constexpr Side mesh_wall(std::size_t index)
  {
    return static_cast<Side>(n_named_sides + index);
  }

  /** The reverse. */
  constexpr unsigned int index_of_mesh_wall(Side side)
  {
    return static_cast<unsigned int>(static_cast<std::size_t>(side) - n_named_sides);
  }

  /** The word for a side that has one of its own, `x_min`. */
  const char *to_string(Side side);

  /** What a side of a domain is called: `x_min`; of a mesh the name of its wall. */
  std::string name_of(const Domain &domain, Side side);

  /** Where something that moves is at a time. */
  struct Path
  {
    std::string expression; ///< as it was given
    std::function<Position(double time)> position;
  };

  /** A source of heat at a point: a point in 3D, a line across the plane in 2D; a sink is
   * negative. */
  struct PointSource
  {
    Position position{};    ///< where it starts, and stays unless it has a path
    std::string expression; ///< the strength as it was given
    std::function<double(double time)> power; ///< W (3D), W/m (2D)
    std::function<double(double time)>
        energy; ///< integral of power from the scene's start (J, J/m)
    std::optional<Path> path{};

    Position at(double time) const
    {
      return path ? path->position(time) : position;
    }
  };

  /** What is asked of a scene. */
  enum class ProblemKind
  {
    stefan,              ///< heat over time, with or without a change of phase
    poisson,             ///< the steady temperature: -div(k grad T) = heat released
    interface_advection, ///< a front that a given velocity carries along
    particle_solid       ///< particles that bind each other, heated by moving them
  };

  /** The word for a kind of problem in case files, `interface advection`. */
  const char *to_string(ProblemKind problem);

  /** A region whose front a velocity carries along. */
  struct InterfaceAdvection
  {
    std::shared_ptr<const Shape> shape; ///< where it is at the start
    std::shared_ptr<const VelocityField> velocity;
  };

  /** A region that conducts otherwise than the rest. */
  struct Inclusion
  {
    Field level_set;         ///< negative inside; only its sign and its zeros matter
    double conductivity = 1; ///< inside, W/(m K)
    /** Where it is all cells of one material of the domain's mesh: its index. */
    std::optional<unsigned int> material{};

    bool contains(const Position &position) const
    {
      return level_set(position, 0) < 0;
    }
  };

  struct InitialState
  {
    Field temperature;
    /** Solid fraction of a point whose temperature is the melting point. */
    double solid_fraction_at_melting = 0;
    /**
     * The exact solution that the state is taken from, if it is: lets a method start from
     * exact cell averages (heat_content) instead of point values.
     */
    std::shared_ptr<const ExactSolution> exact;
    /**
     * Where the front is at the start, as a level set: negative in solid, zero on the
     * front (m, but only its sign and its zeros matter). Absent: solid is where the
     * temperature is below the melting point. Present, it may leave a phase on the wrong
     * side of the melting temperature (undercooled liquid, superheated solid).
     */
    std::optional<Field> front;
    /** Of each solute of the alloy: mass fraction of all that is at a point. */
    std::vector<Field> concentration;
  };

  /** Physics to simulate: no parameter of any method stands here. SI units, or as `units`
   * says. */
  struct Scene
  {
    std::string name;
    std::string units = "SI";
    ProblemKind problem = ProblemKind::stefan;
    Symmetry symmetry = Symmetry::none;
    Domain domain;
    Material material;          ///< of an alloy: the solvent
    std::optional<Alloy> alloy; ///< absent: a pure substance
    InitialState initial;
    std::array<std::optional<Boundary>, n_sides>
        boundaries; ///< by Side; those the shape has
    std::vector<PointSource> sources;
    /** Heat released throughout the domain (W/m^3). */
    std::optional<Field> volumetric_source;
    std::optional<Inclusion> inclusion;
    /** Of ProblemKind::interface_advection. */
    std::optional<InterfaceAdvection> interface;
    /** Of ProblemKind::particle_solid; of a heat problem: what the material is made of.
     */
    std::optional<ParticleSolid> particle_solid;
    double start_time = 0; ///< s; 0 in a steady scene, which ends at 1
    double end_time = 1;   ///< s
    std::map<Effect, EffectChoice> effect_choices; ///< absent means automatic

    const Boundary &boundary(Side side) const;

    /** Of a substance with one conductivity (W/(m K)): the inclusion's or the solid's. */
    double conductivity_at(const Position &position) const;

    /** Whether a temperature is asked for: all kinds of problem but those that carry a
     * front along or move particles. */
    bool conducts_heat() const;

    /** Whether latent heat is exchanged, so that there is a front. */
    bool changes_phase() const;

    /** The sides that the domain's shape has, in the order of Side. */
    std::vector<Side> sides() const;
  };

  /** Bounds that the maximum principle sets on the temperature of a scene; infinite where
   * none. */
  struct TemperatureBounds
  {
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
  };

  /**
   * Extremes of initial and wall temperatures, sampled over the domain and time (an
   * expression at 4097 times: a shorter pulse than that goes unseen), and ambient
   * temperatures of walls. A sink removes the lower bound, a source the upper one, an
   * inward (outward) flux the upper (lower) one.
   */
  TemperatureBounds temperature_bounds(const Scene &scene);

  /** By how much the phases that the scene's initial front divides are on the wrong side
   * of the melting temperature at the start, at most (K); 0: not at all. */
  struct MetastableStart
  {
    double undercooling = 0; ///< of liquid
    double superheat = 0;    ///< of solid
  };

  /** Sampled over the domain; stable without an initial front. */
  MetastableStart metastable_start(const Scene &scene);

  /** `liquid is undercooled` or `solid is superheated` where metastable_start() says so,
   * else null. */
  const char *metastable_initial_phase(const Scene &scene);

  /** Whether there is any of a solute at the start; sampled over the domain. */
  bool initially_present(const Scene &scene, std::size_t solute);

  /**
   * Throw NumericalError unless lowest and highest are finite and within the bounds,
   * widened by `tolerance` times the bounds' span.
   */
  void check_temperature(const TemperatureBounds &bounds, double lowest, double highest,
                         const std::string &method, long step, double time,
                         double tolerance = 1e-9);

  /** Throw Refusal where a source gives off heat at a time, for methods that follow the
   * front about what is solid and no second one about a source. */
  void require_sinks(const Scene &scene, double time, const std::string &method);
} // namespace meltfront::cases

#endif
