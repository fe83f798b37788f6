// How far turned shapes reach from their position along the world axes.
#pragma once

#include <Eigen/Geometry>

#include "carom/shapes/shape.h"

namespace carom::reference {

// Corners relative to the position, rounded outwards. Shape and orientation are valid.
Aabb turned_extent(const Capsule& capsule, const Eigen::Quaternionf& orientation);
Aabb turned_extent(const carom::Box& box, const Eigen::Quaternionf& orientation);
Aabb turned_extent(const Cylinder& cylinder, const Eigen::Quaternionf& orientation);
Aabb turned_extent(const Cone& cone, const Eigen::Quaternionf& orientation);
Aabb turned_extent(const Ellipsoid& ellipsoid, const Eigen::Quaternionf& orientation);
Aabb turned_extent(const Triangle& triangle, const Eigen::Quaternionf& orientation);
Aabb turned_extent(const Dop& dop, const Eigen::Quaternionf& orientation);
Aabb turned_extent(const Hull& hull, const Eigen::Quaternionf& orientation);
// The extent of the turned box that holds all parts in the body's frame.
Aabb turned_extent(const Mesh& mesh, const Eigen::Quaternionf& orientation);
Aabb turned_extent(const HeightField& field, const Eigen::Quaternionf& orientation);
Aabb turned_extent(const Compound& compound, const Eigen::Quaternionf& orientation);
// Empty: half-spaces have no extent.
Aabb turned_extent(const Halfspace& plane, const Eigen::Quaternionf& orientation);

}  // namespace carom::reference
