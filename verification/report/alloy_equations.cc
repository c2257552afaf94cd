#include <verification/report/alloy_equations.h>
#include <verification/report/case_runs.h>
#include <verification/report/equation_markup.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    Markup excess()
    {
      return text("(") + symbol("T") + text(" − ") + symbol("T", "m") + text(")");
    }

    Markup heat()
    {
      return symbol("ρ") + text(" ") + derivative(symbol("H"), symbol("t"))
             + text(" = ∇·(") + symbol("k") + text(" ∇") + symbol("T") + text(")");
    }

    Markup enthalpy(const CaseRecord &record)
    {
      const cases::Material &m = record.material;
      const Markup melting = text("(") + symbol("T") + text(" − ")
                             + equation_number(m.melting_temperature) + text(")");
      return symbol("H") + text(" = ") + symbol("f") + text(" ") + symbol("c", "s")
             + excess() + text(" + (1 − ") + symbol("f") + text(") [") + symbol("c", "l")
             + excess() + text(" + ") + symbol("L") + text("]")
             + filled(symbol("H") + text(" = ") + symbol("f") + text(" ")
                      + factor(m.solid.specific_heat_capacity) + melting
                      + text(" + (1 − ") + symbol("f") + text(") [")
                      + factor(m.liquid.specific_heat_capacity) + melting + text(" + ")
                      + equation_number(m.latent_heat) + text("]"));
    }

    Markup lever_rule(const CaseRecord &record)
    {
      Markup sum;
      bool curved = false;
      for(std::size_t s = 0; s < record.alloy->solutes.size(); ++s)
      {
        const SoluteRecord &solute = record.alloy->solutes[s];
        curved = curved || std::isnan(solute.liquidus_slope);
        sum += text(" − ") + equation_number(solute.liquidus_slope) + text(" ")
               + symbol("C", std::to_string(s + 1));
      }
      const Markup liquidus
          = curved ? text(" the liquidus " + record.alloy->solutes[0].liquidus)
                   : symbol("T") + text(" = ")
                         + equation_number(record.material.melting_temperature) + sum;
      return liquidus + text(" where 0 < ") + symbol("f")
             + text(" < 1; all solute stays in the liquid");
    }

    Markup conductivity(const CaseRecord &record)
    {
      const cases::Material &m = record.material;
      const double expansion = m.liquid.density / record.alloy->crystal_density;
      const Markup theta = symbol("θ");
      return symbol("k") + text(" = ") + theta + text(" ") + symbol("k", "s")
             + text(" + (1 − ") + theta + text(") ") + symbol("k", "l")
             + filled(symbol("k") + text(" = ") + factor(m.solid.conductivity) + theta
                      + text(" + ") + factor(m.liquid.conductivity) + text("(1 − ")
                      + theta + text("), ") + theta + text(" = ") + factor(expansion)
                      + symbol("f"));
    }

    Markup solute(const SoluteRecord &solute, std::size_t number)
    {
      const std::string index = std::to_string(number);
      const Markup in_liquid = symbol("C", index);
      if(!(solute.diffusivity > 0))
        return derivative(text("(1 − ") + symbol("f") + text(") ") + in_liquid,
                          symbol("t"))
               + text(" = 0");
      return derivative(text("(1 − ") + symbol("f") + text(") ") + in_liquid, symbol("t"))
             + text(" = ∇·[(1 − ") + symbol("θ") + text(") ")
             + equation_number(solute.diffusivity) + text(" ∇") + in_liquid + text("]");
    }
  } // namespace

  Markup alloy_equations(const CaseRecord &record)
  {
    Markup result = equation_line("heat", heat())
                    + equation_line("enthalpy", enthalpy(record))
                    + equation_line("liquidus", lever_rule(record))
                    + equation_line("mush", conductivity(record));
    for(std::size_t s = 0; s < record.alloy->solutes.size(); ++s)
      result += equation_line(record.alloy->solutes[s].name,
                              solute(record.alloy->solutes[s], s + 1));
    if(std::isfinite(record.alloy->eutectic_temperature))
      result += equation_line("eutectic",
                              text("the rest freezes at ")
                                  + equation_number(record.alloy->eutectic_temperature)
                                  + text(unit_of(record, " (K or °C)")));
    return result
           + element("p", {{"class", "nothing"}},
                     text("f: mass fraction of solid; θ: its volume fraction; C: mass "
                          "fraction of solute in the liquid."));
  }

  void add_alloy_properties(const CaseRecord &record, RowGroup &group)
  {
    const auto add = [&group](const std::string &what, const std::string &unit,
                              const Cell &solid, const Cell &liquid) {
      group.rows.push_back({{what}, {unit}, solid, liquid, {std::string()}});
    };
    const Cell none{std::string()};
    add("density of the crystals", unit_of(record, "kg/m³"),
        {prose_number(record.alloy->crystal_density, 4)}, none);
    for(const SoluteRecord &solute : record.alloy->solutes)
    {
      add("mass fraction of " + solute.name + " at the start", "", none,
          {solute.concentration});
      add("its liquidus slope", unit_of(record, "K"), none,
          {std::isnan(solute.liquidus_slope)
               ? Cell{solute.liquidus}
               : Cell{prose_number(solute.liquidus_slope, 4)}});
      add("its diffusivity", unit_of(record, "m²/s"), none,
          {prose_number(solute.diffusivity, 4)});
    }
  }
} // namespace meltfront::verification
