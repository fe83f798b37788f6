// Runs a scene with candidate settings and chooses the fastest that meet the tolerance.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/scenes/trials.h"
#include "cli/advise/scene_survey.h"

namespace carom::cli {

// The setting that a candidate changes. Tiers are only compared, never chosen.
enum class SettingGroup : uint8_t {
  standard,
  cache,
  broadphase,
  margin,
  dops,
  threads,
  tolerance,
  tier,
  together,  // a combination of others
};

struct TriedSettings {
  SettingGroup group;
  std::string name;
  accuracy::Trial trial;
  std::optional<accuracy::TrialResult> result;  // empty: there was no time for it
  // Values of the choice that it should improve, measured in the same turns.
  double frame_ms_beside = 0;
  uint64_t tested_beside = 0;  // pairs
  bool meets = false;          // it meets the tolerance

  double ratio() const { return result->frame_ms / frame_ms_beside; }
};

struct SettingsChoice {
  std::vector<TriedSettings> tried;  // in order; the first is a world's default
  accuracy::Trial chosen;
  double frame_ms = 0;  // of the choice and of the default, measured in the same turns
  double frame_ms_standard = 0;
  accuracy::Deviation deviation;  // of the choice
  accuracy::StandardRun standard;
};

struct TrialLimits {
  double tolerance = 0;  // metres
  int threads = 1;       // the most to use
  accuracy::TrialPlan plan;
};

// A setting must save more than this share of a frame and more than these milliseconds; timing is
// not more precise.
inline constexpr double kWorthwhile = 0.05;
inline constexpr double kWorthwhileMs = 0.01;

// The number of frames, at most `most`, with which all runs of choose_settings() fit into `budget`.
// Measures the frames already loaded in `scene`.
Result<size_t> affordable_frames(const LoadedScene& scene, std::chrono::duration<double> budget,
                                 size_t most);

Result<SettingsChoice> choose_settings(const LoadedScene& scene, const SceneSurvey& survey,
                                       const TrialLimits& limits);

}  // namespace carom::cli
