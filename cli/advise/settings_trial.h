// Runs a scene with candidates of settings and chooses the cheapest that keep errors small.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/scenes/trials.h"
#include "cli/advise/scene_survey.h"

namespace carom::cli {

// What a candidate is about. Of knobs several may be chosen, of tiers none: those are for
// comparing.
enum class SettingGroup : uint8_t {
  standard,
  cache,
  broadphase,
  margin,
  dops,
  threads,
  knob,
  motion,  // the knob that has a number
  tier,
  together,  // several of the others
};

struct TriedSettings {
  SettingGroup group;
  std::string name;
  accuracy::Trial trial;
  std::optional<accuracy::TrialResult> result;  // none: there was no time for it
  // Of what it was to better, measured in the same turns.
  double frame_ms_beside = 0;
  uint64_t tested_beside = 0;  // pairs
  bool meets = false;          // the tolerance

  double ratio() const { return result->frame_ms / frame_ms_beside; }
};

struct SettingsChoice {
  std::vector<TriedSettings> tried;  // in order; the first is what a world does by default
  accuracy::Trial chosen;
  double frame_ms = 0;  // of the choice and of the default, measured in the same turns
  double frame_ms_standard = 0;
  accuracy::Deviation deviation;  // of the choice
  accuracy::StandardRun standard;
};

struct TrialLimits {
  double tolerance = 0;  // metres
  int threads = 1;       // to use at most
  accuracy::TrialPlan plan;
};

// What saves less is not chosen: this part of a frame, and as many milliseconds. Timing is no
// better.
inline constexpr double kWorthwhile = 0.05;
inline constexpr double kWorthwhileMs = 0.01;

// Frames that `budget` has time for, of all the runs that choose_settings() makes; `scene` holds
// some, and there is no use in more than `most`.
Result<size_t> affordable_frames(const LoadedScene& scene, std::chrono::duration<double> budget,
                                 size_t most);

Result<SettingsChoice> choose_settings(const LoadedScene& scene, const SceneSurvey& survey,
                                       const TrialLimits& limits);

}  // namespace carom::cli
