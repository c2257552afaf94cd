#include <cases/case_file/conduction_reader.h>
#include <cases/case_file/expression.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/material_reader.h>
#include <cases/case_file/prm_scan.h>
#include <cases/expression_words.h>
#include <cases/numbers.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    const std::string material_keys = "Scene/Material";
    const std::string solid_phase_keys = "Scene/Material/Solid";
    const std::string liquid_keys = "Scene/Material/Liquid";
    const std::string conductivity_key = "conductivity";
    const std::string heat_capacity_key = "specific heat capacity";
    constexpr const char *lever = "lever", *scheil = "Scheil", *linear = "linear";

    /** The temperatures between which expressions of T hold. */
    struct Span
    {
      double lowest, highest;
    };

    Span span_of_expressions(const PrmFile &prm)
    {
      for(const char *key : {"lowest temperature", "highest temperature"})
        prm.require(material_keys, key,
                    "it says between which temperatures an expression of T holds");
      const Span span{prm.get_number(material_keys, "lowest temperature"),
                      prm.get_number(material_keys, "highest temperature")};
      if(!(span.lowest < span.highest))
        throw prm.error(material_keys, "highest temperature",
                        "must exceed 'lowest temperature'");
      return span;
    }

    PropertyCurve curve_through(const std::string &text)
    {
      std::vector<double> temperatures, values;
      for(const auto &[temperature, value] : parse_points(text, "temperature: value"))
      {
        temperatures.push_back(temperature);
        values.push_back(value);
      }
      return {temperatures, values, text};
    }

    std::string unit_of(const std::string &key)
    {
      return key == conductivity_key ? "W/(m K)" : "J/(kg K)";
    }

    /** What is said of a property of a phase: a number, an expression of T or a table. */
    struct Property
    {
      double number = 0;
      std::shared_ptr<const PropertyCurve> curve{};
    };

    double read_constant(const std::string &text, const std::string &unit)
    {
      try
      {
        if(const double number = parse_field(text, "")({}, 0); number >= above_zero)
          return number;
      }
      catch(const InputError &)
      {
        throw InputError(fmt::format("needs a number greater than 0 ({}), an expression "
                                     "of T or points 'T: value, ...', not '{}'",
                                     unit, quotable(text)));
      }
      throw InputError(
          fmt::format("needs a number greater than 0 ({}), not '{}'", unit, text));
    }

    Property read_property(const PrmFile &prm, const std::string &here,
                           const std::string &key, double melting)
    {
      const std::string text = prm.get_text(here, key);
      try
      {
        const bool table = is_table(text);
        if(!table && text.find('T') == std::string::npos)
          return {read_constant(text, unit_of(key))};
        Property property;
        if(table)
          property.curve = std::make_shared<const PropertyCurve>(curve_through(text));
        else
        {
          const auto function = parse_function(text, "T");
          const Span span = span_of_expressions(prm);
          property.curve = std::make_shared<const PropertyCurve>(
              PropertyCurve::tabulated(function, span.lowest, span.highest, text));
        }
        for(std::size_t i = 0; i < property.curve->values().size(); ++i)
          if(!(property.curve->values()[i] > 0))
            throw InputError(fmt::format("is {:.6g} at T = {:.6g}; it must be greater "
                                         "than 0",
                                         property.curve->values()[i],
                                         property.curve->temperatures()[i]));
        property.number = (*property.curve)(melting);
        return property;
      }
      catch(const InputError &error)
      {
        throw prm.error(here, key, error.what());
      }
    }

    /** Of a steady scene: it conducts, that is all. */
    Material read_conductor(const PrmFile &prm)
    {
      const std::string why = "the scene is steady";
      for(const char *key :
          {"latent heat", "melting temperature", "Gibbs-Thomson coefficient",
           "solidus temperature", "liquidus temperature", "solid fraction",
           "partition coefficient", "solvent melting temperature", "lowest temperature",
           "highest temperature"})
        prm.forbid(material_keys, key, why);
      for(const std::string &key : {heat_capacity_key, std::string("density")})
        prm.forbid(solid_phase_keys, key, why);
      if(prm.opened(liquid_keys))
        throw prm.subsection_error(liquid_keys,
                                   fmt::format("has no meaning here: {}", why));
      const Property conductivity
          = read_property(prm, solid_phase_keys, conductivity_key, 0);
      if(conductivity.curve)
        throw prm.error(solid_phase_keys, conductivity_key,
                        "must be a number in a steady scene");
      Material material;
      material.latent_heat = 0;
      material.solid.conductivity = material.liquid.conductivity = conductivity.number;
      return material;
    }

    /** f_s(T) of the lever rule or of Scheil's (1942), for straight liquidus and solidus
     * that meet at the solvent's melting temperature. */
    std::function<double(double)>
    rule_of_freezing(const PrmFile &prm, const std::string &word, double liquidus)
    {
      for(const char *key : {"partition coefficient", "solvent melting temperature"})
        prm.require(material_keys, key, fmt::format("'{}' needs it", word));
      const double partition = prm.get_number(material_keys, "partition coefficient");
      const double solvent = prm.get_number(material_keys, "solvent melting temperature");
      if(!(partition < 1))
        throw prm.error(material_keys, "partition coefficient", "must be less than 1");
      if(!(solvent > liquidus))
        throw prm.error(material_keys, "solvent melting temperature",
                        "must exceed the liquidus temperature");
      if(word == lever)
        return [=](double temperature) {
          return (liquidus - temperature) / ((1 - partition) * (solvent - temperature));
        };
      return [=](double temperature)
      {
        return 1
               - std::pow((solvent - temperature) / (solvent - liquidus),
                          1 / (partition - 1));
      };
    }

    /** Solid fraction between solidus and liquidus. */
    PropertyCurve read_solid_fraction(const PrmFile &prm, double solidus, double liquidus)
    {
      const std::string text = prm.get_text(material_keys, "solid fraction");
      if(text != lever && text != scheil)
        for(const char *key : {"partition coefficient", "solvent melting temperature"})
          prm.forbid(material_keys, key,
                     fmt::format("it is for '{}' and '{}'", lever, scheil));
      try
      {
        if(text == linear)
          return {{solidus, liquidus}, {1, 0}, text};
        PropertyCurve curve
            = is_table(text)
                  ? curve_through(text)
                  : PropertyCurve::tabulated(text == lever || text == scheil
                                                 ? rule_of_freezing(prm, text, liquidus)
                                                 : parse_function(text, "T"),
                                             solidus, liquidus, text);
        const double at_solidus = curve(solidus), at_liquidus = curve(liquidus);
        constexpr double round_off = 1e-9;
        if(!(at_solidus > 0 && at_solidus <= 1 + round_off))
          throw InputError(
              fmt::format("is {:.6g} at the solidus temperature; it must lie above 0 and "
                          "be at most 1 there (by the lever rule it is 1 where the "
                          "solidus is that of the partition coefficient)",
                          at_solidus));
        if(!(std::abs(at_liquidus) <= round_off))
          throw InputError(fmt::format("is {:.6g} at the liquidus temperature and must "
                                       "fall to 0 there",
                                       at_liquidus));
        return curve;
      }
      catch(const InputError &error)
      {
        throw prm.error(material_keys, "solid fraction", error.what());
      }
    }

    void read_melting_range(const PrmFile &prm, Material &material)
    {
      const std::string why = "the material melts at one temperature";
      if(!prm.given(material_keys, "solidus temperature"))
      {
        for(const char *key : {"liquidus temperature", "solid fraction",
                               "partition coefficient", "solvent melting temperature"})
          prm.forbid(material_keys, key, why);
        return;
      }
      prm.forbid(material_keys, "melting temperature",
                 "the material melts from the solidus to the liquidus temperature");
      prm.forbid(initial_keys, "front", "where it is solid follows from the temperature");
      MeltingRange range;
      range.solidus = prm.get_number(material_keys, "solidus temperature");
      range.liquidus = prm.get_number(material_keys, "liquidus temperature");
      if(!(material.latent_heat > 0))
        throw prm.error(material_keys, "solidus temperature",
                        "has no meaning without latent heat");
      if(material.gibbs_thomson_coefficient != 0)
        throw prm.error(material_keys, "Gibbs-Thomson coefficient",
                        "must be 0 where the material melts over a range");
      if(!(range.solidus < range.liquidus))
        throw prm.error(material_keys, "liquidus temperature",
                        "must exceed the solidus temperature");
      range.words = prm.get_text(material_keys, "solid fraction");
      range.solid_fraction = std::make_shared<const PropertyCurve>(
          read_solid_fraction(prm, range.solidus, range.liquidus));
      material.melting_temperature = range.solidus;
      material.melting_range = std::make_shared<const MeltingRange>(range);
    }

    void read_phases(const PrmFile &prm, Material &material)
    {
      const double melting = material.melting_temperature;
      const auto properties
          = [&](const std::string &key, double PhaseProperties::*number,
                std::shared_ptr<const PropertyCurve> PhaseProperties::*curve)
      {
        prm.require(solid_phase_keys, key,
                    fmt::format("it needs a number greater than 0 ({})", unit_of(key)));
        const Property solid = read_property(prm, solid_phase_keys, key, melting);
        const Property liquid = prm.given(liquid_keys, key)
                                    ? read_property(prm, liquid_keys, key, melting)
                                    : solid;
        material.solid.*number = solid.number;
        material.liquid.*number = liquid.number;
        material.solid.*curve = solid.curve;
        material.liquid.*curve = liquid.curve;
      };
      properties(conductivity_key, &PhaseProperties::conductivity,
                 &PhaseProperties::conductivity_curve);
      properties(heat_capacity_key, &PhaseProperties::specific_heat_capacity,
                 &PhaseProperties::heat_capacity_curve);
      material.solid.density = prm.get_number(solid_phase_keys, "density");
      material.liquid.density = prm.given(liquid_keys, "density")
                                    ? prm.get_number(liquid_keys, "density")
                                    : material.solid.density;
    }

    /** A curve of a phase must reach from the coldest to the warmest that the phase gets.
     */
    void require_reach(const PrmFile &prm, const std::string &here,
                       const std::string &key,
                       const std::shared_ptr<const PropertyCurve> &curve, double coldest,
                       double warmest, double slack)
    {
      if(!curve)
        return;
      const double first = curve->temperatures().front();
      const double last = curve->temperatures().back();
      for(const double temperature : {coldest, warmest})
        if(std::isfinite(temperature) && coldest <= warmest
           && !(temperature >= first - slack && temperature <= last + slack))
          throw prm.error(
              prm.given(here, key) ? here : solid_phase_keys, key,
              fmt::format("is known from {:.6g} to {:.6g}, and the scene needs "
                          "it at {:.6g}",
                          first, last, temperature));
    }
  } // namespace

  void declare_material(PrmFile &prm)
  {
    prm.declare(material_keys,
                number_key("latent heat", "", "J/kg", "Latent heat of melting.", 0));
    prm.declare(material_keys, number_key("melting temperature", "", temperature_units,
                                          "Temperature at which the phases meet."));
    prm.declare(material_keys,
                number_key("Gibbs-Thomson coefficient", "0", "K m",
                           "By how much times its curvature the solid's convex surface "
                           "melts below the melting temperature.",
                           0));
    prm.declare(material_keys,
                number_key("solidus temperature", "", temperature_units,
                           "Of a material that melts over a range, in place of 'melting "
                           "temperature': where it begins to melt."));
    prm.declare(material_keys, number_key("liquidus temperature", "", temperature_units,
                                          "Where such a material is all liquid."));
    prm.declare(
        material_keys,
        {.key = "solid fraction",
         .kind = PrmKind::text,
         .default_value = linear,
         .unit = {},
         .description
         = "Mass fraction of solid between solidus and liquidus: linear; lever or "
           "Scheil, which need 'partition coefficient' and 'solvent melting "
           "temperature'; an expression of T; or points, T: fraction, T: fraction. "
           "What is liquid still at the solidus freezes there."});
    prm.declare(
        material_keys,
        number_key("partition coefficient", "", "",
                   "Of the solute between solid and liquid, for lever and Scheil.", 0,
                   1));
    prm.declare(material_keys,
                number_key("solvent melting temperature", "", temperature_units,
                           "Where liquidus and solidus meet, for lever and Scheil."));
    for(const char *which : {"lowest", "highest"})
      prm.declare(
          material_keys,
          number_key(fmt::format("{} temperature", which), "", temperature_units,
                     fmt::format("The {} temperature at which properties that are "
                                 "expressions of T are known.",
                                 which)));
    for(const std::string phase : {"Solid", "Liquid"})
    {
      const std::string here = material_keys + "/" + phase;
      const std::string remark
          = phase == "Liquid" ? " The solid's value where it is not given." : "";
      const std::string forms
          = " A number, an expression of the temperature T, or points "
            "of a table, T: value, T: value.";
      prm.declare(here,
                  with_table(expression_key(conductivity_key, "W/(m K)",
                                            "Thermal conductivity." + forms + remark),
                             temperature_units));
      prm.declare(here,
                  with_table(expression_key(heat_capacity_key, "J/(kg K)",
                                            "Heat capacity per mass." + forms + remark),
                             temperature_units));
      prm.declare(here,
                  number_key("density", "", "kg/m^3", "Density." + remark, above_zero));
    }
  }

  Material read_material(const PrmFile &prm)
  {
    if(read_problem(prm) == ProblemKind::poisson)
      return read_conductor(prm);
    Material material;
    material.latent_heat = prm.get_number(material_keys, "latent heat");
    material.gibbs_thomson_coefficient
        = prm.get_number(material_keys, "Gibbs-Thomson coefficient");
    read_melting_range(prm, material);
    // Without latent heat and without a second phase nothing depends on it.
    if(!material.melting_range
       && (material.latent_heat > 0 || prm.opened(liquid_keys)
           || prm.given(material_keys, "melting temperature")))
      material.melting_temperature = prm.get_number(material_keys, "melting temperature");
    read_phases(prm, material);
    try
    {
      material.update_curves();
    }
    catch(const InputError &error)
    {
      throw prm.subsection_error(material_keys,
                                 fmt::format("cannot be: {}", error.what()));
    }
    return material;
  }

  void check_material(const PrmFile &prm, const Scene &scene)
  {
    const Material &material = scene.material;
    if(!material.curves)
      return;
    if(scene.alloy)
      throw prm.subsection_error(
          material_keys, "cannot hold properties that depend on temperature, or a "
                         "melting range, beside solutes");
    if(scene.inclusion && material.varies_with_temperature())
      throw prm.subsection_error("Scene/Inclusion",
                                 "has no meaning where properties depend on temperature");
    const TemperatureBounds bounds = temperature_bounds(scene);
    const double melting = material.melting_temperature;
    const bool melts = scene.changes_phase() || prm.opened(liquid_keys);
    const double molten
        = material.melting_range ? material.melting_range->liquidus : melting;
    // Bounds of what varies in time are a little wider than what was sampled.
    const double span = bounds.upper - bounds.lower;
    const double slack = std::isfinite(span) ? 2e-3 * span : 0;
    const auto reach = [&](const std::string &here, const PhaseProperties &phase,
                           double coldest, double warmest)
    {
      require_reach(prm, here, conductivity_key, phase.conductivity_curve, coldest,
                    warmest, slack);
      require_reach(prm, here, heat_capacity_key, phase.heat_capacity_curve, coldest,
                    warmest, slack);
    };
    reach(solid_phase_keys, material.solid, bounds.lower,
          melts ? std::min(molten, bounds.upper) : bounds.upper);
    if(melts)
      reach(liquid_keys, material.liquid, std::max(melting, bounds.lower), bounds.upper);
  }
} // namespace meltfront::cases
