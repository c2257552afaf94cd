#include <cases/case_file/alloy_reader.h>
#include <cases/case_file/case_checks.h>
#include <cases/case_file/case_file.h>
#include <cases/case_file/case_keys.h>
#include <cases/case_file/conduction_reader.h>
#include <cases/case_file/criterion_parser.h>
#include <cases/case_file/effect_checks.h>
#include <cases/case_file/exact_reader.h>
#include <cases/case_file/key_list.h>
#include <cases/case_file/material_reader.h>
#include <cases/case_file/output_reader.h>
#include <cases/case_file/prm_library.h>
#include <cases/case_file/prm_scan.h>
#include <cases/case_file/scene_reader.h>
#include <cases/data_folder.h>
#include <cases/options.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace meltfront::cases
{
  namespace
  {
    PrmLibrary library()
    {
      return {data_path("cases/library"), "case"};
    }

    /** Call a parser of one value; its complaint gets file, line and key. */
    template <typename Parse>
    auto at_key(const PrmFile &prm, const std::string &subsection, const std::string &key,
                const Parse &parse)
    {
      try
      {
        return parse(prm.get_text(subsection, key));
      }
      catch(const InputError &error)
      {
        throw prm.error(subsection, key, error.what());
      }
    }

    std::vector<std::string> read_tags(const PrmFile &prm)
    {
      std::vector<std::string> tags;
      for(const std::string &tag : split_list(prm.get_text("", "tags"), ','))
        if(!tag.empty())
          tags.push_back(tag);
      return tags;
    }

    std::vector<TimedEvent> parse_events(const std::string &text)
    {
      const std::vector<std::string> names(timed_event_names.begin(),
                                           timed_event_names.end());
      std::vector<TimedEvent> events;
      for(const std::string &word : split_list(text, ','))
      {
        const auto found = std::find(names.begin(), names.end(), word);
        if(found == names.end())
          throw InputError(
              fmt::format("names the unknown event '{}'; the nearest is '{}'",
                          quotable(word), nearest_name(word, names)));
        events.push_back(static_cast<TimedEvent>(found - names.begin()));
      }
      return events;
    }

    Measurement read_measurement(const PrmFile &prm)
    {
      const std::string here = "Measure";
      Measurement measurement;
      measurement.samples = static_cast<int>(prm.get_integer(here, "samples"));
      if(measurement.samples != 0 && measurement.samples < 50)
        throw prm.error(here, "samples",
                        "must be at least 50, or 0 for every step: fewer times do not "
                        "average over a front that moves inside a cell");
      measurement.square_root_clock = prm.get_text(here, "clock") == "sqrt(t)";
      measurement.temperature_from = prm.get_number(here, "temperature from");
      if(prm.given(here, "temperature to"))
        measurement.temperature_to = prm.get_number(here, "temperature to");
      if(!(measurement.temperature_from < measurement.temperature_to))
        throw prm.error(here, "temperature to", "must exceed 'temperature from'");
      measurement.front_floor = prm.get_number(here, "front floor");
      measurement.monotone_front = prm.get_boolean(here, "monotone front");
      measurement.front_mode = static_cast<int>(prm.get_integer(here, "front mode"));
      if(prm.given(here, "front square from"))
        measurement.front_square_from = prm.get_number(here, "front square from");
      if(prm.given(here, "intermediate times"))
        measurement.intermediate_times = prm.get_numbers(here, "intermediate times");
      if(prm.given(here, "events"))
        measurement.events = at_key(prm, here, "events", parse_events);
      measurement.picture_time
          = static_cast<int>(prm.get_integer(here, "picture time number"));
      if(measurement.picture_time
         > static_cast<int>(measurement.intermediate_times.size()))
        throw prm.error(
            here, "picture time number",
            fmt::format("({}) counts the intermediate times, of which there are {}",
                        measurement.picture_time, measurement.intermediate_times.size()));
      const std::string mirror = prm.get_text(here, "mirror");
      if(mirror != "none")
        measurement.mirror = mirror[0] - 'x';
      if(prm.given(here, "absolute zero"))
        measurement.absolute_zero = prm.get_number(here, "absolute zero");
      return measurement;
    }

    /** What is measured must lie within the scene. */
    void check_measurement(const PrmFile &prm, const Case &c)
    {
      const std::string here = "Measure";
      const double coldest = temperature_bounds(c.scene).lower;
      if(c.measurement.absolute_zero && !(coldest > *c.measurement.absolute_zero))
        throw prm.error(here, "absolute zero",
                        fmt::format("({:.6g}) must lie below every temperature of the "
                                    "scene, which may fall to {:.6g}",
                                    *c.measurement.absolute_zero, coldest));
      double before = c.scene.start_time;
      for(const double intermediate : c.measurement.intermediate_times)
      {
        if(!(intermediate > before && intermediate < c.scene.end_time))
          throw prm.error(
              here, "intermediate times",
              fmt::format("must ascend between the scene's start ({}) and its "
                          "end ({}), which {} does not",
                          c.scene.start_time, c.scene.end_time, intermediate));
        before = intermediate;
      }
      if(c.measurement.front_mode > 0
         && !(c.scene.domain.round() && c.scene.domain.dimension == 2
              && c.scene.symmetry == Symmetry::none))
        prm.forbid(here, "front mode",
                   "only a disk or a shell in 2 dimensions without symmetry has modes");
    }

    /** Events and symmetries that the scene cannot show. */
    void check_events(const PrmFile &prm, const Case &c)
    {
      const std::string here = "Measure";
      long sinks = 0;
      for(const PointSource &source : c.scene.sources)
        sinks += source.energy(c.scene.end_time) < 0;
      for(const TimedEvent event : c.measurement.events)
        if(event == TimedEvent::first_contact && sinks < 2)
          throw prm.error(here, "events",
                          fmt::format("holds first_contact, which is that of the ice "
                                      "around two sinks; the scene has {}",
                                      sinks));
      if(c.measurement.mirror.value_or(0) >= c.scene.domain.dimension)
        throw prm.error(here, "mirror",
                        fmt::format("names a direction that a scene of {} dimension{} "
                                    "lacks",
                                    c.scene.domain.dimension,
                                    c.scene.domain.dimension == 1 ? "" : "s"));
    }

    std::optional<Reference> read_reference(const PrmFile &prm, const Case &c)
    {
      const std::string here = "Reference";
      if(!prm.opened(here))
        return {};
      for(const char *key : {"method", "n"})
      {
        if(c.exact)
          prm.forbid(here, key, "there is an exact solution");
        prm.require(here, key, "a reference is a method at a resolution");
      }
      return Reference{at_key(prm, here, "method", parse_label),
                       static_cast<int>(prm.get_integer(here, "n"))};
    }

    void read_lists(const PrmFile &prm, Case &c)
    {
      for(const int i : prm.given_numbers("Acceptance", "criterion"))
        c.criteria.push_back(
            at_key(prm, "Acceptance", fmt::format("criterion {}", i), parse_criterion));
      const std::string paper = prm.get_text("Printed", "source");
      for(const int i : prm.given_numbers("Printed", "value"))
      {
        prm.require("Printed", "source", "printed values need the paper they are from");
        c.printed.push_back(at_key(prm, "Printed", fmt::format("value {}", i),
                                   [&paper](const std::string &text)
                                   { return parse_printed_value(text, paper); }));
      }
      for(const std::string name : figure_names)
        if(prm.given("Printed", name + " figure"))
        {
          prm.require("Printed", "source", "a printed figure needs the paper it is in");
          c.printed_figures[name]
              = paper + ", " + prm.get_text("Printed", name + " figure");
        }
      for(const int i : prm.given_numbers("Limits", "limit"))
        c.limits.push_back(prm.get_text("Limits", fmt::format("limit {}", i)));
    }

    Case assemble(const PrmFile &prm, const std::string &file)
    {
      Case c;
      prm.require("", "title", "every case has one");
      c.title = prm.get_text("", "title");
      c.description = prm.get_text("", "description");
      c.effect_tolerance = read_effect_tolerance(prm);
      c.tags = read_tags(prm);
      c.file = file;
      c.text = prm.text();
      c.measurement = read_measurement(prm);
      read_lists(prm, c);
      c.scene = read_scene(prm);
      c.scene.name = std::filesystem::path(file).stem().string();
      const KnownSolution known = read_exact_solution(prm, c.scene);
      c.exact = known.solution;
      complete_scene(prm, known, c.scene);
      check_effects(prm, c.scene);
      check_fields(prm, c.scene);
      check_material(prm, c.scene);
      find_scene_breakpoints(prm, c.scene);
      check_alloy(prm, c.scene, sample_points(c.scene.domain));
      check_conduction(prm, c.scene, sample_points(c.scene.domain));
      check_exact_solution(prm, c);
      c.reference = read_reference(prm, c);
      check_measurement(prm, c);
      check_events(prm, c);
      read_output(prm, c.scene); // what is wrong with it is said now
      return c;
    }
  } // namespace

  Case read_case(const std::string &path)
  {
    PrmFile prm = case_keys();
    prm.read(path);
    return assemble(prm, path);
  }

  Case read_case_text(const std::string &text, const std::string &file)
  {
    PrmFile prm = case_keys();
    prm.read_text(text, file);
    return assemble(prm, file);
  }

  std::vector<std::string> library_names()
  {
    return library().names();
  }

  std::string library_title(const std::string &name)
  {
    const std::string path = library().path(name);
    const PrmScan scan = scan_prm(
        expand_includes(read_prm_text(path), path, data_path("cases/library")));
    std::string title;
    for(const PrmAssignment &assignment : scan.assignments)
      if(assignment.subsection.empty() && assignment.key == "title")
        title = assignment.value;
    return title;
  }

  std::string library_path(const std::string &name)
  {
    return library().path(name);
  }

  Case load_case(const std::string &name_or_path)
  {
    return read_case(library().find(name_or_path));
  }

  std::string case_file_reference()
  {
    return case_keys().reference();
  }

  std::vector<PrmKey> case_file_keys()
  {
    return case_keys().declarations();
  }
} // namespace meltfront::cases
