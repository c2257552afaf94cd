#include <cases/case_file/output_reader.h>
#include <cases/error.h>
#include <verification/app/probe_writer.h>
#include <verification/run/temperature_probes.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace meltfront::verification
{
  namespace
  {
    constexpr const char *axes[] = {"x", "y", "z"};

    void remove_earlier_output(const std::string &directory)
    {
      for(const auto &entry : std::filesystem::directory_iterator(directory))
      {
        const std::string name = entry.path().filename().string();
        if(name == "probes.csv" || (name.starts_with("line-") && name.ends_with(".csv")))
          std::filesystem::remove(entry.path());
      }
    }

    std::ofstream opened(const std::string &path, const std::string &header)
    {
      std::ofstream out(path);
      if(!(out << header << '\n'))
        throw cases::OutputError(fmt::format("cannot write {}", path));
      return out;
    }

    void write_row(std::ofstream &out, const std::string &row)
    {
      if(!(out << row << std::endl))
        throw cases::OutputError("cannot write what the probes say");
    }

    cases::Position point_of(const cases::OutputLine &line, double share)
    {
      cases::Position point{};
      for(int d = 0; d < 3; ++d)
        point[d] = line.from[d] + share * (line.to[d] - line.from[d]);
      return point;
    }

    double length_of(const cases::OutputLine &line)
    {
      return std::hypot(line.to[0] - line.from[0], line.to[1] - line.from[1],
                        line.to[2] - line.from[2]);
    }
  } // namespace

  ProbeWriter::ProbeWriter(const std::string &directory, const cases::Case &c)
    : scene(c.scene)
    , output(cases::output_of(c))
  {
    remove_earlier_output(directory);
    if(!output.probes.empty())
    {
      std::string header = "time";
      for(std::size_t i = 1; i <= output.probes.size(); ++i)
        header += fmt::format(",temperature_{0},solid_fraction_{0}", i);
      probes = opened(directory + "/probes.csv", header);
    }
    std::string coordinates;
    for(int d = 0; d < c.scene.domain.dimension; ++d)
      coordinates += fmt::format("{},", axes[d]);
    for(std::size_t i = 1; i <= output.lines.size(); ++i)
      lines.push_back(
          opened(fmt::format("{}/line-{}.csv", directory, i),
                 fmt::format("time,{}distance,temperature,solid_fraction", coordinates)));
  }

  void ProbeWriter::begin(const cases::RunDescription &description)
  {
    spacing = description.spacing;
  }

  bool ProbeWriter::probes_due(double time) const
  {
    // A step may end a rounding error before the time.
    const int samples = output.probe_samples;
    const double share
        = (time - scene.start_time) / (scene.end_time - scene.start_time) + 1e-9;
    return !output.probes.empty() && samples * share >= next_sample;
  }

  bool ProbeWriter::lines_due(double time) const
  {
    const std::vector<double> &times = output.line_times;
    const double margin = 1e-9 * (scene.end_time - scene.start_time);
    return !lines.empty() && next_line_time < times.size()
           && time >= times[next_line_time] - margin;
  }

  bool ProbeWriter::wants(long, double time)
  {
    return probes_due(time) || lines_due(time);
  }

  void ProbeWriter::observe(const cases::Snapshot &snapshot)
  {
    if(probes_due(snapshot.time))
    {
      write_probes(snapshot);
      while(next_sample <= output.probe_samples && probes_due(snapshot.time))
        ++next_sample;
    }
    if(lines_due(snapshot.time))
    {
      write_lines(snapshot);
      while(lines_due(snapshot.time))
        ++next_line_time;
    }
  }

  void ProbeWriter::write_probes(const cases::Snapshot &snapshot)
  {
    std::string row = fmt::format("{:.16g}", snapshot.time);
    for(const PlaceReading &reading :
        read_places(scene, snapshot, spacing, output.probes))
      row += fmt::format(",{:.12g},{:.12g}", reading.temperature, reading.solid_fraction);
    write_row(probes, row);
  }

  void ProbeWriter::write_lines(const cases::Snapshot &snapshot)
  {
    const int points = output.line_points;
    for(std::size_t k = 0; k < lines.size(); ++k)
    {
      const cases::OutputLine &line = output.lines[k];
      std::vector<cases::Position> places;
      for(int i = 0; i < points; ++i)
        places.push_back(point_of(line, double(i) / (points - 1)));
      const std::vector<PlaceReading> readings
          = read_places(scene, snapshot, spacing, places);
      for(int i = 0; i < points; ++i)
      {
        std::string row = fmt::format("{:.16g}", snapshot.time);
        for(int d = 0; d < scene.domain.dimension; ++d)
          row += fmt::format(",{:.12g}", places[i][d]);
        write_row(lines[k],
                  fmt::format("{},{:.12g},{:.12g},{:.12g}", row,
                              length_of(line) * i / (points - 1), readings[i].temperature,
                              readings[i].solid_fraction));
      }
    }
  }
} // namespace meltfront::verification
