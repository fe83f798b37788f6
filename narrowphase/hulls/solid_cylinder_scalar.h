// The widest gap between a solid and a cylinder, scalar form, in the solid's frame.
//
// As for two cylinders (narrowphase/features/cylinders_scalar.h), every pair of features that can
// face each other has its own direction, and the separation is the widest gap of all:
// - a face, a cap: along its normal;
// - a corner, and a side or a rim: away from the axis, or from the nearest point of the rim;
// - an edge and a side: across both;
// - an edge and a rim: the best direction between the normals of the edge's two faces
//   (narrowphase/features/edge_arc_scalar.h). Few edges have bounds that exceed what is known.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/few_of.h"
#include "base/tolerances.h"
#include "narrowphase/features/edge_arc_scalar.h"
#include "narrowphase/features/round_tolerances.h"
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
  Vector3f along, u, v;

  EdgeFrame(const Solid& solid, size_t e)
      : along(solid.edges[e].direction.head<3>()),
        u(solid.normal(solid.side[0][e])),
        v(cross(along, u)) {}

  Vector3f direction(const ArcPlace& n) const { return u * n.u + v * n.v; }
};

inline EdgeArc arc_of_edge(const Solid& solid, size_t e, const PlacedCylinder& cylinder) {
  const EdgeFrame frame(solid, e);
  const Vector3f right = solid.normal(solid.side[1][e]);
  const Vector3f way = cylinder.middle - solid.corner(solid.end[0][e]);
  return {.u_way = dot(way, frame.u),
          .v_way = dot(way, frame.v),
          .along = dot(cylinder.axis, frame.along),
          .u_axis = dot(cylinder.axis, frame.u),
          .v_axis = dot(cylinder.axis, frame.v),
          .half_length = cylinder.half_length,
          .rim = cylinder.rim,
          .end = {dot(right, frame.u), dot(right, frame.v)}};
}

// How far the middle of the cylinder lies in front of each face, and how far its axis leads there.
struct FaceHeights {
  std::array<float, Solid::kMostFaces> middle, axis;

  FaceHeights(const Solid& solid, const PlacedCylinder& cylinder) {
    for (size_t f = 0; f < solid.face_count; ++f) {
      middle[f] = dot(solid.normal(f), cylinder.middle) - solid.height(f);
      axis[f] = dot(solid.normal(f), cylinder.axis);
    }
  }
};

// The length of the slope in the plane of the arc, by its parts along both ends, where that is a
// direction of the arc, and otherwise `end`. Of a narrow arc rounding leaves no digits of it: then
// `most`.
inline float peak_of_arc(float left, float right, float cosine, float most, float end) {
  if (!(cosine <= kWideArc)) return most;
  const float square = cosine * cosine;
  const float c = 2 * square - 1, sine = (4 * square) * (1 - square);
  const float squares = left * left + right * right, product = (2 * c) * (left * right);
  const bool is_inside = right - c * left > 0 && left - c * right > 0;
  return is_inside ? std::sqrt((squares - product) / sine) + kEdgeBoundSlack : end;
}

// The least that the gap is at the middle of an edge's arc, and the most that it may be on the
// whole arc: with the slope at the middle, the greater of those at its ends or, if that is
// positive, the peak between. An edge that float32 has no bound for is searched.
struct EdgeBound {
  float at_middle, most;
  bool is_in_front, is_behind;  // whether the arc has directions on the sides of the caps
};

inline EdgeBound bound_edge(const Solid& solid, size_t e, const FaceHeights& faces,
                            const PlacedCylinder& cylinder) {
  const size_t l = solid.side[0][e], r = solid.side[1][e];
  const float axis_l = faces.axis[l], axis_r = faces.axis[r];
  const bool is_in_front = max(axis_l, axis_r) > 0;
  const bool is_behind = min(axis_l, axis_r) < 0 || !is_in_front;
  const float cosine = solid.half_cosine[e];
  const float over = 1 / max(cosine, kEdgeBoundCosine), half = 0.5f * over;
  const float x = (axis_l + axis_r) * half;
  const float off = 1 - x * x;
  if (!(off >= kEdgeBoundSine && cosine >= kEdgeBoundCosine)) {
    return {-kLargest, kLargest, is_in_front, is_behind};
  }
  const float bend = cylinder.rim / std::sqrt(off);
  const float reach = std::copysign(cylinder.half_length, x);
  const float left = (faces.middle[l] - reach * axis_l) - (cosine - x * axis_l) * bend;
  const float right = (faces.middle[r] - reach * axis_r) - (cosine - x * axis_r) * bend;
  const float end = max(left, right) + kEdgeBoundSlack;
  const float most = end > 0 ? peak_of_arc(left, right, cosine, end * over, end) : end;
  return {(left + right) * half - kEdgeBoundSlack, most, is_in_front, is_behind};
}

// By halving. The cosine of half an angle makes the sum of two directions a unit vector.
inline std::array<ArcPlace, 5> places_on(const EdgeArc& arc) {
  const auto half_of = [](float cosine) { return std::sqrt(max(0.5f + 0.5f * cosine, kLeastWay)); };
  const auto between = [](const ArcPlace& m, const ArcPlace& n, float over) -> ArcPlace {
    return {(m.u + n.u) * over, (m.v + n.v) * over};
  };
  const float half = half_of(arc.end.u), quarter = half_of(half), eighth = half_of(quarter);
  const float of_half = 0.5f / half, of_quarter = 0.5f / quarter, of_eighth = 0.5f / eighth;
  const ArcPlace left{1, 0}, middle = between(left, arc.end, of_half);
  const ArcPlace before = between(left, middle, of_quarter);
  const ArcPlace behind = between(middle, arc.end, of_quarter);
  return {middle, before, behind, between(left, before, of_eighth),
          between(behind, arc.end, of_eighth)};
}

// Across the edge and a line of the cylinder's side.
inline ArcFound way_across(const EdgeArc& arc) {
  const float sign = std::copysign(1.0f, arc.u_axis);
  const ArcPlace n = unit(ArcPlace{-(arc.v_axis * sign), arc.u_axis * sign});
  return {arc.holds(n) ? arc.gap(n) : -kLargest, n, true};
}

inline void search_edge(const EdgeArc& arc, float sign, uint32_t e, SolidWay& best) {
  using Feature = SolidWay::Feature;
  const auto keep = [&](const ArcFound& found, Feature feature) {
    best.keep_if_wider({found.gap, {found.n.u, found.n.v, 0}, feature, e, found.has_ended});
  };
  keep(way_across(arc), Feature::crossing);
  const ArcStarts starts(arc, places_on(arc));
  keep(climb_arc(arc, sign, sign > 0 ? starts.front : starts.back), Feature::edge);
}

inline float height_along(const Solid& solid, const Vector3f& n) {
  float most = -kLargest;
  for (size_t i = 0; i < solid.point_count; ++i) most = max(most, dot(n, solid.corner(i)));
  return most;
}

// The best way of faces, caps and corners.
inline SolidWay find_simple_way(const Solid& solid, const PlacedCylinder& cylinder) {
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
  return best;
}

// Looks for a better way at the edges whose bounds exceed what is known.
inline void search_edges(const Solid& solid, const PlacedCylinder& cylinder, SolidWay& best) {
  const FaceHeights faces(solid, cylinder);
  FewOf<EdgeBound, Solid::kMostEdges> bounds;
  float known = best.gap;
  for (size_t e = 0; e < solid.edge_count; ++e) {
    bounds.push_back(bound_edge(solid, e, faces, cylinder));
    known = max(known, bounds[e].at_middle);
  }
  for (const float sign : {1.0f, -1.0f}) {
    for (uint32_t e = 0; e < solid.edge_count; ++e) {
      const EdgeBound& bound = bounds[e];
      if (!(bound.most > known && (sign > 0 ? bound.is_in_front : bound.is_behind))) continue;
      search_edge(arc_of_edge(solid, e, cylinder), sign, e, best);
    }
  }
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
  const Vector3f from = solid.corner(solid.end[0][e]), along = solid.edges[e].direction.head<3>();
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
//   n: the direction of the way; height: how far the solid reaches along it
//   is_blunt: as is_blunt(); of others a point must lie clearly within, seen from the face
//   furthest(): the corner at that height; is_within(p, most): as is_within() above
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

// Whether the contact along a way of faces, caps and corners may prove that the shapes are apart
// and no edge has a better one. A corner whose point faces no point of the cylinder proves nothing.
inline bool may_prove(const Solid& solid, const PlacedCylinder& cylinder, const SolidWay& way) {
  if (!(way.gap > 0)) return false;
  if (way.feature != SolidWay::Feature::corner) return true;
  const Vector3f facing = solid.corner(way.place) + way.n * way.gap;
  return holds(cylinder.core(), facing - cylinder.middle, kBesideSolid);
}

inline SolidContact find_solid_contact(const Solid& solid, const PlacedCylinder& cylinder,
                                       bool is_blunt) {
  SolidWay way = find_simple_way(solid, cylinder);
  if (may_prove(solid, cylinder, way)) {
    const SolidContact contact = contact_along(solid, cylinder, way, is_blunt);
    if (contact.is_sure) return contact;
  }
  search_edges(solid, cylinder, way);
  return contact_along(solid, cylinder, way, is_blunt);
}

// Whether the point between those of the contact lies in both by more than rounding.
inline bool has_common_point(const Solid& solid, const PlacedCylinder& cylinder,
                             const SolidContact& contact) {
  const Vector3f common = contact.on_solid + contact.normal * (contact.separation * 0.5f);
  return is_within(solid, common, -kSureGap) &&
         holds(cylinder.core(), common - cylinder.middle, -kSureGap);
}

}  // namespace carom::scalar
