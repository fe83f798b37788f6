// The candidate pairs of a scene and how near to touching they are.
#pragma once

#include "cli/advise/scene_survey.h"

namespace carom::cli {

// Of the first, the middle and the last frame that `scene` holds; `radius` has the bounding radius
// of every body.
Result<PairSurvey> survey_pairs(const LoadedScene& scene, const std::vector<double>& radius);

}  // namespace carom::cli
