// Robot descriptions (URDF and MJCF) as scenes.
#pragma once

#include <memory>
#include <string>

#include "io/models/model.h"

namespace carom::io {

// Whether the name ends in .urdf, .xml or .mjcf, ignoring case.
bool names_model(const std::string& path);

// Reads a file whose root element is <robot> (URDF) or <mujoco> (MJCF).
Result<Model> read_model(const std::string& path);

// The model as a scene of one frame.
Result<std::unique_ptr<SceneReader>> open_model(const std::string& path,
                                                const SceneArrays& wanted = {});

}  // namespace carom::io
