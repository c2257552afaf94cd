#include <verification/report/chapters/alloy_equations.h>
#include <verification/report/chapters/equation_markup.h>
#include <verification/report/chapters/equations.h>

#include <verification/report/chapters/scene_words.h>
#include <verification/report/page/case_runs.h>
#include <verification/report/tables/table.h>

namespace meltfront::verification
{
  namespace
  {
    bool radial(const StoredCase &record)
    {
      return record.scene.symmetry == cases::Symmetry::cylindrical
             || record.scene.symmetry == cases::Symmetry::spherical;
    }

    Markup coordinate_symbol(const StoredCase &record)
    {
      return symbol(radial(record)
                        ? "r"
                        : (record.scene.symmetry == cases::Symmetry::planar ? "x" : "n"));
    }

    /** The Laplacian of T in the coordinate that the solution depends on. */
    Markup laplacian(const StoredCase &record)
    {
      const Markup temperature = symbol("T"), r = symbol("r");
      if(record.scene.symmetry == cases::Symmetry::planar)
        return fraction(text("∂") + element("sup", "2") + temperature,
                        text("∂") + symbol("x") + element("sup", "2"));
      if(!radial(record))
        return text("∇") + element("sup", "2") + temperature;
      const Markup power = record.scene.symmetry == cases::Symmetry::spherical
                               ? r + element("sup", "2")
                               : r;
      return fraction(text("1"), power) + fraction(text("∂"), text("∂") + r) + text(" (")
             + power + text(" ") + derivative(temperature, r) + text(")");
    }

    Markup heat_equation(const StoredCase &record, const cases::PhaseProperties &phase,
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
    Markup gradient_at_front(const StoredCase &record, const std::string &phase)
    {
      return derivative(symbol("T"), coordinate_symbol(record))
             + element("sub", {{"class", "side"}}, text(phase));
    }

    Markup stefan_condition(const StoredCase &record)
    {
      const cases::Material &material = record.scene.material;
      const Markup speed
          = record.scene.symmetry == cases::Symmetry::none
                ? symbol("V", "n")
                : fraction(text("d") + symbol("s"), text("d") + symbol("t"));
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
    Markup conduction_equation(const StoredCase &record)
    {
      const Markup flux
          = text("∇·(") + symbol("k") + text(" ∇") + symbol("T") + text(")");
      const cases::PhaseProperties &solid = record.scene.material.solid;
      const Markup release
          = record.scene.heat_release ? text(" + ") + symbol("q") : Markup();
      const Markup rate = steady(record) ? text("0")
                                         : symbol("ρ") + symbol("c") + text(" ")
                                               + derivative(symbol("T"), symbol("t"));
      Markup numbers = symbol("k") + text(" = ") + equation_number(solid.conductivity);
      if(record.scene.inclusion)
        numbers += text(", " + words(*record.scene.inclusion));
      if(!steady(record))
        numbers += text(", ") + symbol("ρ") + symbol("c") + text(" = ")
                   + equation_number(solid.volumetric_heat_capacity());
      if(const auto &release = record.scene.heat_release)
        numbers += text(", ") + symbol("q") + text(" = " + release->expression);
      return equation_line("", rate + text(" = ") + flux + release)
             + equation_line("", numbers);
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
    if(!record.scene.changes_phase())
      return element("div", {{"class", "equations"}}, conduction_equation(record))
             + conditions(record);
    const cases::Material &material = record.scene.material;
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
    result += equation_line("front", stefan_condition(record))
              + equation_line("",
                              symbol("T") + text(" = ") + curved + text(" = ") + melting
                                  + text(degrees + " at the front"
                                         + (record.scene.symmetry == cases::Symmetry::none
                                                ? ", n its normal into the liquid"
                                                : "")));
    if(material.solid.density != material.liquid.density
       && record.scene.symmetry == cases::Symmetry::planar)
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
    add("conductivity k", "W/(m K)", solid.conductivity, liquid.conductivity);
    add("heat capacity c", "J/(kg K)", solid.specific_heat_capacity,
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
