// Compares Carom's worlds with the scalar reference in every frame of a scene.
#pragma once

#include <string>

#include "cli/support/progress.h"
#include "cli/verify/verify_outcome.h"
#include "cli/verify/verify_system.h"
#include "io/scene.h"

namespace carom::cli {

// Runs one world for each combination of instruction set, threads, broadphase and carried results,
// at every detail that tests pairs, beside the reference. Stops at the first difference.
Result<VerifyOutcome> verify_scene(System& system, const Engines& engines, io::SceneReader& scene,
                                   const std::string& source, uint64_t frames,
                                   const Console& console);

}  // namespace carom::cli
