// Generated scenes, streamed like files.
#pragma once

#include <memory>

#include "carom/base/result.h"
#include "io/generate/spec.h"
#include "io/scene.h"

namespace carom::io {

// The same spec gives the same bits with every compiler and on every machine. In each frame
// position(f + 1) = position(f) + dt * linear_velocity(f), except for bodies that meet a wall, and
// orientation(f + 1) is orientation(f) turned by dt * angular_velocity(f).
std::unique_ptr<SceneReader> open_generator(const GeneratorSpec& spec);

}  // namespace carom::io
