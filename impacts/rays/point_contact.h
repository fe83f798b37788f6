// The contact of a point with a triangle of a mesh that it meets.
#pragma once

#include <cstdint>
#include <optional>

#include "geometries/part.h"
#include "narrowphase/scalar/separation.h"

namespace carom {

// A mesh as a point sees it.
struct SeenMesh {
  const MeshGeometry& mesh;
  Double3 place;  // of the mesh's position, from the point
  Row orientation;
  Turn turn;                      // rotation_of(orientation)
  std::optional<bool> one_sided;  // without it, as the mesh is made
};

// Writes the contact with the point as A. The arm of B is from the mesh's position.
void find_point_contact(const SeenMesh& seen, uint32_t triangle, scalar::Separation& contact);

}  // namespace carom
