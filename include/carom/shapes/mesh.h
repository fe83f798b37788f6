// Meshes: triangles as a surface, with the tree that finds them.
#pragma once

#include <memory>

namespace carom {

class MeshGeometry;  // carom/shapes/mesh_geometry.h: made by make_mesh()

// Turns with its body. Without geometry it is not valid.
struct Mesh {
  std::shared_ptr<const MeshGeometry> geometry;
};

}  // namespace carom
