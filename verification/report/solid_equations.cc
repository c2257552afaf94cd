#include <verification/report/equation_markup.h>
#include <verification/report/number_text.h>
#include <verification/report/solid_equations.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    Markup power(const Markup &base, const std::string &exponent)
    {
      return base + element("sup", exponent);
    }

    Markup half_step(const std::string &letter, const std::string &index)
    {
      return symbol(letter, index);
    }

    Markup leapfrog(const cases::ParticleSolid &solid)
    {
      return half_step("v", "½") + text(" = ") + symbol("v", "0") + text(" + ½ Δ")
             + symbol("t") + text(" ") + symbol("a", "0") + text(",  ")
             + symbol("v", "k+½") + text(" = ") + symbol("v", "k−½") + text(" + Δ")
             + symbol("t") + text(" ") + symbol("a", "k") + text(",  ")
             + symbol("r", "k+1") + text(" = ") + symbol("r", "k") + text(" + Δ")
             + symbol("t") + text(" ") + symbol("v", "k+½")
             + filled(text("Δ") + symbol("t") + text(" = ")
                      + equation_number(solid.time_step));
    }

    Markup forces(const cases::ParticleSolid &solid)
    {
      const cases::PairLaw &law = solid.law;
      const auto sum = [&](const Markup &attraction, const Markup &repulsion,
                           const std::string &beta, const std::string &alpha)
      {
        return text("Σ") + element("sub", std::string("j≠i")) + text(" [ −")
               + fraction(attraction, power(symbol("r"), beta)) + text(" + ")
               + fraction(repulsion, power(symbol("r"), alpha)) + text(" ] ")
               + fraction(symbol("r", "i") + text(" − ") + symbol("r", "j"), symbol("r"));
      };
      Markup numbers
          = sum(equation_number(law.attraction), equation_number(law.repulsion),
                plain_number(law.attraction_exponent, 4),
                plain_number(law.repulsion_exponent, 4));
      if(solid.gravity != 0)
        numbers += text(" − ") + equation_number(solid.gravity) + text(" ")
                   + symbol("e", "y");
      numbers += text(",  no force where ") + symbol("r") + text(" > ")
                 + equation_number(law.cutoff);
      return symbol("a", "i") + text(" = ") + sum(symbol("G"), symbol("H"), "β", "α")
             + (solid.gravity != 0
                    ? text(" − ") + symbol("g") + text(" ") + symbol("e", "y")
                    : Markup())
             + filled(symbol("a", "i") + text(" = ") + numbers);
    }

    Markup base(const cases::SolidBase &base)
    {
      Markup gamma = text("γ = ") + equation_number(base.restitution);
      if(base.hot)
      {
        gamma = text("γ = ") + equation_number(base.hot->left);
        if(base.hot->slope != 0)
          gamma += text(" − ") + equation_number(base.hot->slope) + text(" (")
                   + symbol("x") + text(" + ") + equation_number(base.hot->half_width)
                   + text(")");
        gamma += text(" where |") + symbol("x") + text("| < ")
                 + equation_number(base.hot->half_width) + text(", ")
                 + equation_number(base.restitution) + text(" elsewhere");
      }
      return text("where ") + symbol("y") + text(" < 0:  ") + symbol("y") + text(" → −")
             + symbol("y") + text(",  ") + symbol("v", "x") + text(" → 0,  ")
             + symbol("v", "y") + text(" → −γ ") + symbol("v", "y") + filled(gamma);
    }

    /** Gamma over R to the power, or times it where the power is negative. */
    Markup intensity(double exponent)
    {
      const Markup distance
          = std::abs(exponent) == 1
                ? symbol("R")
                : power(symbol("R"), plain_number(std::abs(exponent), 3));
      if(exponent == 0)
        return text("Γ");
      return exponent > 0 ? fraction(text("Γ"), distance) : text("Γ ") + distance;
    }

    Markup heating(const cases::PointHeating &heating)
    {
      return text("where ") + symbol("R") + text(" = |") + symbol("r") + text(" − ")
             + symbol("s") + text("| < ") + equation_number(heating.reach) + text(":  ")
             + symbol("v") + text(" → ") + symbol("v") + text(" + ")
             + intensity(heating.power) + text(" ")
             + fraction(symbol("r") + text(" − ") + symbol("s"), symbol("R"))
             + filled(text("in every step"));
    }

    Markup source_words(const cases::PointHeating &heating)
    {
      Markup words = symbol("s") + text(" = (") + number_markup(heating.position[0], 4)
                     + text(", ") + number_markup(heating.position[1], 4)
                     + text("), Γ = ");
      for(std::size_t i = 0; i < heating.stages.size(); ++i)
        words += text(i == 0 ? "" : ", then ")
                 + number_markup(heating.stages[i].strength, 4)
                 + text(fmt::format(" for {} steps", grouped(heating.stages[i].steps)));
      return words;
    }

    std::string words_of_arrangement(const cases::ParticleSolid &solid)
    {
      switch(solid.arrangement)
      {
      case cases::SolidArrangement::table:
        return fmt::format("table {} of the report, {}", solid.table,
                           solid.errata ? "its misprints put right" : "as printed");
      case cases::SolidArrangement::triangle:
        return "a triangle of rows that become shorter upwards, at rest";
      case cases::SolidArrangement::rectangle:
        return fmt::format("{} rows of a rectangle, at rest", solid.rows);
      default:
        return "a bar of a crystal between two walls";
      }
    }

    Markup condition(const std::string &what, const Markup &words)
    {
      return element("dt", what) + element("dd", words) + Markup("\n");
    }

    Markup solid_conditions(const CaseRecord &record)
    {
      const cases::ParticleSolid &solid = *record.moving->solid;
      Markup start = text(words_of_arrangement(solid));
      if(solid.disturbance > 0)
        start += text("; each coordinate disturbed by ")
                 + number_markup(solid.disturbance)
                 + text(" (standard deviation), otherwise for every seed");
      const Markup source
          = solid.heating ? condition("source", source_words(*solid.heating)) : Markup();
      const double steps = (record.end_time - record.start_time) / solid.time_step;
      return element(
          "dl", {{"class", "conditions"}},
          condition("moved", text("particles of mass 1 that bind each other; "
                                  "Boltzmann's constant is 1"))
              + condition("start", start) + source
              + condition("end", text("t = " + plain_number(record.end_time, 6)
                                      + fmt::format(", after {} steps",
                                                    grouped(std::lround(steps)))))
              + condition(
                  "solid",
                  text("a particle that makes a triangle with two others, all sides "
                       "shorter than "
                       + plain_number(solid.law.cutoff, 4)
                       + (solid.test == cases::SolidTest::temperature
                              ? ", whose temperatures (mean kinetic energy since the "
                                "start) are all below 25"
                              : ", none of which moved faster than 7.5 on average over "
                                "the last 1000 steps")
                       + "; any other is fluid")));
    }
  } // namespace

  Markup solid_equations(const CaseRecord &record)
  {
    const cases::ParticleSolid &solid = *record.moving->solid;
    Markup lines = equation_line("(2.1–3)", leapfrog(solid))
                   + equation_line("(2.4–8)", forces(solid));
    if(solid.base)
      lines += equation_line(solid.base->hot ? "(5.1)" : "(3.1)", base(*solid.base));
    if(solid.heating)
      lines += equation_line("(4.1)", heating(*solid.heating));
    Markup note;
    if(solid.heating && solid.heating->power != 2)
      note = element("p", {{"class", "nothing"}},
                     text("The report prints (4.1) with Γ/R² in place of ")
                         + intensity(solid.heating->power) + text("."));
    return element("div", {{"class", "equations"}}, lines) + note
           + solid_conditions(record);
  }

  Markup carried_equations(const CaseRecord &record)
  {
    const Markup phi = symbol("φ");
    const Markup equation = derivative(phi, symbol("t")) + text(" + ") + symbol("u")
                            + text(" · ∇") + phi + text(" = 0");
    return element(
               "div", {{"class", "equations"}},
               equation_line("front", equation)
                   + equation_line("", text("the region is where ") + phi + text(" > 0")))
           + element(
               "dl", {{"class", "conditions"}},
               condition("region", text(record.moving->region))
                   + condition("velocity", text(record.moving->velocity))
                   + condition("start", text("t = " + plain_number(record.start_time, 6)))
                   + condition("end", text("t = " + plain_number(record.end_time, 6))));
  }
} // namespace meltfront::verification
