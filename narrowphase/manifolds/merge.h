// Merges the contacts of many parts of two bodies into regions, each with one normal and one
// manifold.
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

// The contact of two parts. Arms and points are relative to the positions of the bodies.
struct PartContact {
  std::array<uint64_t, 2> parts;  // ordered by sub-shape
  std::array<float, 3> normal;
  float separation;
  std::array<float, 3> arm_a, arm_b;
  uint8_t status;
  bool is_over_edge;  // the penetration direction leads over an inner edge
  uint8_t count;
  ManifoldPoints points;

  // Deeper contacts come first; contacts over inner edges come last.
  friend bool operator<(const PartContact& x, const PartContact& y) {
    return std::tie(x.is_over_edge, x.separation, x.parts) <
           std::tie(y.is_over_edge, y.separation, y.parts);
  }
};

struct MergedManifold {
  uint8_t count = 0;
  ManifoldPoints points{};
  std::array<const PartContact*, 4> from{};  // whose point each one is
};

// The contacts of the parts of one region.
struct PartRegion {
  const PartContact* deepest;
  MergedManifold manifold;
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
  const PartContact* from;
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

inline Double3 vector_of(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

template <class Points, class Value>
const SeenPoint& greatest(const Points& points, const Value& value) {
  return *std::max_element(
      points.begin(), points.end(),
      [&](const SeenPoint& x, const SeenPoint& y) { return value(x) < value(y); });
}

// Collects the points of all parts that `joins` the deepest contact. Returns the greatest
// coordinate.
template <class Joins>
double see_points(std::span<const PartContact> contacts, const PartContact& deepest,
                  const Joins& joins, std::vector<SeenPoint>& seen) {
  const auto [u, v] = across(vector_of(deepest.normal));
  double size = 0;
  seen.clear();
  for (const PartContact& contact : contacts) {
    if (!joins(contact)) continue;
    for (size_t i = 0; i < contact.count; ++i) {
      const std::array<float, 3>& point = contact.points.point[i];
      const Double3 p = {point[0], point[1], point[2]};
      size = std::max(size, carom::greatest(p));
      seen.push_back({dot(u, p), dot(v, p), contact.points.separation[i], point, &contact});
    }
  }
  return size;
}

// The deepest point. Among points that are equally deep up to rounding it is the one farthest from
// the middle, because that is a corner.
inline SeenPoint first_point(const std::vector<SeenPoint>& seen, double size) {
  SeenPoint middle{0, 0, seen[0].separation, {}, nullptr};
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

// Up to four points: the deepest, the point farthest from it, and on each side of the line through
// both the point farthest from that line. None is deeper than `deepest`.
inline MergedManifold reduced(const std::vector<SeenPoint>& seen, double size, float deepest) {
  MergedManifold result;
  const auto keep = [&](const SeenPoint& point) {
    result.points.point[result.count] = point.point;
    result.from[result.count] = point.from;
    result.points.separation[result.count++] = std::max(point.separation, deepest);
  };
  if (seen.empty()) return result;
  const SeenPoint first = first_point(seen, size);
  const SeenPoint second =
      greatest(seen, [&](const SeenPoint& p) { return squared_distance(first, p); });
  keep(first);
  const double squared = squared_distance(first, second);
  const double limit = double{kSamePoint} * (size * size);
  if (!(squared > limit)) return result;
  keep(second);
  for (const double side : {1.0, -1.0}) {
    const auto height = [&](const SeenPoint& p) { return side * area_left(first, second, p); };
    const SeenPoint& beside = greatest(seen, height);
    const double most = height(beside);
    if (most > 0 && most * most > limit * squared) keep(beside);
  }
  return result;
}

}  // namespace merging

// Divides the contacts of two bodies into regions. The scratch memory is kept from pair to pair.
class RegionMerger {
 public:
  // The region of the deepest contact: all parts whose normals are within an angle of the deepest
  // one's (`cosine`). Contacts over inner edges join a region, because a body that is tilted a
  // little on a flat mesh meets most triangles over their inner edges.
  MergedManifold first(std::span<PartContact> all, double cosine) {
    if (all.empty()) return {};
    const std::span<PartContact> contacts = deepest_of(all);
    std::sort(contacts.begin(), contacts.end());
    return merge(contacts, contacts[0],
                 [&](const PartContact& c) { return joins(contacts[0], c, cosine); });
  }

  // All regions, the deepest first, at most `most`. The deepest contact that is in no region yet
  // begins the next one; if it came over an inner edge, the neighbouring triangle has the correct
  // normal, and the region is dropped. `left_out`: how many there are beyond `most`, and how many
  // parts there are beyond the deepest ones.
  std::span<const PartRegion> all(std::span<PartContact> all, double cosine, size_t most,
                                  uint32_t& left_out) {
    const std::span<PartContact> contacts = deepest_of(all);
    std::sort(contacts.begin(), contacts.end());
    taken_.assign(contacts.size(), 0);
    regions_.clear();
    left_out = static_cast<uint32_t>(all.size() - contacts.size());
    for (size_t i = 0; i < contacts.size(); ++i) {
      if (taken_[i]) continue;
      if (i > 0 && contacts[i].is_over_edge) break;
      const MergedManifold manifold = merge(contacts, contacts[i], [&](const PartContact& c) {
        uint8_t& taken = taken_[static_cast<size_t>(&c - contacts.data())];
        if (taken || !joins(contacts[i], c, cosine)) return false;
        taken = 1;
        return true;
      });
      if (regions_.size() < most) {
        regions_.push_back({&contacts[i], manifold});
      } else {
        ++left_out;
      }
    }
    return regions_;
  }

 private:
  static bool joins(const PartContact& deepest, const PartContact& contact, double cosine) {
    return &contact == &deepest ||
           dot(merging::vector_of(deepest.normal), merging::vector_of(contact.normal)) >= cosine;
  }

  template <class Joins>
  MergedManifold merge(std::span<const PartContact> contacts, const PartContact& deepest,
                       const Joins& joins) {
    const double size = merging::see_points(contacts, deepest, joins, seen_);
    return merging::reduced(seen_, size, deepest.separation);
  }

  std::vector<merging::SeenPoint> seen_;
  std::vector<uint8_t> taken_;
  std::vector<PartRegion> regions_;
};

}  // namespace carom
