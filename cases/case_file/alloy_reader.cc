#include <cases/case_file/alloy_reader.h>
#include <cases/case_file/expression.h>
#include <cases/case_file/key_builders.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meltfront::cases
{
  namespace
  {
    const std::string material_keys = "Scene/Material";
    const std::string alloy_keys = "Scene/Material/Alloy";
    constexpr std::size_t most_solutes = 2;

    std::string solute_keys(std::size_t solute)
    {
      return fmt::format("Scene/Material/Solute {}", solute + 1);
    }

    PrmEntry entry(const std::string &key, PrmKind kind, const std::string &unit,
                   const std::string &description)
    {
      return {.key = key,
              .kind = kind,
              .default_value = {},
              .unit = unit,
              .description = description};
    }

    PrmEntry number(const std::string &key, const std::string &default_value,
                    const std::string &unit, const std::string &description, double lower,
                    double upper = std::numeric_limits<double>::infinity())
    {
      return {.key = key,
              .kind = PrmKind::number,
              .default_value = default_value,
              .unit = unit,
              .description = description,
              .lower = lower,
              .upper = upper};
    }

    void declare_solute(PrmFile &prm, std::size_t solute)
    {
      const std::string here = solute_keys(solute);
      prm.declare(here, entry("name", PrmKind::text, {}, "What is dissolved."));
      prm.declare(here,
                  entry("liquidus", PrmKind::text, {},
                        "A number: by how much the liquidus falls per unit mass fraction "
                        "(K); an expression of the mass fraction C: liquidus temperature "
                        "(K or degrees Celsius); or points of it, 0: 0, 0.1: -4, ..., "
                        "mass fraction: temperature."));
      prm.declare(here, number("largest concentration", "1", {},
                               "Mass fraction up to which an expression of C holds.",
                               above_zero, 1));
      prm.declare(here, number("diffusivity", "0", "m^2/s",
                               "Diffusivity of the solute in the liquid.", 0));
    }

    void read_liquidus_table(const std::string &text, double melting, Solute &solute)
    {
      const std::vector<std::pair<double, double>> points
          = parse_points(text, "mass fraction: temperature");
      try
      {
        solute.liquidus_curve = liquidus_through(points, melting);
      }
      catch(const InputError &error)
      {
        throw InputError(fmt::format("is no liquidus: {}", error.what()));
      }
      solute.largest_concentration = points.back().first;
      if(!(solute.largest_concentration <= 1))
        throw InputError(fmt::format("goes on to the mass fraction {:.6g}; 1 is all",
                                     solute.largest_concentration));
    }

    void read_liquidus_formula(const std::string &text, double melting, Solute &solute)
    {
      constexpr int samples = 256;
      const double largest = solute.largest_concentration;
      const std::function<double(double)> formula = parse_function(text, "C");
      const double at_zero = formula(0);
      const double span = std::abs(at_zero - formula(largest));
      if(!(std::isfinite(at_zero) && std::abs(at_zero - melting) <= 1e-9 * span))
        throw InputError(fmt::format("is {:.9g} at C = 0, where it must be the melting "
                                     "temperature {:.9g}",
                                     at_zero, melting));
      double before = at_zero;
      for(int i = 1; i <= samples; ++i)
      {
        const double concentration = largest * i / samples;
        const double temperature = formula(concentration);
        if(!(temperature < before) || !std::isfinite(temperature))
          throw InputError(
              fmt::format("must fall as C rises: it is {:.6g} at C = {:.6g} after {:.6g} "
                          "(the key 'largest concentration' says where it ends)",
                          temperature, concentration, before));
        before = temperature;
      }
      solute.liquidus_curve = [formula, at_zero, largest](double concentration)
      { return at_zero - formula(std::clamp(concentration, 0., largest)); };
    }

    /** The three forms are told apart by the colon of a table and by the letter C. */
    void read_liquidus(const std::string &text, double melting, Solute &solute)
    {
      solute.liquidus = text;
      if(text.find(':') != std::string::npos && text.find('?') == std::string::npos)
        read_liquidus_table(text, melting, solute);
      else if(text.find('C') != std::string::npos)
        read_liquidus_formula(text, melting, solute);
      else
      {
        solute.liquidus_slope = parse_field(text, "")({}, 0);
        if(!(solute.liquidus_slope > 0))
          throw InputError(fmt::format("is the slope {:.6g}; a slope must be greater "
                                       "than 0, by which the liquidus "
                                       "falls per unit mass fraction",
                                       solute.liquidus_slope));
      }
    }

    Solute read_solute(const PrmFile &prm, std::size_t number, double melting)
    {
      const std::string here = solute_keys(number);
      prm.require(here, "name", "a solute needs one");
      prm.require(here, "liquidus", "a solute lowers the melting temperature");
      Solute solute;
      solute.name = prm.get_text(here, "name");
      solute.diffusivity = prm.get_number(here, "diffusivity");
      solute.largest_concentration = prm.get_number(here, "largest concentration");
      try
      {
        read_liquidus(prm.get_text(here, "liquidus"), melting, solute);
      }
      catch(const InputError &error)
      {
        throw prm.error(here, "liquidus", error.what());
      }
      if(solute.liquidus.find('C') == std::string::npos)
        prm.forbid(here, "largest concentration", "the liquidus is no expression of C");
      return solute;
    }

    void check_material_of_alloy(const PrmFile &prm, const Scene &scene)
    {
      const Material &material = scene.material;
      if(!(material.latent_heat > 0))
        throw prm.error(material_keys, "latent heat",
                        "must be greater than 0 in an alloy");
      if(material.solid.density != material.liquid.density)
        throw prm.error("Scene/Material/Liquid", "density",
                        "must be that of the solid in an alloy, which stays at rest: how "
                        "much room the crystals take up is the key 'crystal density' in "
                        "subsection 'Scene/Material/Alloy'");
      if(!(scene.alloy->eutectic_temperature < material.melting_temperature))
        throw prm.error(alloy_keys, "eutectic temperature",
                        fmt::format("({:.6g}) must lie below the melting temperature of "
                                    "the solvent ({:.6g})",
                                    scene.alloy->eutectic_temperature,
                                    material.melting_temperature));
      if(scene.alloy->solutes.size() > 1)
        for(std::size_t s = 0; s < most_solutes; ++s)
          if(scene.alloy->solutes[s].liquidus_curve)
            throw prm.error(solute_keys(s), "liquidus",
                            "is curved, which needs the solute to be the only one: with "
                            "two solutes both must be slopes");
    }

    void read_concentrations(const PrmFile &prm, Scene &scene)
    {
      for(const char *key : {"front", "solid fraction at melting"})
        prm.forbid(initial_keys, key, "the liquidus of an alloy says what is solid");
      const bool exact = prm.get_text(initial_keys, "kind") == "exact";
      const std::string variables = std::string("xyz").substr(0, scene.domain.dimension);
      for(std::size_t s = 0; s < most_solutes; ++s)
      {
        const char *key = concentration_key(s);
        if(exact)
          prm.forbid(initial_keys, key, "the initial state is the exact solution's");
        if(s >= scene.alloy->solutes.size())
          prm.forbid(initial_keys, key, "the material has one solute");
        if(exact || s >= scene.alloy->solutes.size())
          continue;
        prm.require(
            initial_keys, key,
            fmt::format("there is {} in the liquid", scene.alloy->solutes[s].name));
        try
        {
          scene.initial.concentration.push_back(
              parse_field(prm.get_text(initial_keys, key), variables));
        }
        catch(const InputError &error)
        {
          throw prm.error(initial_keys, key, error.what());
        }
      }
    }

    void forbid_alloy_keys(const PrmFile &prm)
    {
      const std::string missing = "there is no subsection 'Scene/Material/Solute 1'";
      for(std::size_t s = 0; s < most_solutes; ++s)
        prm.forbid(initial_keys, concentration_key(s), missing);
      for(const std::string &here : {alloy_keys, solute_keys(1)})
        if(prm.opened(here))
          throw prm.subsection_error(here,
                                     fmt::format("has no meaning here: {}", missing));
    }

    /**
     * The coldest liquid of the scene holds no more solute than the phase diagram knows,
     * and never more than its own mass.
     */
    void check_coldest_liquid(const PrmFile &prm, const Scene &scene,
                              const PhaseDiagram &diagram, double lowest, double first,
                              double second)
    {
      const double eutectic = scene.alloy->eutectic_temperature;
      // Just above it: by more than what subtracting the melting temperature rounds off.
      const double margin = std::isfinite(eutectic)
                                ? 1e-9 * (scene.material.melting_temperature - eutectic)
                                : 0;
      const double temperature = std::max(lowest, eutectic + margin);
      if(!std::isfinite(temperature) || first + second == 0)
        return;
      try
      {
        const double liquid = 1 - diagram.solid_fraction(temperature, first, second);
        if(first + second > liquid)
          throw InputError(fmt::format(
              "makes the solute of the liquid exceed the liquid's own mass at {:.6g}, to "
              "which the scene may cool: state a eutectic temperature above that",
              temperature));
      }
      catch(const InputError &error)
      {
        throw prm.error(solute_keys(0), "liquidus", error.what());
      }
    }

    std::string words(const Position &p, int dimension)
    {
      std::string text;
      for(int d = 0; d < dimension; ++d)
        text += fmt::format("{}{} = {:.6g}", d == 0 ? "" : ", ", "xyz"[d], p[d]);
      return text;
    }
  } // namespace

  const char *concentration_key(std::size_t solute)
  {
    return solute == 0 ? "concentration" : "second concentration";
  }

  void declare_alloy(PrmFile &prm)
  {
    prm.declare(alloy_keys,
                number("crystal density", {}, "kg/m^3",
                       "Density of the crystals, by which their mass becomes a volume "
                       "where conductivities are mixed; that of the material where it is "
                       "not given.",
                       above_zero));
    prm.declare(alloy_keys,
                entry("eutectic temperature", PrmKind::number, "K or degrees Celsius",
                      "Temperature at which the rest of the liquid freezes; none where "
                      "it is not given."));
    for(std::size_t s = 0; s < most_solutes; ++s)
    {
      declare_solute(prm, s);
      prm.declare(initial_keys,
                  entry(concentration_key(s), PrmKind::text, {},
                        fmt::format("Mass fraction of the {} solute, expression of x, y, "
                                    "z.",
                                    s == 0 ? "first" : "second")));
    }
  }

  void read_alloy(const PrmFile &prm, Scene &scene)
  {
    if(!prm.opened(solute_keys(0)))
    {
      forbid_alloy_keys(prm);
      return;
    }
    Alloy alloy;
    for(std::size_t s = 0; s < most_solutes; ++s)
      if(prm.opened(solute_keys(s)))
        alloy.solutes.push_back(read_solute(prm, s, scene.material.melting_temperature));
    if(prm.given(alloy_keys, "crystal density"))
      alloy.crystal_density = prm.get_number(alloy_keys, "crystal density");
    if(prm.given(alloy_keys, "eutectic temperature"))
      alloy.eutectic_temperature = prm.get_number(alloy_keys, "eutectic temperature");
    scene.alloy = alloy;
    check_material_of_alloy(prm, scene);
    read_concentrations(prm, scene);
  }

  void check_alloy(const PrmFile &prm, const Scene &scene,
                   const std::vector<Position> &points)
  {
    if(!scene.alloy)
      return;
    const PhaseDiagram diagram(scene.material, *scene.alloy);
    const double eutectic = scene.alloy->eutectic_temperature;
    const double lowest = temperature_bounds(scene).lower;
    const std::size_t solutes = scene.initial.concentration.size();
    const std::string last_key = concentration_key(solutes - 1);
    for(const Position &p : points)
    {
      const std::string where = words(p, scene.domain.dimension);
      std::array<double, most_solutes> c{};
      for(std::size_t s = 0; s < solutes; ++s)
      {
        c[s] = scene.initial.concentration[s](p, scene.start_time);
        if(!(c[s] >= 0 && c[s] < 1))
          throw prm.error(
              initial_keys, concentration_key(s),
              fmt::format("is {:.6g} at {}; a mass fraction is at least 0 and "
                          "less than 1",
                          c[s], where));
      }
      const double all = c[0] + c[1];
      if(!(all < 1))
        throw prm.error(initial_keys, last_key,
                        fmt::format("makes {:.6g} at {} together with the first; mass "
                                    "fractions must sum to less than 1",
                                    all, where));
      if(all > 0 && !(diagram.liquidus(c[0], c[1]) > eutectic))
        throw prm.error(
            initial_keys, last_key,
            fmt::format("puts the liquidus to {:.6g} at {}, not above the eutectic "
                        "temperature {:.6g}: crystals of solute, not of solvent, would "
                        "grow",
                        diagram.liquidus(c[0], c[1]), where, eutectic));
      check_coldest_liquid(prm, scene, diagram, lowest, c[0], c[1]);
    }
  }
} // namespace meltfront::cases
