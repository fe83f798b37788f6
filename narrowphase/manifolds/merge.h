// Merges the contacts of many parts of two bodies into one manifold.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "base/tolerances.h"
#include "carom/results/contact.h"
#include "geometries/part.h"

namespace carom {

// The contact of two parts. The points are relative to the position of body A.
struct PartContact {
  std::array<uint64_t, 2> parts;  // ordered by sub-shape
  std::array<float, 3> normal;
  float separation;
  uint8_t count;
  ManifoldPoints points;
  bool is_over_edge;  // the penetration direction leads over an inner edge

  // Deeper contacts come first; contacts over inner edges come last.
  friend bool operator<(const PartContact& x, const PartContact& y) {
    return std::tie(x.is_over_edge, x.separation, x.parts) <
           std::tie(y.is_over_edge, y.separation, y.parts);
  }
};

struct MergedManifold {
  uint8_t count = 0;
  ManifoldPoints points{};
};

// The kMostPartsOfManifold deepest contacts.
inline std::span<PartContact> deepest_of(std::span<PartContact> contacts) {
  if (contacts.size() <= kMostPartsOfManifold) return contacts;
  const auto end = contacts.begin() + static_cast<std::ptrdiff_t>(kMostPartsOfManifold);
  std::nth_element(contacts.begin(), end, contacts.end());
  return contacts.first(kMostPartsOfManifold);
}

namespace merging {

// A contact point; u and v are its coordinates across the normal.
struct SeenPoint {
  double u, v;
  float separation;
  std::array<float, 3> point;
};

inline double area_left(const SeenPoint& a, const SeenPoint& b, const SeenPoint& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

inline double squared_distance(const SeenPoint& a, const SeenPoint& b) {
  return (b.u - a.u) * (b.u - a.u) + (b.v - a.v) * (b.v - a.v);
}

// Two unit vectors perpendicular to a unit vector, after T. Duff et al., Building an Orthonormal
// Basis, Revisited, JCGT 6(1), 2017.
inline std::array<Double3, 2> across(const Double3& n) {
  const double sign = std::copysign(1.0, n[2]);
  const double a = -1 / (sign + n[2]);
  const double b = n[0] * n[1] * a;
  return {
      {{1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]}, {b, sign + n[1] * n[1] * a, -n[1]}}};
}

template <class Points, class Value>
const SeenPoint& greatest(const Points& points, const Value& value) {
  return *std::max_element(
      points.begin(), points.end(),
      [&](const SeenPoint& x, const SeenPoint& y) { return value(x) < value(y); });
}

// Collects the points of all parts whose normals are close to that of the deepest contact,
// contacts[0]. Contacts over inner edges count too, because a body that is tilted a little on a
// flat mesh meets most triangles over their inner edges.
inline void see_points(std::span<const PartContact> contacts, std::vector<SeenPoint>& seen,
                       double& size) {
  const PartContact& deepest = contacts[0];
  const Double3 normal = {deepest.normal[0], deepest.normal[1], deepest.normal[2]};
  const auto [u, v] = across(normal);
  seen.clear();
  size = 0;
  for (const PartContact& contact : contacts) {
    const Double3 m = {contact.normal[0], contact.normal[1], contact.normal[2]};
    if (&contact != &deepest && dot(normal, m) < kSameManifold) continue;
    for (size_t i = 0; i < contact.count; ++i) {
      const std::array<float, 3>& point = contact.points.point[i];
      const Double3 p = {point[0], point[1], point[2]};
      size = std::max(size, carom::greatest(p));
      seen.push_back({dot(u, p), dot(v, p), contact.points.separation[i], point});
    }
  }
}

// The deepest point. Among points that are equally deep up to rounding it is the one farthest from
// the middle, because that is a corner.
inline SeenPoint first_point(const std::vector<SeenPoint>& seen, double size) {
  SeenPoint middle{0, 0, seen[0].separation, {}};
  for (const SeenPoint& p : seen) {
    middle.u += p.u / double(seen.size());
    middle.v += p.v / double(seen.size());
    middle.separation = std::min(middle.separation, p.separation);
  }
  const double deep = middle.separation + kSameDepth * size;
  return greatest(seen, [&](const SeenPoint& p) {
    return p.separation <= deep ? squared_distance(middle, p) : -1;
  });
}

}  // namespace merging

// Up to four points: the deepest, the point farthest from it, and on each side of the line through
// both the point farthest from that line. `seen` is scratch.
inline MergedManifold merged_manifold(std::span<PartContact> all,
                                      std::vector<merging::SeenPoint>& seen) {
  using merging::SeenPoint;
  if (all.empty()) return {};
  const std::span<PartContact> contacts = deepest_of(all);
  std::sort(contacts.begin(), contacts.end());
  double size;
  merging::see_points(contacts, seen, size);
  MergedManifold result;
  const auto keep = [&](const SeenPoint& point) {
    result.points.point[result.count] = point.point;
    result.points.separation[result.count++] = std::max(point.separation, contacts[0].separation);
  };
  if (seen.empty()) return result;
  const SeenPoint first = merging::first_point(seen, size);
  const SeenPoint second = merging::greatest(
      seen, [&](const SeenPoint& p) { return merging::squared_distance(first, p); });
  keep(first);
  const double squared = merging::squared_distance(first, second);
  const double limit = double{kSamePoint} * (size * size);
  if (!(squared > limit)) return result;
  keep(second);
  for (const double side : {1.0, -1.0}) {
    const auto height = [&](const SeenPoint& p) {
      return side * merging::area_left(first, second, p);
    };
    const SeenPoint& beside = merging::greatest(seen, height);
    const double most = height(beside);
    if (most > 0 && most * most > limit * squared) keep(beside);
  }
  return result;
}

}  // namespace carom
