// A generated scene of bullets in a room: bodies that move further in a frame than they are wide,
// and obstacles so thin that discrete steps miss them.
#pragma once

#include <memory>

#include "io/generate/spec.h"
#include "io/scene.h"

namespace carom::io {

// Bodies are spec.bodies bullets, then walls, thin boxes and sheets. Bullets bounce off the walls
// and fly through everything else.
std::unique_ptr<SceneReader> open_bullets(const GeneratorSpec& spec);

}  // namespace carom::io
