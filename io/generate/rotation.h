// Rotations with + - * / sqrt of doubles alone, like everything in this folder (see random.h).
#pragma once

#include <array>

#include "io/generate/random.h"

namespace carom::io {

// First rotation b, then rotation a.
Quaternion product(const Quaternion& a, const Quaternion& b);
Quaternion normalized(const Quaternion& q);

// The unit quaternion of a rotation by |vector| radians about the vector.
Quaternion rotation_by(const Vec3& vector);

// Half the extents, along the world axes, of a turned box with these edges. The quaternion need not
// be a unit one.
Vec3 half_extents_turned(const Vec3& edges, const Quaternion& q);

}  // namespace carom::io
