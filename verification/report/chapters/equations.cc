#include <verification/report/chapters/alloy_equations.h>
#include <verification/report/chapters/equation_markup.h>
#include <verification/report/chapters/equations.h>

#include <verification/report/chapters/scene_words.h>
#include <verification/report/page/case_runs.h>
#include <verification/report/tables/table.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    bool radial(const StoredCase &record)
    {
      return record.scene.symmetry == cases::Symmetry::cylindrical
             || record.scene.symmetry == cases::Symmetry::spherical;
    }

    /** The Laplacian of T in the coordinate that the solution depends on. */
    Markup laplacian(const StoredCase &record)
    {
      if(record.scene.symmetry == cases::Symmetry::planar)
        return math("\\f{∂^{2}$T}{∂$x^{2}}");
      if(record.scene.symmetry == cases::Symmetry::spherical)
        return math("\\f{1}{$r^{2}}\\f{∂}{∂$r} ($r^{2} \\d{$T}{$r})");
      return math(radial(record) ? "\\f{1}{$r}\\f{∂}{∂$r} ($r \\d{$T}{$r})" : "∇^{2}$T");
    }

    Markup heat_equation(const StoredCase &record, const cases::PhaseProperties &phase,
                         const char *pattern)
    {
      const Markup right = laplacian(record);
      return math(pattern, {right})
             + filled(math("#\\d{$T}{$t} = ##", {factor(phase.volumetric_heat_capacity()),
                                                 factor(phase.conductivity), right}));
    }

    /** A gradient at the front, taken on one of its sides. */
    Markup gradient_at_front(const StoredCase &record, const std::string &phase)
    {
      const bool planar = record.scene.symmetry == cases::Symmetry::planar;
      return math(radial(record) ? "\\d{$T}{$r}"
                  : planar       ? "\\d{$T}{$x}"
                                 : "\\d{$T}{$n}")
             + element("sub", {{"class", "side"}}, text(phase));
    }

    Markup stefan_condition(const StoredCase &record)
    {
      const cases::Material &material = record.scene.material;
      const Markup speed = math(
          record.scene.symmetry == cases::Symmetry::none ? "$V_n" : "\\f{d$s}{d$t}");
      const Markup solid = gradient_at_front(record, "solid");
      const Markup liquid = gradient_at_front(record, "liquid");
      return math("$ρ_s$L # = $k_s # − $k_l #", {speed, solid, liquid})
             + filled(math("## = ## − ##",
                           {factor(material.solid.density * material.latent_heat), speed,
                            factor(material.solid.conductivity), solid,
                            factor(material.liquid.conductivity), liquid}));
    }

    /** Conduction alone: one substance, perhaps with an inclusion. */
    Markup conduction_equation(const StoredCase &record)
    {
      const cases::Scene &scene = record.scene;
      const cases::PhaseProperties &solid = scene.material.solid;
      Markup numbers = math("$k = #", {equation_number(solid.conductivity)});
      if(scene.inclusion)
        numbers += text(", " + words(*scene.inclusion));
      if(!steady(record))
        numbers
            += math(", $ρ$c = #", {equation_number(solid.volumetric_heat_capacity())});
      if(scene.volumetric_source)
        numbers += math(", $q = #", {text(scene.volumetric_source->expression)});
      return equation_line("", math(steady(record) ? "0 = ∇·($k ∇$T)"
                                                   : "$ρ$c \\d{$T}{$t} = ∇·($k ∇$T)")
                                   + (scene.volumetric_source ? math(" + $q") : Markup()))
             + equation_line("", numbers);
    }

    /** A property as it is given: a number, or what depends on temperature. */
    std::string property_words(double number,
                               const std::shared_ptr<const cases::PropertyCurve> &curve)
    {
      return curve ? curve->words() : fmt::format("{:.4g}", number);
    }

    /** Of a material whose properties depend on temperature, or that melts over a range.
     */
    Markup equations_of_curves(const StoredCase &record)
    {
      const cases::Material &material = record.scene.material;
      const auto properties = [](const cases::PhaseProperties &phase)
      {
        return text(fmt::format(
            "k(T) = {}, c(T) = {}, ρ = {}",
            property_words(phase.conductivity, phase.conductivity_curve),
            property_words(phase.specific_heat_capacity, phase.heat_capacity_curve),
            fmt::format("{:.4g}", phase.density)));
      };
      Markup result = equation_line("heat", math("$ρ($c − L \\d{$f_s}{$T}) \\d{$T}{$t} = "
                                                 "∇·($k ∇$T)"))
                      + equation_line("solid", properties(material.solid))
                      + equation_line("liquid", properties(material.liquid));
      if(material.melting_range)
        return result
               + equation_line(
                   "melting",
                   text(fmt::format(
                       "f_s(T): {}, from {:.6g} (solidus) to {:.6g} (liquidus); "
                       "k and c are mixed by it",
                       material.melting_range->words, material.melting_range->solidus,
                       material.melting_range->liquidus)));
      return result
             + equation_line(
                 "front", text(fmt::format("all latent heat is exchanged at T = {:.6g}",
                                           material.melting_temperature)));
    }

    Markup conditions(const StoredCase &record)
    {
      Markup rows;
      const auto add
          = [&rows](const std::string &what, const std::vector<std::string> &values)
      {
        Markup items;
        for(const std::string &value : values)
          items += element("div", value);
        if(!values.empty())
          rows += element("dt", what) + element("dd", items) + Markup("\n");
      };
      const std::string seconds = unit_of(record, " s");
      if(!steady(record))
      {
        add("start", {"t = " + plain_number(record.scene.start_time, 6) + seconds + ": "
                      + words(record.scene.initial)});
        add("end", {"t = " + plain_number(record.scene.end_time, 6) + seconds});
      }
      add("walls", wall_words(record.scene));
      add("sources", source_words(record.scene));
      return element("dl", {{"class", "conditions"}}, rows);
    }
  } // namespace

  Markup equations(const StoredCase &record)
  {
    if(record.scene.alloy)
      return element("div", {{"class", "equations"}}, alloy_equations(record))
             + conditions(record);
    if(record.scene.material.curves)
      return element("div", {{"class", "equations"}}, equations_of_curves(record))
             + conditions(record);
    if(!record.scene.changes_phase())
      return element("div", {{"class", "equations"}}, conduction_equation(record))
             + conditions(record);
    const cases::Material &material = record.scene.material;
    const std::string degrees = unit_of(record, " (K or °C)");
    Markup curved, melting = equation_number(material.melting_temperature);
    if(material.gibbs_thomson_coefficient != 0)
    {
      curved = math(" − $Γ$κ");
      melting += math(" − # $κ", {equation_number(material.gibbs_thomson_coefficient)});
    }
    Markup result
        = equation_line("solid", heat_equation(record, material.solid,
                                               "$ρ_s$c_s \\d{$T}{$t} = $k_s #"))
          + equation_line("liquid", heat_equation(record, material.liquid,
                                                  "$ρ_l$c_l \\d{$T}{$t} = $k_l #"));
    result
        += equation_line("front", stefan_condition(record))
           + equation_line(
               "", math("$T = $T_m# = # at the front", {curved, melting + text(degrees)})
                       + text(record.scene.symmetry == cases::Symmetry::none
                                  ? ", n its normal into the liquid"
                                  : ""));
    if(material.solid.density != material.liquid.density
       && record.scene.symmetry == cases::Symmetry::planar)
      result += equation_line(
          "motion",
          math(
              "the liquid moves with $u = (1 − $ρ_s/$ρ_l) d$s/d$t = # d$s/d$t where that "
              "effect is on",
              {equation_number(1 - material.solid.density / material.liquid.density)}));
    return element("div", {{"class", "equations"}}, result) + conditions(record);
  }

  Markup material_table(const StoredCase &record)
  {
    const cases::PhaseProperties &solid = record.scene.material.solid;
    const cases::PhaseProperties &liquid = record.scene.material.liquid;
    Table table;
    table.columns = {{"property", "", false},
                     {"unit", "", false},
                     {"solid", "", true},
                     {"liquid", "", true},
                     {"solid : liquid", "", true}};
    RowGroup &group = table.groups.emplace_back();
    const auto add = [&](const std::string &name, const std::string &unit,
                         double of_solid, double of_liquid)
    {
      group.rows.push_back({{name},
                            {unit_of(record, unit)},
                            {prose_number(of_solid, 4)},
                            {prose_number(of_liquid, 4)},
                            {prose_number(of_solid / of_liquid)}});
    };
    const std::string at_melting = record.scene.material.varies_with_temperature()
                                       ? " at the melting temperature"
                                       : "";
    add("conductivity k" + at_melting, "W/(m K)", solid.conductivity,
        liquid.conductivity);
    add("heat capacity c" + at_melting, "J/(kg K)", solid.specific_heat_capacity,
        liquid.specific_heat_capacity);
    add("density ρ", "kg/m³", solid.density, liquid.density);
    add("diffusivity k/(ρc)", "m²/s", solid.diffusivity(), liquid.diffusivity());
    group.rows.push_back({{std::string("latent heat L")},
                          {unit_of(record, "J/kg")},
                          {prose_number(record.scene.material.latent_heat, 6)},
                          {std::string()},
                          {std::string()}});
    if(record.scene.alloy)
      add_alloy_properties(record, group);
    return table_markup(table);
  }
} // namespace meltfront::verification
