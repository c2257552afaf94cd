// What the particle operator, the lists of neighbours and whole runs cost on this
// machine, as one table.

#include <particles/benchmarks/benchmarks.h>
#include <particles/benchmarks/lammps.h>
#include <particles/benchmarks/table.h>

#include <iostream>
#include <string>
#include <vector>

int main(int argc, char **argv)
{
  using namespace meltfront::particles::benchmarks;
  // The fastest of several repetitions is the least disturbed one.
  std::string repetitions = "--benchmark_repetitions=5";
  std::vector<char *> arguments(argv, argv + argc);
  arguments.insert(arguments.begin() + 1, repetitions.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if(benchmark::ReportUnrecognizedArguments(count, arguments.data()))
    return 2;
  register_operator_benchmarks();
  register_mixture_benchmarks();
  register_neighbour_benchmarks();
  register_moment_benchmarks();
  register_solid_benchmarks();
  register_relaxation_benchmarks();
  register_level_set_benchmarks();
  register_marker_benchmarks();
  register_run_benchmarks();
  Table table;
  if(benchmark::RunSpecifiedBenchmarks(&table) == 0)
    return 2;
  // Whoever chooses benchmarks does not ask for it.
  if(argc == 1)
    compare_with_lammps(std::cout);
  return 0;
}
