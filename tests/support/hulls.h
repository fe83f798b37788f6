// Hulls of simple form.
#pragma once

#include <numbers>
#include <vector>

#include "oracle/hull_faces.h"
#include "oracle/random.h"
#include "tests/support/pairs.h"

namespace carom::test {

using Points = std::vector<Eigen::Vector3f>;

PlacedShape placed_hull(const Points& points,
                        const Eigen::Vector3d& position = Eigen::Vector3d::Zero(),
                        const Eigen::Quaternionf& turn = Eigen::Quaternionf::Identity());

Points points_of(const Hull& hull);

Points box_corners(const Eigen::Vector3f& half);

Points cube_corners(float half = 1);

// The corners of a box whose edges are bevelled: of each face, this much is missing on all sides.
Points bevelled_corners(const Eigen::Vector3f& half, float bevel);

// A square at z = 0 with sides of 2, and an apex above it.
Points pyramid(float height);

// A prism about the z axis, from -half_height to half_height.
Points prism(size_t sides, float radius, float half_height);

// Random points on an ellipsoid.
Points round_points(size_t count, const Eigen::Vector3f& half, oracle::Random& random);

Points scaled(Points points, float factor);

}  // namespace carom::test
