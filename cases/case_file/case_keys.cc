#include <cases/case.h>
#include <cases/case_file/alloy_reader.h>
#include <cases/case_file/case_keys.h>
#include <cases/case_file/conduction_reader.h>
#include <cases/case_file/interface_reader.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/manufactured_reader.h>
#include <cases/case_file/material_reader.h>
#include <cases/case_file/mesh_reader.h>
#include <cases/case_file/output_reader.h>
#include <cases/case_file/particle_solid_reader.h>
#include <cases/data_folder.h>
#include <cases/effects.h>
#include <cases/scene.h>

#include <fmt/format.h>

#include <functional>

namespace meltfront::cases
{
  namespace
  {
    void declare_head(PrmFile &prm)
    {
      prm.declare("", text_key("title", "The case in a few words."));
      prm.declare("", text_key("description", "What it is and what is to be seen."));
      prm.declare("", text_key("tags", "Words to select cases by, separated by commas."));
      prm.declare("", word_key("units", "SI", {"SI", "normalised"},
                               "Whether quantities are in SI units or normalised."));
    }

    void declare_domain(PrmFile &prm)
    {
      prm.declare("Scene",
                  word_key("symmetry", "", {"planar", "cylindrical", "spherical", "none"},
                           "What the solution depends on: x, the distance from the "
                           "axis, the distance from the origin, or everything."));
      prm.declare("Scene", number_key("start time", "0", "s", "When the scene begins."));
      prm.declare("Scene", number_key("end time", "", "s", "When the scene ends."));
      prm.declare("Scene", number_key("start front", "", "m",
                                      "Where the front of Neumann's solution is when the "
                                      "scene begins, in place of 'start time'.",
                                      above_zero));
      prm.declare("Scene", number_key("end front", "", "m",
                                      "Where it is when the scene ends, in place of 'end "
                                      "time'.",
                                      above_zero));
      const std::string domain = "Scene/Domain";
      prm.declare(
          domain,
          word_key("shape", "",
                   {"slab", "box", "ball", "shell", "outline", "axisymmetric", "mesh"},
                   "slab: 0 <= x <= length; box: between two corners; ball: a disk or "
                   "a ball about the origin; shell: that outside of an inner radius; "
                   "outline: within a closed curve in the plane; axisymmetric: a body "
                   "about an axis, x the distance from it and y along it, between two "
                   "corners; mesh: the cells of a file."));
      prm.declare(
          domain,
          integer_key("dimension", "1", 1, 3,
                      "Dimensions of the shape: 1 for a slab, 2 of an axisymmetric "
                      "section, 2 or 3 else."));
      prm.declare(domain, number_key("length", "", "m", "Length of a slab.", above_zero));
      prm.declare(domain, number_key("left end", "0", "m", "Where a slab begins."));
      prm.declare(domain, numbers_key("lower corner", "m",
                                      "Corner of a box or of an axisymmetric section."));
      prm.declare(domain, numbers_key("upper corner", "m", "Opposite corner of a box."));
      prm.declare(domain,
                  number_key("radius", "", "m",
                             "Radius of a ball, outer radius of a shell.", above_zero));
      prm.declare(domain, number_key("inner radius", "", "m", "Inner radius of a shell.",
                                     above_zero));
      prm.declare(domain,
                  text_key("corners", "Corners of a polygonal outline: x, y; x, y; "
                                      "... in metres, either way round."));
      prm.declare(domain, formula_key("polar radius",
                                      "Any other outline: distance from its centre "
                                      "(m), expression of the angle phi from -pi to "
                                      "pi."));
      prm.declare(
          domain,
          numbers_key("centre", "m",
                      "Centre of an outline: where its angles are taken, and what "
                      "lattices are arranged about; the origin where not "
                      "given."));
      prm.declare(
          domain,
          number_key("reference length", "", "m",
                     "Length of an outline that a resolution n divides; the larger "
                     "side of its bounding box where not given.",
                     above_zero));
      declare_mesh(prm);
    }

    /** Keys of a wall. @param declare takes each of them */
    void declare_wall(const std::function<void(const PrmEntry &)> &declare)
    {
      declare(
          word_key("kind", "insulated",
                   {"insulated", "fixed temperature", "exact", "flux", "periodic",
                    "heat transfer", "radiation"},
                   "What holds at the wall; exact: the exact solution's "
                   "temperature; heat transfer: a flux that the wall's difference "
                   "from the ambient temperature drives; radiation: the same with the "
                   "fourth powers of the absolute temperatures."));
      declare(
          with_table(expression_key("ambient temperature", temperature_units,
                                    "Temperature of the surroundings: expression of x, "
                                    "y, z, t; exact: that which makes the flux the exact "
                                    "solution's."),
                     "s"));
      declare(number_key("heat transfer coefficient", "", "W/(m^2 K)",
                         "Heat flux per difference of temperature.", above_zero));
      declare(number_key("emissivity", "", "",
                         "Of a wall that radiates: the share of a black "
                         "body's radiation.",
                         above_zero));
      declare(number_key("Stefan-Boltzmann constant", "5.670374419e-8", "W/(m^2 K^4)",
                         "In normalised scenes another number.", above_zero));
      declare(number_key("absolute zero", "", "K",
                         "Of a wall that radiates: on the scene's scale of "
                         "temperature, -273.15 for degrees Celsius."));
      declare(with_table(
          expression_key("temperature", temperature_units, "Expression of x, y, z, t."),
          "s"));
      declare(with_table(expression_key("flux", "W/m^2",
                                        "Heat flux into the domain, expression of x, y, "
                                        "z, t; exact: that of the exact solution."),
                         "s"));
    }

    void declare_walls(PrmFile &prm)
    {
      for(std::size_t s = 0; s < n_named_sides; ++s)
        declare_wall(
            [&](const PrmEntry &entry) {
              prm.declare(all_wall_keys + "/" + to_string(static_cast<Side>(s)), entry);
            });
      declare_wall([&](const PrmEntry &entry)
                   { prm.declare_in_each(all_wall_keys, "PHYSICAL GROUP", entry, 0); });
    }

    void declare_state_and_walls(PrmFile &prm)
    {
      const std::string initial = "Scene/Initial state";
      prm.declare(initial, word_key("kind", "temperature", {"temperature", "exact"},
                                    "Given as a temperature, or taken from the exact "
                                    "solution at the start time."));
      prm.declare(initial, expression_key("temperature", temperature_units,
                                          "Expression of x, y, z."));
      prm.declare(initial,
                  formula_key("front",
                              "Level set of the front, expression of x, y, z: negative "
                              "in solid, zero on the front. Where it is not given, "
                              "what is colder than the melting temperature is "
                              "solid."));
      prm.declare(initial,
                  number_key("solid fraction at melting", "0", "",
                             "Solid fraction of points at the melting temperature.", 0,
                             1));
      declare_walls(prm);
      for(int i = 1; i <= most_sources; ++i)
      {
        const std::string source = fmt::format("Scene/Source {}", i);
        prm.declare(source,
                    expression_key("position", "m",
                                   "Where the source is: as many coordinates as the "
                                   "domain has dimensions, separated by commas; of "
                                   "a source that moves, expressions of t."));
        prm.declare(
            source,
            number_key("radius", "", "m",
                       "Of a Gaussian spot in place of a point: power densities "
                       "fall as exp(-(d/radius)^2) with the distance d. What lies "
                       "outside of the domain is not released.",
                       above_zero));
        prm.declare(
            source,
            with_table(
                expression_key("power", "W or W/m",
                               "Heat released per time, expression of t, negative for "
                               "a sink; exact: that of the exact solution (W/m in two "
                               "dimensions)."),
                "s"));
      }
    }

    void declare_effects(PrmFile &prm)
    {
      PrmEntry all = text_key(
          "effects",
          "auto: subsection Effects decides. auto within 1e-3: of those that are 'auto' "
          "there, effects are left out before the run as long as all that are left out "
          "together are certain to change the front by less than 1e-3 of the domain's "
          "side, and the temperature by less than 1e-3 of its range (mean over the "
          "domain); the list of effects says by how much each could.");
      all.default_value = "auto";
      prm.declare("", all);
      for(const Effect effect : all_effects())
        prm.declare("Effects",
                    word_key(to_string(effect), "auto", {"auto", "on", "off"},
                             std::string(description(effect))
                                 + " auto: simulated where the scene calls for it."));
    }

    void declare_exact_solution(PrmFile &prm)
    {
      const std::string exact = "Exact solution";
      prm.declare(
          exact,
          word_key(
              "kind", "none",
              {"none", "neumann", "line sink", "point sink", "frank", "mushy layer",
               "oracle", "formula", "five-point lattice", "manufactured"},
              "The solution that is known; oracle: a spectral solution of the scene; "
              "manufactured: a front that is given, with the heat that has to be "
              "released "
              "for it to move so."));
      prm.declare(exact, number_key("wall temperature", "", "K",
                                    "Wall temperature of Neumann's solution; that of the "
                                    "wall x_min where not given."));
      prm.declare(exact,
                  number_key("far temperature", "", "K",
                             "Far from the wall or the sink; the initial temperature "
                             "where not given."));
      for(const std::string which : {"", "second "})
        prm.declare(exact, number_key("far " + which + "concentration", "", "",
                                      "Mass fraction of a solute far from the wall, of a "
                                      "mushy layer; the initial one where that is given.",
                                      0, 1));
      prm.declare(exact, number_key("lambda", "", "",
                                    "Front constant of a sink's solution.", above_zero));
      prm.declare(
          exact,
          word_key("start", "neumann",
                   {"neumann", "line sink", "point sink", "initial state", "wall flux",
                    "one phase"},
                   "What the oracle starts from: a similarity solution, or "
                   "the scene's initial temperature with a front, or liquid that "
                   "a flux out of x_min cools until it freezes, or one phase "
                   "throughout until its walls, of any kind, make another one appear."));
      prm.declare(exact,
                  number_key("start time", "", "s",
                             "Time until which the oracle is the similarity solution.",
                             above_zero));
      prm.declare(exact,
                  number_key("initial front", "", "m",
                             "Front of the initial state, for the oracle.", above_zero));
    }

    void declare_measures(PrmFile &prm)
    {
      const std::string measure = "Measure";
      prm.declare(measure,
                  integer_key("samples", "100", 0, 1e6,
                              "Snapshots over the run, at least 50; 0: every step."));
      prm.declare(measure,
                  word_key("clock", "t", {"t", "sqrt(t)"},
                           "Samples are equidistant in the time or in its root."));
      prm.declare(measure,
                  number_key("temperature from", "0", "m",
                             "Coordinate from which temperature is compared.", 0));
      prm.declare(measure,
                  number_key("temperature to", "", "m",
                             "Coordinate up to which temperature is compared; all "
                             "where not given.",
                             above_zero));
      prm.declare(
          measure,
          number_key("front floor", "0", "m",
                     "By how much the exact solution itself is off in this domain; "
                     "0: exact.",
                     0));
      prm.declare(measure, {.key = "monotone front",
                            .kind = PrmKind::boolean,
                            .default_value = "true",
                            .unit = {},
                            .description = "Physics says that the front never turns "
                                           "back."});
      prm.declare(measure,
                  number_key("front square from", "", "m",
                             "Coordinate from which on the squares of the front's "
                             "positions are held against a straight line over time; they "
                             "are not where the key is not given.",
                             0));
      prm.declare(measure,
                  integer_key("front mode", "0", 0, 1000,
                              "m: the amplitude of cos(m phi) in a circular front is "
                              "measured; 0: none."));
      PrmEntry intermediate_times
          = numbers_key("intermediate times", "s",
                        "Times, ascending, at which the volume that is solid is "
                        "measured beside the end.");
      intermediate_times.most_values = most_intermediate_times;
      prm.declare(measure, intermediate_times);
      prm.declare(measure,
                  text_key("events",
                           "What is timed, separated by commas: first_contact of "
                           "the ice around two sinks, half_frozen, all_frozen."));
      prm.declare(measure,
                  integer_key("picture time number", "0", 0, most_intermediate_times,
                              "Number of the mark, from 1, at which a picture of the "
                              "scene is kept beside that of the end; 0: none."));
      prm.declare(measure,
                  word_key("mirror", "none", {"none", "x", "y", "z"},
                           "Direction in which the temperature is compared with its "
                           "mirror image about the origin."));
      prm.declare(measure,
                  number_key("absolute zero", "", temperature_units,
                             "Absolute zero on the scene's scale of temperature, "
                             "-273.15 for degrees Celsius: the entropy is measured; "
                             "it is not where the key is not given."));
      prm.declare("Reference",
                  text_key("method", "The run that others are held against "
                                     "where there is no exact solution: METHOD "
                                     "or METHOD[KEY=VALUE,KEY=VALUE]."));
      prm.declare("Reference", integer_key("n", "", 1, 1e9, "Resolution of that run."));
      prm.declare_numbered("Acceptance",
                           text_key("criterion",
                                    "METHOD: QUANTITY at n=N <= BOUND, and so "
                                    "on; METHOD[KEY=VALUE,...] for a method "
                                    "with options."),
                           40);
      prm.declare("Printed", text_key("source", "Paper that the values are printed in."));
      prm.declare_numbered(
          "Printed", text_key("value", "METHOD: QUANTITY at n=N = VALUE (TABLE)."), 40);
      for(const std::string name : figure_names)
        prm.declare("Printed",
                    text_key(name + " figure",
                             "Figure of the paper that the report's plot of the " + name
                                 + " restates, `Fig. 6`."));
      prm.declare_numbered("Limits", text_key("limit", "What the case does not show."),
                           20);
    }
  } // namespace

  PrmFile case_keys()
  {
    PrmFile prm(data_path("cases/library"));
    prm.allow_constants();
    declare_head(prm);
    declare_domain(prm);
    declare_material(prm);
    declare_state_and_walls(prm);
    declare_alloy(prm);
    declare_conduction(prm);
    declare_interface(prm);
    declare_particle_solid(prm);
    declare_effects(prm);
    declare_exact_solution(prm);
    declare_manufactured(prm);
    declare_measures(prm);
    declare_output(prm);
    return prm;
  }
} // namespace meltfront::cases
