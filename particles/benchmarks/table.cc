#include <particles/benchmarks/table.h>
#include <particles/benchmarks/triad.h>

#include <fmt/format.h>

#include <limits>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    constexpr const char *line_format
        = "{:<42} {:>9} {:>7} {:>8} {:<16} {:>9} {:>7} {:>8}  {}\n";

    double counter(const benchmark::UserCounters &counters, const char *name)
    {
      const auto found = counters.find(name);
      return found == counters.end() ? 0. : found->second.value;
    }

    std::string target(const benchmark::UserCounters &counters)
    {
      if(const double most = counter(counters, "most_nanoseconds"))
        return fmt::format("<= {:.3g} ns", most);
      if(const double least = counter(counters, "least_share"))
        return fmt::format(">= {:.0f} %", 100 * least);
      return "";
    }
  } // namespace

  void set_size(benchmark::State &state, const PassSize &size, const char *item)
  {
    state.SetLabel(item);
    state.counters["particles"] = size.particles;
    state.counters["items"] = size.items;
    state.counters["bytes"] = size.bytes;
    state.counters["threads"] = size.threads;
    state.counters["timed"] = size.timed;
    state.counters["most_nanoseconds"] = size.most_nanoseconds;
    state.counters["least_share"] = size.least_share;
  }

  double Table::bandwidth(int threads)
  {
    const auto [found, inserted] = triad.try_emplace(threads, 0.);
    if(inserted)
      found->second = triad_bandwidth(threads);
    return found->second;
  }

  bool Table::ReportContext(const Context &)
  {
    GetOutputStream() << fmt::format("memory bandwidth (triad): {:.1f} GB/s on 1 thread",
                                     1e-9 * bandwidth(1))
                      << fmt::format(", {:.1f} GB/s on 2\n\n", 1e-9 * bandwidth(2))
                      << fmt::format(line_format, "benchmark", "particles", "threads",
                                     "ns", "per", "1/s", "GB/s", "of triad", "target");
    return true;
  }

  void Table::ReportRuns(const std::vector<Run> &runs)
  {
    const Run *fastest = nullptr;
    double seconds = std::numeric_limits<double>::infinity();
    for(const Run &run : runs)
    {
      if(run.error_occurred)
      {
        GetErrorStream() << run.benchmark_name() << ": " << run.error_message << "\n";
        return;
      }
      // The time of the processor where it is one: others may use the machine as well.
      const bool alone
          = counter(run.counters, "threads") == 1 && !counter(run.counters, "timed");
      const double total = alone ? run.cpu_accumulated_time : run.real_accumulated_time;
      const double each = total / double(run.iterations);
      if(run.run_type == Run::RT_Iteration && each < seconds)
      {
        fastest = &run;
        seconds = each;
      }
    }
    if(!fastest)
      return;
    const auto &counters = fastest->counters;
    const double items = counter(counters, "items");
    const double bytes = counter(counters, "bytes");
    const int threads = static_cast<int>(counter(counters, "threads"));
    GetOutputStream() << fmt::format(
        line_format, fastest->run_name.function_name, counter(counters, "particles"),
        threads, fmt::format("{:.3g}", 1e9 * seconds / items), fastest->report_label,
        fmt::format("{:.3g}", items / seconds),
        bytes > 0 ? fmt::format("{:.1f}", 1e-9 * bytes / seconds) : "",
        bytes > 0 ? fmt::format("{:.0f} %", 100 * bytes / seconds / bandwidth(threads))
                  : "",
        target(counters))
                      << std::flush;
  }
} // namespace meltfront::particles::benchmarks
