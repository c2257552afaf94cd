#include <verification/report/chapters/alloy_equations.h>
#include <verification/report/chapters/equation_markup.h>
#include <verification/report/page/case_runs.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    Markup enthalpy(const cases::Material &m)
    {
      const Markup melting = math("($T − #)", {equation_number(m.melting_temperature)});
      return math("$H = $f $c_s($T − $T_m) + (1 − $f) [$c_l($T − $T_m) + $L]")
             + filled(math("$H = $f ## + (1 − $f) [## + #]",
                           {factor(m.solid.specific_heat_capacity), melting,
                            factor(m.liquid.specific_heat_capacity), melting,
                            equation_number(m.latent_heat)}));
    }

    Markup lever_rule(const cases::Scene &scene)
    {
      Markup liquidus
          = math("$T = #", {equation_number(scene.material.melting_temperature)});
      int number = 0;
      for(const cases::Solute &solute : scene.alloy->solutes)
      {
        if(solute.liquidus_curve)
        {
          liquidus = text(" the liquidus " + scene.alloy->solutes[0].liquidus);
          break;
        }
        liquidus += math(" − # $C_" + std::to_string(++number),
                         {equation_number(solute.liquidus_slope)});
      }
      return liquidus + math(" where 0 < $f < 1; all solute stays in the liquid");
    }

    double crystal_density(const cases::Scene &scene)
    {
      const double density = scene.alloy->crystal_density;
      return density > 0 ? density : scene.material.liquid.density;
    }

    Markup conductivity(const cases::Scene &scene)
    {
      const cases::Material &m = scene.material;
      return math("$k = $θ $k_s + (1 − $θ) $k_l")
             + filled(math("$k = #$θ + #(1 − $θ), $θ = #$f",
                           {factor(m.solid.conductivity), factor(m.liquid.conductivity),
                            factor(m.liquid.density / crystal_density(scene))}));
    }

    Markup solute(const cases::Solute &solute, std::size_t number)
    {
      const std::string in_liquid = "$C_" + std::to_string(number);
      const std::string rate = "\\d{(1 − $f) " + in_liquid + "}{$t}";
      if(!(solute.diffusivity > 0))
        return math(rate + " = 0");
      return math(rate + " = ∇·[(1 − $θ) # ∇" + in_liquid + "]",
                  {equation_number(solute.diffusivity)});
    }
  } // namespace

  Markup alloy_equations(const StoredCase &record)
  {
    const cases::Scene &scene = record.scene;
    Markup result = equation_line("heat", math("$ρ \\d{$H}{$t} = ∇·($k ∇$T)"))
                    + equation_line("enthalpy", enthalpy(scene.material))
                    + equation_line("liquidus", lever_rule(scene))
                    + equation_line("mush", conductivity(scene));
    std::size_t number = 0;
    for(const cases::Solute &one : scene.alloy->solutes)
      result += equation_line(one.name, solute(one, ++number));
    if(std::isfinite(scene.alloy->eutectic_temperature))
      result += equation_line("eutectic",
                              text("the rest freezes at ")
                                  + equation_number(scene.alloy->eutectic_temperature)
                                  + text(unit_of(record, " (K or °C)")));
    return result
           + element("p", {{"class", "nothing"}},
                     text("f: mass fraction of solid; θ: its volume fraction; C: mass "
                          "fraction of solute in the liquid."));
  }

  void add_alloy_properties(const StoredCase &record, RowGroup &group)
  {
    const auto add = [&group](const std::string &what, const std::string &unit,
                              const Cell &solid, const Cell &liquid) {
      group.rows.push_back({{what}, {unit}, solid, liquid, {std::string()}});
    };
    const Cell none{std::string()};
    add("density of the crystals", unit_of(record, "kg/m³"),
        {prose_number(crystal_density(record.scene), 4)}, none);
    const std::vector<cases::Solute> &solutes = record.scene.alloy->solutes;
    const std::vector<cases::Field> &concentration = record.scene.initial.concentration;
    for(std::size_t s = 0; s < solutes.size(); ++s)
    {
      const cases::Solute &solute = solutes[s];
      add("mass fraction of " + solute.name + " at the start", "", none,
          {s < concentration.size() ? concentration[s].expression : std::string()});
      add("its liquidus slope", unit_of(record, "K"), none,
          {solute.liquidus_curve ? Cell{solute.liquidus}
                                 : Cell{prose_number(solute.liquidus_slope, 4)}});
      add("its diffusivity", unit_of(record, "m²/s"), none,
          {prose_number(solute.diffusivity, 4)});
    }
  }
} // namespace meltfront::verification
