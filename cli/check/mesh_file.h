// Reads mesh files of other programs with assimp: OBJ, STL and glTF.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "carom/base/result.h"

namespace carom::cli {

struct MeshPart {
  std::string name;  // may be empty
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};

// Whether the name ends in .obj, .stl, .gltf or .glb, ignoring case.
bool names_mesh(const std::string& path);

// The meshes of a file in the poses of its scene, once for each use there. Splits polygons into
// triangles and drops points and lines. Merges vertices at one place, whatever their normals and
// colours.
Result<std::vector<MeshPart>> read_mesh_file(const std::string& path);

}  // namespace carom::cli
