#include <cases/domain_measure.h>
#include <cases/error.h>
#include <cases/expression_words.h>
#include <cases/scene.h>
#include <verification/external/protocol.h>
#include <verification/external/sample_places.h>
#include <verification/external/scene_json.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>

namespace meltfront::verification::external
{
  namespace
  {
    using cases::Position;
    using nlohmann::json;

    constexpr double most_samples = 4e6;

    /** What case files call a value that an exact solution gives. */
    const std::string exact_word = "exact";

    json quantity(double value, const char *unit)
    {
      return {{"value", value}, {"unit", unit}};
    }

    json quantities(const std::vector<double> &values, const char *unit)
    {
      return {{"values", values}, {"unit", unit}};
    }

    /** Points one row for each dimension. */
    json rows_of(const std::vector<Position> &points, int dimension)
    {
      json rows = json::array();
      for(int d = 0; d < dimension; ++d)
      {
        std::vector<double> row;
        for(const Position &point : points)
          row.push_back(point[d]);
        rows.push_back(row);
      }
      return rows;
    }

    json curve_json(const cases::PropertyCurve &curve, const char *unit)
    {
      return {{"unit", unit},
              {"expression", curve.words()},
              {"temperatures", curve.temperatures()},
              {"values", curve.values()}};
    }

    json phase_json(const cases::PhaseProperties &phase)
    {
      json result{
          {"conductivity", quantity(phase.conductivity, "W/(m K)")},
          {"specific_heat_capacity", quantity(phase.specific_heat_capacity, "J/(kg K)")},
          {"density", quantity(phase.density, "kg/m^3")}};
      if(phase.conductivity_curve)
        result["conductivity_curve"] = curve_json(*phase.conductivity_curve, "W/(m K)");
      if(phase.heat_capacity_curve)
        result["heat_capacity_curve"]
            = curve_json(*phase.heat_capacity_curve, "J/(kg K)");
      return result;
    }

    json material_json(const cases::Material &material)
    {
      json result{{"solid", phase_json(material.solid)},
                  {"liquid", phase_json(material.liquid)},
                  {"latent_heat", quantity(material.latent_heat, "J/kg")},
                  {"melting_temperature", quantity(material.melting_temperature, "K")},
                  {"gibbs_thomson_coefficient",
                   quantity(material.gibbs_thomson_coefficient, "K m")}};
      if(material.melting_range)
        result["melting_range"] = {
            {"solidus", quantity(material.melting_range->solidus, "K")},
            {"liquidus", quantity(material.melting_range->liquidus, "K")},
            {"solid_fraction", curve_json(*material.melting_range->solid_fraction, "1")}};
      return result;
    }

    /** The half section of a body about an axis stands for all of it. */
    bool in_space(const cases::Domain &domain)
    {
      return domain.dimension == 3 || domain.shape == cases::DomainShape::axisymmetric;
    }

    json domain_json(const cases::Domain &domain)
    {
      json result{
          {"shape", to_string(domain.shape)},
          {"dimension", domain.dimension},
          {"side", quantity(domain.side(), "m")},
          {"volume", quantity(cases::volume_of(domain), domain.dimension == 1 ? "m"
                                                        : in_space(domain)    ? "m^3"
                                                                              : "m^2")}};
      if(domain.round())
      {
        result["radius"] = quantity(domain.radius, "m");
        result["inner_radius"] = quantity(domain.inner_radius, "m");
        return result;
      }
      const auto corner = [&domain](const Position &p)
      { return std::vector(p.begin(), p.begin() + domain.dimension); };
      result["lower"] = quantities(corner(domain.lower), "m");
      result["upper"] = quantities(corner(domain.upper), "m");
      if(domain.outline)
      {
        std::vector<Position> vertices;
        for(const auto &[x, y] : domain.outline->vertices())
          vertices.push_back({x, y, 0});
        result["vertices"] = {{"values", rows_of(vertices, 2)}, {"unit", "m"}};
      }
      return result;
    }

    /** Writes a scene's fields and courses. */
    class Tables
    {
    public:
      Tables(const cases::Scene &scene, int n, const Sampling &sampling)
        : scene(scene)
        , n(n)
        , sampling(sampling)
      {
        for(int i = 0; i < sampling.times; ++i)
          times.push_back(scene.start_time
                          + i * (scene.end_time - scene.start_time)
                                / (sampling.times - 1));
        times.back() = scene.end_time;
      }

      /** In the domain; at the start alone, or over time. */
      json field(const cases::Field &of, const char *unit, bool at_start) const
      {
        return field_json(
            of, unit, [this] { return places_in(scene, n, sampling.at_vertices); },
            at_start ? std::vector{scene.start_time} : times);
      }

      json on_wall(const cases::Field &of, const char *unit, cases::Side side) const
      {
        return field_json(
            of, unit,
            [this, side] { return places_on(scene, side, n, sampling.at_vertices); },
            times);
      }

      json course(const std::function<double(double)> &value, const char *unit) const
      {
        std::vector<double> values;
        for(const double time : times)
          values.push_back(value(time));
        return {{"unit", unit}, {"times", times}, {"values", values}};
      }

      json path(const cases::Path &of) const
      {
        std::vector<Position> points;
        for(const double time : times)
          points.push_back(of.position(time));
        return {{"unit", "m"},
                {"expression", of.expression},
                {"times", times},
                {"values", rows_of(points, scene.domain.dimension)}};
      }

    private:
      json field_json(const cases::Field &of, const char *unit,
                      const std::function<std::vector<Position>()> &places,
                      const std::vector<double> &at_times) const
      {
        json result{
            {"unit", unit}, {"expression", of.expression}, {"constant", of.constant}};
        if(of.constant)
        {
          result["value"] = of({}, scene.start_time);
          return result;
        }
        if(!of.breakpoints.empty())
          result["breakpoints"] = of.breakpoints;
        if(sampling.expressions || of.expression == exact_word
           || cases::is_table(of.expression))
          result["samples"] = samples_json(of, places(), at_times);
        return result;
      }

      json samples_json(const cases::Field &of, const std::vector<Position> &places,
                        const std::vector<double> &at_times) const
      {
        const double count
            = static_cast<double>(places.size()) * static_cast<double>(at_times.size());
        if(count > most_samples)
          throw cases::Refusal(fmt::format(
              "would have to be told {:.2g} values of '{}', and at most {:.0e} are "
              "written: ask for fewer times (samples in the manifest)",
              count, quoted(of.expression), most_samples));
        json values = json::array();
        for(const double time : at_times)
        {
          json row = json::array();
          for(const Position &place : places)
          {
            const double value = of(place, time);
            row.push_back(std::isfinite(value) ? json(value) : json(nullptr));
          }
          values.push_back(std::move(row));
        }
        return {{"times", at_times},
                {"positions", rows_of(places, scene.domain.dimension)},
                {"values", std::move(values)}};
      }

      const cases::Scene &scene;
      int n;
      const Sampling &sampling;
      std::vector<double> times;
    };

    json wall_json(const cases::Boundary &wall, cases::Side side, const Tables &tables)
    {
      using cases::BoundaryKind;
      json result{{"kind", to_string(wall.kind)}};
      switch(wall.kind)
      {
      case BoundaryKind::fixed_temperature:
        result["temperature"] = tables.on_wall(wall.value, "K", side);
        break;
      case BoundaryKind::flux:
        result["flux"] = tables.on_wall(wall.value, "W/m^2", side);
        break;
      case BoundaryKind::heat_transfer:
        result["ambient_temperature"] = tables.on_wall(wall.value, "K", side);
        result["heat_transfer_coefficient"]
            = quantity(wall.heat_transfer_coefficient, "W/(m^2 K)");
        break;
      case BoundaryKind::radiation:
        result["ambient_temperature"] = tables.on_wall(wall.value, "K", side);
        result["emission_coefficient"]
            = quantity(wall.emission_coefficient, "W/(m^2 K^4)");
        result["absolute_zero"] = quantity(wall.absolute_zero, "K");
        break;
      default:
        break;
      }
      return result;
    }

    json initial_json(const cases::InitialState &initial, const Tables &tables)
    {
      json result{{"temperature", tables.field(initial.temperature, "K", true)},
                  {"solid_fraction_at_melting",
                   quantity(initial.solid_fraction_at_melting, "1")}};
      if(initial.front)
        result["front"] = tables.field(*initial.front, "m", true);
      return result;
    }

    json sources_json(const cases::Scene &scene, const Tables &tables)
    {
      const bool whole = in_space(scene.domain);
      json list = json::array();
      for(const cases::PointSource &source : scene.sources)
      {
        const Position &p = source.position;
        json one{{"position",
                  quantities({p.begin(), p.begin() + scene.domain.dimension}, "m")},
                 {"power", tables.course(source.power, whole ? "W" : "W/m")},
                 {"energy", tables.course(source.energy, whole ? "J" : "J/m")}};
        one["power"]["expression"] = source.expression;
        if(source.path)
          one["path"] = tables.path(*source.path);
        list.push_back(std::move(one));
      }
      return list;
    }

    const char *word_of(cases::Symmetry symmetry)
    {
      constexpr const char *words[] = {"planar", "cylindrical", "spherical", "none"};
      return words[static_cast<std::size_t>(symmetry)];
    }

    /** The values in use, by key, each in its type. */
    json options_json(const cases::Options &options)
    {
      json result = json::object();
      for(const cases::OptionDeclaration &option : options.declarations())
        switch(option.default_value.index())
        {
        case 0:
          result[option.key] = options.get_bool(option.key);
          break;
        case 1:
          result[option.key] = options.get_integer(option.key);
          break;
        case 2:
          result[option.key] = options.get_double(option.key);
          break;
        default:
          result[option.key] = options.get_string(option.key);
        }
      return result;
    }
  } // namespace

  json scene_json(const cases::Scene &scene, int n, const Sampling &sampling)
  {
    if(!scene.conducts_heat() || scene.alloy || scene.particle_solid)
      throw cases::Refusal("has no words for alloys, particle solids and fronts that a "
                           "velocity carries along");
    const Tables tables(scene, n, sampling);
    json result{{"name", scene.name},
                {"units", scene.units},
                {"problem", to_string(scene.problem)},
                {"symmetry", word_of(scene.symmetry)},
                {"start_time", quantity(scene.start_time, "s")},
                {"end_time", quantity(scene.end_time, "s")},
                {"domain", domain_json(scene.domain)},
                {"material", material_json(scene.material)},
                {"initial", initial_json(scene.initial, tables)},
                {"walls", json::object()},
                {"sources", sources_json(scene, tables)}};
    for(const cases::Side side : scene.sides())
      result["walls"][name_of(scene.domain, side)]
          = wall_json(scene.boundary(side), side, tables);
    if(scene.volumetric_source)
      result["volumetric_source"]
          = tables.field(*scene.volumetric_source, "W/m^3",
                         scene.problem == cases::ProblemKind::poisson);
    if(scene.inclusion)
      result["inclusion"]
          = {{"level_set", tables.field(scene.inclusion->level_set, "m", true)},
             {"conductivity", quantity(scene.inclusion->conductivity, "W/(m K)")}};
    return result;
  }

  json request_json(const cases::Scene &scene, const cases::EffectSet &effects,
                    const cases::Resolution &resolution,
                    const cases::Options &options_of_program,
                    const std::vector<double> &times, const Sampling &sampling)
  {
    json on = json::array();
    for(const cases::EffectDecision &decision : effects.decisions())
      if(decision.on)
        on.push_back(to_string(decision.effect));
    return {{"protocol", protocol},
            {"n", resolution.n},
            {"seed", resolution.seed},
            {"threads", resolution.threads},
            {"spacing", quantity(scene.domain.side() / resolution.n, "m")},
            {"options", options_json(options_of_program)},
            {"effects", on},
            {"times", quantities(times, "s")},
            {"scene", scene_json(scene, resolution.n, sampling)}};
  }
} // namespace meltfront::verification::external
