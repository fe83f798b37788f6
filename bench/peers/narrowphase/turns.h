// Times Carom and other libraries in turns, so that a drift of the machine's clock affects all.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/peers/narrowphase/answers.h"
#include "bench/peers/narrowphase/comparison.h"
#include "carom/simd/isa.h"

namespace carom::bench {

// A library with the pairs of a stream or the first of them, and what it answered.
struct Library {
  const char* name;
  std::unique_ptr<PairPeer> pairs;
  PairAnswers answers;
  Agreement agreement;
};

// Asks a library once; `truths` are those of its pairs.
Library ask(const char* name, std::unique_ptr<PairPeer> pairs, std::span<const Truth> truths);

class TimedRunner {
 public:
  TimedRunner(RunnerResult about, std::function<void()> pass, std::optional<Isa> isa = std::nullopt)
      : result_(std::move(about)), pass_(std::move(pass)), isa_(isa) {}

  // The first pass is not timed, because the runner before has filled the caches.
  void take_turn(double seconds);
  RunnerResult result();

 private:
  RunnerResult result_;
  std::function<void()> pass_;
  std::optional<Isa> isa_;
  std::vector<double> times_;
};

// The libraries, in order.
std::vector<TimedRunner> runners_of(std::vector<Library>& libraries);

// Carom on every instruction set; make_pass() returns a pass over `pairs` pairs. All but the
// default one are forced: that runs as in a program that forces none (simd/measured_kernels.h).
void add_carom(std::vector<TimedRunner>& runners, size_t pairs,
               const std::function<std::function<void()>()>& make_pass);

// `budget`: seconds of passes for each runner.
std::vector<RunnerResult> time_in_turns(std::vector<TimedRunner> runners, double budget);

// The reference, whose passes were timed when the stream was made.
RunnerResult reference_result(size_t pairs, double seconds);

}  // namespace carom::bench
