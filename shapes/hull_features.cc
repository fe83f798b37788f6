#include "shapes/hull_features.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/tolerances.h"

namespace carom {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

Vector3d point(const HullGeometry& hull, uint32_t i) { return hull.points()[i].cast<double>(); }

// Twice the area times the normal. Source: see narrowphase/manifolds/hull_face.h.
Vector3d area_vector(const HullGeometry& hull, std::span<const uint32_t> corners) {
  const Vector3d first = point(hull, corners[0]);
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 2; i < corners.size(); ++i) {
    sum += (point(hull, corners[i - 1]) - first).cross(point(hull, corners[i]) - first);
  }
  return sum;
}

// The face whose outline runs from one point to another.
struct Way {
  std::pair<uint32_t, uint32_t> ends;
  uint32_t face;
};

}  // namespace

std::shared_ptr<const HullFeatures> HullFeatures::of(const HullGeometry& hull) {
  constexpr size_t kMostFaces = std::numeric_limits<uint16_t>::max();
  if (hull.faces().size() < 4 || hull.faces().size() > kMostFaces) return nullptr;
  auto features = std::make_shared<HullFeatures>();
  const bool is_solid = features->add_faces(hull) && features->add_edges(hull);
  return is_solid ? features : nullptr;
}

bool HullFeatures::add_faces(const HullGeometry& hull) {
  const double most_behind = kBehindFace * double{hull.size()};
  const size_t padded = padded_count(hull.faces().size());
  columns_.assign(4 * padded, 0);
  planes_.reserve(hull.faces().size());
  std::fill_n(columns_.begin() + static_cast<ptrdiff_t>(3 * padded), padded, HUGE_VALF);
  double inner_radius = HUGE_VAL;
  for (const HullGeometry::Face& face : hull.faces()) {
    const auto corners = hull.corners(face);
    const Vector3d area = area_vector(hull, corners);
    const double twice_area = area.stableNorm();
    if (!(twice_area > 0)) return false;
    const Vector3d normal = area / twice_area;
    double height = normal.dot(point(hull, corners[0]));
    for (uint32_t i = 0; i < hull.points().size(); ++i) {
      height = std::max(height, normal.dot(point(hull, i)));
    }
    for (const uint32_t corner : corners) {
      if (height - normal.dot(point(hull, corner)) > most_behind) return false;
    }
    const Eigen::Vector3f n = normal.cast<float>();
    planes_.push_back({n.x(), n.y(), n.z(), static_cast<float>(height)});
    for (size_t i = 0; i < 4; ++i) columns_[i * padded + planes_.size() - 1] = planes_.back()[i];
    inner_radius = std::min(inner_radius, height - normal.dot(hull.middle()));
  }
  inner_radius_ = static_cast<float>(std::max(inner_radius - 4 * most_behind, 0.0));
  return true;
}

bool HullFeatures::add_edges(const HullGeometry& hull) {
  std::vector<Way> ways;
  ways.reserve(hull.corners().size());
  for (uint32_t f = 0; f < hull.faces().size(); ++f) {
    const auto corners = hull.corners(hull.faces()[f]);
    for (size_t i = 0; i < corners.size(); ++i) {
      ways.push_back({{corners[i], corners[(i + 1) % corners.size()]}, f});
    }
  }
  const auto is_before = [](const Way& a, const Way& b) { return a.ends < b.ends; };
  std::sort(ways.begin(), ways.end(), is_before);
  edges_.reserve(ways.size() / 2);
  const auto is_same = [](const Way& a, const Way& b) { return a.ends == b.ends; };
  if (std::adjacent_find(ways.begin(), ways.end(), is_same) != ways.end()) return false;
  for (const auto& [there, left] : ways) {
    const Way opposite{{there.second, there.first}, 0};
    const auto back = std::lower_bound(ways.begin(), ways.end(), opposite, is_before);
    if (back == ways.end() || !is_same(*back, opposite)) return false;
    if (there.first > there.second) continue;
    const uint32_t right = back->face;
    const Vector3d along = point(hull, there.second) - point(hull, there.first);
    const double length = along.stableNorm();
    if (!(length > 0)) return false;
    if (length <= double{kSameCorner} * double{hull.size()}) continue;
    const Vector3d direction = along / length;
    edges_.push_back({Vector4d(direction.x(), direction.y(), direction.z(), 0).cast<float>(),
                      there.first, left, right});
  }
  const size_t padded = (edges_.size() + 63) / 64 * 64;
  sides_.assign(2 * padded, 0);
  for (size_t e = 0; e < edges_.size(); ++e) {
    sides_[e] = static_cast<uint8_t>(edges_[e].left);
    sides_[padded + e] = static_cast<uint8_t>(edges_[e].right);
  }
  return true;
}

size_t HullFeatures::bytes() const {
  return sizeof(*this) + edges_.capacity() * sizeof(Edge) + sides_.capacity() * sizeof(sides_[0]) +
         planes_.capacity() * sizeof(planes_[0]) + columns_.capacity() * sizeof(float);
}

size_t bytes_of(const HullGeometry& hull) {
  const size_t padded = padded_count(hull.points().size());
  return sizeof(hull) + hull.points().size_bytes() + hull.faces().size_bytes() +
         hull.corners().size_bytes() + 3 * padded * sizeof(float) + hull.records().size_bytes() +
         (hull.features() ? hull.features()->bytes() : 0);
}

}  // namespace carom
