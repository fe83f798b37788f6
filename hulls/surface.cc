#include "hulls/surface.h"

#include <algorithm>
#include <limits>

namespace carom::hulls {
namespace {

using Eigen::Vector3d;

// Of what was looked at, the point that is nearest to p.
class Nearest {
 public:
  explicit Nearest(const Vector3d& p) : p_(p) {}

  void look_at(const Vector3d& q) {
    const double squared = (q - p_).squaredNorm();
    if (squared >= squared_) return;
    squared_ = squared;
    point_ = q;
  }
  void look_at_segment(const Vector3d& a, const Vector3d& b) {
    const Vector3d way = b - a;
    const double length = way.squaredNorm();
    const double t = length > 0 ? std::clamp(way.dot(p_ - a) / length, 0.0, 1.0) : 0;
    look_at(a + t * way);
  }
  // The foot of the perpendicular in barycentric coordinates, if it is in the triangle, else the
  // edges.
  void look_at_triangle(const Surface::Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    const Vector3d u = b - a, v = c - a, w = p_ - a;
    const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v);
    const double scale = uu * vv - uv * uv;
    if (scale > 0) {
      const double s = (vv * wu - uv * wv) / scale, t = (uu * wv - uv * wu) / scale;
      if (s >= 0 && t >= 0 && s + t <= 1) return look_at(a + s * u + t * v);
    }
    look_at_segment(a, b);
    look_at_segment(b, c);
    look_at_segment(c, a);
  }
  const Vector3d& point() const { return point_; }

 private:
  Vector3d p_, point_ = Vector3d::Zero();
  double squared_ = std::numeric_limits<double>::infinity();
};

std::vector<Vector3d> points_of(const HullGeometry& hull) {
  std::vector<Vector3d> points;
  for (const Eigen::Vector3f& p : hull.points()) points.push_back(p.cast<double>());
  return points;
}

}  // namespace

Surface::Surface(const HullGeometry& hull) : Surface(hull, points_of(hull)) {}

Surface::Surface(const HullGeometry& hull, std::span<const Vector3d> points) {
  for (const HullGeometry::Face& face : hull.faces()) {
    const auto corners = hull.corners(face);
    for (size_t i = 2; i < corners.size(); ++i) {
      triangles_.push_back({points[corners[0]], points[corners[i - 1]], points[corners[i]]});
    }
  }
  if (!triangles_.empty()) return;
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = i; j < points.size(); ++j) {
      triangles_.push_back({points[i], points[j], points[j]});
    }
  }
}

Vector3d Surface::nearest(const Vector3d& p) const {
  Nearest nearest(p);
  for (const Triangle& triangle : triangles_) nearest.look_at_triangle(triangle);
  return nearest.point();
}

}  // namespace carom::hulls
