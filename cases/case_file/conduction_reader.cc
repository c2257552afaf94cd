#include <cases/case_file/conduction_reader.h>
#include <cases/case_file/expression.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/mesh_reader.h>
#include <cases/exact/formula_solution.h>
#include <cases/exact/lattice_reference.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    const std::string release_keys = "Scene/Volumetric source";
    const std::string inclusion_keys = "Scene/Inclusion";

    std::string variables(const Scene &scene)
    {
      return std::string("xyz").substr(0, scene.domain.dimension);
    }

    Field field(const PrmFile &prm, const std::string &subsection, const std::string &key,
                const std::string &names)
    {
      try
      {
        return parse_field(prm.get_text(subsection, key), names);
      }
      catch(const InputError &error)
      {
        throw prm.error(subsection, key, error.what());
      }
    }

    /** The lattice takes a square whose walls prescribe temperatures. */
    LatticeProblem lattice_problem(const PrmFile &prm, const Scene &scene)
    {
      const auto complain = [&prm](const std::string &why)
      {
        throw prm.error(exact_keys, "kind",
                        "cannot be 'five-point lattice' but for a steady square: " + why);
      };
      if(scene.problem != ProblemKind::poisson || scene.domain.shape != DomainShape::box
         || scene.domain.dimension != 2)
        complain("the scene is no steady box in 2 dimensions");
      if(scene.inclusion || !scene.sources.empty())
        complain("it takes neither inclusion nor point source");
      for(const Side side : scene.sides())
        if(scene.boundary(side).kind != BoundaryKind::fixed_temperature
           || scene.boundary(side).exact)
          complain(
              fmt::format("{} prescribes no temperature of its own", to_string(side)));
      LatticeProblem problem;
      problem.lower = scene.domain.lower;
      problem.upper = scene.domain.upper;
      problem.conductivity = scene.material.solid.conductivity;
      problem.intervals = static_cast<int>(prm.get_integer(exact_keys, "intervals"));
      if(scene.volumetric_source && !scene.volumetric_source->value)
        complain("its solution releases no heat of its own");
      problem.volumetric_source = [release = scene.volumetric_source](const Position &p)
      { return release ? (*release)(p, 0) : 0.; };
      problem.wall_temperature = [&scene](const Position &p)
      {
        const Domain &domain = scene.domain;
        const double tolerance = 1e-9 * domain.side();
        for(const Side side : scene.sides())
        {
          const int d = static_cast<int>(side) / 2;
          const double wall
              = static_cast<int>(side) % 2 == 1 ? domain.upper[d] : domain.lower[d];
          if(std::abs(p[d] - wall) < tolerance)
            return scene.boundary(side).value(p, 0);
        }
        return 0.;
      };
      return problem;
    }
  } // namespace

  void declare_conduction(PrmFile &prm)
  {
    prm.declare("Scene",
                word_key("problem", "stefan",
                         {"stefan", "poisson", "interface advection", "particle solid"},
                         "stefan: heat over time, with or without a change of phase; "
                         "poisson: the steady temperature; interface advection: a front "
                         "that a given velocity carries along; particle solid: particles "
                         "that bind each other."));
    prm.declare(
        release_keys,
        expression_key("power density", "W/m^3",
                       "Heat released throughout the domain, expression of x, "
                       "y, z, t; exact: that of the exact solution `manufactured`."));
    prm.declare(
        inclusion_keys,
        formula_key("level set",
                    "Level set of the region: expression of x, y, z, negative inside."));
    prm.declare(inclusion_keys,
                text_key("material",
                         "In a domain of the shape 'mesh' in place of the level set: the "
                         "physical group of its cells."));
    prm.declare(inclusion_keys, number_key("conductivity", "", "W/(m K)",
                                           "Thermal conductivity inside.", above_zero));
    prm.declare(
        exact_keys,
        formula_key(
            "temperature",
            "Temperature of the exact solution `formula`: expression of x, y, z, t "
            "(K)."));
    prm.declare(exact_keys,
                integer_key("intervals", "101", 4, 2000,
                            "Intervals of the five-point lattice along each side."));
  }

  ProblemKind read_problem(const PrmFile &prm)
  {
    const std::string word = prm.get_text("Scene", "problem");
    for(const ProblemKind kind : {ProblemKind::poisson, ProblemKind::interface_advection,
                                  ProblemKind::particle_solid})
      if(word == to_string(kind))
        return kind;
    return ProblemKind::stefan;
  }

  void read_conduction(const PrmFile &prm, Scene &scene)
  {
    const bool release = prm.given(release_keys, "power density");
    const bool inclusion = prm.opened(inclusion_keys);
    if(inclusion && scene.changes_phase())
      throw prm.subsection_error(inclusion_keys,
                                 "has no meaning where the material has a latent heat");
    if(release && prm.get_text(release_keys, "power density") == exact_value)
      scene.volumetric_source = Field{exact_value, {}};
    else if(release)
      scene.volumetric_source
          = field(prm, release_keys, "power density", variables(scene) + "t");
    if(!inclusion)
      return;
    prm.require(inclusion_keys, "conductivity", "an inclusion needs it");
    if(prm.given(inclusion_keys, "material"))
    {
      scene.inclusion = read_mesh_inclusion(prm, inclusion_keys, scene.domain);
      return;
    }
    prm.require(inclusion_keys, "level set", "an inclusion needs it");
    scene.inclusion = Inclusion{field(prm, inclusion_keys, "level set", variables(scene)),
                                prm.get_number(inclusion_keys, "conductivity")};
  }

  void forbid_frontless_keys(const PrmFile &prm, const std::string &kind)
  {
    if(kind != "formula")
      prm.forbid(exact_keys, "temperature", "it is a key of the formula");
    if(kind != "five-point lattice")
      prm.forbid(exact_keys, "intervals", "it is a key of the five-point lattice");
  }

  KnownSolution read_frontless_solution(const PrmFile &prm, const Scene &scene)
  {
    const std::string kind = prm.get_text(exact_keys, "kind");
    for(const char *key : {"wall temperature", "far temperature", "lambda"})
      prm.forbid(exact_keys, key, fmt::format("the solution is a {}", kind));
    if(scene.changes_phase())
      throw prm.error(
          exact_keys, "kind",
          fmt::format("cannot be '{}' where the material has a latent heat: it "
                      "knows no front",
                      kind));
    KnownSolution known;
    if(kind == "five-point lattice")
    {
      try
      {
        known.solution = std::make_shared<LatticeReference>(lattice_problem(prm, scene));
      }
      catch(const InputError &error)
      {
        throw prm.error(exact_keys, "kind",
                        fmt::format("gives no solution: {}", error.what()));
      }
      return known;
    }
    prm.require(exact_keys, "temperature", "a formula needs it");
    const Field formula = field(prm, exact_keys, "temperature", variables(scene) + "t");
    const Symmetry symmetry
        = scene.domain.shape == DomainShape::slab ? Symmetry::planar : Symmetry::none;
    known.solution = std::make_shared<FormulaSolution>(
        symmetry, formula.expression,
        [formula](const Position &p, double time) { return formula(p, time); });
    return known;
  }

  void check_conduction(const PrmFile &prm, const Scene &scene,
                        const std::vector<Position> &points)
  {
    for(const Position &p : points)
    {
      if(scene.volumetric_source
         && !std::isfinite((*scene.volumetric_source)(p, scene.start_time)))
        throw prm.error(release_keys, "power density", "is not finite in the domain");
      if(scene.inclusion && !std::isfinite(scene.inclusion->level_set(p, 0)))
        throw prm.error(inclusion_keys, "level set", "is not finite in the domain");
    }
  }
} // namespace meltfront::cases
