// Tolerances of manifolds, in scaled units (see Units), for the kernels and the scalar reference.
#pragma once

namespace carom {

// Points of a manifold may be as far apart as this, which is what rounding does to them.
inline constexpr float kTouchingPoint = 0x1p-18f;

// Sides of faces count as so much farther out: edges that lie on one another stay in sight.
inline constexpr float kClipSlack = 0x1p-20f;

// Slower than this an edge does not cross a line: the quotient would lose its meaning.
inline constexpr float kLeastCrossing = 0x1p-60f;

// Points whose squared distance is less are one; so are lines and points so near to them.
inline constexpr float kSamePoint = 0x1p-32f;

// A face whose normal is at a greater angle to the view (the cosine is less) is seen from the edge.
inline constexpr float kEdgeOn = 0.05f;

// Special triangles show their front if its normal is at a smaller angle to the contact's.
inline constexpr float kFront = 0.99f;

// Triangles whose longest edge has a smaller squared sine with another are segments.
inline constexpr float kSliver = 0x1p-40f;

// Capsules that the contact's normal meets at a smaller squared sine touch with an end.
inline constexpr float kEndOn = 0x1p-10f;

// Capsules touch along a line if the squared sine of their angle is less.
inline constexpr float kSameDirection = 0x1p-12f;

// So much of the radius beyond its end a capsule is still a cylinder: off by half the square.
inline constexpr float kOverhang = 0x1p-9f;

}  // namespace carom
