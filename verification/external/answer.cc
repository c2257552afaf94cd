#include <cases/domain_measure.h>
#include <cases/error.h>
#include <verification/external/answer.h>
#include <verification/external/protocol.h>
#include <verification/record/json_values.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meltfront::verification::external
{
  namespace
  {
    using nlohmann::json;

    /** Relative: what is rounded to some ten digits on its way is the same. */
    constexpr double same = 1e-9;

    /** A cell that is larger than so many of side / n is not of that resolution. */
    constexpr double largest_spacing = 2;

    void take_rows(const json &rows, std::array<std::vector<double>, 3> &into)
    {
      for(std::size_t d = 0; d < into.size(); ++d)
        into[d] = d < rows.size() ? rows[d].get<std::vector<double>>()
                                  : std::vector<double>();
    }

    bool same_length(const json &rows)
    {
      return std::ranges::all_of(rows, [&rows](const json &row)
                                 { return row.size() == rows.front().size(); });
    }
  } // namespace

  Answer::Answer(const std::string &path, Expected of_run)
    : expected(std::move(of_run))
    , in(path, std::ios::binary)
  {
    take_start(message("start"));
  }

  void Answer::fail(const std::string &problem) const
  {
    throw ProgramError(
        fmt::format("{}: line {} of its answer {}", expected.who, line_number, problem));
  }

  /** The next line that is not blank; false at the end of the file. */
  bool Answer::read_line()
  {
    std::string block(1 << 16, '\0');
    for(;;)
    {
      line.clear();
      ++line_number;
      do
      {
        in.clear(in.rdstate() & ~std::ios::failbit);
        in.getline(block.data(), static_cast<std::streamsize>(block.size()));
        line.append(block.data());
        if(static_cast<double>(line.size()) > expected.most_bytes)
          fail(fmt::format("is longer than {:.3g} GB", expected.most_bytes / 1e9));
      } while(in.fail() && !in.eof() && !in.bad());
      if(line.find_first_not_of(" \t\r") != std::string::npos)
        return true;
      if(in.eof())
        return false;
    }
  }

  json Answer::message(const std::string &kind)
  {
    const std::string wanted
        = kind == "snapshot"
              ? fmt::format("the snapshot of t = {:.6g}", expected.times[next])
              : fmt::format("the line of the kind '{}'", kind);
    if(!read_line())
      throw ProgramError(
          line_number == 1
              ? fmt::format("{}: it answered nothing", expected.who)
              : fmt::format("{}: its answer ends before {}", expected.who, wanted));
    json result;
    try
    {
      result = json::parse(line);
    }
    catch(const json::exception &error)
    {
      const bool no_number = std::ranges::any_of(
          std::array{"NaN", "nan", "Infinity", ",inf", "-inf"},
          [this](const char *word) { return line.find(word) != std::string::npos; });
      fail(fmt::format("is not JSON{}: {}",
                       no_number ? " (a NaN or an infinity is no number there)" : "",
                       quoted(error.what())));
    }
    const std::string found
        = result.is_object() && result.contains("kind") && result["kind"].is_string()
              ? result["kind"].get<std::string>()
              : "";
    if(found == "refused" && kind == "start"
       && breach_of_protocol(result, "refused").empty())
      throw cases::Refusal(fmt::format("{} refuses the scene: {}", expected.who,
                                       quoted(result["reason"].get<std::string>())));
    if(found != kind)
      fail(fmt::format("is '{}', where {} was to come", quoted(line.substr(0, 60)),
                       wanted));
    if(const std::string breach = breach_of_protocol(result, kind); !breach.empty())
      fail(fmt::format("is not as the protocol says: {}", breach));
    return result;
  }

  void Answer::check_sites() const
  {
    const std::size_t sites = told.positions[0].size();
    if(sites == 0)
      fail("has no sites");
    if(told.weights.size() != sites)
      fail(fmt::format("has {} weights for {} sites", told.weights.size(), sites));
    const double sum = std::accumulate(told.weights.begin(), told.weights.end(), 0.);
    if(std::ranges::any_of(told.weights, [](double weight) { return weight < 0; }))
      fail("has a negative weight");
    // Straight cells leave a layer along a wall that bends.
    const cases::Domain &domain = expected.scene.domain;
    const double volume = cases::volume_of(domain);
    double slack = same;
    if(domain.round() || domain.outline)
      for(const cases::Side side : expected.scene.sides())
        slack += expected.spacing * cases::area_of(domain, side) / volume;
    if(std::abs(sum - volume) > slack * volume)
      fail(fmt::format("has weights of {:.9g} in all, and the domain's volume is {:.9g}",
                       sum, volume));
  }

  void Answer::take_sites(const json &of_line)
  {
    if(of_line.contains("positions"))
    {
      const json &rows = of_line["positions"];
      if(!same_length(rows))
        fail("has positions of different lengths");
      const auto rows_wanted = static_cast<std::size_t>(described.dimension);
      if(rows_wanted > 0 && rows.size() != rows_wanted)
        fail(fmt::format("has positions in {} dimensions, and the first line in {}",
                         rows.size(), rows_wanted));
      described.dimension = static_cast<int>(rows.size());
      take_rows(rows, told.positions);
    }
    if(of_line.contains("weights"))
      told.weights = of_line["weights"].get<std::vector<double>>();
    check_sites();
  }

  void Answer::take_start(const json &start)
  {
    described.spacing = start["spacing"];
    if(described.spacing > largest_spacing * expected.spacing)
      fail(fmt::format("has the spacing {:.6g}, and n asks for {:.6g}", described.spacing,
                       expected.spacing));
    described.dimension = 0;
    take_sites(start);
    const cases::Scene &scene = expected.scene;
    if(described.dimension < scene.domain.dimension
       && !(described.dimension == 1 && scene.symmetry != cases::Symmetry::none))
      fail(fmt::format("has positions in {} dimensions, and the domain has {}",
                       described.dimension, scene.domain.dimension));
    described.time_step = start.value("time_step", 0.);
    described.unknowns = start.value("unknowns", static_cast<long>(told.weights.size()));
    const json parameters = start.value("parameters", json::object());
    for(const auto &[name, value] : parameters.items())
      described.parameters.push_back(
          {quoted(name), quoted(value.get<std::string>()), ""});
  }

  void Answer::take_heat(const json &snapshot)
  {
    if(!snapshot.contains("heat"))
    {
      if(expected.capabilities.conserves_heat)
        fail("has no 'heat', and the manifest says that the program conserves it");
      told.heat.conservative = false;
      return;
    }
    const json &heat = snapshot["heat"];
    told.heat.stored = heat["stored"];
    told.heat.latent = heat["latent"];
    told.heat.boundary = heat["boundary"];
    told.heat.sources = heat["sources"];
    if(next == 0 && expected.scene.problem != cases::ProblemKind::poisson)
      initial_heat = told.heat.stored + told.heat.latent;
    told.heat.initial = initial_heat;
  }

  void Answer::take_snapshot(const json &snapshot, double time)
  {
    const double told_time = snapshot["time"];
    const double duration = expected.scene.end_time - expected.scene.start_time;
    if(!(std::abs(told_time - time) <= same * duration))
      fail(fmt::format("is of t = {:.9g}, where t = {:.9g} was asked for", told_time,
                       time));
    if(snapshot.contains("positions") || snapshot.contains("weights"))
      take_sites(snapshot);
    told.temperature = snapshot["temperature"].get<std::vector<double>>();
    told.solid_fraction = snapshot["solid_fraction"].get<std::vector<double>>();
    const std::size_t sites = told.weights.size();
    for(const auto &[what, values] : {std::pair("temperatures", &told.temperature),
                                      std::pair("solid fractions", &told.solid_fraction)})
      if(values->size() != sites)
        fail(fmt::format("has {} {} for {} sites", values->size(), what, sites));
    for(const double fraction : told.solid_fraction)
      if(fraction < 0 || fraction > 1)
        fail(fmt::format("has a solid fraction of {:.9g}, which is not within 0 to 1",
                         fraction));
    const json front = snapshot.value("front", json::array({json::array()}));
    if(!same_length(front)
       || (!front.front().empty()
           && front.size() != static_cast<std::size_t>(described.dimension)))
      fail("has points of a front that are not of the dimension of its sites");
    take_rows(front, told.front);
    take_heat(snapshot);
  }

  const ToldState &Answer::state(std::size_t index)
  {
    for(; next <= index; ++next)
      take_snapshot(message("snapshot"), expected.times[next]);
    return told;
  }

  cases::Cost Answer::end()
  {
    const json last = message("end");
    if(read_line())
      fail(
          fmt::format("follows the line that ends it: '{}'", quoted(line.substr(0, 60))));
    cases::Cost cost;
    const auto number = [&](const char *key) -> long
    {
      if(!last.contains(key))
        return 0;
      if(!last[key].is_number_integer())
        fail(fmt::format("gives as '{}' a number that is not written as a whole one",
                         key));
      return whole_number_in<long>(last[key]);
    };
    cost.steps = number("steps");
    cost.unknowns = described.unknowns;
    cost.work = number("work");
    cost.solver_iterations = number("solver_iterations");
    return cost;
  }
} // namespace meltfront::verification::external
