#include <cases/case_file/domain_reader.h>
#include <cases/case_file/expression.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/particle_solid_reader.h>
#include <cases/case_file/thermal_particles_reader.h>
#include <cases/outline.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    const std::string solid_keys = "Scene/Particle solid";
    const std::string base_keys = "Scene/Particle solid/Base";
    const std::string heating_keys = "Scene/Particle solid/Heating";

    /** The words of a case file for arrangements, but for the tables. */
    constexpr std::pair<const char *, SolidArrangement> arrangements[]
        = {{"triangle", SolidArrangement::triangle},
           {"rectangle", SolidArrangement::rectangle},
           {"bar", SolidArrangement::bar},
           {"disk", SolidArrangement::disk},
           {"outline", SolidArrangement::outline},
           {"block", SolidArrangement::block},
           {"ball", SolidArrangement::ball}};

    void declare_law(PrmFile &prm)
    {
      prm.declare(solid_keys,
                  number_key("attraction", "2500", "",
                             "G: force at distance 1 that draws together.", above_zero));
      prm.declare(solid_keys,
                  number_key("repulsion", "2900", "",
                             "H: force at distance 1 that drives apart.", above_zero));
      prm.declare(solid_keys,
                  number_key("attraction exponent", "4", "",
                             "Power of the distance in the attraction.", 2, 40));
      prm.declare(solid_keys,
                  number_key("repulsion exponent", "6", "",
                             "Power of the distance in the repulsion.", 2, 40));
      prm.declare(solid_keys,
                  number_key("cutoff", "1.5", "",
                             "Distance beyond which there is no force.", above_zero));
      prm.declare(solid_keys,
                  {.key = "shifted",
                   .kind = PrmKind::boolean,
                   .default_value = "false",
                   .unit = {},
                   .description = "The force's value at the cutoff is taken from it, so "
                                  "that it ends at zero there without a jump."});
    }

    void declare_base_and_heating(PrmFile &prm)
    {
      prm.declare(base_keys,
                  number_key("restitution", "0.1", "",
                             "gamma: share of the vertical velocity that is thrown back.",
                             0));
      prm.declare(base_keys,
                  number_key("hot half width", "0", "",
                             "The base is hot where |x| is less; 0: nowhere.", 0));
      prm.declare(base_keys, number_key("hot restitution", "1.5", "",
                                        "gamma at the left end of the hot part.", 0));
      prm.declare(base_keys,
                  number_key("hot slope", "0.025", "",
                             "By how much gamma falls there per length to the right."));
      prm.declare(heating_keys, numbers_key("position", "", "Where the source is."));
      prm.declare(heating_keys,
                  text_key("stages", "STEPS x STRENGTH, STEPS x STRENGTH, ...: velocity "
                                     "added in each step at distance 1, in turn; the "
                                     "last holds on."));
      prm.declare(
          heating_keys,
          number_key("power", "2", "",
                     "Power of the distance by which the strength is divided: 2 as "
                     "printed, -2 as the figures of the report need.",
                     -8, 8));
      prm.declare(heating_keys,
                  number_key("reach", "2.5", "", "Particles that are nearer are heated.",
                             above_zero));
    }

    /** `50000 x 0.008`. */
    HeatingStage read_stage(const PrmFile &prm, const std::string &stage)
    {
      const std::size_t cross = stage.find('x');
      HeatingStage result;
      const auto number = [](const std::string &text, auto &value)
      {
        const auto [end, error]
            = std::from_chars(text.data(), text.data() + text.size(), value);
        return error == std::errc() && end == text.data() + text.size();
      };
      if(cross == std::string::npos
         || !number(trimmed(stage.substr(0, cross)), result.steps)
         || !number(trimmed(stage.substr(cross + 1)), result.strength) || result.steps < 1
         || !std::isfinite(result.strength))
        throw prm.error(
            heating_keys, "stages",
            fmt::format("holds '{}', which is not STEPS x STRENGTH", quotable(stage)));
      return result;
    }

    PointHeating read_heating(const PrmFile &prm)
    {
      for(const char *key : {"position", "stages"})
        prm.require(heating_keys, key, "a source needs it");
      PointHeating heating;
      heating.position = read_position(prm, heating_keys, "position", 2);
      for(const std::string &stage :
          split_list(prm.get_text(heating_keys, "stages"), ','))
        heating.stages.push_back(read_stage(prm, trimmed(stage)));
      heating.power = prm.get_number(heating_keys, "power");
      heating.reach = prm.get_number(heating_keys, "reach");
      return heating;
    }

    SolidBase read_base(const PrmFile &prm)
    {
      SolidBase base;
      base.restitution = prm.get_number(base_keys, "restitution");
      const double half_width = prm.get_number(base_keys, "hot half width");
      if(half_width > 0)
        base.hot = HotBase{half_width, prm.get_number(base_keys, "hot restitution"),
                           prm.get_number(base_keys, "hot slope")};
      else
        for(const char *key : {"hot restitution", "hot slope"})
          prm.forbid(base_keys, key, "'hot half width' is zero");
      return base;
    }

    PairLaw read_law(const PrmFile &prm)
    {
      PairLaw law;
      law.attraction = prm.get_number(solid_keys, "attraction");
      law.repulsion = prm.get_number(solid_keys, "repulsion");
      law.attraction_exponent = prm.get_number(solid_keys, "attraction exponent");
      law.repulsion_exponent = prm.get_number(solid_keys, "repulsion exponent");
      law.cutoff = prm.get_number(solid_keys, "cutoff");
      law.shifted = prm.get_boolean(solid_keys, "shifted");
      if(!(law.attraction_exponent < law.repulsion_exponent))
        throw prm.error(solid_keys, "repulsion exponent",
                        "must exceed 'attraction exponent': nothing would keep the "
                        "particles apart");
      return law;
    }

    /** The polar radius of a solid's outline, tried out as one. */
    std::function<double(double)> read_outline_of_solid(const PrmFile &prm)
    {
      prm.require(solid_keys, "outline", "the arrangement is an outline");
      try
      {
        const auto radius = parse_function(prm.get_text(solid_keys, "outline"), "phi");
        const Outline tried(radius, {0, 0});
        return radius;
      }
      catch(const InputError &error)
      {
        throw prm.error(solid_keys, "outline", error.what());
      }
    }

    void read_arrangement(const PrmFile &prm, const Scene &scene, ParticleSolid &solid)
    {
      const std::string word = prm.get_text(solid_keys, "arrangement");
      if(word.starts_with("table"))
        solid.table = word == "table 1" ? 1 : 2;
      else
        for(const auto &[name, arrangement] : arrangements)
          if(word == name)
            solid.arrangement = arrangement;
      solid.errata = prm.get_boolean(solid_keys, "errata");
      solid.rows = static_cast<int>(prm.get_integer(solid_keys, "rows"));
      if(word != "table 2")
        prm.forbid(solid_keys, "errata", "only table 2 has any");
      if(word != "rectangle" && word != "bar")
        prm.forbid(solid_keys, "rows", "the arrangement is neither rectangle nor bar");
      if(word != "bar")
        prm.forbid(solid_keys, "pressure", "the arrangement is no bar");
      if((word == "bar") != (scene.problem == ProblemKind::stefan))
        throw prm.error(solid_keys, "arrangement",
                        fmt::format("must be a bar where heat is conducted, and only "
                                    "there; the problem is '{}'",
                                    to_string(scene.problem)));
      if(word == "outline")
        solid.outline = read_outline_of_solid(prm);
      else
        prm.forbid(solid_keys, "outline", "the arrangement is no outline");
      solid.settled = prm.get_boolean(solid_keys, "settled");
      if(word != "triangle" && word != "rectangle")
        prm.forbid(solid_keys, "settled",
                   "only triangles and rectangles are laid to rest");
    }

    SolidTest read_test(const PrmFile &prm, const ParticleSolid &solid)
    {
      const std::string word = prm.get_text(solid_keys, "phase test");
      if(word == "order" && solid.dimension() == 3)
        throw prm.error(solid_keys, "phase test",
                        "is 'order', which is known of crystals of the plane only");
      return word == "temperature" ? SolidTest::temperature
             : word == "order"     ? SolidTest::order
                                   : SolidTest::average_speed;
    }
  } // namespace

  void declare_particle_solid(PrmFile &prm)
  {
    prm.declare(solid_keys,
                word_key("arrangement", "table 1",
                         {"table 1", "table 2", "triangle", "rectangle", "bar", "disk",
                          "outline", "block", "ball"},
                         "Where the particles are: a table of Greenspan's report of "
                         "1976, a solid of any size at rest on the base, a bar between "
                         "two walls, a crystal of the plane within a disk or an outline, "
                         "or a close packing of space in a block or a ball."));
    prm.declare(solid_keys,
                formula_key("outline", "Radius of an outline over n / 2 spacings: an "
                                       "expression of the angle phi."));
    prm.declare(solid_keys, {.key = "settled",
                             .kind = PrmKind::boolean,
                             .default_value = "true",
                             .unit = {},
                             .description = "A triangle or a rectangle on a base is laid "
                                            "to rest before the start; false: it begins "
                                            "as a lattice."});
    prm.declare(solid_keys, {.key = "errata",
                             .kind = PrmKind::boolean,
                             .default_value = "false",
                             .unit = {},
                             .description = "The misprints of table 2 are put right."});
    prm.declare(solid_keys, integer_key("rows", "7", 2, 1e4,
                                        "Rows of particles of a rectangle or a bar."));
    declare_law(prm);
    prm.declare(solid_keys,
                number_key("time step", "1e-4", "",
                           "Time step of the model, in which base and source act once.",
                           above_zero));
    prm.declare(solid_keys, number_key("gravity", "0", "", "Downward acceleration.", 0));
    prm.declare(solid_keys,
                number_key("disturbance", "0", "",
                           "Standard deviation of what is added to each coordinate at "
                           "the start, by the seed.",
                           0, 0.1));
    prm.declare(solid_keys,
                word_key("phase test", "average speed",
                         {"average speed", "temperature", "order"},
                         "What makes a particle fluid: it moves faster than 7.5 on "
                         "average over 1000 steps, its mean kinetic energy reaches 25, "
                         "or its partners do not lie about it as in a crystal of the "
                         "plane."));
    prm.declare(solid_keys,
                numbers_key("corners", "", "Particles whose last bonds are looked for."));
    prm.declare(solid_keys, number_key("pressure", "0", "",
                                       "Force per length on the cold end of a bar.", 0));
    declare_base_and_heating(prm);
    declare_thermal_particles(prm);
  }

  void read_particle_solid(const PrmFile &prm, Scene &scene)
  {
    const bool required = scene.problem == ProblemKind::particle_solid;
    if(required && !prm.opened(solid_keys))
      throw prm.error("Scene", "problem",
                      "needs subsection 'Scene/Particle solid', which is missing");
    if(!prm.opened(solid_keys))
      return;
    if(!required && scene.problem != ProblemKind::stefan)
      throw prm.subsection_error(solid_keys,
                                 fmt::format("has no meaning where the problem is '{}'",
                                             to_string(scene.problem)));
    ParticleSolid solid;
    read_arrangement(prm, scene, solid);
    solid.law = read_law(prm);
    solid.time_step = prm.get_number(solid_keys, "time step");
    solid.gravity = prm.get_number(solid_keys, "gravity");
    solid.disturbance = prm.get_number(solid_keys, "disturbance");
    solid.pressure = prm.get_number(solid_keys, "pressure");
    solid.test = read_test(prm, solid);
    if(prm.given(solid_keys, "corners"))
      for(const double corner : prm.get_numbers(solid_keys, "corners"))
      {
        if(!(corner >= 1) || corner != std::floor(corner) || corner > 1e6)
          throw prm.error(solid_keys, "corners", "counts particles from 1");
        solid.corners.push_back(static_cast<int>(corner));
      }
    if(solid.corners.size() > 2)
      throw prm.error(solid_keys, "corners", "holds more than two particles");
    if(prm.opened(base_keys))
      solid.base = read_base(prm);
    if(prm.opened(heating_keys))
      solid.heating = read_heating(prm);
    read_thermal_particles(prm, scene, solid);
    scene.particle_solid = solid;
    if(!required)
      return;
    // Nothing bounds a solid that melts; this is where most of it stays.
    scene.domain.shape = DomainShape::box;
    scene.domain.dimension = solid.dimension();
    scene.domain.lower = {-10, 0, 0};
    scene.domain.upper = {10, 10, solid.dimension() == 3 ? 10. : 0.};
  }
} // namespace meltfront::cases
