// Runs a scene with different settings, in turns, and measures their times and the deviation of
// their results from the standard ones.
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

// The results of a run with a world's default settings.
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
  WorldSettings settings;  // play() sets detail (contact), positions and parallelism
  int threads = 1;
};

struct TrialResult {
  // For each frame the least time of any round; of these the mean, without the first frame if there
  // are others: steps that hold on to results take turns with those that renew them.
  double frame_ms = 0;
  uint64_t candidates = 0;  // sums over all frames
  uint64_t tested = 0;
  Deviation deviation;
};

struct TrialPlan {
  using TimePoint = std::chrono::steady_clock::time_point;
  int rounds = 2;
  TimePoint deadline = TimePoint::max();
  std::function<void()> before_run = [] {};  // to report progress
};

// Returns one result for each trial, or nothing if there was no time to begin it. Compares every
// trial once, then times all in turns, so that a change in the machine's speed affects all of them.
// It repeats that for the planned rounds or until the deadline. Without a full round the times are
// those of the comparison run.
Result<std::vector<std::optional<TrialResult>>> run_trials(const Playback& scene,
                                                           const StandardRun& standard,
                                                           std::span<const Trial> trials,
                                                           const TrialPlan& plan);

// The middle value; for an even number of values the mean of the two in the middle; 0 if there is
// none.
double median(std::vector<double> values);
// The mean without the first value, in which everything is built for the first time, if there are
// others.
double steady_mean(const std::vector<double>& frame_ms);

}  // namespace carom::accuracy
