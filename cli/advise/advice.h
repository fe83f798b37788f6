// The advice of `carom advise` for a scene: settings, each with its measured reason.
#pragma once

#include <string>
#include <vector>

#include "cli/advise/front.h"
#include "cli/advise/scene_survey.h"
#include "cli/advise/settings_trial.h"
#include "cli/support/json_output.h"

namespace carom::cli {

struct AdviceRow {
  std::string what;
  std::string value;  // of a setting; empty for features that the scene does not need
  std::string reason;
};

struct Advice {
  std::string scene;
  double tolerance = 0;
  std::string isa;
  SceneSurvey survey;
  SettingsChoice choice;
  // Derived from these two:
  bool meets = false;  // the choice plus the standard tier's own error meets the tolerance
  std::vector<AdviceRow> settings;
  std::vector<AdviceRow> not_needed;
  std::string command;            // runs the scene with these settings
  double guaranteed_error = 0;    // metres: that of the tolerance, and the rounding beside it
  std::vector<FrontPoint> front;  // empty unless it was asked for
};

Advice advise(const std::string& scene, double tolerance, SceneSurvey survey,
              SettingsChoice choice);

// The shell command "carom run SCENE --tier ...".
std::string run_command(const std::string& scene, const accuracy::Trial& trial);

// As JSON if that is wanted, as text otherwise.
Result<void> write_advice(const Advice& advice, JsonOutput& json, const Console& console);

}  // namespace carom::cli
