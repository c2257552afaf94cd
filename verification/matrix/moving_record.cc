#include <cases/shape.h>
#include <cases/velocity_field.h>
#include <verification/matrix/json_values.h>
#include <verification/matrix/moving_record.h>
#include <verification/measure/exact_front.h>

namespace meltfront::verification
{
  namespace
  {
    using nlohmann::json;

    constexpr const char *arrangement_names[] = {"table", "triangle", "rectangle", "bar"};

    const char *name_of(cases::SolidArrangement arrangement)
    {
      return arrangement_names[static_cast<std::size_t>(arrangement)];
    }

    cases::SolidArrangement arrangement_named(const std::string &name)
    {
      std::size_t i = 0;
      while(i + 1 < std::size(arrangement_names) && name != arrangement_names[i])
        ++i;
      return static_cast<cases::SolidArrangement>(i);
    }

    json json_of_base(const cases::SolidBase &base)
    {
      json result{{"restitution", json_of(base.restitution)}};
      if(base.hot)
        result["hot"] = {{"half_width", json_of(base.hot->half_width)},
                         {"left", json_of(base.hot->left)},
                         {"slope", json_of(base.hot->slope)}};
      return result;
    }

    cases::SolidBase base_in(const json &stored)
    {
      cases::SolidBase base;
      base.restitution = number_in(stored.at("restitution"));
      if(stored.contains("hot"))
      {
        const json &hot = stored.at("hot");
        base.hot = cases::HotBase{number_in(hot.at("half_width")),
                                  number_in(hot.at("left")), number_in(hot.at("slope"))};
      }
      return base;
    }

    json json_of_heating(const cases::PointHeating &heating)
    {
      json stages = json::array();
      for(const cases::HeatingStage &stage : heating.stages)
        stages.push_back({{"steps", stage.steps}, {"strength", json_of(stage.strength)}});
      return {{"position", json_of(heating.position)},
              {"stages", stages},
              {"power", json_of(heating.power)},
              {"reach", json_of(heating.reach)}};
    }

    cases::PointHeating heating_in(const json &stored)
    {
      cases::PointHeating heating;
      heating.position = position_in(stored.at("position"));
      for(const json &stage : stored.at("stages"))
        heating.stages.push_back({stage.at("steps"), number_in(stage.at("strength"))});
      heating.power = number_in(stored.at("power"));
      heating.reach = number_in(stored.at("reach"));
      return heating;
    }

    /** Calls visit(name, member) for each number of a solid and of its forces. */
    template <typename Solid, typename Visit>
    void visit_numbers(Solid &solid, const Visit &visit)
    {
      visit("attraction", solid.law.attraction);
      visit("repulsion", solid.law.repulsion);
      visit("attraction_exponent", solid.law.attraction_exponent);
      visit("repulsion_exponent", solid.law.repulsion_exponent);
      visit("cutoff", solid.law.cutoff);
      visit("time_step", solid.time_step);
      visit("gravity", solid.gravity);
      visit("disturbance", solid.disturbance);
      visit("pressure", solid.pressure);
    }

    json json_of_solid(const cases::ParticleSolid &solid)
    {
      json result{{"arrangement", name_of(solid.arrangement)},
                  {"table", solid.table},
                  {"errata", solid.errata},
                  {"rows", solid.rows},
                  {"by_temperature", solid.test == cases::SolidTest::temperature},
                  {"corners", solid.corners}};
      visit_numbers(solid, [&](const char *name, double value)
                    { result[name] = json_of(value); });
      if(solid.base)
        result["base"] = json_of_base(*solid.base);
      if(solid.heating)
        result["heating"] = json_of_heating(*solid.heating);
      return result;
    }

    cases::ParticleSolid solid_in(const json &stored)
    {
      cases::ParticleSolid solid;
      solid.arrangement = arrangement_named(stored.at("arrangement"));
      solid.table = stored.at("table");
      solid.errata = stored.at("errata");
      solid.rows = stored.at("rows");
      solid.test = stored.at("by_temperature") ? cases::SolidTest::temperature
                                               : cases::SolidTest::average_speed;
      stored.at("corners").get_to(solid.corners);
      visit_numbers(solid, [&](const char *name, double &value)
                    { value = number_in(stored.at(name)); });
      if(stored.contains("base"))
        solid.base = base_in(stored.at("base"));
      if(stored.contains("heating"))
        solid.heating = heating_in(stored.at("heating"));
      return solid;
    }

    /** The pieces of the exact edge at the marks and at the end. */
    std::vector<FrontFrame> exact_fronts_of(const cases::Case &c)
    {
      std::vector<FrontFrame> frames;
      if(c.scene.domain.dimension != 2)
        return frames;
      std::vector<double> times = c.measurement.marks;
      times.push_back(c.scene.end_time);
      for(const double time : times)
      {
        FrontFrame &frame = frames.emplace_back();
        frame.time = time;
        for(const FrontPiece &piece :
            exact_front_pieces(c.scene, time, 0.006 * c.scene.domain.side()))
          for(const cases::Position &end : {piece.begin, piece.end})
          {
            frame.x.push_back(end[0]);
            frame.y.push_back(end[1]);
          }
      }
      return frames;
    }
  } // namespace

  MovingRecord make_moving_record(const cases::Case &c)
  {
    MovingRecord record;
    record.problem = cases::to_string(c.scene.problem);
    record.solid = c.scene.particle_solid;
    if(c.scene.interface)
    {
      record.region = c.scene.interface->shape->description();
      record.velocity = c.scene.interface->velocity->description();
      record.region_volume = c.scene.interface->shape->volume();
      record.exact_fronts = exact_fronts_of(c);
    }
    return record;
  }

  void to_json(nlohmann::json &json, const MovingRecord &record)
  {
    json = {{"problem", record.problem},
            {"region", record.region},
            {"velocity", record.velocity},
            {"region_volume", json_of(record.region_volume)}};
    if(record.solid)
      json["solid"] = json_of_solid(*record.solid);
    json["exact_fronts"] = nlohmann::json::array();
    for(const FrontFrame &frame : record.exact_fronts)
      json["exact_fronts"].push_back({{"time", json_of(frame.time)},
                                      {"x", json_of(frame.x)},
                                      {"y", json_of(frame.y)}});
  }

  void from_json(const nlohmann::json &json, MovingRecord &record)
  {
    record = {};
    record.problem = json.at("problem");
    record.region = json.at("region");
    record.velocity = json.at("velocity");
    record.region_volume = number_in(json.at("region_volume"));
    if(json.contains("solid"))
      record.solid = solid_in(json.at("solid"));
    for(const auto &frame : json.at("exact_fronts"))
      record.exact_fronts.push_back({number_in(frame.at("time")),
                                     numbers_in(frame.at("x")),
                                     numbers_in(frame.at("y"))});
  }
} // namespace meltfront::verification
