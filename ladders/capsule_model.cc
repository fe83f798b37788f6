#include "ladders/capsule_model.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "shapes/hull_features.h"

namespace carom::ladders {
namespace {

using Eigen::Vector3d;

// The rounding of heights, radii and errors, a share of the size.
constexpr double kSlackOfCapsules = 1e-6;

struct Segment {
  Vector3d a, b;

  double distance(const Vector3d& p) const {
    const Vector3d along = b - a;
    const double square = along.squaredNorm();
    const double t = square > 0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0;
    return (a + t * along - p).norm();
  }
};

Vector3d rounded(const Vector3d& p) { return p.cast<float>().cast<double>(); }

// The direction in which the points of a hull are spread most.
Vector3d long_axis(const HullGeometry& hull) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3f& p : hull.points()) {
    const Vector3d way = p.cast<double>() - hull.middle();
    spread += way * way.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
}

// Both are convex. A segment that lies `deep` inside a hull has a capsule of that radius in it; no
// point of a capsule of the radius r is then further from the hull than r - deep. No point of the
// hull is further from the capsule than its furthest corner. Infinitely far if the segment is not
// inside.
Rung around(const HullGeometry& hull, const HullFeatures& features, const Segment& segment) {
  double deep = std::numeric_limits<double>::infinity();
  for (size_t face = 0; face < features.face_count(); ++face) {
    const Vector3d normal = features.normal(face).cast<double>();
    const double highest = std::max(normal.dot(segment.a), normal.dot(segment.b));
    deep = std::min(deep, double{features.height(face)} - highest);
  }
  double furthest = 0;
  for (const Eigen::Vector3f& p : hull.points()) {
    furthest = std::max(furthest, segment.distance(p.cast<double>()));
  }
  const double slack = kSlackOfCapsules * double{hull.size()};
  const auto radius = static_cast<float>(std::max((furthest + deep) / 2, slack));
  double error = std::max(furthest - double{radius}, double{radius} - deep) + slack;
  if (!(deep >= 0)) error = std::numeric_limits<double>::infinity();
  return {Capsule{segment.a.cast<float>(), segment.b.cast<float>(), radius}, error};
}

std::optional<Rung> model_of(const HullGeometry& hull) {
  const HullFeatures* const features = hull.features();
  if (!features) return std::nullopt;
  const Vector3d axis = long_axis(hull);
  double low = 0, high = 0;
  for (const Eigen::Vector3f& p : hull.points()) {
    const double along = axis.dot(p.cast<double>() - hull.middle());
    low = std::min(low, along);
    high = std::max(high, along);
  }
  const Vector3d middle = hull.middle() + (low + high) / 2 * axis;
  std::optional<Rung> best;
  for (const double length : {0.0, 0.15, 0.3, 0.45, 0.6, 0.7, 0.8, 0.9}) {
    const Vector3d half = length * (high - low) / 2 * axis;
    Rung rung = around(hull, *features, {rounded(middle - half), rounded(middle + half)});
    if (!best || rung.error < best->error) best = std::move(rung);
  }
  return best;
}

// A small ball is no further from a shape that lies in a ball about the same middle than the sum of
// the two radii.
std::optional<Rung> ball_in(const Eigen::Vector3f& lower, const Eigen::Vector3f& upper) {
  constexpr double kSmall = 0x1p-8;
  const Vector3d low = lower.cast<double>(), high = upper.cast<double>();
  const Vector3d middle = rounded((low + high) / 2);
  const double reach = (high - middle).cwiseMax(middle - low).norm();
  const auto radius = static_cast<float>(kSmall * reach);
  if (!(radius > 0) || !std::isfinite(radius)) return std::nullopt;
  const Eigen::Vector3f at = middle.cast<float>();
  return Rung{Capsule{at, at, radius}, (reach + double{radius}) * (1 + kSlackOfCapsules)};
}

// Triangles without area do not collide.
bool has_area(const MeshGeometry& mesh) {
  for (uint32_t i = 0; i < mesh.triangles().size(); ++i) {
    if (!mesh.is_degenerate(i)) return true;
  }
  return false;
}

bool has_triangles(const CompoundChild& child) {
  return std::holds_alternative<Mesh>(child.shape) ||
         std::holds_alternative<Triangle>(child.shape) ||
         std::holds_alternative<Compound>(child.shape);
}

}  // namespace

std::optional<Rung> capsule_model(const Shape& shape) {
  if (const auto* hull = std::get_if<Hull>(&shape)) return model_of(*hull->geometry);
  if (const auto* mesh = std::get_if<Mesh>(&shape)) {
    const MeshRules& rules = mesh->geometry->rules();
    if (rules.one_sided || rules.thickness > 0 || !has_area(*mesh->geometry)) return std::nullopt;
    return ball_in(mesh->geometry->lower(), mesh->geometry->upper());
  }
  const auto* compound = std::get_if<Compound>(&shape);
  if (!compound) return std::nullopt;
  const auto children = compound->geometry->children();
  if (children.empty() || std::any_of(children.begin(), children.end(), has_triangles))
    return std::nullopt;
  return ball_in(compound->geometry->lower(), compound->geometry->upper());
}

}  // namespace carom::ladders
