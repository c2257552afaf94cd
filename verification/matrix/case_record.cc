#include <verification/matrix/case_record.h>
#include <verification/matrix/criterion_record.h>
#include <verification/matrix/hash.h>
#include <verification/matrix/json_values.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using nlohmann::json;
    using verification::json_of;

    const char *name_of(cases::Symmetry symmetry)
    {
      switch(symmetry)
      {
      case cases::Symmetry::planar:
        return "planar";
      case cases::Symmetry::cylindrical:
        return "cylindrical";
      case cases::Symmetry::spherical:
        return "spherical";
      default:
        return "none";
      }
    }

    const char *name_of(cases::DomainShape shape)
    {
      switch(shape)
      {
      case cases::DomainShape::slab:
        return "slab";
      case cases::DomainShape::box:
        return "box";
      case cases::DomainShape::shell:
        return "shell";
      case cases::DomainShape::outline:
        return "outline";
      default:
        return "ball";
      }
    }

    std::string words(const cases::Boundary &boundary)
    {
      switch(boundary.kind)
      {
      case cases::BoundaryKind::fixed_temperature:
        return boundary.exact ? "temperature of the exact solution"
                              : "fixed temperature " + boundary.value.expression;
      case cases::BoundaryKind::flux:
        return "heat flux inward " + boundary.value.expression;
      case cases::BoundaryKind::periodic:
        return "periodic";
      case cases::BoundaryKind::heat_transfer:
        return fmt::format("heat transfer with the ambient temperature {}, coefficient "
                           "{:.6g}",
                           boundary.value.expression, boundary.heat_transfer_coefficient);
      default:
        return "insulated";
      }
    }

    std::string words(const cases::Scene &scene, const cases::PointSource &source)
    {
      const auto coordinates
          = std::vector(source.position.begin(),
                        source.position.begin() + std::max(scene.domain.dimension, 1));
      const std::string unit
          = scene.units != "SI" ? "" : (scene.domain.dimension == 3 ? " W" : " W/m");
      // "exact" is a word for a number that the exact solution knows.
      const std::string strength
          = source.expression == "exact"
                ? fmt::format("that of the exact solution, {:.7g}{} at the end",
                              source.power(scene.end_time), unit)
                : source.expression + unit;
      return fmt::format("at ({}): {}", fmt::join(coordinates, ", "), strength);
    }

    std::string words(const cases::InitialState &state)
    {
      if(state.exact)
        return "the exact solution at the start time";
      std::string result = "temperature " + state.temperature.expression;
      if(state.front)
        result += fmt::format("; solid where {} < 0", state.front->expression);
      if(state.solid_fraction_at_melting != 0)
        result += fmt::format("; solid fraction {} where it is the melting point",
                              state.solid_fraction_at_melting);
      return result;
    }

    json json_of(const cases::PhaseProperties &phase)
    {
      return {{"conductivity", json_of(phase.conductivity)},
              {"specific_heat_capacity", json_of(phase.specific_heat_capacity)},
              {"density", json_of(phase.density)}};
    }

    cases::PhaseProperties phase_in(const json &json)
    {
      return {number_in(json.at("conductivity")),
              number_in(json.at("specific_heat_capacity")),
              number_in(json.at("density"))};
    }

    json json_of(const cases::Material &material)
    {
      return {{"solid", json_of(material.solid)},
              {"liquid", json_of(material.liquid)},
              {"latent_heat", json_of(material.latent_heat)},
              {"melting_temperature", json_of(material.melting_temperature)},
              {"gibbs_thomson_coefficient", json_of(material.gibbs_thomson_coefficient)}};
    }

    cases::Material material_in(const json &json)
    {
      return {phase_in(json.at("solid")), phase_in(json.at("liquid")),
              number_in(json.at("latent_heat")),
              number_in(json.at("melting_temperature")),
              number_in(json.at("gibbs_thomson_coefficient"))};
    }

    json json_of(const std::vector<cases::TimedEvent> &events)
    {
      json names = json::array();
      for(const cases::TimedEvent event : events)
        names.push_back(cases::timed_event_names[static_cast<std::size_t>(event)]);
      return names;
    }

    std::vector<cases::TimedEvent> timed_events_in(const json &names)
    {
      std::vector<cases::TimedEvent> events;
      for(std::size_t i = 0; i < cases::n_timed_events; ++i)
        for(const std::string name : names)
          if(name == cases::timed_event_names[i])
            events.push_back(static_cast<cases::TimedEvent>(i));
      return events;
    }

    json json_of(const cases::Measurement &m)
    {
      return {{"samples", m.samples},
              {"square_root_clock", m.square_root_clock},
              {"temperature_from", json_of(m.temperature_from)},
              {"temperature_to", json_of(m.temperature_to)},
              {"front_floor", json_of(m.front_floor)},
              {"monotone_front", m.monotone_front},
              {"front_mode", m.front_mode},
              {"marks", json_of(m.marks)},
              {"events", json_of(m.events)},
              {"mirror", m.mirror.value_or(-1)},
              {"picture_mark", m.picture_mark}};
    }

    cases::Measurement measurement_in(const json &stored)
    {
      cases::Measurement m;
      m.samples = stored.at("samples");
      m.square_root_clock = stored.at("square_root_clock");
      m.temperature_from = number_in(stored.at("temperature_from"));
      m.temperature_to = number_in(stored.at("temperature_to"));
      m.front_floor = number_in(stored.at("front_floor"));
      m.monotone_front = stored.at("monotone_front");
      m.front_mode = stored.value("front_mode", 0);
      m.marks = numbers_in(stored.value("marks", json::array()));
      m.events = timed_events_in(stored.value("events", json::array()));
      if(const int mirror = stored.value("mirror", -1); mirror >= 0)
        m.mirror = mirror;
      m.picture_mark = stored.value("picture_mark", 0);
      return m;
    }

    json json_of(const cases::PrintedValue &p)
    {
      return {{"source", p.source},
              {"method", p.method},
              {"quantity", p.quantity},
              {"n", p.n},
              {"value", json_of(p.value)}};
    }

    cases::PrintedValue printed_in(const json &json)
    {
      return {json.at("source"), json.at("method"), json.at("quantity"), json.at("n"),
              number_in(json.at("value"))};
    }

    /** The corners of a polygon; evenly spread points on a curve of many more vertices.
     */
    void record_outline(const cases::Outline &outline, CaseRecord &record)
    {
      constexpr int most_points = 400;
      const auto add = [&record](const auto &point)
      {
        record.outline_x.push_back(point[0]);
        record.outline_y.push_back(point[1]);
      };
      if(outline.vertices().size() > most_points)
        for(const cases::Position &point : outline.points(most_points))
          add(point);
      else
        for(const cases::Outline::Point &point : outline.vertices())
          add(point);
    }

    /** Calls visit(name, member) for each member that JSON knows as it is. */
    template <typename Record, typename Visit>
    void visit_plain(Record &record, const Visit &visit)
    {
      visit("name", record.name);
      visit("title", record.title);
      visit("description", record.description);
      visit("tags", record.tags);
      visit("limits", record.limits);
      visit("units", record.units);
      visit("symmetry", record.symmetry);
      visit("shape", record.shape);
      visit("dimension", record.dimension);
      visit("initial_state", record.initial_state);
      visit("boundaries", record.boundaries);
      visit("sources", record.sources);
      visit("exact", record.exact);
      visit("text", record.text);
      visit("hash", record.hash);
    }

    template <typename Record, typename Visit>
    void visit_conduction(Record &record, const Visit &visit)
    {
      visit("steady", record.steady);
      visit("changes_phase", record.changes_phase);
      visit("heat_release", record.heat_release);
      visit("inclusion", record.inclusion);
    }
    /** Of the phase at the wall x = 0 of a plane exact solution, else NaN. */
    double stefan_number(const cases::Case &c)
    {
      if(!c.exact || !c.exact->has_front() || !c.scene.changes_phase()
         || c.exact->symmetry() != cases::Symmetry::planar)
        return std::numeric_limits<double>::quiet_NaN();
      const cases::Material &material = c.scene.material;
      const cases::PhaseProperties &phase
          = c.exact->solid_at_origin() ? material.solid : material.liquid;
      const double wall = c.exact->temperature(0., c.scene.end_time);
      return phase.specific_heat_capacity * std::abs(wall - material.melting_temperature)
             / material.latent_heat;
    }
  } // namespace

  CaseRecord make_case_record(const cases::Case &c)
  {
    const cases::Scene &scene = c.scene;
    CaseRecord record;
    record.name = scene.name;
    record.title = c.title;
    record.description = c.description;
    record.tags = c.tags;
    record.limits = c.limits;
    record.units = scene.units;
    record.symmetry = name_of(scene.symmetry);
    record.shape = name_of(scene.domain.shape);
    record.dimension = scene.domain.dimension;
    record.lower = scene.domain.lower;
    record.upper = scene.domain.upper;
    record.radius = scene.domain.radius;
    record.inner_radius = scene.domain.inner_radius;
    record.reference_length = scene.domain.reference_length;
    if(scene.domain.outline)
      record_outline(*scene.domain.outline, record);
    record.material = scene.material;
    if(scene.alloy)
      record.alloy = make_alloy_record(scene);
    if(!scene.conducts_heat())
      record.moving = make_moving_record(c);
    record.initial_state = words(scene.initial);
    for(const cases::Side side : scene.sides())
      record.boundaries.push_back(
          fmt::format("{}: {}", cases::to_string(side), words(scene.boundary(side))));
    for(const cases::PointSource &source : scene.sources)
    {
      record.source_positions.push_back(source.position);
      record.sources.push_back(words(scene, source));
    }
    record.start_time = scene.start_time;
    record.end_time = scene.end_time;
    record.steady = scene.problem == cases::ProblemKind::poisson;
    record.changes_phase = scene.changes_phase();
    if(scene.heat_release)
      record.heat_release = scene.heat_release->expression;
    if(scene.inclusion)
      record.inclusion
          = fmt::format("conductivity {:.6g} where {} < 0", scene.inclusion->conductivity,
                        scene.inclusion->level_set.expression);
    record.exact = c.exact ? c.exact->description() : "";
    record.front_exact_end = c.exact ? c.exact->front(scene.end_time)
                                     : std::numeric_limits<double>::quiet_NaN();
    record.reference = c.reference;
    record.stefan_number = stefan_number(c);
    record.measurement = c.measurement;
    record.criteria = c.criteria;
    record.printed = c.printed;
    record.printed_figures = c.printed_figures;
    record.text = c.text;
    record.hash = sha256(c.text);
    return record;
  }

  void to_json(nlohmann::json &json, const CaseRecord &record)
  {
    json = nlohmann::json::object();
    visit_plain(record, [&](const char *name, const auto &value) { json[name] = value; });
    visit_conduction(record,
                     [&](const char *name, const auto &value) { json[name] = value; });
    json["lower"] = json_of(record.lower);
    json["upper"] = json_of(record.upper);
    json["radius"] = json_of(record.radius);
    json["inner_radius"] = json_of(record.inner_radius);
    json["outline_x"] = json_of(record.outline_x);
    json["outline_y"] = json_of(record.outline_y);
    json["reference_length"] = json_of(record.reference_length);
    if(record.reference)
      json["reference"]
          = {{"label", record.reference->label}, {"n", record.reference->n}};
    json["material"] = json_of(record.material);
    if(record.alloy)
      json["alloy"] = *record.alloy;
    if(record.moving)
      json["moving"] = *record.moving;
    json["start_time"] = json_of(record.start_time);
    json["end_time"] = json_of(record.end_time);
    json["front_exact_end"] = json_of(record.front_exact_end);
    json["stefan_number"] = json_of(record.stefan_number);
    json["variation_of"] = record.variation_of;
    json["variation"] = record.variation;
    json["measurement"] = json_of(record.measurement);
    for(const char *list : {"source_positions", "criteria", "printed"})
      json[list] = nlohmann::json::array();
    for(const cases::Position &position : record.source_positions)
      json["source_positions"].push_back(json_of(position));
    for(const cases::Criterion &criterion : record.criteria)
      json["criteria"].push_back(json_of(criterion));
    json["printed_figures"] = record.printed_figures;
    for(const cases::PrintedValue &printed : record.printed)
      json["printed"].push_back(json_of(printed));
  }

  void from_json(const nlohmann::json &json, CaseRecord &record)
  {
    record = {};
    visit_plain(record,
                [&](const char *name, auto &value) { json.at(name).get_to(value); });
    if(json.contains("steady")) // older records lack it
      visit_conduction(record, [&](const char *name, auto &value)
                       { json.at(name).get_to(value); });
    record.lower = position_in(json.at("lower"));
    record.upper = position_in(json.at("upper"));
    record.radius = number_in(json.at("radius"));
    record.inner_radius = json.contains("inner_radius") // older records lack it
                              ? number_in(json.at("inner_radius"))
                              : 0;
    if(json.contains("outline_x")) // older records lack it
    {
      record.outline_x = numbers_in(json.at("outline_x"));
      record.outline_y = numbers_in(json.at("outline_y"));
      record.reference_length = number_in(json.at("reference_length"));
    }
    if(json.contains("reference"))
      record.reference = cases::Reference{json.at("reference").at("label"),
                                          json.at("reference").at("n")};
    record.material = material_in(json.at("material"));
    if(json.contains("alloy"))
      record.alloy = json.at("alloy").get<AlloyRecord>();
    if(json.contains("moving"))
      record.moving = json.at("moving").get<MovingRecord>();
    record.start_time = number_in(json.at("start_time"));
    record.end_time = number_in(json.at("end_time"));
    record.front_exact_end = number_in(json.at("front_exact_end"));
    if(json.contains("variation")) // older records lack it
    {
      record.stefan_number = number_in(json.at("stefan_number"));
      record.variation_of = json.at("variation_of");
      json.at("variation").get_to(record.variation);
    }
    record.measurement = measurement_in(json.at("measurement"));
    for(const auto &position : json.at("source_positions"))
      record.source_positions.push_back(position_in(position));
    for(const auto &criterion : json.at("criteria"))
      record.criteria.push_back(criterion_in(criterion));
    if(json.contains("printed_figures")) // older records lack it
      json.at("printed_figures").get_to(record.printed_figures);
    for(const auto &printed : json.at("printed"))
      record.printed.push_back(printed_in(printed));
  }
} // namespace meltfront::verification
