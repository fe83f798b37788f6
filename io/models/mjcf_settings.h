// The compiler section of an MJCF model: units of angles, folders of files, and the poses they
// govern.
#pragma once

#include <filesystem>
#include <string>

#include "io/models/mjcf_files.h"
#include "io/models/model.h"

namespace carom::io {

struct MjcfSettings {
  double angle_unit = 0.017453292519943295;  // radians
  std::string euler_sequence = "xyz";        // lower case: axes that turn along; upper: fixed ones
  std::filesystem::path mesh_folder;         // relative to the folder of the main file
  bool strips_paths = false;                 // of mesh files
};

// Reads one compiler section into `settings`.
void read_compiler(const Xml& compiler, MjcfSettings& settings, FirstError& errors);

// The turn that the attributes quat, axisangle, xyaxes, zaxis or euler give, at most one of them;
// `usual` if none is there.
Eigen::Quaterniond orientation_of(const Xml& element, const MjcfSettings& settings,
                                  const Eigen::Quaterniond& usual, FirstError& errors);

// The least turn that brings z to this way. About x if that is backwards.
Eigen::Quaterniond turn_from_z(const Eigen::Vector3d& way);

}  // namespace carom::io
