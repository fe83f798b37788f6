// The signed distance of any two convex shapes by their support functions alone, in long double:
// slow, and bounded from both sides. It shares nothing with the searches of the library.
#pragma once

#include <cstddef>
#include <functional>

#include "oracle/vec3.h"

namespace carom::oracle {

// A placed convex shape: all points within `radius` of a core.
struct SupportShape {
  using Vec = Vec3<long double>;

  // A point of the core that is furthest along `way`, which is not zero and need not be a unit
  // vector.
  std::function<Vec(const Vec& way)> furthest;
  long double radius = 0;
};

// The separation lies between the two ends. Negative: the shapes overlap by that much.
struct SeparationBounds {
  long double low, high;
  Vec3<long double> normal;  // unit, from A to B; the gap along it is `low`
};

// Searches until both ends are nearer than `tolerance`, or it has looked at too many triangles of
// directions: near a least overlap that is the same in a whole range of directions. A ring of such
// directions takes some 10^5 at a tolerance of 1e-10.
SeparationBounds separation_by_supports(const SupportShape& a, const SupportShape& b,
                                        long double tolerance, size_t most_triangles = 4'000'000);

}  // namespace carom::oracle
