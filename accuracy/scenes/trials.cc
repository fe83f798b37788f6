#include "accuracy/scenes/trials.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "carom/base/thread_arena.h"

namespace carom::accuracy {
namespace {

using Clock = std::chrono::steady_clock;
using AfterStep = std::function<void(size_t frame, const World& world)>;

Error too_many_pairs(const Playback& scene, size_t frame, const World& world) {
  return {scene.name() + ": frame " + std::to_string(frame) + " has " +
          std::to_string(world.report().search.pairs) +
          " pairs of overlapping bounds, more than the limit of " +
          std::to_string(world.settings().most_pairs)};
}

// Plays the scene; returns the milliseconds of each step.
Result<std::vector<double>> play(const Playback& scene, const Trial& trial,
                                 const AfterStep& after_step) {
  ThreadArena arena(trial.threads);
  WorldSettings settings = trial.settings;
  settings.detail = Detail::contact;
  settings.positions = scene.positions();
  settings.parallelism = arena.parallelism();
  World world(settings);
  std::vector<double> frame_ms;
  std::optional<Error> failure;
  arena.run([&] {
    for (size_t frame = 0; frame < scene.frames() && !failure; ++frame) {
      if (frame == 0) {
        scene.start(world);
      } else {
        scene.move(frame, world);
      }
      const Clock::time_point begin = Clock::now();
      const StepReport& report = world.step();
      const Clock::time_point end = Clock::now();
      frame_ms.push_back(std::chrono::duration<double, std::milli>(end - begin).count());
      if (!report.search.complete) failure = too_many_pairs(scene, frame, world);
      if (!failure && after_step) after_step(frame, world);
    }
  });
  if (failure) return *failure;
  return frame_ms;
}

Result<TrialResult> compare(const Playback& scene, const StandardRun& standard,
                            const Trial& trial) {
  TrialResult result;
  DeviationMeter meter(standard.frames);
  const auto frame_ms = play(scene, trial, [&](size_t frame, const World& world) {
    result.candidates += world.report().pairs;
    result.tested += world.report().tested;
    meter.add(frame, world);
  });
  if (!frame_ms) return frame_ms.error();
  result.frame_ms = steady_mean(*frame_ms);
  result.deviation = meter.finish();
  return result;
}

// Keeps the least time of each frame, because other load on the machine only ever adds time.
void keep_least(const std::vector<double>& frame_ms, std::vector<double>& least) {
  if (least.empty()) least = frame_ms;
  for (size_t i = 0; i < least.size(); ++i) least[i] = std::min(least[i], frame_ms[i]);
}

// Times the trials in turns without comparisons, each the same number of times.
Result<void> time_in_turns(const Playback& scene, std::span<const Trial> trials,
                           const TrialPlan& plan,
                           std::vector<std::optional<TrialResult>>& results) {
  std::vector<std::vector<double>> least(trials.size());
  for (int round = 0; round < plan.rounds; ++round) {
    for (size_t i = 0; i < trials.size(); ++i) {
      if (!results[i]) continue;
      if (Clock::now() >= plan.deadline) return {};
      plan.before_run();
      const auto times = play(scene, trials[i], {});
      if (!times) return times.error();
      keep_least(*times, least[i]);
    }
    for (size_t i = 0; i < trials.size(); ++i) {
      if (results[i]) results[i]->frame_ms = steady_mean(least[i]);
    }
  }
  return {};
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double steady_mean(const std::vector<double>& frame_ms) {
  const auto first = frame_ms.begin() + (frame_ms.size() > 1);
  if (first == frame_ms.end()) return 0;
  return std::accumulate(first, frame_ms.end(), 0.0) / static_cast<double>(frame_ms.end() - first);
}

Result<StandardRun> run_standard(const Playback& scene) {
  StandardRun run;
  auto frame_ms =
      play(scene, {.name = "standard", .settings = {}}, [&](size_t, const World& world) {
        const StepReport& report = world.report();
        run.frames.push_back(results_of(world));
        run.candidates += report.pairs;
        run.tested += report.tested;
        run.kept += report.kept;
        run.overlaps += report.overlaps;
        run.quarantined += report.quarantined;
        run.search = report.search;
      });
  if (!frame_ms) return frame_ms.error();
  run.frame_ms = std::move(*frame_ms);
  return run;
}

Result<std::vector<std::optional<TrialResult>>> run_trials(const Playback& scene,
                                                           const StandardRun& standard,
                                                           std::span<const Trial> trials,
                                                           const TrialPlan& plan) {
  std::vector<std::optional<TrialResult>> results(trials.size());
  for (size_t i = 0; i < trials.size(); ++i) {
    if (Clock::now() >= plan.deadline) break;
    plan.before_run();
    Result<TrialResult> result = compare(scene, standard, trials[i]);
    if (!result) return result.error();
    results[i] = *result;
  }
  Result<void> timed = time_in_turns(scene, trials, plan, results);
  if (!timed) return timed.error();
  return results;
}

}  // namespace carom::accuracy
