#include <cases/case_file/alloy_reader.h>
#include <cases/case_file/breakpoints.h>
#include <cases/case_file/case_checks.h>
#include <cases/case_file/case_keys.h>
#include <cases/case_file/conduction_reader.h>
#include <cases/case_file/domain_reader.h>
#include <cases/case_file/expression.h>
#include <cases/case_file/interface_reader.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/material_reader.h>
#include <cases/case_file/mesh_reader.h>
#include <cases/case_file/particle_solid_reader.h>
#include <cases/case_file/scene_reader.h>
#include <cases/case_file/source_reader.h>
#include <cases/case_file/times_reader.h>
#include <cases/expression_words.h>
#include <cases/sampling.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace meltfront::cases
{
  namespace
  {

    /** The variables that a field of the domain may depend on. */
    std::string coordinates(const Domain &domain)
    {
      return std::string("xyz").substr(0, domain.dimension);
    }

    Field read_field(const PrmFile &prm, const std::string &subsection,
                     const std::string &key, const std::string &variables)
    {
      try
      {
        return parse_field(prm.get_text(subsection, key), variables);
      }
      catch(const InputError &error)
      {
        throw prm.error(subsection, key, error.what());
      }
    }

    void find_breakpoints_of(const PrmFile &prm, const std::string &subsection,
                             const std::string &key, const Scene &scene,
                             const std::vector<Position> &positions, Field &field)
    {
      try
      {
        add_breakpoints(field, positions, scene.start_time, scene.end_time);
      }
      catch(const InputError &error)
      {
        throw prm.error(subsection, key, error.what());
      }
    }

    /** Some of many positions, so that what moves is seen at several. */
    std::vector<Position> some_of(const std::vector<Position> &positions)
    {
      constexpr std::size_t wanted = 9;
      std::vector<Position> result;
      const std::size_t taken = std::min(wanted, positions.size());
      for(std::size_t i = 0; i < taken; ++i)
        result.push_back(
            positions[i * (positions.size() - 1) / std::max<std::size_t>(taken - 1, 1)]);
      return result;
    }

    std::vector<Side> sides_of(const Domain &domain)
    {
      std::vector<Side> sides;
      if(domain.mesh)
      {
        for(std::size_t wall = 0; wall < domain.mesh->walls().size(); ++wall)
          sides.push_back(mesh_wall(wall));
        return sides;
      }
      if(domain.shape == DomainShape::ball || domain.outline)
        return {Side::outer};
      if(domain.shape == DomainShape::shell)
        return {Side::inner, Side::outer};
      for(int s = 0; s < 2 * domain.dimension; ++s)
        sides.push_back(static_cast<Side>(s));
      return sides;
    }

    Boundary radiating_wall(const PrmFile &prm, const std::string &here,
                            const Field &ambient)
    {
      prm.forbid(here, "heat transfer coefficient", "the wall's kind is 'radiation'");
      for(const char *key : {"emissivity", "absolute zero"})
        prm.require(here, key, "a wall of kind 'radiation' needs it");
      Boundary wall{BoundaryKind::radiation, ambient, !ambient.value};
      wall.emission_coefficient = prm.get_number(here, "emissivity")
                                  * prm.get_number(here, "Stefan-Boltzmann constant");
      wall.absolute_zero = prm.get_number(here, "absolute zero");
      return wall;
    }

    Boundary read_wall(const PrmFile &prm, Side side, const Domain &domain)
    {
      const std::string here = wall_keys(domain, side);
      if(!prm.opened(here))
        return {};
      const std::string kind = prm.get_text(here, "kind");
      const std::string variables = coordinates(domain) + "t";
      const auto value = [&](const char *key, const char *owner)
      {
        if(kind == owner)
        {
          prm.require(here, key, fmt::format("a wall of kind '{}' needs it", kind));
          if(kind != "fixed temperature" && prm.get_text(here, key) == exact_value)
            return Field{exact_value, {}};
          return read_field(prm, here, key, variables);
        }
        prm.forbid(here, key, fmt::format("the wall's kind is '{}'", kind));
        return Field();
      };
      const Field temperature = value("temperature", "fixed temperature");
      const Field flux = value("flux", "flux");
      const Field ambient = value("ambient temperature",
                                  kind == "radiation" ? "radiation" : "heat transfer");
      if(kind == "radiation")
        return radiating_wall(prm, here, ambient);
      for(const char *key : {"emissivity", "Stefan-Boltzmann constant", "absolute zero"})
        prm.forbid(here, key, fmt::format("the wall's kind is '{}'", kind));
      if(kind == "heat transfer")
      {
        prm.require(here, "heat transfer coefficient",
                    "a wall of kind 'heat transfer' needs it");
        return {BoundaryKind::heat_transfer, ambient, !ambient.value,
                prm.get_number(here, "heat transfer coefficient")};
      }
      prm.forbid(here, "heat transfer coefficient",
                 fmt::format("the wall's kind is '{}'", kind));
      if(kind == "fixed temperature")
        return {BoundaryKind::fixed_temperature, temperature};
      if(kind == "exact")
        return {BoundaryKind::fixed_temperature, Field(), true};
      if(kind == "flux")
        return {BoundaryKind::flux, flux, !flux.value};
      return {kind == "periodic" ? BoundaryKind::periodic : BoundaryKind::insulated,
              Field()};
    }

    /** Complain of a subsection that is no wall of the domain. */
    void check_names_of_walls(const PrmFile &prm, const Domain &domain,
                              const std::vector<Side> &sides)
    {
      std::vector<std::string> names;
      for(const Side side : sides)
        names.push_back(name_of(domain, side));
      for(const std::string &name : prm.subsections_of(all_wall_keys))
        if(std::ranges::find(names, name) == names.end())
          throw prm.subsection_error(
              all_wall_keys + "/" + name,
              names.empty()
                  ? "names a wall, and no part of the mesh's boundary has a name"
                  : fmt::format("names a wall that the domain lacks; its walls "
                                "are {}",
                                fmt::join(names, ", ")));
    }

    void read_walls(const PrmFile &prm, Scene &scene)
    {
      const std::vector<Side> sides = sides_of(scene.domain);
      check_names_of_walls(prm, scene.domain, sides);
      for(const Side side : sides)
        scene.boundaries[static_cast<std::size_t>(side)]
            = read_wall(prm, side, scene.domain);
      if(scene.domain.shape == DomainShape::axisymmetric && scene.domain.lower[0] == 0
         && scene.boundary(Side::x_min).kind != BoundaryKind::insulated)
        throw prm.error(wall_keys(scene.domain, Side::x_min), "kind",
                        "must be 'insulated': it is the axis, and no wall");
      for(const Side side : sides)
      {
        if(scene.boundary(side).kind != BoundaryKind::periodic)
          continue;
        if(scene.domain.round() || scene.domain.irregular())
          throw prm.error(wall_keys(scene.domain, side), "kind",
                          "cannot be periodic: walls of a ball, a shell, an outline or a "
                          "mesh face no other");
        if(scene.domain.shape == DomainShape::axisymmetric
           && (side == Side::x_min || side == Side::x_max))
          throw prm.error(wall_keys(scene.domain, side), "kind",
                          "cannot be periodic across the axis of an axisymmetric domain");
        const auto opposite = static_cast<Side>(static_cast<int>(side) ^ 1);
        if(scene.boundary(opposite).kind != BoundaryKind::periodic)
          throw prm.error(
              wall_keys(scene.domain, side), "kind",
              fmt::format("is periodic but that of '{}' is not", to_string(opposite)));
      }
    }

    void read_initial_state(const PrmFile &prm, Scene &scene)
    {
      if(scene.problem == ProblemKind::poisson)
      {
        if(prm.opened(initial_keys))
          throw prm.subsection_error(initial_keys,
                                     "has no meaning here: the scene is steady");
        scene.initial.temperature = Field::uniform(0);
        return;
      }
      scene.initial.solid_fraction_at_melting
          = prm.get_number(initial_keys, "solid fraction at melting");
      if(prm.get_text(initial_keys, "kind") == "exact")
      {
        for(const char *key : {"temperature", "front"})
          prm.forbid(initial_keys, key, "the initial state is the exact solution's");
        return;
      }
      prm.require(initial_keys, "temperature", "the scene needs an initial temperature");
      scene.initial.temperature
          = read_field(prm, initial_keys, "temperature", coordinates(scene.domain));
      if(prm.given(initial_keys, "front"))
        scene.initial.front
            = read_field(prm, initial_keys, "front", coordinates(scene.domain));
    }

    /** The front of an exact solution as a level set, negative in solid. */
    Field exact_level_set(const std::shared_ptr<const ExactSolution> &exact)
    {
      const double sign = exact->solid_at_origin() ? 1 : -1;
      return {"exact", [exact, sign](const Position &p, double time)
              { return sign * exact->signed_distance(p, time); }};
    }

    /** The outward normal at a point of a wall. */
    Position outward_normal(const Domain &domain, Side side, const Position &wall)
    {
      Position normal{};
      if(!domain.round())
        normal[static_cast<int>(side) / 2] = static_cast<int>(side) % 2 == 0 ? -1 : 1;
      else
        for(int d = 0; d < domain.dimension; ++d)
          normal[d] = (side == Side::outer ? wall[d] : -wall[d])
                      / std::hypot(wall[0], wall[1], wall[2]);
      return normal;
    }

    /** Of a wall that lets the exact solution's flux through: the flux, or the ambient
     * temperature that makes it. */
    void take_exact_flux(const PrmFile &prm, const KnownSolution &known, Side side,
                         const Domain &domain, Boundary &boundary)
    {
      if(domain.irregular())
        throw prm.error(wall_keys(domain, side), value_key(boundary),
                        "cannot be 'exact' at a wall of an outline or a mesh");
      if(!known.heat_flux)
        throw prm.error(
            wall_keys(domain, side), value_key(boundary),
            "is 'exact', which has a meaning only where the exact solution is "
            "'manufactured'");
      const auto flux = [known, side, domain](const Position &p, double time)
      {
        const std::array<double, 3> gradient = known.heat_flux(p, time);
        const Position normal = outward_normal(domain, side, p);
        return gradient[0] * normal[0] + gradient[1] * normal[1]
               + gradient[2] * normal[2];
      };
      if(boundary.kind == BoundaryKind::flux)
        boundary.value = {exact_value, flux};
      else if(boundary.kind == BoundaryKind::radiation)
        boundary.value
            = {exact_value,
               [flux, exact = known.solution, coefficient = boundary.emission_coefficient,
                zero = boundary.absolute_zero](const Position &p, double time)
               {
                 const double own = exact->temperature(p, time) - zero;
                 return zero
                        + std::sqrt(std::sqrt(own * own * own * own
                                              + flux(p, time) / coefficient));
               }};
      else
        boundary.value
            = {exact_value, [flux, exact = known.solution,
                             coefficient = boundary.heat_transfer_coefficient](
                                const Position &p, double time)
               { return exact->temperature(p, time) + flux(p, time) / coefficient; }};
    }

    /** Of a scene that conducts heat. */
    void read_heat(const PrmFile &prm, Scene &scene)
    {
      check_symmetry(prm, scene.domain, scene.symmetry);
      scene.material = read_material(prm);
      read_walls(prm, scene);
      read_initial_state(prm, scene);
      read_alloy(prm, scene);
      read_conduction(prm, scene);
      check_mesh_materials(prm, scene);
      read_sources(prm, scene);
    }

    /** A scene that conducts none has no use for what belongs to heat. */
    void forbid_heat(const PrmFile &prm, const Scene &scene)
    {
      std::vector<std::string> foreign{
          "Scene/Material",          "Scene/Walls",    initial_keys, "Scene/Alloy",
          "Scene/Volumetric source", "Scene/Inclusion"};
      if(scene.problem == ProblemKind::particle_solid)
        foreign.emplace_back("Scene/Domain");
      for(const std::string &here : opened_sources(prm))
        foreign.push_back(here);
      for(const std::string &here : foreign)
        if(prm.opened(here))
          throw prm.subsection_error(here,
                                     fmt::format("has no meaning where the problem is "
                                                 "'{}'",
                                                 to_string(scene.problem)));
    }
  } // namespace

  Scene read_scene(const PrmFile &prm)
  {
    Scene scene;
    scene.units = prm.get_text("", "units");
    if(scene.units != "SI" && !prm.key_with_unit().empty())
      throw prm.error(
          "", "units",
          fmt::format("is '{}', but {} has a unit", scene.units, prm.key_with_unit()));
    scene.problem = read_problem(prm);
    scene.symmetry = scene.conducts_heat() ? read_symmetry(prm) : Symmetry::none;
    read_times(prm, scene);
    if(scene.problem != ProblemKind::particle_solid)
      scene.domain = read_domain(prm);
    if(scene.conducts_heat())
      read_heat(prm, scene);
    else
      forbid_heat(prm, scene);
    read_interface(prm, scene);
    read_particle_solid(prm, scene);
    for(const Effect effect : all_effects())
    {
      const std::string choice = prm.get_text("Effects", to_string(effect));
      if(choice != "auto")
        scene.effect_choices[effect]
            = choice == "on" ? EffectChoice::on : EffectChoice::off;
    }
    return scene;
  }

  void complete_scene(const PrmFile &prm, const KnownSolution &known, Scene &scene)
  {
    take_times_from_fronts(prm, known, scene);
    const auto require_solution = [&](const std::string &here, const std::string &key)
    {
      if(!known.solution)
        throw prm.error(here, key,
                        "is 'exact' but the case has no exact solution (subsection "
                        "'Exact solution', key 'kind')");
    };
    const auto temperature = [exact = known.solution]
    {
      return Field{"exact", [exact](const Position &p, double time)
                   { return exact->temperature(p, time); }};
    };
    for(const Side side : scene.sides())
    {
      Boundary &boundary = *scene.boundaries[static_cast<std::size_t>(side)];
      if(!boundary.exact)
        continue;
      require_solution(wall_keys(scene.domain, side), "kind");
      if(boundary.kind == BoundaryKind::fixed_temperature)
        boundary.value = temperature();
      else
        take_exact_flux(prm, known, side, scene.domain, boundary);
    }
    if(scene.volumetric_source && !scene.volumetric_source->value)
      scene.volumetric_source = known.volumetric_source;
    if(scene.conducts_heat() && prm.get_text(initial_keys, "kind") == "exact")
    {
      require_solution(initial_keys, "kind");
      scene.initial.temperature = temperature();
      if(known.solution->has_front())
        scene.initial.exact = known.solution;
      if(scene.alloy)
        scene.initial.concentration = known.concentration;
      else if(known.solution->has_front() && !scene.material.melting_range)
        scene.initial.front = exact_level_set(known.solution);
    }
    complete_sources(prm, known, scene);
  }

  void find_scene_breakpoints(const PrmFile &prm, Scene &scene)
  {
    for(const Side side : scene.sides())
    {
      Boundary &boundary = *scene.boundaries[static_cast<std::size_t>(side)];
      if(scene.problem == ProblemKind::poisson)
      {
        if(is_table(boundary.value.expression))
          throw prm.error(wall_keys(scene.domain, side), value_key(boundary),
                          "cannot be a table over the time: the scene is steady");
        continue;
      }
      if(boundary.exact || !boundary.value.value)
        continue;
      std::vector<Position> positions;
      visit_wall(scene.domain, side,
                 [&](const Position &wall) { positions.push_back(wall); });
      find_breakpoints_of(prm, wall_keys(scene.domain, side), value_key(boundary), scene,
                          some_of(positions), boundary.value);
    }
    if(scene.problem != ProblemKind::poisson && scene.volumetric_source
       && scene.volumetric_source->expression != exact_value)
      find_breakpoints_of(prm, "Scene/Volumetric source", "power density", scene,
                          some_of(sample_points(scene.domain)), *scene.volumetric_source);
  }
} // namespace meltfront::cases
