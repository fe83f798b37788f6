// The widest gap between a solid and a cylinder, scalar form, in the solid's frame.
//
// As for two cylinders (narrowphase/features/cylinders_scalar.h), every pair of features that can
// face each other has its own direction, and the separation is the widest gap of all:
// - a face, a cap: along its normal;
// - a corner, and a side or a rim: away from the axis, or from the nearest point of the rim;
// - an edge and a side: across both;
// - an edge and a rim: the best direction between the normals of the edge's two faces
//   (narrowphase/features/edge_arc_scalar.h). The edge with the greatest bound is searched first,
//   and then the few whose bounds exceed what it has.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/few_of.h"
#include "base/tolerances.h"
#include "narrowphase/features/edge_arc_scalar.h"
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
  Vector3f n{0, 0, 1};  // with an edge: its place on the arc
  Feature feature = Feature::none;
  uint32_t place = 0;     // of the face, corner or edge
  bool has_ended = true;  // of a search

  void keep_if_wider(const SolidWay& next) {
    if (next.rank() > rank()) *this = next;
  }
  float rank() const { return gap - (has_ended ? 0.0f : kNotEnded); }
  bool is_on_arc() const { return feature == Feature::crossing || feature == Feature::edge; }
};

// The directions of an edge: along it, along the normal of its left face, and across both.
struct EdgeFrame {
  Vector3f along, u, v, right;

  EdgeFrame(const Solid& solid, size_t e)
      : u(solid.normal(solid.side[0][e])), right(solid.normal(solid.side[1][e])) {
    along = unit(cross(u, right));
    v = cross(along, u);
  }
  Vector3f direction(const ArcPlace& n) const { return unit(u * n.u + v * n.v); }
  EdgeArc arc(const Vector3f& from, const PlacedCylinder& cylinder) const {
    const Vector3f way = cylinder.middle - from;
    return {.u_way = dot(way, u),
            .v_way = dot(way, v),
            .along = dot(cylinder.axis, along),
            .u_axis = dot(cylinder.axis, u),
            .v_axis = dot(cylinder.axis, v),
            .half_length = cylinder.half_length,
            .rim = cylinder.rim,
            .end = {dot(right, u), dot(right, v)}};
  }
};

inline EdgeArc arc_of_edge(const Solid& solid, size_t e, const PlacedCylinder& cylinder) {
  return EdgeFrame(solid, e).arc(solid.corner(solid.end[0][e]), cylinder);
}

inline ArcPlace middle_of(const EdgeArc& arc) { return unit(ArcPlace{1 + arc.end.u, arc.end.v}); }

// By halving.
inline std::array<ArcPlace, 5> places_on(const EdgeArc& arc) {
  const auto between = [](const ArcPlace& m, const ArcPlace& n) {
    return unit(ArcPlace{m.u + n.u, m.v + n.v});
  };
  const ArcPlace left{1, 0}, middle = middle_of(arc);
  const ArcPlace before = between(left, middle), behind = between(middle, arc.end);
  return {middle, before, behind, between(left, before), between(behind, arc.end)};
}

// Across the edge and a line of the cylinder's side.
inline ArcFound way_across(const EdgeArc& arc) {
  const float sign = std::copysign(1.0f, arc.u_axis);
  const ArcPlace n = unit(ArcPlace{-(arc.v_axis * sign), arc.u_axis * sign});
  return {arc.holds(n) ? arc.gap(n) : -kLargest, n, true};
}

inline void search_edge(const EdgeArc& arc, uint32_t e, SolidWay& best) {
  using Feature = SolidWay::Feature;
  const auto keep = [&](const ArcFound& found, Feature feature) {
    best.keep_if_wider({found.gap, {found.n.u, found.n.v, 0}, feature, e, found.has_ended});
  };
  keep(way_across(arc), Feature::crossing);
  for (const ArcFound& found : search_arc(arc, places_on(arc))) keep(found, Feature::edge);
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
  std::array<float, Solid::kMostEdges> bounds;
  float known = best.gap;  // the widest gap that is known
  for (size_t e = 0; e < solid.edge_count; ++e) {
    const EdgeArc arc = arc_of_edge(solid, e, cylinder);
    const ArcBound bound(arc, middle_of(arc));
    bounds[e] = bound.most;
    known = max(known, bound.at_middle - kNotEnded);
  }
  const auto greatest = std::max_element(bounds.begin(), bounds.begin() + solid.edge_count);
  const auto first = static_cast<size_t>(greatest - bounds.begin());
  if (first == solid.edge_count || !(bounds[first] > known)) return best;
  search_edge(arc_of_edge(solid, first, cylinder), static_cast<uint32_t>(first), best);
  const float least = max(known, best.rank());
  for (uint32_t e = 0; e < solid.edge_count; ++e) {
    if (e != first && bounds[e] > least) search_edge(arc_of_edge(solid, e, cylinder), e, best);
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

// Where an edge and the line of the cylinder's side cross, seen along n.
inline Vector3f crossing_on_edge(const Solid& solid, const PlacedCylinder& cylinder, size_t e,
                                 const Vector3f& n) {
  const Vector3f from = solid.corner(solid.end[0][e]), along = EdgeFrame(solid, e).along;
  const Vector3f across = cross(cylinder.axis, n);
  return from + along * (dot(cylinder.middle - from, across) / dot(along, across));
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
//   n                   the direction of the way
//   height              how far the solid reaches along n
//   is_blunt            as is_blunt(); of others a point must lie clearly within, seen from the
//   face furthest()          the corner at that height is_within(p, most)  as is_within() above
template <class Furthest, class IsWithin>
SolidContact contact_at(const Solid& solid, const PlacedCylinder& cylinder, const SolidWay& way,
                        const Vector3f& n, float height, bool is_blunt, const Furthest& furthest,
                        const IsWithin& is_within) {
  using Feature = SolidWay::Feature;
  const AxialCore core = cylinder.core();
  const float gap = cylinder.gap_over(n, height);
  const Vector3f to_cylinder = n * gap;
  const auto is_on_cylinder = [&](const Vector3f& on_solid) {
    return holds(core, (on_solid + to_cylinder) - cylinder.middle, kBesideSolid);
  };
  const Vector3f of_cylinder = (cylinder.middle - furthest_point(core, n)) - to_cylinder;
  Vector3f on_solid = of_cylinder;
  bool is_on_solid = true;
  if (way.feature == Feature::corner) on_solid = solid.corner(way.place);
  if (way.feature == Feature::cap) on_solid = furthest();
  if (way.feature == Feature::crossing) on_solid = crossing_on_edge(solid, cylinder, way.place, n);
  if (way.is_on_arc()) is_on_solid = is_on_edge(solid, way.place, on_solid);
  if (way.feature == Feature::face || !is_on_solid || !is_on_cylinder(on_solid)) {
    on_solid = of_cylinder;
    const Vector3f inside = on_solid - n * (2 * kBesideSolid);
    is_on_solid = is_blunt ? is_within(on_solid, kBesideSolid) : is_within(inside, -kBesideSolid);
  }
  const bool is_same = way.has_ended && std::fabs(gap - way.gap) <= kBesideSolid;
  return {gap, n, on_solid, is_same && is_on_solid && is_on_cylinder(on_solid)};
}

inline Vector3f direction_of(const Solid& solid, const SolidWay& way) {
  return way.is_on_arc() ? EdgeFrame(solid, way.place).direction({way.n.x(), way.n.y()}) : way.n;
}

inline SolidContact contact_along(const Solid& solid, const PlacedCylinder& cylinder,
                                  const SolidWay& way, bool is_blunt) {
  const Vector3f n = direction_of(solid, way);
  const auto furthest = [&] { return furthest_corner(solid, n); };
  const auto is_in_solid = [&](const Vector3f& p, float most) { return is_within(solid, p, most); };
  return contact_at(solid, cylinder, way, n, height_along(solid, n), is_blunt, furthest,
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
