// Surfaces beside meshes of the same triangles, and checks that queries find the same at both.
#pragma once

#include <vector>

#include "tests/support/cast_checks.h"

namespace carom::test {

// Body i of one list has the triangles of body i of the other.
struct TwinSurfaces {
  std::vector<PlacedShape> surfaces, meshes;
};

std::vector<PlacedShape> make_rays(size_t count, uint64_t seed);

// All hits and the closest, for positions of either type, on every instruction set.
void expect_same_casts(const std::vector<PlacedShape>& queries, bool turn, double length,
                       const TwinSurfaces& twins);
// Casts of the surfaces themselves.
void expect_same_casts_of(const TwinSurfaces& twins, const std::vector<PlacedShape>& others);
// Overlaps and nearest bodies.
void expect_same_meetings(const std::vector<PlacedShape>& queries, const TwinSurfaces& twins);

}  // namespace carom::test
