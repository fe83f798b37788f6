// The radius of a ball about each body's position that holds its shape.
#pragma once

#include <cstddef>

namespace carom {

struct BodyReader;

// An upper bound for any orientation, but at most the largest float. For spheres their own radius;
// infinite for half-spaces; zero for shapes that are not valid.
float bounding_radius(const BodyReader& reader, size_t i);

// Turned about the body's position by a small angle, the surface of the shape moves by no more than
// the angle times this radius (as sets: no point of one is further from the other). That of a
// convex shape is the most by which a support point is off the line through the position along its
// direction, since the height of the support changes by that: a ball has 0, a cube half the
// diagonal of a face. Zero for what does not turn, infinite for half-spaces. `radius`: that of
// bounding_radius().
float turning_radius(const BodyReader& reader, size_t i, float radius);

}  // namespace carom
