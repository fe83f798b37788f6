// Surveys the candidate pairs of a scene and how many are near touching.
#pragma once

#include "cli/advise/scene_survey.h"

namespace carom::cli {

// Surveys the first, middle and last loaded frame of `scene`; `radius` has the bounding radius of
// every body.
Result<PairSurvey> survey_pairs(const LoadedScene& scene, const std::vector<double>& radius);

}  // namespace carom::cli
