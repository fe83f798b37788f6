// Convex outlines of coplanar points.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::hulls {

// The corners of the convex polygon of points[indices] in the plane of this normal,
// counter-clockwise as seen from where the normal points. Points within 1e-12 of an edge are
// dropped; collinear points give fewer than three corners. The points have size about one. A. M.
// Andrew, Another efficient algorithm for convex hulls in two dimensions, Information Processing
// Letters 9(5), 1979.
std::vector<uint32_t> outline(std::span<const Eigen::Vector3d> points,
                              std::span<const uint32_t> indices, const Eigen::Vector3d& normal);

// Twice the area of a polygon times its unit normal (Newell).
Eigen::Vector3d area_vector(std::span<const Eigen::Vector3d> points,
                            std::span<const uint32_t> corners);

}  // namespace carom::hulls
