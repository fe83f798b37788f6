// carom_bench [--smoke | --large] [--pairs=N] [Google Benchmark's flags]
//   --smoke    short streams, small scenes, few repetitions: checks that everything still runs
//   --large    also scenes of a million bodies
//   --pairs=N  streams of N pairs, fewer of hulls and k-DOPs
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <cstring>
#include <iterator>
#include <vector>

#include "bench/support/context.h"
#include "bench/support/measure.h"
#include "bench/support/suites.h"

namespace carom::bench {
namespace {

// Removes our own flags from the list. Later flags override those that --smoke adds.
Options take_options(std::vector<char*>& arguments) {
  static char min_time[] = "--benchmark_min_time=0.001";
  constexpr const char* kPairs = "--pairs=";
  Options options;
  for (auto argument = std::next(arguments.begin()); argument != arguments.end();) {
    if (std::strcmp(*argument, "--smoke") == 0) {
      options = {.pairs = 2'000, .max_bodies = 10'000};
      *argument++ = min_time;
    } else if (std::strcmp(*argument, "--large") == 0) {
      options.max_bodies = 1'000'000;
      argument = arguments.erase(argument);
    } else if (std::strncmp(*argument, kPairs, std::strlen(kPairs)) == 0) {
      options.pairs = std::strtoul(*argument + std::strlen(kPairs), nullptr, 10);
      argument = arguments.erase(argument);
    } else {
      ++argument;
    }
  }
  return options;
}

void register_all(const Options& options) {
  register_clock();
  register_memory();
  register_bounds();
  register_dop_bounds();
  register_loads();
  register_find_pairs(options);
  register_narrowphase(options);
  register_impacts(options);
  register_world(options);
  register_moving(options);
  register_spaces(options);
  register_casts(options);
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  const carom::bench::Options options = carom::bench::take_options(arguments);
  argc = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&argc, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(argc, arguments.data())) return 2;
  carom::bench::add_context();
  carom::bench::register_all(options);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return carom::bench::any_failed() ? 1 : 0;
}
