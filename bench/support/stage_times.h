// Measures the stages of steps.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>

#include "carom/world/step_report.h"

namespace carom::bench {

// Sums of stage times over frames; as counters they are milliseconds a frame.
class StageTimes {
 public:
  void add(const StepReport& step) {
    for (int stage = 0; stage < kStageCount; ++stage) ns_[stage] += step.stage_ns[stage];
    stages_run_ |= step.stages_run;
  }

  void report(benchmark::State& state) const {
    for (int stage = 0; stage < kStageCount; ++stage) {
      if (!(stages_run_ >> stage & 1)) continue;
      state.counters[std::string("ms_") + name(static_cast<Stage>(stage))] =
          static_cast<double>(ns_[stage]) * 1e-6 / static_cast<double>(state.iterations());
    }
  }

 private:
  uint64_t ns_[kStageCount] = {};
  uint32_t stages_run_ = 0;
};

}  // namespace carom::bench
