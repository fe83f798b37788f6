/// @file
/// Meshes: surfaces of triangles, with the tree that finds them.
#pragma once

#include <memory>

#include "carom/shapes/ladder.h"

namespace carom {

class MeshGeometry;  // carom/shapes/mesh_geometry.h: made by make_mesh()

/// A surface of triangles, which turns with its body. Without geometry it is not valid.
struct Mesh {
  std::shared_ptr<const MeshGeometry> geometry;  ///< made by make_mesh(); may be shared
  LadderPtr ladder = nullptr;  ///< simpler models of it, for bodies with a tolerance
};

}  // namespace carom
