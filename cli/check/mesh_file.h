// Meshes of other programs, by assimp: OBJ, STL and glTF.
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

// Whether the name ends in .obj, .stl, .gltf or .glb, in upper or lower case.
bool names_mesh(const std::string& path);

// The meshes of a file, each where the file's scene has it, as often as it is there. Polygons are
// cut into triangles, points and lines left out. Vertices at one place are one vertex, whatever
// their normals and colours.
Result<std::vector<MeshPart>> read_mesh_file(const std::string& path);

}  // namespace carom::cli
