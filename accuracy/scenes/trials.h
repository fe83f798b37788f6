// Runs a scene with different settings, in turns, and says how long each takes and how far its
// results are from the standard ones.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "accuracy/scenes/deviation.h"
#include "accuracy/scenes/playback.h"
#include "carom/base/result.h"

namespace carom::accuracy {

// What a run with the settings that a world has by default found.
struct StandardRun {
  std::vector<FrameResults> frames;
  std::vector<double> frame_ms;  // World::step() alone
  uint64_t candidates = 0;       // sums over all frames
  uint64_t tested = 0;
  uint64_t kept = 0;
  uint64_t overlaps = 0;
  uint64_t quarantined = 0;
  PairSearch search;  // of the last frame
};
Result<StandardRun> run_standard(const Playback& scene);

struct Trial {
  std::string name;
  WorldSettings settings;  // at detail contact; positions and parallelism are chosen by the trial
  int threads = 1;
};

struct TrialResult {
  // Median over the frames, the first one left out where there are others, of the least time that a
  // frame took in any round.
  double frame_ms = 0;
  uint64_t candidates = 0;  // sums over all frames
  uint64_t tested = 0;
  Deviation deviation;
};

struct TrialPlan {
  using TimePoint = std::chrono::steady_clock::time_point;
  int rounds = 2;
  TimePoint deadline = TimePoint::max();
  std::function<void()> before_run = [] {};  // for who wants to know how far it is
};

// One result a trial; none for trials that there was no time to begin. Every trial is compared
// once; then all are timed in turns, as many rounds as planned or as there is time for, so that a
// machine that changes its pace does so for all of them. Without a full round the times are those
// of the run that was compared.
Result<std::vector<std::optional<TrialResult>>> run_trials(const Playback& scene,
                                                           const StandardRun& standard,
                                                           std::span<const Trial> trials,
                                                           const TrialPlan& plan);

// The middle value, of an even number the mean of the two in the middle; 0 if there is none.
double median(std::vector<double> values);
// The same without the first, which built everything for the first time, where there are others.
double steady_median(const std::vector<double>& frame_ms);

}  // namespace carom::accuracy
