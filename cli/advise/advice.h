// What `carom advise` says about a scene: settings, each with its measured reason.
#pragma once

#include <string>
#include <vector>

#include "cli/advise/scene_survey.h"
#include "cli/advise/settings_trial.h"
#include "cli/support/json_output.h"

namespace carom::cli {

struct AdviceRow {
  std::string what;
  std::string value;  // of a setting; empty for what a scene does not need
  std::string reason;
};

struct Advice {
  std::string scene;
  double tolerance = 0;
  std::string isa;
  SceneSurvey survey;
  SettingsChoice choice;
  // Made of these two:
  bool meets = false;  // the choice, with what the standard tier itself may be off
  std::vector<AdviceRow> settings;
  std::vector<AdviceRow> not_needed;
  std::string command;  // that runs the scene like this
};

Advice advise(const std::string& scene, double tolerance, SceneSurvey survey,
              SettingsChoice choice);

// "carom run SCENE --tier ...", for a shell.
std::string run_command(const std::string& scene, const accuracy::Trial& trial);

// As JSON if that is wanted, as text otherwise.
Result<void> write_advice(const Advice& advice, JsonOutput& json, const Console& console);

}  // namespace carom::cli
