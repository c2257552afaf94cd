#ifndef meltfront_particles_benchmarks_table_h
#define meltfront_particles_benchmarks_table_h

#include <benchmark/benchmark.h>

#include <map>

namespace meltfront::particles::benchmarks
{
  /** What one pass of a benchmark does, for the table. */
  struct PassSize
  {
    double particles = 0;
    double items = 0; ///< interactions, pairs or particle updates
    double bytes = 0; ///< that have to come from memory; 0: not said
    int threads = 1;
    bool timed = false;          ///< the benchmark takes its time by itself
    double most_nanoseconds = 0; ///< target, of one item; 0: none
    double least_share = 0;      ///< target, of the triad's bandwidth; 0: none
  };

  /** Hand a benchmark's size to the table. */
  void set_size(benchmark::State &state, const PassSize &size, const char *item);

  /** Prints one line for each benchmark: the fastest of its repetitions. */
  class Table : public benchmark::BenchmarkReporter
  {
  public:
    bool ReportContext(const Context &context) override;
    void ReportRuns(const std::vector<Run> &runs) override;

  private:
    double bandwidth(int threads);

    std::map<int, double> triad; ///< byte/s, by the number of threads
  };
} // namespace meltfront::particles::benchmarks

#endif
