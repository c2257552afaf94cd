#include <cases/shape.h>
#include <cases/velocity_field.h>
#include <verification/report/chapters/equation_markup.h>
#include <verification/report/chapters/solid_equations.h>
#include <verification/report/page/number_text.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    Markup leapfrog(const cases::ParticleSolid &solid)
    {
      return math("$v_½ = $v_0 + ½ Δ$t $a_0,  $v_{k+½} = $v_{k−½} + Δ$t $a_k,  "
                  "$r_{k+1} = $r_k + Δ$t $v_{k+½}")
             + filled(math("Δ$t = #", {equation_number(solid.time_step)}));
    }

    Markup forces(const cases::ParticleSolid &solid)
    {
      const cases::PairLaw &law = solid.law;
      const auto power
          = [](double exponent) { return element("sup", plain_number(exponent, 4)); };
      const std::string direction = "\\f{$r_i − $r_j}{$r}";
      const Markup over_others = element("sub", std::string("j≠i")) + text(" ");
      const bool falls = solid.gravity != 0;
      return math("$a_i = Σ#[ −\\f{$G}{$r^{β}} + \\f{$H}{$r^{α}} ] " + direction
                      + (falls ? " − $g $e_y" : ""),
                  {over_others})
             + filled(
                 math("$a_i = Σ#[ −\\f{#}{$r#} + \\f{#}{$r#} ] " + direction,
                      {over_others, equation_number(law.attraction),
                       power(law.attraction_exponent), equation_number(law.repulsion),
                       power(law.repulsion_exponent)})
                 + (falls ? math(" − # $e_y", {equation_number(solid.gravity)})
                          : Markup())
                 + math(",  no force where $r > #", {equation_number(law.cutoff)}));
    }

    Markup base(const cases::SolidBase &base)
    {
      Markup gamma = math("γ = #", {equation_number(base.restitution)});
      if(base.hot)
      {
        const Markup half_width = equation_number(base.hot->half_width);
        gamma = math("γ = #", {equation_number(base.hot->left)});
        if(base.hot->slope != 0)
          gamma += math(" − # ($x + #)", {equation_number(base.hot->slope), half_width});
        gamma += math(" where |$x| < #, # elsewhere",
                      {half_width, equation_number(base.restitution)});
      }
      return math("where $y < 0:  $y → −$y,  $v_x → 0,  $v_y → −γ $v_y") + filled(gamma);
    }

    /** Gamma over R to the power, or times it where the power is negative. */
    Markup intensity(double exponent)
    {
      if(exponent == 0)
        return text("Γ");
      const double size = std::abs(exponent);
      const Markup power = size == 1 ? Markup() : element("sup", plain_number(size, 3));
      return math(exponent > 0 ? "\\f{Γ}{$R#}" : "Γ $R#", {power});
    }

    Markup heating(const cases::PointHeating &heating)
    {
      return math("where $R = |$r − $s| < #:  $v → $v + # \\f{$r − $s}{$R}",
                  {equation_number(heating.reach), intensity(heating.power)})
             + filled(text("in every step"));
    }

    Markup source_words(const cases::PointHeating &heating)
    {
      Markup words = math("$s = (#, #), Γ = ", {number_markup(heating.position[0], 4),
                                                number_markup(heating.position[1], 4)});
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
        return solid.settled ? "a triangle of rows that become shorter upwards, at rest"
                             : "a triangle of rows that become shorter upwards, as a "
                               "lattice";
      case cases::SolidArrangement::rectangle:
        return fmt::format("{} rows of a rectangle, {}", solid.rows,
                           solid.settled ? "at rest" : "as a lattice");
      case cases::SolidArrangement::disk:
        return "a crystal of the plane within a disk of n spacings";
      case cases::SolidArrangement::outline:
        return "a crystal of the plane within an outline";
      case cases::SolidArrangement::block:
        return "a cubic close packing, n cells along each side";
      case cases::SolidArrangement::ball:
        return "a cubic close packing within a ball of n spacings";
      default:
        return "a bar of a crystal between two walls";
      }
    }

    /** What is moved beside what the report of 1976 says. */
    Markup thermal_conditions(const cases::ParticleSolid &solid)
    {
      Markup lines;
      if(solid.initial_temperature > 0)
        lines += condition("velocities", text("of the temperature ")
                                             + number_markup(solid.initial_temperature)
                                             + text(", otherwise for every seed"));
      if(!solid.cell.empty())
        lines += condition("cell", text(fmt::format("space repeats itself after {}",
                                                    fmt::join(solid.cell, ", "))));
      if(solid.drag > 0)
        lines += condition("drag", math("$v → $v e^{−# Δ$t} in every step",
                                        {equation_number(solid.drag)}));
      if(solid.bath)
      {
        std::string words = "Langevin, temperature";
        for(std::size_t k = 0; k < solid.bath->times.size(); ++k)
          words += fmt::format("{} {} at t = {}", k == 0 ? "" : ",",
                               plain_number(solid.bath->temperatures[k], 4),
                               plain_number(solid.bath->times[k], 4));
        lines += condition("bath",
                           text(words + ", rate " + plain_number(solid.bath->rate, 4)));
      }
      if(solid.light)
        lines += condition(
            "light",
            text(fmt::format("{} ({}), power {}; of each particle what no other one "
                             "hides",
                             solid.light->parallel ? "parallel rays along" : "a point at",
                             fmt::join(solid.light->at.begin(),
                                       solid.light->at.begin() + solid.dimension(), ", "),
                             plain_number(solid.light->power, 4))));
      return lines;
    }

    std::string words_of_test(cases::SolidTest test)
    {
      switch(test)
      {
      case cases::SolidTest::temperature:
        return ", whose temperatures (mean kinetic energy since the start) are all below "
               "25";
      case cases::SolidTest::order:
        return ", whose partners lie about them as in a crystal (|ψ₆|, averaged over a "
               "particle and its partners, exceeds 1/2)";
      default:
        return ", none of which moved faster than 7.5 on average over the last 1000 "
               "steps";
      }
    }

    Markup solid_conditions(const StoredCase &record)
    {
      const cases::ParticleSolid &solid = *record.scene.particle_solid;
      Markup start = text(words_of_arrangement(solid));
      if(solid.disturbance > 0)
        start += text("; each coordinate disturbed by ")
                 + number_markup(solid.disturbance)
                 + text(" (standard deviation), otherwise for every seed");
      const Markup source
          = solid.heating ? condition("source", source_words(*solid.heating)) : Markup();
      const double steps
          = (record.scene.end_time - record.scene.start_time) / solid.time_step;
      return element(
          "dl", {{"class", "conditions"}},
          condition("moved", text("particles of mass 1 that bind each other; "
                                  "Boltzmann's constant is 1"))
              + condition("start", start) + thermal_conditions(solid) + source
              + condition("end", text("t = " + plain_number(record.scene.end_time, 6)
                                      + fmt::format(", after {} steps",
                                                    grouped(std::lround(steps)))))
              + condition(
                  "solid",
                  text("a particle that makes a triangle with two others, all sides "
                       "shorter than "
                       + plain_number(solid.law.cutoff, 4) + words_of_test(solid.test)
                       + "; any other is fluid")));
    }
  } // namespace

  Markup solid_equations(const StoredCase &record)
  {
    const cases::ParticleSolid &solid = *record.scene.particle_solid;
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

  Markup advection_equations(const StoredCase &record)
  {
    return element("div", {{"class", "equations"}},
                   equation_line("front", math("\\d{$φ}{$t} + $u · ∇$φ = 0"))
                       + equation_line("", math("the region is where $φ > 0")))
           + element(
               "dl", {{"class", "conditions"}},
               condition("region", text(record.scene.interface->shape->description()))
                   + condition("velocity",
                               text(record.scene.interface->velocity->description()))
                   + condition("start",
                               text("t = " + plain_number(record.scene.start_time, 6)))
                   + condition("end",
                               text("t = " + plain_number(record.scene.end_time, 6))));
  }
} // namespace meltfront::verification
