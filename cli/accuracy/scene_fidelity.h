// Scenes of the command line, measured by accuracy/scenes/fidelity.h.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "accuracy/scenes/fidelity.h"

namespace carom::cli {

// Of the built-in scenes, and of `more` as the command line names them: up to 60 frames of each.
// `before_scene(done, all)` is told how far it is.
Result<accuracy::FidelityReport> measure_scene_fidelity(
    const std::vector<std::string>& more, bool is_short,
    const std::function<void(size_t, size_t)>& before_scene);

}  // namespace carom::cli
