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

// Unit normals of all faces; nothing if one has no area.
std::optional<std::vector<Vector3d>> normals_of(const HullGeometry& hull) {
  std::vector<Vector3d> normals;
  normals.reserve(hull.faces().size());
  for (const HullGeometry::Face& face : hull.faces()) {
    const Vector3d area = area_vector(hull, hull.corners(face));
    const double twice_area = area.stableNorm();
    if (!(twice_area > 0)) return std::nullopt;
    normals.push_back(area / twice_area);
  }
  return normals;
}

bool has_few_faces(const HullGeometry& hull) {
  return hull.faces().size() >= 4 && hull.faces().size() <= std::numeric_limits<uint16_t>::max();
}

// The face whose outline runs from one point to another.
struct Way {
  std::pair<uint32_t, uint32_t> ends;
  uint32_t face;
};

}  // namespace

std::shared_ptr<const HullFeatures> HullFeatures::of(const HullGeometry& hull) {
  if (!has_few_faces(hull)) return nullptr;
  const auto normals = normals_of(hull);
  const auto edges = edges_of(hull);
  auto features = std::make_shared<HullFeatures>();
  if (!normals || !edges || !features->add_faces(hull, *normals)) return nullptr;
  features->add_edges(hull, *edges);
  return features;
}

std::shared_ptr<const HullFeatures> HullFeatures::of(const HullGeometry& hull,
                                                     std::span<const Vector3d> normals) {
  auto features = std::make_shared<HullFeatures>();
  return has_few_faces(hull) && features->add_faces(hull, normals) ? features : nullptr;
}

bool HullFeatures::add_faces(const HullGeometry& hull, std::span<const Vector3d> normals) {
  const double most_behind = kBehindFace * double{hull.size()};
  const size_t padded = padded_count(hull.faces().size());
  columns_.assign(4 * padded, 0);
  planes_.reserve(hull.faces().size());
  std::fill_n(columns_.begin() + static_cast<ptrdiff_t>(3 * padded), padded, HUGE_VALF);
  double inner_radius = HUGE_VAL;
  for (const HullGeometry::Face& face : hull.faces()) {
    const auto corners = hull.corners(face);
    const Vector3d& normal = normals[planes_.size()];
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

std::optional<std::vector<HullEdge>> edges_of(const HullGeometry& hull) {
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
  std::vector<HullEdge> edges;
  edges.reserve(ways.size() / 2);
  const auto is_same = [](const Way& a, const Way& b) { return a.ends == b.ends; };
  if (std::adjacent_find(ways.begin(), ways.end(), is_same) != ways.end()) {
    return std::nullopt;
  }
  for (const auto& [there, left] : ways) {
    const Way opposite{{there.second, there.first}, 0};
    const auto back = std::lower_bound(ways.begin(), ways.end(), opposite, is_before);
    if (back == ways.end() || !is_same(*back, opposite)) return std::nullopt;
    if (there.first > there.second) continue;
    const double length = (point(hull, there.second) - point(hull, there.first)).stableNorm();
    if (!(length > 0)) return std::nullopt;
    if (length <= double{kSameCorner} * double{hull.size()}) continue;
    edges.push_back({there.first, there.second, left, back->face});
  }
  return edges;
}

void HullFeatures::add_edges(const HullGeometry& hull, std::span<const HullEdge> edges) {
  edges_.reserve(edges.size());
  for (const HullEdge& edge : edges) {
    const Vector3d along = point(hull, edge.to) - point(hull, edge.from);
    const Vector3d direction = along / along.stableNorm();
    edges_.push_back({Vector4d(direction.x(), direction.y(), direction.z(), 0).cast<float>(),
                      edge.from, edge.left, edge.right});
  }
  const size_t padded = (edges_.size() + 63) / 64 * 64;
  ends_.assign(4 * padded, 0);
  for (size_t e = 0; e < edges.size(); ++e) {
    const uint32_t numbers[] = {edges[e].left, edges[e].right, edges[e].from, edges[e].to};
    for (size_t i = 0; i < 4; ++i) ends_[i * padded + e] = static_cast<uint8_t>(numbers[i]);
  }
  half_cosines_.assign(padded_count(edges.size()), 1);
  for (size_t e = 0; e < edges.size(); ++e) {
    const Eigen::Vector3f sum = normal(edges[e].left) + normal(edges[e].right);
    half_cosines_[e] = static_cast<float>(sum.cast<double>().norm() / 2);
  }
}

size_t HullFeatures::bytes() const {
  return sizeof(*this) + edges_.capacity() * sizeof(Edge) + ends_.capacity() * sizeof(ends_[0]) +
         half_cosines_.capacity() * sizeof(float) + planes_.capacity() * sizeof(planes_[0]) +
         columns_.capacity() * sizeof(float);
}

size_t bytes_of(const HullGeometry& hull) {
  const size_t columns = hull.dop_solid() ? 0 : 3 * hull.column_stride() * sizeof(float);
  return sizeof(hull) + hull.points().size_bytes() + hull.faces().size_bytes() +
         hull.corners().size_bytes() + columns + hull.records().size_bytes() +
         (hull.features() ? hull.features()->bytes() : 0);
}

}  // namespace carom
