// Bullets in a room: what goes further in a frame than it is wide, and what is thin enough to be
// missed so.
#pragma once

#include <memory>

#include "io/generate/spec.h"
#include "io/scene.h"

namespace carom::io {

// spec.bodies bullets first, then the walls, thin boxes and sheets. Bullets bounce off the walls
// and fly through all the rest.
std::unique_ptr<SceneReader> open_bullets(const GeneratorSpec& spec);

}  // namespace carom::io
