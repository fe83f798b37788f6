// Every frame of a scene: carom's worlds against the scalar reference.
#pragma once

#include <string>

#include "cli/support/progress.h"
#include "cli/verify/verify_outcome.h"
#include "cli/verify/verify_system.h"
#include "io/scene.h"

namespace carom::cli {

// Runs one world a way of running (instruction set, threads, broadphase, with and without carried
// results, at every detail that tests pairs) beside the reference, and stops at the first
// difference.
Result<VerifyOutcome> verify_scene(System& system, const Engines& engines, io::SceneReader& scene,
                                   const std::string& source, uint64_t frames,
                                   const Console& console);

}  // namespace carom::cli
