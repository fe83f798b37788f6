// Signed distances in double, as simple as possible: for generators only, never to judge a result.
#pragma once

#include <algorithm>
#include <cmath>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "tests/support/pairs.h"

namespace carom::test {

// A sphere or an aabb, as a box grown by a radius.
struct RoundedBox {
  Eigen::Vector3d lower;
  Eigen::Vector3d upper;
  double radius;
};

RoundedBox rounded_box(const Shape& shape);

// The separation of two shapes; `d` is the position of B relative to A's.
double textbook_separation(const Shape& shape_a, const Shape& shape_b, const Eigen::Vector3d& d);

// The radius of the ball about the body's position that contains it, or its bounds; 0 for
// half-spaces.
double bounding_radius(const Sphere& sphere);
double bounding_radius(const Aabb& box);
double bounding_radius(const Capsule& c);
double bounding_radius(const Box& box);
double bounding_radius(const Cylinder& cylinder);
double bounding_radius(const Cone& cone);
double bounding_radius(const Ellipsoid& ellipsoid);
double bounding_radius(const Triangle& triangle);
double bounding_radius(const Dop& dop);
double bounding_radius(const Hull& hull);
double bounding_radius(const Halfspace&);
double bounding_radius(const Mesh& mesh);
double bounding_radius(const HeightField& field);
double bounding_radius(const Compound& compound);
double bounding_radius(const Shape& shape);

}  // namespace carom::test
