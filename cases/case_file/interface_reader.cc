#include <cases/case_file/domain_reader.h>
#include <cases/case_file/expression.h>
#include <cases/case_file/interface_reader.h>
#include <cases/case_file/key_builders.h>
#include <cases/shape.h>
#include <cases/velocity_field.h>

#include <fmt/format.h>

namespace meltfront::cases
{
  namespace
  {
    const std::string region_keys = "Scene/Region";
    const std::string velocity_keys = "Scene/Velocity";

    /** Keys that one kind needs and no other knows. */
    void belongs(const PrmFile &prm, const std::string &here, const std::string &kind,
                 const std::string &key, const std::vector<std::string> &owners)
    {
      if(std::find(owners.begin(), owners.end(), kind) != owners.end())
        prm.require(here, key, fmt::format("the kind '{}' needs it", kind));
      else
        prm.forbid(here, key, fmt::format("the kind is '{}'", kind));
    }

    std::shared_ptr<const Shape> read_shape(const PrmFile &prm, int dimension)
    {
      const std::string kind = prm.get_text(region_keys, "kind");
      for(const char *key : {"centre", "radius"})
        belongs(prm, region_keys, kind, key, {"ball", "slotted disk"});
      for(const char *key : {"slot width", "slot length"})
        belongs(prm, region_keys, kind, key, {"slotted disk"});
      belongs(prm, region_keys, kind, "front", {"half-space"});
      try
      {
        if(kind == "half-space")
          return std::make_shared<HalfSpace>(prm.get_number(region_keys, "front"));
        const Position centre = read_position(prm, region_keys, "centre", dimension);
        const double radius = prm.get_number(region_keys, "radius");
        if(kind == "ball")
          return std::make_shared<Ball>(dimension, centre, radius);
        if(dimension != 2)
          throw prm.error(region_keys, "kind",
                          "is a slotted disk, which needs a domain of 2 dimensions");
        return std::make_shared<SlottedDisk>(centre, radius,
                                             prm.get_number(region_keys, "slot width"),
                                             prm.get_number(region_keys, "slot length"));
      }
      catch(const Refusal &refusal)
      {
        throw prm.error(region_keys, "kind",
                        fmt::format("gives no region: {}", refusal.what()));
      }
    }

    std::shared_ptr<const VelocityField> read_formulas(const PrmFile &prm,
                                                       const Domain &domain)
    {
      std::array<FormulaVelocity::Formula, 3> components;
      std::string text;
      for(int d = 0; d < domain.dimension; ++d)
      {
        const std::string key = fmt::format("{} component", "xyz"[d]);
        prm.require(velocity_keys, key, "the kind 'formula' needs it");
        try
        {
          const Field field
              = parse_field(prm.get_text(velocity_keys, key),
                            std::string("xyz").substr(0, domain.dimension) + "t");
          text += (d == 0 ? "" : ", ") + field.expression;
          components[d] = field.value;
        }
        catch(const InputError &error)
        {
          throw prm.error(velocity_keys, key, error.what());
        }
      }
      return std::make_shared<FormulaVelocity>(text, components, domain.side());
    }

    std::shared_ptr<const VelocityField> read_velocity(const PrmFile &prm,
                                                       const Domain &domain)
    {
      const std::string kind = prm.get_text(velocity_keys, "kind");
      belongs(prm, velocity_keys, kind, "period", {"vortex", "deformation"});
      if(kind != "rigid")
        for(const char *key : {"translation", "angular velocity", "centre"})
          prm.forbid(velocity_keys, key, fmt::format("the kind is '{}'", kind));
      if(kind != "formula")
        for(int d = 0; d < 3; ++d)
          prm.forbid(velocity_keys, fmt::format("{} component", "xyz"[d]),
                     fmt::format("the kind is '{}'", kind));
      if(kind == "formula")
        return read_formulas(prm, domain);
      if(kind == "rigid")
      {
        const auto position = [&](const char *key)
        {
          return prm.given(velocity_keys, key)
                     ? read_position(prm, velocity_keys, key, domain.dimension)
                     : Position{};
        };
        return std::make_shared<RigidMotion>(
            position("translation"), prm.get_number(velocity_keys, "angular velocity"),
            position("centre"));
      }
      if((kind == "vortex") != (domain.dimension == 2))
        throw prm.error(velocity_keys, "kind",
                        "is a vortex in 2 dimensions, a deformation in 3");
      const double period = prm.get_number(velocity_keys, "period");
      if(kind == "vortex")
        return std::make_shared<SingleVortex>(period);
      return std::make_shared<CubeDeformation>(period);
    }
  } // namespace

  void declare_interface(PrmFile &prm)
  {
    prm.declare(region_keys,
                word_key("kind", "ball", {"ball", "slotted disk", "half-space"},
                         "What a velocity carries along: a disk in the plane or a ball "
                         "in space, a disk with a slot, or all of x <= front."));
    prm.declare(region_keys,
                numbers_key("centre", "m", "Centre of the disk or the ball."));
    prm.declare(region_keys, number_key("radius", "", "m",
                                        "Radius of the disk or the ball.", above_zero));
    prm.declare(region_keys,
                number_key("slot width", "", "m", "Width of the slot.", above_zero));
    prm.declare(region_keys,
                number_key("slot length", "", "m",
                           "Length of the slot, from the disk's lowest point up.",
                           above_zero));
    prm.declare(region_keys,
                number_key("front", "", "m", "Position of the half-space's front."));
    prm.declare(velocity_keys,
                word_key("kind", "rigid", {"rigid", "vortex", "deformation", "formula"},
                         "rigid: translation and rotation in the plane; vortex: the "
                         "single vortex in the unit square; deformation: that of the "
                         "unit cube; formula: as the components say."));
    prm.declare(velocity_keys,
                numbers_key("translation", "m/s",
                            "Translation velocity of a rigid motion; zero where not "
                            "given."));
    prm.declare(velocity_keys,
                number_key("angular velocity", "0", "1/s",
                           "Angular velocity of a rigid motion, counterclockwise."));
    prm.declare(velocity_keys, numbers_key("centre", "m",
                                           "Centre of the rotation; the origin where not "
                                           "given."));
    prm.declare(velocity_keys,
                number_key("period", "", "s",
                           "Period after which a vortex or a deformation has "
                           "brought everything back.",
                           above_zero));
    for(const char axis : {'x', 'y', 'z'})
      prm.declare(velocity_keys,
                  formula_key(fmt::format("{} component", axis),
                              "Velocity component, expression of x, y, z, t (m/s)."));
  }

  void read_interface(const PrmFile &prm, Scene &scene)
  {
    if(scene.problem != ProblemKind::interface_advection)
    {
      for(const std::string &here : {region_keys, velocity_keys})
        if(prm.opened(here))
          throw prm.subsection_error(here,
                                     fmt::format("has no meaning where the problem is "
                                                 "'{}'",
                                                 to_string(scene.problem)));
      return;
    }
    if(scene.domain.shape != DomainShape::box)
      throw prm.error("Scene/Domain", "shape", "must be a box where a front is carried");
    if(!prm.opened(region_keys))
      throw prm.error("Scene", "problem",
                      "needs subsection 'Scene/Region', which is missing");
    scene.interface = InterfaceAdvection{read_shape(prm, scene.domain.dimension),
                                         read_velocity(prm, scene.domain)};
  }
} // namespace meltfront::cases
