// Rotations, by + - * / sqrt of doubles alone, like everything in this folder (see random.h).
#pragma once

#include <array>

#include "io/generate/random.h"

namespace carom::io {

// The rotation a after the rotation b.
Quaternion product(const Quaternion& a, const Quaternion& b);
Quaternion normalized(const Quaternion& q);

// By |vector| radians about the vector, as a unit quaternion.
Quaternion rotation_by(const Vec3& vector);

// Half the extents, along the world axes, of a turned box with these edges. The quaternion need not
// be a unit one.
Vec3 half_extents_turned(const Vec3& edges, const Quaternion& q);

}  // namespace carom::io
