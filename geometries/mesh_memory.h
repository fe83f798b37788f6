// Asks for the memory of triangles before they are needed: first for the indices of their corners,
// later for the corners.
#pragma once

#include <hwy/cache_control.h>

#include "carom/shapes/mesh_geometry.h"

namespace carom {

inline void prefetch_indices(const MeshGeometry& mesh, uint32_t triangle) {
  hwy::Prefetch(&mesh.triangles()[triangle]);
}

inline void prefetch_corners(const MeshGeometry& mesh, uint32_t triangle) {
  for (const uint32_t vertex : mesh.triangles()[triangle]) hwy::Prefetch(&mesh.vertices()[vertex]);
}

}  // namespace carom
