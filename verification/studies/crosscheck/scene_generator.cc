#include <verification/studies/crosscheck/random_course.h>
#include <verification/studies/crosscheck/random_stream.h>
#include <verification/studies/crosscheck/random_substance.h>
#include <verification/studies/crosscheck/scene_generator.h>

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    const std::string initial = "Scene/Initial state";

    enum class Problem
    {
      pure, ///< a pure substance that melts or freezes
      alloy,
      heat, ///< no phase changes
      steady
    };

    /** Makes one scene, part by part; each part finds what those before it chose. */
    class SceneMaker
    {
    public:
      SceneMaker(std::uint64_t seed, int index, int dimension)
        : random(seed, static_cast<std::uint64_t>(index))
        , dimension(dimension > 0 ? dimension : 1 + random.weighted({0.6, 0.35, 0.05}))
        , problem(static_cast<Problem>(random.weighted({0.76, 0.08, 0.1, 0.06})))
        , substance(random_substance(random, changes_phase()))
      {
        draft.set("", "title", "Random scene " + scene_name(seed, index).substr(6));
        draft.set("", "units", substance.si ? "SI" : "normalised");
      }

      SceneDraft make()
      {
        if(problem == Problem::alloy)
          make_alloy_of_substance();
        if(problem == Problem::steady)
          draft.set("Scene", "problem", "poisson");
        choose_domain();
        choose_duration();
        choose_material();
        if(problem != Problem::steady)
          choose_start();
        choose_walls();
        if(changes_phase())
          choose_sources();
        else
          choose_release_and_inclusion();
        if(problem == Problem::alloy)
          choose_solute();
        return draft;
      }

    private:
      bool changes_phase() const
      {
        return problem == Problem::pure || problem == Problem::alloy;
      }

      /** An alloy has one density, and heat of melting down to its coldest mush, which is
       * less than 20 scales below the melting point. */
      void make_alloy_of_substance()
      {
        substance.liquid_density = substance.solid_density;
        const double loss
            = 20 * substance.temperature_scale
              * std::abs(substance.liquid_capacity - substance.solid_capacity);
        if(loss > substance.latent_heat / 2)
          substance.liquid_capacity = substance.solid_capacity;
      }

      bool round() const
      {
        return shape == "ball" || shape == "shell";
      }

      std::string list(const std::array<double, 3> &values) const
      {
        std::string text;
        for(int d = 0; d < shape_dimension; ++d)
          text += (d > 0 ? ", " : "") + words(values[d]);
        return text;
      }

      void choose_domain()
      {
        const bool linear = problem == Problem::steady;
        if(dimension == 1)
        {
          const int kind = linear ? 0 : random.weighted({0.66, 0.1, 0.09, 0.08, 0.07});
          shape = std::array{"slab", "ball", "ball", "shell", "shell"}[kind];
          shape_dimension = std::array{1, 2, 3, 2, 3}[kind];
          symmetry
              = std::array{"planar", "cylindrical", "spherical"}[shape_dimension - 1];
        }
        else
        {
          shape_dimension = dimension;
          const bool plane = dimension == 2;
          const int kind
              = linear ? 0 : random.weighted({0.6, 0.2, 0.13, plane ? 0.07 : 0});
          shape = std::array{"box", "ball", "shell", "outline"}[kind];
          symmetry = "none";
        }
        draft.set("Scene", "symmetry", symmetry);
        const std::string here = "Scene/Domain";
        draft.set(here, "shape", shape);
        draft.set(here, "dimension", fmt::format("{}", shape_dimension));
        const double length = substance.length;
        last = length;
        if(shape == "slab")
          draft.set(here, "length", words(length));
        else if(shape == "box")
        {
          upper = {length, length, length};
          for(int d = 1; d < shape_dimension; ++d)
            upper[d]
                *= std::array{1., 1., 0.5, 1.5}[random.below(plane_or_less() ? 4 : 2)];
          draft.set(here, "lower corner", list({0, 0, 0}));
          draft.set(here, "upper corner", list(upper));
        }
        else if(round())
        {
          draft.set(here, "radius", words(length));
          if(shape == "shell")
          {
            first = rounded(length * random.uniform(0.2, 0.6));
            draft.set(here, "inner radius", words(first));
          }
        }
        else
          draft.set(here, "polar radius",
                    fmt::format("{}*(1 + {}*cos(2*phi) + {}*sin(phi))", words(length / 2),
                                words(random.uniform(0, 0.2)),
                                words(random.uniform(0, 0.15))));
        coordinate = radius_or_x();
      }

      bool plane_or_less() const
      {
        return shape_dimension <= 2;
      }

      std::string radius_or_x() const
      {
        if(!round() && shape != "outline")
          return "x";
        return shape_dimension == 2 ? "sqrt(x^2 + y^2)" : "sqrt(x^2 + y^2 + z^2)";
      }

      /** About the time in which a front crosses a part of the domain, or heat spreads.
       */
      void choose_duration()
      {
        const double spread
            = substance.length * substance.length / substance.diffusivity();
        duration = spread * random.log_uniform(0.02, 0.5);
        if(changes_phase())
        {
          const double part = random.log_uniform(0.1, 1);
          const double stefan_number
              = std::max(substance.solid_capacity, substance.liquid_capacity)
                * substance.temperature_scale / substance.latent_heat;
          duration = part * part * spread * (0.5 / stefan_number + 0.5);
        }
        duration = rounded(duration);
        if(problem != Problem::steady)
          // Much shorter than that nothing is resolved.
          draft.set("Scene", "end time", words(duration),
                    {words(duration / 4), words(duration / 2)});
      }

      void choose_material()
      {
        if(problem == Problem::steady)
          draft.set("Scene/Material/Solid", "conductivity",
                    words(substance.solid_conductivity));
        else
          write_substance(substance, changes_phase(), draft);
        if(problem == Problem::pure && dimension == 2 && random.chance(0.02))
          draft.set("Scene/Material", "Gibbs-Thomson coefficient",
                    words(0.01 * substance.temperature_scale * substance.length));
      }

      /** The melting temperature and so much more. */
      double warmer(double shares) const
      {
        return rounded(substance.melting_temperature
                       + shares * substance.temperature_scale);
      }

      void choose_start()
      {
        const auto [from, to] = std::pair(first, last);
        const double sign = random.chance(0.5) ? 1 : -1;
        start_sign = sign;
        int kind = random.weighted({0.33, 0.15, 0.06, 0.22, 0.08, 0.1, 0.04, 0.02});
        if(problem == Problem::alloy)
        {
          start_sign = 1;
          kind = std::array{0, 0, 6}[random.below(3)];
        }
        if(problem == Problem::heat)
          kind = random.chance(0.5) ? 0 : 6;
        const auto set = [this](const std::string &expression,
                                const std::vector<std::string> &simpler = {})
        { draft.set(initial, "temperature", expression, simpler); };
        const double melting = substance.melting_temperature;
        const std::string one_phase = words(warmer(start_sign * random.uniform(0.05, 1)));
        switch(kind)
        {
        case 0:
          set(one_phase, {words(melting)});
          break;
        case 1:
        case 2:
          set(words(melting));
          draft.set(initial, "solid fraction at melting",
                    kind == 1 ? (sign < 0 ? "1" : "0") : words(random.uniform(0.1, 0.9)));
          if(kind == 2)
            start_sign = 0;
          break;
        case 3:
        case 4:
        case 7:
          choose_start_with_front(kind, sign, from, to);
          start_sign = 0;
          break;
        default:
        {
          // A wave within a phase, or across the melting point.
          const double level = kind == 5 ? 0.55 : random.uniform(-0.3, 0.3);
          const double height = random.uniform(0.1, kind == 5 ? 0.5 : 1);
          set(fmt::format("{} + {}*cos({}*{})", words(warmer(start_sign * level)),
                          words(height * substance.temperature_scale),
                          words(3.14159265 / (to - from) * (1 + random.below(3))),
                          coordinate),
              {one_phase});
          if(kind == 6)
            start_sign = 0;
        }
        }
      }

      /** Solid on one side of a plane, a circle or a sphere, with linear profiles. */
      void choose_start_with_front(int kind, double sign, double from, double to)
      {
        std::string level = coordinate;
        double front = rounded(from + (to - from) * random.uniform(0.15, 0.85));
        if(dimension == 2 && shape != "shell" && random.chance(0.5))
        {
          // A disk off the middle.
          const double shift = shape == "box" ? 0.5 : 0;
          const double y = shape == "box" ? upper[1] : to;
          level = fmt::format("sqrt((x - {})^2 + (y - {})^2)",
                              words(to * (shift + random.uniform(-0.1, 0.1))),
                              words(y * (shift + random.uniform(-0.1, 0.1))));
          front = rounded(std::min(y, to) * random.uniform(0.15, 0.3));
        }
        // Per length, on the near side of the front and on the far one.
        const double slope = substance.temperature_scale / (to - from);
        double near = -sign * slope * random.uniform(0.1, 1.5);
        double far = -sign * slope * random.uniform(0.1, 1.5);
        if(random.chance(0.3))
          (random.chance(0.5) ? near : far) = 0;
        const bool given = kind != 3 || near == 0 || far == 0;
        if(kind == 7)
          (sign > 0 ? near : far) = 0.3 * sign * slope; // the liquid is undercooled
        const std::string beyond = fmt::format("{} - {}", level, words(front));
        draft.set(initial, "temperature",
                  fmt::format("{} + ({})*min({}, 0) + ({})*max({}, 0)",
                              words(substance.melting_temperature), words(near), beyond,
                              words(far), beyond),
                  {words(substance.melting_temperature)});
        // Where one phase is at the melting point throughout, only this tells the phases.
        if(given)
          draft.set(initial, "front",
                    sign < 0 ? beyond : fmt::format("{} - {}", words(front), level));
      }

      std::vector<std::string> sides() const
      {
        if(shape == "shell")
          return {"inner", "outer"};
        if(shape == "ball" || shape == "outline")
          return {"outer"};
        const std::vector<std::string> all{"x_min", "x_max", "y_min",
                                           "y_max", "z_min", "z_max"};
        return {all.begin(), all.begin() + 2 * shape_dimension};
      }

      void choose_walls()
      {
        std::string periodic;
        if(shape == "slab" && problem != Problem::steady && random.chance(0.03))
          periodic = "x";
        if(shape == "box" && random.chance(0.08))
          periodic = "y";
        held = false;
        for(const std::string &side : sides())
        {
          const std::string here = "Scene/Walls/" + side;
          if(!periodic.empty() && side.substr(0, 1) == periodic)
            draft.set(here, "kind", "periodic");
          else
            choose_wall(here, side);
        }
        // A steady temperature is known up to a constant unless a wall holds it.
        if(problem == Problem::steady && !held)
        {
          draft.remove("Scene/Walls/x_min");
          hold("Scene/Walls/x_min", "x_min");
        }
      }

      void choose_wall(const std::string &here, const std::string &side)
      {
        switch(changes_phase() ? random.weighted({0.3, 0.46, 0.17, 0.07})
                               : random.weighted({0.25, 0.35, 0.2, 0.2}))
        {
        case 0:
          return;
        case 1:
          hold(here, side);
          return;
        case 2:
        {
          const double flux = random_sign() * substance.conductivity()
                              * substance.temperature_scale / substance.length
                              * random.log_uniform(0.3, 4);
          const Course course = over_time(flux, 0);
          draft.set(here, "kind", "flux");
          draft.set(here, "flux", course.expression, course.simpler);
          unbounded = true;
          return;
        }
        default:
        {
          const Course course = over_time(wall_temperature(), wall_temperature());
          draft.set(here, "kind", "heat transfer");
          draft.set(here, "ambient temperature", course.expression, course.simpler);
          draft.set(here, "heat transfer coefficient",
                    words(substance.conductivity() / substance.length
                          * random.log_uniform(0.3, 100)));
          held = unbounded = true;
        }
        }
      }

      void hold(const std::string &here, const std::string &side)
      {
        held = true;
        draft.set(here, "kind", "fixed temperature");
        const double temperature = wall_temperature();
        Course course = over_time(temperature, wall_temperature());
        if(dimension >= 2 && shape != "outline" && random.chance(0.15))
        {
          const std::string along = side.starts_with("y") || round() ? "x" : "y";
          course = {fmt::format("{} + {}*cos({}*{})", words(temperature),
                                words(0.3 * substance.temperature_scale),
                                words(3.14159265 / substance.length), along),
                    {words(temperature)}};
        }
        draft.set(here, "temperature", course.expression, course.simpler);
      }

      /** In a steady scene nothing depends on time. */
      Course over_time(double from, double to)
      {
        return random_course(random, from, to, duration,
                             problem == Problem::steady ? 0 : 0.35);
      }

      double random_sign()
      {
        return random.chance(0.5) ? 1 : -1;
      }

      /** More often than not on the other side of the melting point than the start. */
      double wall_temperature()
      {
        const bool opposite = start_sign != 0 && random.chance(0.7);
        return warmer((opposite ? -start_sign : random_sign()) * random.uniform(0.1, 1));
      }

      void choose_sources()
      {
        const bool symmetric = symmetry != "none";
        if(shape == "slab" || shape == "shell" || (symmetric && shape != "ball")
           || !random.chance(symmetric ? 0.1 : 0.15))
          return;
        const int count = symmetric ? 1 : 1 + random.below(2);
        for(int i = 1; i <= count; ++i)
        {
          std::array<double, 3> position{};
          if(!symmetric)
            for(int d = 0; d < shape_dimension; ++d)
              position[d] = shape == "box" ? upper[d] * random.uniform(0.3, 0.7)
                                           : substance.length * random.uniform(-0.2, 0.2);
          const double sign = start_sign != 0 ? -start_sign : random_sign();
          const double power = sign * substance.conductivity()
                               * substance.temperature_scale * random.log_uniform(1, 10)
                               * (shape_dimension == 3 ? substance.length : 1);
          const std::string here = fmt::format("Scene/Source {}", i);
          const Course course = random_course(random, power, 0, duration, 0.2);
          draft.set(here, "position", list(position));
          draft.set(here, "power", course.expression, course.simpler);
          unbounded = true;
        }
      }

      void choose_release_and_inclusion()
      {
        const double length = substance.length;
        if(random.chance(problem == Problem::steady ? 0.8 : 0.5))
        {
          const double density = random_sign() * substance.solid_conductivity
                                 * substance.temperature_scale / (length * length)
                                 * random.log_uniform(0.5, 20);
          const Course course = over_time(density, 0);
          const std::string wave
              = random.chance(0.5) && symmetry != "cylindrical" && symmetry != "spherical"
                    ? fmt::format("(1 + 0.5*sin({}*x))*", words(6 / length))
                    : "";
          draft.set("Scene/Heat release", "power density",
                    fmt::format("{}({})", wave, course.expression), course.simpler);
        }
        if(!random.chance(0.2))
          return;
        const std::string here = "Scene/Inclusion";
        const std::string middle = words(length * random.uniform(0.3, 0.6));
        const std::string distance
            = shape == "slab" ? fmt::format("abs(x - {})", middle)
              : shape == "box"
                  ? fmt::format("sqrt((x - {})^2 + (y - {})^2)", middle, middle)
                  : coordinate;
        draft.set(
            here, "level set",
            fmt::format("{} - {}", distance,
                        words(first + (length - first) * random.uniform(0.1, 0.3))));
        draft.set(here, "conductivity",
                  words(substance.solid_conductivity * random.log_uniform(1e-2, 1e2)));
      }

      void choose_solute()
      {
        // The coldest mush of these scenes is three scales below the melting point: its
        // liquid holds less than its own mass of solute.
        const double slope
            = rounded(substance.temperature_scale * random.log_uniform(5, 40));
        const std::string here = "Scene/Material/Solute 1";
        draft.set(here, "name", "salt");
        draft.set(here, "liquidus", words(slope));
        if(random.chance(0.3))
          draft.set(here, "diffusivity",
                    words(substance.diffusivity() * random.log_uniform(1e-3, 1e-1)));
        draft.set(initial, "concentration",
                  words(substance.temperature_scale * random.uniform(0.05, 0.4) / slope));
        if(unbounded || random.chance(0.25))
          draft.set(
              "Scene/Material/Alloy", "eutectic temperature",
              words(substance.melting_temperature - slope * random.uniform(0.15, 0.4)));
      }

      RandomStream random;
      int dimension;
      Problem problem;
      Substance substance;
      SceneDraft draft;
      std::string shape, symmetry, coordinate;
      int shape_dimension = 1;
      double first = 0, last = 1; ///< of the coordinate
      std::array<double, 3> upper{};
      double duration = 1;
      double start_sign = 0;  ///< 1 liquid, -1 solid, 0 both
      bool unbounded = false; ///< something drives temperatures without a bound
      bool held = false;      ///< a wall holds the temperature
    };
  } // namespace

  std::string scene_name(std::uint64_t seed, int index)
  {
    return fmt::format("scene-{}-{}", seed, index);
  }

  SceneDraft random_scene(std::uint64_t seed, int index, int dimension)
  {
    return SceneMaker(seed, index, dimension).make();
  }
} // namespace meltfront::verification
