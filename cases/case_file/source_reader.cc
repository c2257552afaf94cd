#include <cases/case_file/breakpoints.h>
#include <cases/case_file/case_keys.h>
#include <cases/case_file/expression.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/source_reader.h>
#include <cases/expression_words.h>
#include <cases/sampling.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>

namespace meltfront::cases
{
  namespace
  {
    constexpr int samples_of_path = 257;

    /** Parts of a list at its commas, but not at those within brackets. */
    std::vector<std::string> coordinates_in(const std::string &text)
    {
      std::vector<std::string> parts{""};
      int depth = 0;
      for(const char c : text)
      {
        depth += (c == '(') - (c == ')');
        if(c == ',' && depth == 0)
          parts.emplace_back();
        else
          parts.back() += c;
      }
      for(std::string &part : parts)
        part = trimmed(part);
      return parts;
    }

    bool inside(const Domain &domain, const Position &p)
    {
      if(domain.rectangular())
        for(int d = 0; d < domain.dimension; ++d)
          if(p[d] < domain.lower[d] || p[d] > domain.upper[d])
            return false;
      return contains(domain, p);
    }

    /** Where a source is: a point or a path. */
    struct Place
    {
      std::vector<std::string> words; ///< by coordinate
      Position start{};
      std::optional<Path> path;
    };

    Place read_place(const PrmFile &prm, const std::string &here, const Scene &scene)
    {
      prm.require(here, "position", "a source needs one");
      Place place;
      place.words = coordinates_in(prm.get_text(here, "position"));
      const auto wanted = static_cast<std::size_t>(scene.domain.dimension);
      if(place.words.size() != wanted)
        throw prm.error(here, "position",
                        fmt::format("needs {} coordinate{}, not {}", wanted,
                                    wanted == 1 ? "" : "s", place.words.size()));
      std::vector<Field> fields;
      try
      {
        for(const std::string &word : place.words)
          fields.push_back(parse_field(word, "t"));
      }
      catch(const InputError &error)
      {
        throw prm.error(here, "position", error.what());
      }
      const auto at = [fields](double time)
      {
        Position position{};
        for(std::size_t d = 0; d < fields.size(); ++d)
          position[d] = fields[d]({}, time);
        return position;
      };
      place.start = at(scene.start_time);
      if(std::ranges::any_of(fields, [](const Field &f) { return !f.constant; }))
        place.path = Path{prm.get_text(here, "position"), at};
      for(int i = 0; i < (place.path ? samples_of_path : 1); ++i)
      {
        const double time
            = scene.start_time
              + (scene.end_time - scene.start_time) * i / (samples_of_path - 1);
        if(!inside(scene.domain, at(time)))
          throw prm.error(here, "position",
                          place.path
                              ? fmt::format("lies outside the domain at t = {:.6g}", time)
                              : "lies outside the domain");
      }
      return place;
    }

    void check_place(const PrmFile &prm, const std::string &here, const Scene &scene,
                     const Place &place)
    {
      if(scene.symmetry != Symmetry::none && (place.path || place.start != Position{}))
        throw prm.error(here, "position",
                        fmt::format("contradicts the {} symmetry: it must be the origin",
                                    prm.get_text("Scene", "symmetry")));
    }

    PointSource read_point(const PrmFile &prm, const std::string &here,
                           const Scene &scene)
    {
      if(scene.domain.shape == DomainShape::axisymmetric)
        throw prm.subsection_error(here, "needs a 'radius' in an axisymmetric domain, "
                                         "where a point off the axis would be a ring");
      const Place place = read_place(prm, here, scene);
      check_place(prm, here, scene, place);
      PointSource source;
      source.position = place.start;
      source.path = place.path;
      source.expression = prm.get_text(here, "power");
      if(source.expression == exact_value)
      {
        if(source.path)
          throw prm.error(here, "position",
                          "must not move where the power is the exact solution's");
        return source;
      }
      try
      {
        const Field field = parse_field(source.expression, "t");
        source.power = [field](double time) { return field({}, time); };
      }
      catch(const InputError &error)
      {
        throw prm.error(here, "power", error.what());
      }
      return source;
    }

    /** A Gaussian spot as an expression of the power density, so that all that is done to
     * expressions is done to it: P exp(-(d/R)^2)/(sqrt(pi) R)^m, with m = 2 for a line
     * across the plane and 3 in space. */
    std::string gaussian(const PrmFile &prm, const std::string &here, const Scene &scene)
    {
      const Domain &domain = scene.domain;
      const bool turned = domain.shape == DomainShape::axisymmetric;
      const Place place = read_place(prm, here, scene);
      check_place(prm, here, scene, place);
      if(turned && place.words[0] != "0")
        throw prm.error(here, "position",
                        "must lie on the axis: its first coordinate is 0");
      if(prm.get_text(here, "power") == exact_value)
        throw prm.error(here, "power", "cannot be 'exact' of a source with a radius");
      if(is_table(prm.get_text(here, "power")))
        throw prm.error(here, "power", "cannot be a table of a source with a radius");
      std::string squares;
      for(int d = 0; d < domain.dimension; ++d)
        squares
            += fmt::format("{}({}-({}))^2", d == 0 ? "" : "+", "xyz"[d], place.words[d]);
      const double radius = prm.get_number(here, "radius");
      const int space = turned ? 3 : domain.dimension;
      return fmt::format("({})*exp(-({})/{})/{}", prm.get_text(here, "power"), squares,
                         radius * radius,
                         std::pow(std::sqrt(std::numbers::pi) * radius, space));
    }

    void release_throughout(const PrmFile &prm, const std::string &here,
                            const std::string &expression, Scene &scene)
    {
      std::string all = expression;
      if(scene.volumetric_source)
      {
        if(scene.volumetric_source->expression == exact_value)
          throw prm.subsection_error(
              here, "cannot have a radius where 'power density' is exact");
        all = scene.volumetric_source->expression + " + " + expression;
      }
      try
      {
        scene.volumetric_source = parse_field(
            all, std::string("xyz").substr(0, scene.domain.dimension) + "t");
      }
      catch(const InputError &error)
      {
        throw prm.error(here, "power", error.what());
      }
    }

    /** The subsections of the points, in the order of Scene::sources. */
    std::vector<std::string> opened_points(const PrmFile &prm)
    {
      std::vector<std::string> points = opened_sources(prm);
      std::erase_if(points, [&prm](const std::string &here)
                    { return prm.given(here, "radius"); });
      return points;
    }

    /** The source's energy: the integral of its power, piece by piece between the times
     * at which that breaks. */
    void integrate_power(const PrmFile &prm, const std::string &here, const Scene &scene,
                         PointSource &source)
    {
      const double start = scene.start_time;
      Field field = parse_field(source.expression, "t");
      if(field.constant)
      {
        source.energy = [power = field({}, 0), start](double time)
        { return power * (time - start); };
        return;
      }
      try
      {
        add_breakpoints(field, {Position{}}, start, scene.end_time);
      }
      catch(const InputError &error)
      {
        throw prm.error(here, "power", error.what());
      }
      source.energy
          = integral_from(source.power, start, scene.end_time, field.breakpoints);
    }
  } // namespace

  std::vector<std::string> opened_sources(const PrmFile &prm)
  {
    std::vector<std::string> subsections;
    for(int i = 1; i <= most_sources; ++i)
      if(const std::string here = fmt::format("Scene/Source {}", i); prm.opened(here))
        subsections.push_back(here);
    return subsections;
  }

  void read_sources(const PrmFile &prm, Scene &scene)
  {
    for(const std::string &here : opened_sources(prm))
    {
      if(scene.domain.shape == DomainShape::slab)
        throw prm.subsection_error(here, "has no meaning in a slab; a line or point "
                                         "source needs a box, a ball or a shell");
      prm.require(here, "position", "a source needs one");
      prm.require(here, "power", "a source needs one");
      if(prm.given(here, "radius"))
        release_throughout(prm, here, gaussian(prm, here, scene), scene);
      else
        scene.sources.push_back(read_point(prm, here, scene));
    }
  }

  void complete_sources(const PrmFile &prm, const KnownSolution &known, Scene &scene)
  {
    const std::vector<std::string> subsections = opened_points(prm);
    for(std::size_t i = 0; i < subsections.size(); ++i)
    {
      PointSource &source = scene.sources[i];
      if(source.expression != exact_value)
      {
        integrate_power(prm, subsections[i], scene, source);
        continue;
      }
      if(!known.power)
        throw prm.error(subsections[i], "power",
                        "is 'exact' but the exact solution is not that of a sink");
      source.power = known.power;
      source.energy
          = [energy = known.energy, before = known.energy(scene.start_time)](double time)
      { return energy(time) - before; };
    }
  }
} // namespace meltfront::cases
