#include "carom/hulls/build_hull.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/float_environment.h"
#include "hulls/facets.h"
#include "hulls/merge_facets.h"
#include "hulls/outline.h"
#include "hulls/unit_points.h"

namespace carom::hulls {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kFlat = 1e-12;   // this close to a line or plane counts as on it
constexpr double kInside = 1e-9;  // thicker facets may hide corners; a share of the height

template <class Value>
std::pair<uint32_t, double> largest(const std::vector<Vector3d>& points, const Value& value) {
  std::pair<uint32_t, double> best = {0, -std::numeric_limits<double>::infinity()};
  for (size_t i = 0; i < points.size(); ++i) {
    const double v = value(points[i]);
    if (v > best.second) best = {static_cast<uint32_t>(i), v};
  }
  return best;
}

// The dimension of a point set, with the ends of a segment, the normal of a polygon's plane, or the
// height of a solid above the plane of three of its points.
struct Form {
  HullForm form = HullForm::point;
  uint32_t first = 0;
  uint32_t last = 0;
  Vector3d normal = Vector3d::Zero();
  double height = 0;
};

Form form_of(const std::vector<Vector3d>& points) {
  Form result;
  if (points.size() == 1) return result;
  const auto distance_to = [](const Vector3d& from) {
    return [from](const Vector3d& p) { return (p - from).squaredNorm(); };
  };
  result.first = largest(points, distance_to(points[0])).first;
  result.last = largest(points, distance_to(points[result.first])).first;
  result.form = HullForm::segment;
  const Vector3d& origin = points[result.first];
  const Vector3d along = (points[result.last] - origin).normalized();
  const auto off_line = [&](const Vector3d& p) { return along.cross(p - origin).norm(); };
  const auto [third, height] = largest(points, off_line);
  if (height <= kFlat) return result;

  result.form = HullForm::polygon;
  result.normal = along.cross(points[third] - origin).normalized();
  const auto off_plane = [&](const Vector3d& p) { return std::abs(result.normal.dot(p - origin)); };
  result.height = largest(points, off_plane).second;
  if (result.height > kFlat) result.form = HullForm::solid;
  return result;
}

// Keeps every point as a corner and has no faces.
HullFaces all_points(size_t count) { return {{}, std::vector<bool>(count, true)}; }

HullFaces segment_faces(const Form& form, size_t count) {
  HullFaces faces{{}, std::vector<bool>(count, false)};
  faces.is_corner[form.first] = true;
  faces.is_corner[form.last] = true;
  return faces;
}

HullFaces polygon_faces(const UnitPoints& unit, const Vector3d& normal) {
  std::vector<uint32_t> all(unit.point.size());
  for (uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  std::vector<uint32_t> front = outline(unit.point, all, normal);
  if (front.size() < 3) return all_points(unit.point.size());
  HullFaces faces{{}, std::vector<bool>(unit.point.size(), false)};
  for (const uint32_t corner : front) faces.is_corner[corner] = true;
  faces.faces.push_back(front);
  faces.faces.emplace_back(front.rbegin(), front.rend());
  return faces;
}

HullFaces solid_faces(const UnitPoints& unit, double height) {
  std::optional<Facets> facets = find_facets(unit.point, false);
  if (!facets) facets = find_facets(unit.point, true);
  if (!facets) return all_points(unit.point.size());
  HullFaces faces = merge_facets(unit.point, facets->list, unit.rounding);
  // Thick facets may hide corners: where two meet at a small angle, points further out than the
  // thickness may be missing. Keep all points.
  if (facets->thickness > kInside * height) faces.is_corner.assign(unit.point.size(), true);
  return faces;
}

HullFaces faces_of(const UnitPoints& unit, const Form& form) {
  switch (form.form) {
    case HullForm::point:
      return all_points(1);
    case HullForm::segment:
      return segment_faces(form, unit.point.size());
    case HullForm::polygon:
      return polygon_faces(unit, form.normal);
    case HullForm::solid:
      return solid_faces(unit, form.height);
  }
  return {};
}

// Replaces indices of all points in the outlines by indices of the kept points.
void renumber(HullFaces& faces) {
  std::vector<uint32_t> place(faces.is_corner.size());
  uint32_t next = 0;
  for (size_t i = 0; i < place.size(); ++i) {
    place[i] = next;
    next += faces.is_corner[i];
  }
  for (std::vector<uint32_t>& face : faces.faces) {
    for (uint32_t& corner : face) corner = place[corner];
  }
}

}  // namespace
}  // namespace carom::hulls

namespace carom {

using namespace hulls;

const char* name(HullForm form) {
  switch (form) {
    case HullForm::point:
      return "point";
    case HullForm::segment:
      return "segment";
    case HullForm::polygon:
      return "polygon";
    case HullForm::solid:
      return "solid";
  }
  return "unknown";
}

Result<BuiltHull> build_hull(std::span<const Eigen::Vector3f> points) {
  const FloatEnvironment environment;
  if (points.empty()) return Error{"a hull without points"};
  for (size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    return Error{"point " + std::to_string(i) + " of the hull is not finite"};
  }
  const UnitPoints unit = unit_points(points);
  const Form form = form_of(unit.point);
  HullFaces faces = faces_of(unit, form);

  std::vector<Eigen::Vector3f> kept;
  for (size_t i = 0; i < unit.point.size(); ++i) {
    if (faces.is_corner[i]) kept.push_back(points[unit.source[i]]);
  }
  renumber(faces);
  Result<std::shared_ptr<const HullGeometry>> geometry = make_hull(kept, faces.faces);
  if (!geometry) return geometry.error();
  return BuiltHull{std::move(*geometry), form.form, points.size() - unit.point.size(),
                   unit.point.size() - kept.size()};
}

}  // namespace carom
