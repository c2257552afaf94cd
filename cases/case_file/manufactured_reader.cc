#include <cases/case_file/key_builders.h>
#include <cases/case_file/manufactured_reader.h>
#include <cases/exact/axisymmetric_view.h>
#include <cases/exact/manufactured/manufactured_solution.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace meltfront::cases
{
  namespace
  {
    /** Of a front, in a run: bodies merge and part in each. */
    constexpr int most_periods = 10000;

    constexpr const char *own_keys[]
        = {"family", "period", "length scale", "base flux", "flux rounding", "contact"};
    constexpr const char *foreign_keys[] = {
        "wall temperature",  "far temperature",          "lambda",     "start",
        "far concentration", "far second concentration", "start time", "initial front"};

    /** Those that are bodies about the x axis in space. */
    constexpr std::string_view turned_families[] = {"disk", "two-disks", "finger"};

    /** Where the families have a point of a half section: their axis is that of x. */
    Position in_space(const Position &p)
    {
      return {p[1], p[0], 0};
    }

    /** Front and temperature; what they complain of gets file, line and key. */
    std::shared_ptr<const ManufacturedSolution> make_solution(const PrmFile &prm,
                                                              const Scene &scene)
    {
      FamilyParameters parameters;
      parameters.name = prm.get_text(exact_keys, "family");
      const bool turned = scene.domain.shape == DomainShape::axisymmetric;
      parameters.dimension = turned ? 3 : scene.domain.dimension;
      if(turned
         && std::ranges::find(turned_families, parameters.name)
                == std::end(turned_families))
        throw prm.error(exact_keys, "family",
                        fmt::format("must be one of {} in an axisymmetric domain: bodies "
                                    "about the axis",
                                    fmt::join(turned_families, ", ")));
      parameters.period = prm.get_number(exact_keys, "period");
      if(const double shortest = (scene.end_time - scene.start_time) / most_periods;
         parameters.period < shortest)
        throw prm.error(exact_keys, "period",
                        fmt::format("must be at least {:g} s: the run lasts no more than "
                                    "{} of them",
                                    shortest, most_periods));
      parameters.length_scale = prm.get_number(exact_keys, "length scale");
      parameters.power = static_cast<int>(prm.get_integer(exact_keys, "contact"));
      const double base_flux = prm.get_number(exact_keys, "base flux");
      const double rounding = prm.given(exact_keys, "flux rounding")
                                  ? prm.get_number(exact_keys, "flux rounding")
                                  : base_flux;
      try
      {
        return std::make_shared<const ManufacturedSolution>(
            scene.material, make_front_family(parameters), base_flux, rounding);
      }
      catch(const InputError &error)
      {
        throw prm.error(exact_keys, "family",
                        fmt::format("gives no solution: {}", error.what()));
      }
    }
    void see_in_half_section(const std::shared_ptr<const ManufacturedSolution> &solution,
                             KnownSolution &known)
    {
      known.solution = std::make_shared<const AxisymmetricView>(
          solution, in_space,
          [solution](double time) { return solution->solid_volume(time); },
          [solution](double time) { return solution->front_area(time); });
      known.volumetric_source->value = [solution](const Position &p, double time)
      { return solution->volumetric_source(in_space(p), time); };
      known.heat_flux = [solution](const Position &p, double time)
      {
        const auto flux = solution->heat_flux(in_space(p), time);
        return std::array<double, 3>{flux[1], flux[0], 0};
      };
    }
  } // namespace

  void declare_manufactured(PrmFile &prm)
  {
    prm.declare(exact_keys,
                word_key("family", "plane", front_family_names(),
                         "Front of the manufactured solution, by its family."));
    prm.declare(exact_keys, number_key("period", "1", "s",
                                       "Time after which the family's front comes back.",
                                       above_zero));
    prm.declare(exact_keys, number_key("length scale", "1", "m",
                                       "By which all lengths of the family are "
                                       "multiplied.",
                                       above_zero));
    prm.declare(exact_keys,
                number_key("base flux", "1", "W/m^2",
                           "Heat flux through the front on both sides of it, beside what "
                           "its motion takes.",
                           above_zero));
    prm.declare(exact_keys,
                number_key("flux rounding", "", "W/m^2",
                           "Over which the front's heat changes from one phase to the "
                           "other where it turns back; the base flux where not given.",
                           above_zero));
    prm.declare(exact_keys,
                integer_key("contact", "3", 2, 5,
                            "Power p of the time until bodies meet or part, with which "
                            "the level set passes through zero between them: 2 (tips "
                            "meet at a finite speed), 3 or 5 (mild)."));
  }

  void forbid_manufactured_keys(const PrmFile &prm)
  {
    for(const char *key : own_keys)
      prm.forbid(exact_keys, key, "it is a key of the manufactured solution");
  }

  KnownSolution read_manufactured_solution(const PrmFile &prm, const Scene &scene)
  {
    for(const char *key : foreign_keys)
      prm.forbid(exact_keys, key, "the solution is manufactured");
    if(!scene.changes_phase() || scene.alloy)
      throw prm.error(exact_keys, "kind",
                      "cannot be 'manufactured' but for a pure substance with latent "
                      "heat: it prescribes a front");
    if(!scene.sources.empty())
      throw prm.error(exact_keys, "kind",
                      "cannot be 'manufactured' with point sources: all heat is released "
                      "throughout the domain");
    if(!scene.volumetric_source || scene.volumetric_source->value)
      throw prm.error(exact_keys, "kind",
                      "needs the heat that makes it exact: 'set power density = exact' "
                      "in subsection 'Scene/Volumetric source'");
    const auto solution = make_solution(prm, scene);
    KnownSolution known;
    known.solution = solution;
    known.volumetric_source
        = Field{exact_value, [solution](const Position &p, double time)
                { return solution->volumetric_source(p, time); }};
    known.volumetric_source->breakpoints
        = solution->family().merge_times(scene.start_time, scene.end_time);
    known.heat_flux = [solution](const Position &p, double time)
    { return solution->heat_flux(p, time); };
    if(scene.domain.shape == DomainShape::axisymmetric)
      see_in_half_section(solution, known);
    return known;
  }
} // namespace meltfront::cases
