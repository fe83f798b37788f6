// Measures time against error in a scene, over many tolerances.
#pragma once

#include <string>
#include <vector>

#include "accuracy/scenes/trials.h"
#include "cli/advise/scene_survey.h"

namespace carom::cli {

struct FrontPoint {
  double tolerance = 0;         // metres
  double frame_ms = 0;          // as TrialResult has it
  double guaranteed_error = 0;  // metres: the tolerance, and the rounding of the standard tier
  double measured_error = 0;    // metres: the worst that was seen
  std::string settings;         // options of carom run
};

// Measures tolerance 0 and four tolerances a decade from 1e-7 to 1e-1 of the median bounding
// radius, in turns, and returns those that nothing beats in both time and guaranteed error, the
// least error first. Gives the shapes of the scene ladders for the coarser ones.
Result<std::vector<FrontPoint>> measure_front(LoadedScene& scene, const SceneSurvey& survey,
                                              const accuracy::StandardRun& standard,
                                              const accuracy::TrialPlan& plan);

// A table of the points, and a plot: error to the right, time upwards.
std::string front_text(const std::vector<FrontPoint>& front);

}  // namespace carom::cli
