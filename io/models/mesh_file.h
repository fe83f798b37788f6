// Reads mesh files of other programs with assimp: OBJ, STL, glTF and COLLADA.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "carom/base/result.h"

namespace carom::io {

struct MeshPart {
  std::string name;  // may be empty
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};

// The extensions of mesh files, ".obj, .stl, ...".
extern const char kMeshExtensions[];
// Whether the name ends in one of them, ignoring case.
bool names_mesh(const std::string& path);

// The meshes of a file in the poses of its scene, once for each use there. Splits polygons into
// triangles and drops points and lines. Merges vertices at one place, whatever their normals and
// colours. The axes are those of the file: no axis is declared to be upwards and turned to another.
Result<std::vector<MeshPart>> read_mesh_file(const std::string& path);

}  // namespace carom::io
