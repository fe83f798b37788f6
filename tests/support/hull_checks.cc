#include "tests/support/hull_checks.h"

namespace carom::hulls {

double support(std::span<const Vector3f> points, const Vector3d& direction) {
  double best = -std::numeric_limits<double>::infinity();
  for (const Vector3f& p : points) best = std::max(best, direction.dot(p.cast<double>()));
  return best;
}

Vector3d extents(const Points& points) {
  Vector3d lower = points[0].cast<double>(), upper = lower;
  for (const Vector3f& p : points) {
    lower = lower.cwiseMin(p.cast<double>());
    upper = upper.cwiseMax(p.cast<double>());
  }
  return upper - lower;
}

Vector3d direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

Vector3d face_normal(const HullGeometry& hull, const HullGeometry::Face& face) {
  const std::span<const uint32_t> corners = hull.corners(face);
  const auto point = [&](size_t i) { return hull.points()[corners[i]].cast<double>(); };
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 2; i < corners.size(); ++i) {
    sum += (point(i - 1) - point(0)).cross(point(i) - point(0));
  }
  return sum.normalized();
}

void expect_same_support(const Points& points, const BuiltHull& hull, std::mt19937_64& random,
                         double tolerance) {
  const Vector3d size = extents(points);
  const Vector3d inverse = size.unaryExpr([](double s) { return s > 0 ? 1 / s : 0; });
  for (int i = 0; i < 100; ++i) {
    const Vector3d d = direction(random).cwiseProduct(inverse);
    EXPECT_GE(support(hull.geometry->points(), d), support(points, d) - tolerance) << d.transpose();
  }
}

void expect_subset(const Points& points, const BuiltHull& hull) {
  auto next = points.begin();
  for (const Vector3f& p : hull.geometry->points()) {
    next = std::find(next, points.end(), p);
    ASSERT_NE(next, points.end());
    ++next;
  }
  EXPECT_EQ(points.size(), hull.geometry->points().size() + hull.duplicates + hull.inside);
}

void expect_faces_outside(const Points& points, const BuiltHull& hull, double tolerance) {
  const double size = extents(points).maxCoeff();
  for (const HullGeometry::Face& face : hull.geometry->faces()) {
    const Vector3d normal = face_normal(*hull.geometry, face);
    const Vector3d corner = hull.geometry->points()[hull.geometry->corners(face)[0]].cast<double>();
    EXPECT_LE(support(points, normal), normal.dot(corner) + tolerance * size);
  }
}

Points scaled_axes(std::span<const Vector3f> points, const Vector3d& size) {
  Points scaled(points.begin(), points.end());
  for (int axis = 0; axis < 3; ++axis) {
    int exponent = 0;
    std::frexp(size[axis], &exponent);
    for (Vector3f& p : scaled) p[axis] = std::ldexp(p[axis], -exponent);
  }
  return scaled;
}

void expect_inside(const Points& points, const BuiltHull& hull, double tolerance) {
  const auto kept = hull.geometry->points();
  const Vector3d size = extents(points);
  const Points all = scaled_axes(points, size);
  const oracle::ConvexShape<> around(oracle::hull_of(scaled_axes(kept, size)), Pose{});
  for (size_t i = 0; i < points.size(); ++i) {
    if (std::find(kept.begin(), kept.end(), points[i]) != kept.end()) continue;
    const auto point = oracle::vec3_as<long double>(all[i]);
    EXPECT_LE(oracle::signed_distance(around, point), tolerance) << "point " << i;
  }
}

void expect_closed(const BuiltHull& hull) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const HullGeometry::Face& face : hull.geometry->faces()) {
    const std::span<const uint32_t> corners = hull.geometry->corners(face);
    for (size_t i = 0; i < corners.size(); ++i) {
      ++edges[{corners[i], corners[(i + 1) % corners.size()]}];
    }
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
}

}  // namespace carom::hulls
