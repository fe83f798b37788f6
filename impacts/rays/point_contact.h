// The contact of a point with a triangle of a surface that it meets.
#pragma once

#include <cstdint>
#include <optional>

#include "geometries/part.h"
#include "narrowphase/scalar/separation.h"

namespace carom {

// A surface as a point sees it.
struct SeenSurface {
  Surface surface;
  Double3 place;  // of the surface's position, from the point
  Row orientation;
  Turn turn;                      // rotation_of(orientation)
  std::optional<bool> one_sided;  // without it, as it is made
};

// Writes the contact with the point as A. The arm of B is from the surface's position.
void find_point_contact(const SeenSurface& seen, uint32_t triangle, scalar::Separation& contact);

}  // namespace carom
