// Checks of the properties that build_hull() promises.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "carom/hulls/build_hull.h"
#include "oracle/convex_oracle.h"

namespace carom::hulls {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Points = std::vector<Vector3f>;

double support(std::span<const Vector3f> points, const Vector3d& direction);

Vector3d extents(const Points& points);

Vector3d direction(std::mt19937_64& random);

Vector3d face_normal(const HullGeometry& hull, const HullGeometry::Face& face);

// No corner is lost: the hull reaches as far as its input in random directions, stretched like the
// points, and in the direction of every point.
void expect_same_support(const Points& points, const BuiltHull& hull, std::mt19937_64& random,
                         double tolerance = 1e-8);

// The kept points are a subset of the input, in its order, each once.
void expect_subset(const Points& points, const BuiltHull& hull);

// All points are behind every face, up to `tolerance` extents.
void expect_faces_outside(const Points& points, const BuiltHull& hull, double tolerance);

// The points in the frame in which errors are stated: every axis is scaled by a power of two, so
// that `size` becomes 1/2 to 1 along it, or stays 0.
Points scaled_axes(std::span<const Vector3f> points, const Vector3d& size);

// Dropped points lie inside the hull of the kept ones, up to `tolerance` extents. It tries all
// features of the hull, so the hull must have few corners.
void expect_inside(const Points& points, const BuiltHull& hull, double tolerance = 1e-9);

// Every edge occurs once in each direction.
void expect_closed(const BuiltHull& hull);

}  // namespace carom::hulls
