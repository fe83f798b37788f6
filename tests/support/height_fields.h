// Height fields, and meshes of the same triangles.
#pragma once

#include <vector>

#include "carom/shapes/height_field_geometry.h"
#include "oracle/convex_random.h"
#include "tests/support/composites.h"

namespace carom::test {

// Heights row by row.
struct HeightTable {
  uint32_t nx = 0, ny = 0;
  float dx = 1, dy = 1;
  std::vector<float> heights = {};

  float& at(uint32_t i, uint32_t j) { return heights[size_t{j} * nx + i]; }
  HeightGrid grid() const {
    return {.nx = nx, .ny = ny, .dx = dx, .dy = dy, .samples = {.data = heights.data()}};
  }
};

// Heights of up to `bumps` either way, some of them holes.
HeightTable random_heights(uint32_t nx, uint32_t ny, double bumps, double holes,
                           oracle::Random& random);

std::shared_ptr<HeightFieldGeometry> geometry_of(const HeightTable& table);

// A mesh of the same triangles with the same indices. In holes they have no area.
Mesh mesh_like(const HeightFieldGeometry& field);

}  // namespace carom::test
