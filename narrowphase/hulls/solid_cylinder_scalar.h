// The widest gap between a solid and a cylinder, scalar form, in the solid's frame.
//
// As for two cylinders (narrowphase/features/cylinders_scalar.h), every pair of features that can
// face each other has its own direction, and the separation is the widest gap of all:
// - a face, a cap: along its normal;
// - a corner, and a side or a rim: away from the axis, or from the nearest point of the rim;
// - an edge and a side: across both;
// - an edge and a rim: the best direction of the arc between the normals of the edge's two faces,
//   by Newton's method.
// On the arc of an edge the gap is that of the edge's line: no other point of the solid reaches
// further. It is concave in any multiple of the direction, so a slope at the middle bounds it on
// the whole arc (R. T. Rockafellar, Convex Analysis, 1970, section 23), and most edges need no
// search.
#pragma once

#include <array>
#include <cstdint>

#include "base/few_of.h"
#include "base/tolerances.h"
#include "narrowphase/features/solid_contact_scalar.h"
#include "narrowphase/hulls/solid.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

// `middle` and `axis` in the frame of the solid.
struct PlacedCylinder {
  Vector3f middle, axis;
  float half_length, rim;

  AxialCore core() const { return {axis, half_length, rim}; }
  float gap_over(const Vector3f& n, float height) const {
    const Vector3f across = cross(n, axis);
    const float reach =
        half_length * std::fabs(dot(n, axis)) + rim * std::sqrt(dot(across, across));
    return (dot(n, middle) - reach) - height;
  }
};

// A direction out of the solid, and the feature of the solid that it belongs to.
struct SolidWay {
  enum class Feature : uint8_t { none, face, cap, corner, crossing, edge };

  float gap = -kLargest;
  Vector3f n{0, 0, 1};
  Feature feature = Feature::none;
  uint32_t place = 0;     // of the face, corner or edge
  bool has_ended = true;  // of a search

  void keep_if_wider(const SolidWay& next) {
    if (next.rank() > rank()) *this = next;
  }
  float rank() const { return gap - (has_ended ? 0.0f : kNotEnded); }
};

// An edge, by the normals of its faces; `d` is across both, `way` leads from its line to the middle
// of the cylinder.
struct EdgeArc {
  Vector3f left, right, d, way;

  EdgeArc(const Solid& solid, size_t e, const Vector3f& middle)
      : left(solid.normal(solid.side[0][e])),
        right(solid.normal(solid.side[1][e])),
        d(unit(cross(left, right))),
        way(middle - solid.corner(solid.edges[e].from)) {}

  bool holds(const Vector3f& n) const {
    return dot(cross(left, n), d) > 0 && dot(cross(n, right), d) > 0;
  }
};

// The middle of an arc, the gap there, and a bound of the gap on the whole arc by the slope there.
struct ArcMiddle {
  Vector3f n;
  float gap, bound;

  ArcMiddle(const EdgeArc& arc, const PlacedCylinder& cylinder) : n(unit(arc.left + arc.right)) {
    const float along = dot(n, cylinder.axis);
    const Vector3f across = n - cylinder.axis * along;
    const float over = 1 / max(std::sqrt(dot(across, across)), kLeastRim);
    const Vector3f slope = (arc.way - cylinder.axis * std::copysign(cylinder.half_length, along)) -
                           across * (cylinder.rim * over);
    gap = dot(slope, n);
    const float at_left = dot(slope, arc.left), at_right = dot(slope, arc.right);
    const float from_left = dot(slope, cross(arc.d, arc.left));
    const bool has_peak = from_left > 0 && dot(slope, cross(arc.d, arc.right)) < 0;
    bound =
        has_peak ? std::sqrt(at_left * at_left + from_left * from_left) : max(at_left, at_right);
  }
};

// A step of Newton's method for n . way - rim |n x axis| on the arc, from `way` to a cap. Returns
// whether it was short.
inline bool step_on_arc(const EdgeArc& arc, const Vector3f& way, const PlacedCylinder& cylinder,
                        Vector3f& n) {
  const Vector3f s = cross(arc.d, n), across = cross(n, cylinder.axis);
  const float x = dot(n, cylinder.axis), y = dot(s, cylinder.axis);
  const float off = max(std::sqrt(dot(across, across)), kLeastRim);
  const float over = 1 / off;
  const float tilt = (x * y) * over;
  const float slope = dot(s, way) + cylinder.rim * tilt;
  const float curve = (cylinder.rim * over) * ((y * y - x * x) + tilt * tilt) - dot(n, way);
  const float step = curve < 0 ? -slope / curve : std::copysign(kShortArc, slope);
  const float most = min(kLongTurn, kRimStep * off);
  const float turn = clamp(step, -most, most);
  Vector3f next = unit(n + s * turn);
  if (dot(cross(arc.left, next), arc.d) < 0) next = arc.left;
  if (dot(cross(next, arc.right), arc.d) < 0) next = arc.right;
  const float moved = dot(cross(n, next), arc.d);
  n = next;
  return std::fabs(moved) <= kLastArc;
}

// The direction to start from on the side of one cap: the best of a few that lie there. Near the
// axis the gap has a narrow peak, so that the nearest direction to the axis is one of them.
struct ArcStart {
  float gap = -kLargest;
  Vector3f n{0, 0, 1};

  ArcStart(const EdgeArc& arc, const ArcMiddle& middle, const PlacedCylinder& cylinder,
           float sign) {
    const Vector3f nearest = unit((cylinder.axis - arc.d * dot(arc.d, cylinder.axis)) * sign);
    keep_if_wider(middle.n, arc, cylinder, sign);
    const Vector3f before = unit(arc.left + middle.n), behind = unit(middle.n + arc.right);
    keep_if_wider(before, arc, cylinder, sign);
    keep_if_wider(behind, arc, cylinder, sign);
    keep_if_wider(unit(arc.left + before), arc, cylinder, sign);
    keep_if_wider(unit(behind + arc.right), arc, cylinder, sign);
    if (arc.holds(nearest)) keep_if_wider(nearest, arc, cylinder, sign);
    if (gap > -kLargest) return;
    keep_if_wider(arc.left, arc, cylinder, sign);
    keep_if_wider(arc.right, arc, cylinder, sign);
  }

 private:
  void keep_if_wider(const Vector3f& m, const EdgeArc& arc, const PlacedCylinder& cylinder,
                     float sign) {
    const float wide = cylinder.gap_over(m, dot(m, cylinder.middle) - dot(m, arc.way));
    if (!(dot(m, cylinder.axis) * sign >= 0 && wide > gap)) return;
    gap = wide;
    n = m;
  }
};

inline SolidWay search_edge(const EdgeArc& arc, const ArcMiddle& middle, uint32_t e,
                            const PlacedCylinder& cylinder, float sign) {
  using Feature = SolidWay::Feature;
  const ArcStart start(arc, middle, cylinder, sign);
  SolidWay found{-kLargest, start.n, Feature::edge, e, false};
  const Vector3f way = arc.way - cylinder.axis * (sign * cylinder.half_length);
  for (size_t i = 0; i < kSolidArcSteps; ++i) {
    found.has_ended = step_on_arc(arc, way, cylinder, found.n);
  }
  if (start.gap > -kLargest) {
    found.gap = cylinder.gap_over(found.n, dot(found.n, cylinder.middle) - dot(found.n, arc.way));
  }
  return found;
}

inline SolidWay way_across(const EdgeArc& arc, uint32_t e, const PlacedCylinder& cylinder) {
  using Feature = SolidWay::Feature;
  const Vector3f n = unit(cross(arc.d, cylinder.axis));
  const Vector3f out = dot(cross(arc.left, n), arc.d) < 0 ? Vector3f(-n) : n;
  const float gap = cylinder.gap_over(out, dot(out, cylinder.middle) - dot(out, arc.way));
  return {arc.holds(out) ? gap : -kLargest, out, Feature::crossing, e, true};
}

inline float height_along(const Solid& solid, const Vector3f& n) {
  float most = -kLargest;
  for (size_t i = 0; i < solid.point_count; ++i) most = max(most, dot(n, solid.corner(i)));
  return most;
}

inline SolidWay find_solid_way(const Solid& solid, const PlacedCylinder& cylinder) {
  using Feature = SolidWay::Feature;
  SolidWay best;
  for (uint32_t f = 0; f < solid.face_count; ++f) {
    const Vector3f n = solid.normal(f);
    best.keep_if_wider({cylinder.gap_over(n, solid.height(f)), n, Feature::face, f});
  }
  for (const float sign : {1.0f, -1.0f}) {
    const Vector3f n = cylinder.axis * sign;
    const float gap = (dot(n, cylinder.middle) - cylinder.half_length) - height_along(solid, n);
    best.keep_if_wider({gap, n, Feature::cap, 0});
  }
  for (uint32_t i = 0; i < solid.point_count; ++i) {
    const Vector3f n = way_from_corner(solid.corner(i), cylinder.middle, cylinder.core());
    best.keep_if_wider({cylinder.gap_over(n, height_along(solid, n)), n, Feature::corner, i});
  }
  // The widest gap that is known.
  float most = best.gap;
  for (uint32_t e = 0; e < solid.edge_count; ++e) {
    most = max(most, ArcMiddle(EdgeArc(solid, e, cylinder.middle), cylinder).gap - kNotEnded);
  }
  for (uint32_t e = 0; e < solid.edge_count; ++e) {
    const EdgeArc arc(solid, e, cylinder.middle);
    const ArcMiddle middle(arc, cylinder);
    if (!(middle.bound > most)) continue;
    best.keep_if_wider(way_across(arc, e, cylinder));
    best.keep_if_wider(search_edge(arc, middle, e, cylinder, 1));
    best.keep_if_wider(search_edge(arc, middle, e, cylinder, -1));
  }
  return best;
}

// Where the height over no face exceeds `most`.
inline bool is_within(const Solid& solid, const Vector3f& p, float most) {
  for (size_t f = 0; f < solid.face_count; ++f) {
    if (!(dot(solid.normal(f), p) - solid.height(f) <= most)) return false;
  }
  return true;
}

inline Vector3f furthest_corner(const Solid& solid, const Vector3f& n) {
  size_t furthest = 0;
  float most = -kLargest;
  for (size_t i = 0; i < solid.point_count; ++i) {
    const float height = dot(n, solid.corner(i));
    if (!(height > most)) continue;
    most = height;
    furthest = i;
  }
  return solid.corner(furthest);
}

// Where the edge and the line of the cylinder's side cross, seen along the normal.
inline Vector3f crossing_on_edge(const Solid& solid, const PlacedCylinder& cylinder,
                                 const SolidWay& way) {
  const EdgeArc arc(solid, way.place, cylinder.middle);
  const Vector3f across = cross(cylinder.axis, way.n);
  const float share = dot(arc.way, across) / dot(arc.d, across);
  return solid.corner(solid.edges[way.place].from) + arc.d * share;
}

inline bool is_on_edge(const Solid& solid, size_t e, const Vector3f& p) {
  const Vector3f from = solid.corner(solid.end[0][e]);
  const Vector3f along = solid.corner(solid.end[1][e]) - from, way = p - from;
  const float share = clamp(dot(way, along) / dot(along, along), 0.0f, 1.0f);
  const Vector3f off = way - along * share;
  return dot(off, off) <= kBesideSolid * kBesideSolid;
}

// The contact along a way. The gap is measured again by all corners, so that it parts the shapes
// whatever the search has found. A contact is sure if its points lie on both shapes: then no other
// direction has a wider gap, if they are apart. Where a face and a cap lie on each other, the point
// of the one shape may lie beside the other, and the point of the other does not.
//   height              how far the solid reaches along way.n
//   is_blunt            as is_blunt(); of others a point must lie clearly within, seen from the
//   face furthest()          the corner at that height is_within(p, most)  as is_within() above
template <class Furthest, class IsWithin>
SolidContact contact_at(const Solid& solid, const PlacedCylinder& cylinder, const SolidWay& way,
                        float height, bool is_blunt, const Furthest& furthest,
                        const IsWithin& is_within) {
  using Feature = SolidWay::Feature;
  const AxialCore core = cylinder.core();
  const float gap = cylinder.gap_over(way.n, height);
  const Vector3f to_cylinder = way.n * gap;
  const auto is_on_cylinder = [&](const Vector3f& on_solid) {
    return holds(core, (on_solid + to_cylinder) - cylinder.middle, kBesideSolid);
  };
  const Vector3f of_cylinder = (cylinder.middle - furthest_point(core, way.n)) - to_cylinder;
  Vector3f on_solid = of_cylinder;
  bool is_on_solid = true;
  if (way.feature == Feature::corner) on_solid = solid.corner(way.place);
  if (way.feature == Feature::cap) on_solid = furthest();
  if (way.feature == Feature::crossing) on_solid = crossing_on_edge(solid, cylinder, way);
  if (way.feature == Feature::crossing || way.feature == Feature::edge) {
    is_on_solid = is_on_edge(solid, way.place, on_solid);
  }
  if (way.feature == Feature::face || !is_on_solid || !is_on_cylinder(on_solid)) {
    on_solid = of_cylinder;
    const Vector3f inside = on_solid - way.n * (2 * kBesideSolid);
    is_on_solid = is_blunt ? is_within(on_solid, kBesideSolid) : is_within(inside, -kBesideSolid);
  }
  const bool is_same = way.has_ended && std::fabs(gap - way.gap) <= kBesideSolid;
  return {gap, way.n, on_solid, is_same && is_on_solid && is_on_cylinder(on_solid)};
}

inline SolidContact contact_along(const Solid& solid, const PlacedCylinder& cylinder,
                                  const SolidWay& way, bool is_blunt) {
  const auto furthest = [&] { return furthest_corner(solid, way.n); };
  const auto is_in_solid = [&](const Vector3f& p, float most) { return is_within(solid, p, most); };
  return contact_at(solid, cylinder, way, height_along(solid, way.n), is_blunt, furthest,
                    is_in_solid);
}

// Whether the point between those of the contact lies in both by more than rounding.
inline bool has_common_point(const Solid& solid, const PlacedCylinder& cylinder,
                             const SolidContact& contact) {
  const Vector3f common = contact.on_solid + contact.normal * (contact.separation * 0.5f);
  return is_within(solid, common, -kSureGap) &&
         holds(cylinder.core(), common - cylinder.middle, -kSureGap);
}

}  // namespace carom::scalar
