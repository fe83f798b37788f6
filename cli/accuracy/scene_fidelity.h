// Measures scenes of the command line with accuracy/scenes/fidelity.h.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "accuracy/scenes/fidelity.h"

namespace carom::cli {

// Measures up to 60 frames of each built-in scene and of `more`, named as on the command line.
// Calls `before_scene(done, all)` before each scene.
Result<accuracy::FidelityReport> measure_scene_fidelity(
    const std::vector<std::string>& more, bool is_short,
    const std::function<void(size_t, size_t)>& before_scene);

}  // namespace carom::cli
