#include <verification/report/alloy_equations.h>
#include <verification/report/equation_markup.h>
#include <verification/report/equations.h>

#include <verification/report/case_runs.h>
#include <verification/report/table.h>

namespace meltfront::verification
{
  namespace
  {
    bool radial(const CaseRecord &record)
    {
      return record.symmetry == "cylindrical" || record.symmetry == "spherical";
    }

    Markup coordinate_symbol(const CaseRecord &record)
    {
      return symbol(radial(record) ? "r" : (record.symmetry == "planar" ? "x" : "n"));
    }

    /** The Laplacian of T in the coordinate that the solution depends on. */
    Markup laplacian(const CaseRecord &record)
    {
      const Markup temperature = symbol("T"), r = symbol("r");
      if(record.symmetry == "planar")
        return fraction(text("∂") + element("sup", "2") + temperature,
                        text("∂") + symbol("x") + element("sup", "2"));
      if(!radial(record))
        return text("∇") + element("sup", "2") + temperature;
      const Markup power = record.symmetry == "spherical" ? r + element("sup", "2") : r;
      return fraction(text("1"), power) + fraction(text("∂"), text("∂") + r) + text(" (")
             + power + text(" ") + derivative(temperature, r) + text(")");
    }

    Markup heat_equation(const CaseRecord &record, const cases::PhaseProperties &phase,
                         const std::string &index)
    {
      const Markup rate = derivative(symbol("T"), symbol("t"));
      return symbol("ρ", index) + symbol("c", index) + text(" ") + rate + text(" = ")
             + symbol("k", index) + text(" ") + laplacian(record)
             + element("span", {{"class", "filled"}},
                       factor(phase.volumetric_heat_capacity()) + rate + text(" = ")
                           + factor(phase.conductivity) + laplacian(record));
    }

    /** A gradient at the front, taken on one of its sides. */
    Markup gradient_at_front(const CaseRecord &record, const std::string &phase)
    {
      return derivative(symbol("T"), coordinate_symbol(record))
             + element("sub", {{"class", "side"}}, text(phase));
    }

    Markup stefan_condition(const CaseRecord &record)
    {
      const cases::Material &material = record.material;
      const Markup speed = record.symmetry == "none" ? symbol("V", "n")
                                                     : fraction(text("d") + symbol("s"),
                                                                text("d") + symbol("t"));
      const Markup solid = gradient_at_front(record, "solid");
      const Markup liquid = gradient_at_front(record, "liquid");
      return symbol("ρ", "s") + symbol("L") + text(" ") + speed + text(" = ")
             + symbol("k", "s") + text(" ") + solid + text(" − ") + symbol("k", "l")
             + text(" ") + liquid
             + element("span", {{"class", "filled"}},
                       factor(material.solid.density * material.latent_heat) + speed
                           + text(" = ") + factor(material.solid.conductivity) + solid
                           + text(" − ") + factor(material.liquid.conductivity) + liquid);
    }

    /** Conduction alone: one substance, perhaps with an inclusion. */
    Markup conduction_equation(const CaseRecord &record)
    {
      const Markup flux
          = text("∇·(") + symbol("k") + text(" ∇") + symbol("T") + text(")");
      const cases::PhaseProperties &solid = record.material.solid;
      const Markup release
          = record.heat_release.empty() ? Markup() : text(" + ") + symbol("q");
      const Markup rate = record.steady ? text("0")
                                        : symbol("ρ") + symbol("c") + text(" ")
                                              + derivative(symbol("T"), symbol("t"));
      Markup numbers = symbol("k") + text(" = ") + equation_number(solid.conductivity);
      if(!record.inclusion.empty())
        numbers += text(", " + record.inclusion);
      if(!record.steady)
        numbers += text(", ") + symbol("ρ") + symbol("c") + text(" = ")
                   + equation_number(solid.volumetric_heat_capacity());
      if(!record.heat_release.empty())
        numbers += text(", ") + symbol("q") + text(" = " + record.heat_release);
      return equation_line("", rate + text(" = ") + flux + release)
             + equation_line("", numbers);
    }

    Markup conditions(const CaseRecord &record)
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
      if(!record.steady)
      {
        add("start",
            {"t = " + plain_number(record.start_time, 6) + seconds
             + (record.initial_state.empty() ? "" : ": " + record.initial_state)});
        add("end", {"t = " + plain_number(record.end_time, 6) + seconds});
      }
      add("walls", record.boundaries);
      add("sources", record.sources);
      return element("dl", {{"class", "conditions"}}, rows);
    }
  } // namespace

  Markup equations(const CaseRecord &record)
  {
    if(record.alloy)
      return element("div", {{"class", "equations"}}, alloy_equations(record))
             + conditions(record);
    if(!record.changes_phase)
      return element("div", {{"class", "equations"}}, conduction_equation(record))
             + conditions(record);
    const cases::Material &material = record.material;
    const std::string degrees = unit_of(record, " (K or °C)");
    Markup melting = equation_number(material.melting_temperature);
    Markup curved = symbol("T", "m");
    if(material.gibbs_thomson_coefficient != 0)
    {
      curved += text(" − ") + symbol("Γ") + symbol("κ");
      melting += text(" − ") + equation_number(material.gibbs_thomson_coefficient)
                 + text(" ") + symbol("κ");
    }
    Markup result
        = equation_line("solid", heat_equation(record, material.solid, "s"))
          + equation_line("liquid", heat_equation(record, material.liquid, "l"));
    result
        += equation_line("front", stefan_condition(record))
           + equation_line("", symbol("T") + text(" = ") + curved + text(" = ") + melting
                                   + text(degrees + " at the front"
                                          + (record.symmetry == "none"
                                                 ? ", n its normal into the liquid"
                                                 : "")));
    if(material.solid.density != material.liquid.density && record.symmetry == "planar")
      result += equation_line(
          "motion",
          text("the liquid moves with ") + symbol("u") + text(" = (1 − ")
              + symbol("ρ", "s") + text("/") + symbol("ρ", "l") + text(") d")
              + symbol("s") + text("/d") + symbol("t") + text(" = ")
              + equation_number(1 - material.solid.density / material.liquid.density)
              + text(" d") + symbol("s") + text("/d") + symbol("t")
              + text(" where that effect is on"));
    return element("div", {{"class", "equations"}}, result) + conditions(record);
  }

  Markup material_table(const CaseRecord &record)
  {
    const cases::PhaseProperties &solid = record.material.solid;
    const cases::PhaseProperties &liquid = record.material.liquid;
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
    add("conductivity k", "W/(m K)", solid.conductivity, liquid.conductivity);
    add("heat capacity c", "J/(kg K)", solid.specific_heat_capacity,
        liquid.specific_heat_capacity);
    add("density ρ", "kg/m³", solid.density, liquid.density);
    add("diffusivity k/(ρc)", "m²/s", solid.diffusivity(), liquid.diffusivity());
    group.rows.push_back({{std::string("latent heat L")},
                          {unit_of(record, "J/kg")},
                          {prose_number(record.material.latent_heat, 6)},
                          {std::string()},
                          {std::string()}});
    if(record.alloy)
      add_alloy_properties(record, group);
    return table_markup(table);
  }
} // namespace meltfront::verification
