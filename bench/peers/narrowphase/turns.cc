#include "bench/peers/narrowphase/turns.h"

#include <algorithm>
#include <ctime>

#include "bench/support/measure.h"

namespace carom::bench {
namespace {

constexpr int kTurns = 5;

// Processor time of this process, which other programs do not disturb.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

Library ask(const char* name, std::unique_ptr<PairPeer> pairs, std::span<const Truth> truths) {
  PairAnswers answers(truths.size());
  pairs->run(answers);
  const Agreement found = agreement(truths, answers);
  return {name, std::move(pairs), std::move(answers), found};
}

void TimedRunner::take_turn(double seconds) {
  if (isa_) {
    force_isa(*isa_);
  } else {
    unforce_isa();
  }
  pass_();
  const Stopwatch turn;
  do {
    const double start = processor_seconds();
    pass_();
    times_.push_back(processor_seconds() - start);
  } while (turn.seconds() < seconds);
}

RunnerResult TimedRunner::result() {
  std::sort(times_.begin(), times_.end());
  result_.passes = times_.size();
  result_.median_seconds = times_[times_.size() / 2];
  result_.least_seconds = times_.front();
  return result_;
}

std::vector<TimedRunner> runners_of(std::vector<Library>& libraries) {
  std::vector<TimedRunner> runners;
  for (Library& library : libraries) {
    const RunnerResult about = {
        .runner = library.name, .pairs = library.agreement.pairs, .agreement = library.agreement};
    runners.emplace_back(about, [&library] { library.pairs->run(library.answers); });
  }
  return runners;
}

void add_carom(std::vector<TimedRunner>& runners, size_t pairs,
               const std::function<std::function<void()>()>& make_pass) {
  unforce_isa();
  const Isa by_default = active_isa();
  for (const Isa isa : usable_isas()) {
    const auto forced = isa == by_default ? std::nullopt : std::optional(isa);
    runners.emplace_back(RunnerResult{.runner = name(isa), .pairs = pairs}, make_pass(), forced);
  }
}

std::vector<RunnerResult> time_in_turns(std::vector<TimedRunner> runners, double budget) {
  for (int turn = 0; turn < kTurns; ++turn) {
    for (TimedRunner& runner : runners) runner.take_turn(budget / kTurns);
  }
  unforce_isa();
  std::vector<RunnerResult> timed;
  for (TimedRunner& runner : runners) timed.push_back(runner.result());
  return timed;
}

RunnerResult reference_result(size_t pairs, double seconds) {
  return {.runner = "reference",
          .pairs = pairs,
          .passes = 1,
          .median_seconds = seconds,
          .least_seconds = seconds};
}

}  // namespace carom::bench
