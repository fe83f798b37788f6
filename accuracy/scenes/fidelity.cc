#include "accuracy/scenes/fidelity.h"

#include <algorithm>
#include <cmath>

#include "accuracy/pairs/body_size.h"
#include "accuracy/scenes/trials.h"

namespace carom::accuracy {
namespace {

// Tolerances as shares of the median bounding radius.
constexpr double kTolerances[] = {1e-4, 1e-3, 1e-2, 1e-1};

Trial fast_trial() {
  Trial trial{.name = "single precision", .settings = {}};
  trial.settings.accuracy.tier = Tier::fast;
  return trial;
}

Trial tolerant_trial(float tolerance) {
  Trial trial{.name = "tolerance", .settings = {}};
  trial.settings.accuracy.tolerance = tolerance;
  return trial;
}

double median_radius(const Playback& scene) {
  World world({.positions = scene.positions()});
  scene.start(world);
  std::vector<double> radii;
  for (uint32_t i = 0; i < world.size(); ++i) {
    const double radius = bounding_radius(world.shape(world.id_of(i)));
    if (std::isfinite(radius)) radii.push_back(radius);
  }
  return median(std::move(radii));
}

std::vector<Trial> reuse_trials(double radius) {
  std::vector<Trial> trials;
  for (const double part : kTolerances) {
    const auto tolerance = static_cast<float>(part * radius);
    if (tolerance > 0) trials.push_back(tolerant_trial(tolerance));
  }
  return trials;
}

FidelityEntry fidelity_entry(const Playback& scene, const Trial& trial, const TrialResult& result,
                             double frame_ms_standard) {
  const Deviation& deviation = result.deviation;
  return {.scene = scene.name(),
          .setting = trial.name,
          .pairs = deviation.pairs,
          .lost = deviation.lost,
          .gained = deviation.gained,
          .contact_error_worst = deviation.contact_error_worst,
          .contact_error_p99 = deviation.contact_error_p99,
          .events_moved = deviation.events_moved,
          .frame_ms = result.frame_ms,
          .frame_ms_standard = frame_ms_standard};
}

ReuseEntry reuse_entry(const Playback& scene, const Trial& trial, const TrialResult& result,
                       double frame_ms_standard) {
  const double tolerance = trial.settings.accuracy.tolerance;
  const Deviation& deviation = result.deviation;
  return {.scene = scene.name(),
          .tolerance = tolerance,
          .frame_ms = result.frame_ms,
          .frame_ms_standard = frame_ms_standard,
          .error_bound = tolerance,
          .error_worst = deviation.worst(),
          .lost = deviation.lost,
          .gained = deviation.gained,
          .pairs = deviation.pairs};
}

}  // namespace

std::vector<std::string> fidelity_scenes(bool is_short) {
  const std::string size = is_short ? "n=2000,frames=12,seed=1" : "n=20000,frames=40,seed=1";
  return {"brownian:" + size + ",shape=box,speed=0.005,spin=0.005",
          "brownian:" + size + ",shape=box,speed=3,spin=1",
          "brownian:" + size + ",shape=sphere,speed=3", "static:" + size + ",shape=box"};
}

Result<void> measure_fidelity(const Playback& scene, int rounds, FidelityReport& report) {
  const Result<StandardRun> standard = run_standard(scene);
  if (!standard) return standard.error();
  std::vector<Trial> trials = {{.name = "standard", .settings = {}}, fast_trial()};
  const std::vector<Trial> reuse = reuse_trials(median_radius(scene));
  trials.insert(trials.end(), reuse.begin(), reuse.end());
  const auto results = run_trials(scene, *standard, trials, {.rounds = rounds});
  if (!results) return results.error();
  const double frame_ms_standard = results->front()->frame_ms;
  for (size_t i = 1; i < trials.size(); ++i) {
    const TrialResult& result = *(*results)[i];
    if (i == 1) {
      report.fidelity.push_back(fidelity_entry(scene, trials[i], result, frame_ms_standard));
    } else {
      report.reuse.push_back(reuse_entry(scene, trials[i], result, frame_ms_standard));
    }
  }
  return {};
}

}  // namespace carom::accuracy
