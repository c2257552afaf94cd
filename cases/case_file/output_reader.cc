#include <cases/case_file/case_keys.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/output_reader.h>
#include <cases/sampling.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    const std::string output_keys = "Output";

    /** Within the domain or on its walls. */
    bool in_or_on(const Domain &domain, const Position &p)
    {
      if(domain.rectangular())
      {
        for(int d = 0; d < domain.dimension; ++d)
          if(p[d] < domain.lower[d] || p[d] > domain.upper[d])
            return false;
        return true;
      }
      if(!domain.round())
        return contains(domain, p);
      constexpr double round_off = 1e-12;
      const double r = std::hypot(p[0], p[1], p[2]);
      return r >= domain.inner_radius * (1 - round_off)
             && r <= domain.radius * (1 + round_off);
    }

    Position place(const PrmFile &prm, const std::string &key, const Scene &scene,
                   const std::vector<double> &numbers, std::size_t first)
    {
      Position position{};
      for(int d = 0; d < scene.domain.dimension; ++d)
        position[d] = numbers[first + d];
      if(!in_or_on(scene.domain, position))
        throw prm.error(output_keys, key, "lies outside of the domain");
      return position;
    }

    /** Numbers of a key, as many coordinates as so many places have. */
    std::vector<double> coordinates(const PrmFile &prm, const std::string &key,
                                    const Scene &scene, int places)
    {
      const std::vector<double> numbers = prm.get_numbers(output_keys, key);
      const int wanted = places * scene.domain.dimension;
      if(static_cast<int>(numbers.size()) != wanted)
        throw prm.error(output_keys, key,
                        fmt::format("needs {} number{} in this domain, not {}", wanted,
                                    wanted == 1 ? "" : "s", numbers.size()));
      return numbers;
    }

    std::vector<double> line_times(const PrmFile &prm, const Scene &scene)
    {
      const std::string key = "line times";
      std::vector<double> times;
      if(prm.given(output_keys, key))
        times = prm.get_numbers(output_keys, key);
      double before = -INFINITY;
      for(const double time : times)
      {
        if(!(time > before && time >= scene.start_time && time <= scene.end_time))
          throw prm.error(
              output_keys, key,
              fmt::format("must ascend from the scene's start ({:.6g}) to its end "
                          "({:.6g}), which {:.6g} does not",
                          scene.start_time, scene.end_time, time));
        before = time;
      }
      if(times.empty() || times.back() < scene.end_time)
        times.push_back(scene.end_time);
      return times;
    }
  } // namespace

  void declare_output(PrmFile &prm)
  {
    prm.declare_numbered(
        output_keys,
        numbers_key("probe", "m",
                    "A point whose temperature and solid fraction are written over time "
                    "by 'run', to probes.csv: as many coordinates as the domain has "
                    "dimensions; in symmetric scenes of a disk, ball or shell any point "
                    "at that distance."),
        most_probes);
    prm.declare(output_keys, integer_key("probe samples", "200", 1, 100000,
                                         "Times over the run at which probes are read."));
    PrmEntry line = numbers_key(
        "line", "m",
        "A straight line along which both are written, to line-1.csv and so on: the "
        "coordinates of its first point, then those of its last.");
    line.most_values = 6;
    prm.declare_numbered(output_keys, line, most_probes);
    prm.declare(output_keys,
                integer_key("line points", "101", 2, 100000, "Points along each line."));
    PrmEntry times = numbers_key("line times", "s",
                                 "Times, ascending, at which lines are written beside "
                                 "the end.");
    times.most_values = 8;
    prm.declare(output_keys, times);
  }

  OutputRequest read_output(const PrmFile &prm, const Scene &scene)
  {
    OutputRequest output;
    if(!prm.opened(output_keys))
      return output;
    if(!scene.conducts_heat())
      throw prm.subsection_error(output_keys,
                                 "has no meaning here: the scene has no temperature");
    for(const int i : prm.given_numbers(output_keys, "probe"))
    {
      const std::string key = fmt::format("probe {}", i);
      output.probes.push_back(place(prm, key, scene, coordinates(prm, key, scene, 1), 0));
    }
    for(const int i : prm.given_numbers(output_keys, "line"))
    {
      const std::string key = fmt::format("line {}", i);
      const std::vector<double> numbers = coordinates(prm, key, scene, 2);
      output.lines.push_back({place(prm, key, scene, numbers, 0),
                              place(prm, key, scene, numbers, numbers.size() / 2)});
    }
    output.probe_samples
        = static_cast<int>(prm.get_integer(output_keys, "probe samples"));
    output.line_points = static_cast<int>(prm.get_integer(output_keys, "line points"));
    output.line_times = line_times(prm, scene);
    return output;
  }

  OutputRequest output_of(const Case &c)
  {
    PrmFile prm = case_keys();
    prm.read_text(c.text, c.file);
    return read_output(prm, c.scene);
  }
} // namespace meltfront::cases
