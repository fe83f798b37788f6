// Shared by all benchmarks: registration, timing and failure.
#pragma once

#include <benchmark/benchmark.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "carom/simd/isa.h"

namespace carom::bench {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// The times of many passes.
class PassTimes {
 public:
  template <class Pass>
  void measure(const Pass& pass) {
    const Stopwatch watch;
    pass();
    seconds_.push_back(watch.seconds());
  }

  double median() const;

 private:
  std::vector<double> seconds_;
};

// One of the compared implementations: an instruction set, or the scalar reference.
struct Runner {
  std::optional<Isa> isa;

  const char* name() const { return isa ? carom::name(*isa) : "reference"; }
};

// The reference, then every ISA of this machine, weakest first.
std::vector<Runner> all_runners();

// An ISA with a number of threads: one thread on every ISA, and two on the strongest.
struct Setup {
  Isa isa;
  int threads;

  std::string name() const { return "t" + std::to_string(threads) + "/" + carom::name(isa); }
};
std::vector<Setup> all_setups();
// One and two threads on the strongest.
std::vector<Setup> strongest_setups();

// 1k, 10k, ...
std::string short_count(size_t count);

// Uses that ISA from now on: the default one as a program does that forces none. Returns false and
// fails the benchmark if that is not possible.
bool use_isa(benchmark::State& state, Isa isa);

// Ends the benchmark with an error, and makes the program fail.
void fail(benchmark::State& state, const std::string& message);
bool any_failed();

// Adds the counter ns_per_<item> from the median pass over `items`, and speedup if the reference's
// time for as many items is known. Uses medians because other programs disturb means.
void report(benchmark::State& state, const char* item, size_t items, const PassTimes& times,
            std::optional<double> reference_seconds = std::nullopt);

}  // namespace carom::bench
