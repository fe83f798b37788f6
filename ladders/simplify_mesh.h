// Meshes of fewer triangles, within a proved distance of the original.
#pragma once

#include <memory>
#include <optional>

#include "carom/shapes/mesh_geometry.h"

namespace carom::ladders {

struct SimplerMesh {
  std::shared_ptr<const MeshGeometry> geometry;
  double error;  // metres, an upper bound of the Hausdorff distance of the two surfaces
};

// The mesh of the fewest triangles that was found within `most` metres; nothing if none with
// markedly fewer triangles was. Edges are collapsed by their quadric error (M. Garland and P.
// Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997; the library
// meshoptimizer). That says little about distances, so each result is measured
// (surface_distance.h), and the limit of the collapses is adapted.
std::optional<SimplerMesh> simplify_mesh(const MeshGeometry& mesh, double most);

}  // namespace carom::ladders
