// Nearest points of two oriented boxes, in lanes: along a separating axis, and for separate boxes.
// Sources and reasons: boxes_contact_scalar.h and boxes_distance.h.
#if defined(CAROM_NARROWPHASE_FEATURES_BOXES_CONTACT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_BOXES_CONTACT_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_BOXES_CONTACT_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_BOXES_CONTACT_INL_H_
#endif

#include <type_traits>

#include "base/tolerances.h"
#include "narrowphase/features/boxes_sat-inl.h"
#include "narrowphase/features/rounded-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <class V>
HWY_INLINE Lanes3<V> clamp_to_box(const Lanes3<V>& x, const Lanes3<V>& half) {
  return {clamp(x.x, hn::Neg(half.x), half.x), clamp(x.y, hn::Neg(half.y), half.y),
          clamp(x.z, hn::Neg(half.z), half.z)};
}

template <class V>
HWY_INLINE Lanes3<V> to_b(const BoxPairOf<V>& p, const Lanes3<V>& x) {
  return rotate_back(p.turn, x - p.centre);
}
template <class V>
HWY_INLINE Lanes3<V> from_b(const BoxPairOf<V>& p, const Lanes3<V>& q) {
  return rotate(p.turn, q) + p.centre;
}

template <class V>
HWY_INLINE Mask3Of<V> are_across(const Lanes3<V>& direction) {
  return {hn::Le(hn::Abs(direction.x), splat_as<V>(kAcross<hn::TFromV<V>>)),
          hn::Le(hn::Abs(direction.y), splat_as<V>(kAcross<hn::TFromV<V>>)),
          hn::Le(hn::Abs(direction.z), splat_as<V>(kAcross<hn::TFromV<V>>))};
}

// The corner of a box along a direction; the minus side in axes in which the direction is zero.
template <class V>
HWY_INLINE Lanes3<V> corner_towards(const Lanes3<V>& half, const Lanes3<V>& direction) {
  const V zero = splat_as<V>(0);
  return {hn::IfThenElse(hn::Gt(direction.x, zero), half.x, hn::Neg(half.x)),
          hn::IfThenElse(hn::Gt(direction.y, zero), half.y, hn::Neg(half.y)),
          hn::IfThenElse(hn::Gt(direction.z, zero), half.z, hn::Neg(half.z))};
}

template <class V>
HWY_INLINE Lanes3<V> on_feature(const Lanes3<V>& half, const Lanes3<V>& corner,
                                const Mask3Of<V>& across, const Lanes3<V>& target) {
  return select(across, clamp_to_box(target, half), corner);
}

template <class V>
HWY_INLINE void facing_features(const BoxPairOf<V>& p, const Lanes3<V>& normal, Lanes3<V>& on_a,
                                Lanes3<V>& on_b) {
  const Lanes3<V> out_of_b = -rotate_back(p.turn, normal);
  const Mask3Of<V> across_a = are_across(normal);
  const Mask3Of<V> across_b = are_across(out_of_b);
  const Lanes3<V> corner_a = corner_towards(p.half_a, normal);
  const Lanes3<V> corner_b = corner_towards(p.half_b, out_of_b);
  on_a = on_feature(p.half_a, corner_a, across_a, p.centre);
  for (int i = 0; i < 2; ++i) {
    on_b = from_b(p, on_feature(p.half_b, corner_b, across_b, to_b(p, on_a)));
    on_a = on_feature(p.half_a, corner_a, across_a, on_b);
  }
}

template <class V>
HWY_INLINE Lanes3<V> zero_if(const Mask3Of<V>& mask, const Lanes3<V>& v) {
  return {hn::IfThenZeroElse(mask.x, v.x), hn::IfThenZeroElse(mask.y, v.y),
          hn::IfThenZeroElse(mask.z, v.z)};
}

template <class V>
HWY_INLINE Lanes3<V> replace(const AxisMasksOf<V>& axis, const Lanes3<V>& v, V value) {
  return select(axis, {value, value, value}, v);
}

// The nearest points of edge_a of A and edge_b of B, of the edges that face each other along
// `normal`.
template <class V>
HWY_INLINE void facing_edges(const BoxPairOf<V>& p, const Lanes3<V>& normal,
                             const AxisMasksOf<V>& edge_a, const AxisMasksOf<V>& edge_b,
                             Lanes3<V>& on_a, Lanes3<V>& on_b) {
  const Lanes3<V> v = select_axis(edge_b, p.turn);
  const Lanes3<V> out_of_b = -rotate_back(p.turn, normal);
  const Lanes3<V> a = zero_if(edge_a, corner_towards(p.half_a, normal));
  const Lanes3<V> b = from_b(p, zero_if(edge_b, corner_towards(p.half_b, out_of_b)));
  const V half_a = pick(edge_a, p.half_a);
  const V half_b = pick(edge_b, p.half_b);
  const Lanes3<V> n = axis_cross(edge_a, v);
  const V s = hn::Div(dot(cross(b - a, v), n), dot(n, n));
  on_a = replace(edge_a, a, clamp(s, hn::Neg(half_a), half_a));
  on_b = b + v * clamp(dot(v, on_a - b), hn::Neg(half_b), half_b);
  on_a = replace(edge_a, on_a, clamp(pick(edge_a, on_b), hn::Neg(half_a), half_a));
}

// Whether the support features along an edge axis are really edges, not the faces that they belong
// to.
template <class V>
HWY_INLINE MaskOf<V> is_edge_contact(const BoxPairOf<V>& p, const SeparatingAxisOf<V>& axis) {
  const Mask3Of<V> across_a = are_across(axis.normal);
  const Mask3Of<V> across_b = are_across(rotate_back(p.turn, axis.normal));
  const auto other = [](const AxisMasksOf<V>& edge, const Mask3Of<V>& across) HWY_ATTR {
    return hn::Or(hn::Or(hn::AndNot(edge.x, across.x), hn::AndNot(edge.y, across.y)),
                  hn::AndNot(edge.z, across.z));
  };
  return hn::AndNot(hn::Or(other(axis.edge_a, across_a), other(axis.edge_b, across_b)),
                    axis.is_edge);
}

// Nearest points along an axis: of the edges that face each other, and of the support features.
template <class V>
struct FacingPoints {
  MaskOf<V> are_edges;  // where the edges count
  Lanes3<V> edge_on_a, edge_on_b, feature_on_a, feature_on_b;

  HWY_INLINE FacingPoints(const BoxPairOf<V>& p, const SeparatingAxisOf<V>& axis)
      : are_edges(is_edge_contact(p, axis)) {
    facing_edges(p, axis.normal, axis.edge_a, axis.edge_b, edge_on_a, edge_on_b);
    facing_features(p, axis.normal, feature_on_a, feature_on_b);
  }
  HWY_INLINE Lanes3<V> on_a() const { return select(are_edges, edge_on_a, feature_on_a); }
  HWY_INLINE Lanes3<V> on_b() const { return select(are_edges, edge_on_b, feature_on_b); }
};

// Whether the features lie opposite each other.
HWY_INLINE DoubleMask do_face(const FacingPoints<D>& facing, const D3& normal) {
  const D3 way = facing.feature_on_b - facing.feature_on_a;
  const D3 across = way - normal * dot(way, normal);
  return hn::Le(dot(across, across), splat_double(kTouchingSquared));
}

// The nearest points of the boxes if the normal is the axis. `unsure`: several axes have equal
// gaps, and float32 cannot tell along which of them the boxes meet.
template <class V>
HWY_INLINE void witness_along(const BoxPairOf<V>& p, const SeparatingAxisOf<V>& axis,
                              Lanes3<V>& on_a, Lanes3<V>& on_b, MaskOf<V>& unsure) {
  const FacingPoints<V> facing(p, axis);
  on_a = facing.on_a();
  on_b = on_a + axis.normal * axis.gap;
  if constexpr (std::is_same_v<V, D>) {
    // Where features do not face each other, the scalar form takes their middle.
    unsure = hn::Not(hn::Or(facing.are_edges, do_face(facing, axis.normal)));
  } else {
    const Lanes3<V> off_axis = facing.on_b() - on_b;
    unsure = hn::Gt(dot(off_axis, off_axis), splat_as<V>(kOffAxisSquared));
  }
}

// --- Separate boxes ---

template <class V>
struct NearestCornerOf {
  V squared;
  Lanes3<V> corner;
};

// The corner of a box, with its centre at `centre` and half axes hx, hy, hz, that is nearest to a
// box about the origin.
template <class V>
HWY_INLINE NearestCornerOf<V> nearest_corner(const Lanes3<V>& half, const Lanes3<V>& centre,
                                             const Lanes3<V>& hx, const Lanes3<V>& hy,
                                             const Lanes3<V>& hz) {
  NearestCornerOf<V> nearest;
  const V zero = splat_as<V>(0);
  const Lanes3<V> zeros = {zero, zero, zero};
  const auto offer = [&](const Lanes3<V>& corner, bool is_first) HWY_ATTR {
    const Lanes3<V> outside = max(abs(corner) - half, zeros);
    const V squared = dot(outside, outside);
    if (is_first) {
      nearest = {squared, corner};
      return;
    }
    const MaskOf<V> nearer = hn::Lt(squared, nearest.squared);
    nearest.squared = hn::IfThenElse(nearer, squared, nearest.squared);
    nearest.corner = select(nearer, corner, nearest.corner);
  };
  const Lanes3<V> x0 = centre - hx;
  const Lanes3<V> x1 = centre + hx;
  const Lanes3<V> x0y0 = x0 - hy;
  const Lanes3<V> x1y0 = x1 - hy;
  const Lanes3<V> x0y1 = x0 + hy;
  const Lanes3<V> x1y1 = x1 + hy;
  offer(x0y0 - hz, true);
  offer(x1y0 - hz, false);
  offer(x0y1 - hz, false);
  offer(x1y1 - hz, false);
  offer(x0y0 + hz, false);
  offer(x1y0 + hz, false);
  offer(x0y1 + hz, false);
  offer(x1y1 + hz, false);
  return nearest;
}

template <class V>
HWY_INLINE NearestCornerOf<V> nearest_corner_of_b(const BoxPairOf<V>& p) {
  return nearest_corner(p.half_a, p.centre, p.turn.x * p.half_b.x, p.turn.y * p.half_b.y,
                        p.turn.z * p.half_b.z);
}

// In the frame of B.
template <class V>
HWY_INLINE NearestCornerOf<V> nearest_corner_of_a(const BoxPairOf<V>& p) {
  const RotationOf<V> rows = transposed(p.turn);
  return nearest_corner(p.half_b, -rotate_back(p.turn, p.centre), rows.x * p.half_a.x,
                        rows.y * p.half_a.y, rows.z * p.half_a.z);
}

// A point of A near the nearest one, to start the projections from.
template <class V>
HWY_INLINE Lanes3<V> start_on_a(const BoxPairOf<V>& p, const BestEdgesOf<V>& edges) {
  const NearestCornerOf<V> of_b = nearest_corner_of_b(p);
  const NearestCornerOf<V> of_a = nearest_corner_of_a(p);
  const MaskOf<V> is_of_a = hn::Lt(of_a.squared, of_b.squared);
  const V least = hn::IfThenElse(is_of_a, of_a.squared, of_b.squared);
  const Lanes3<V> x = select(is_of_a, from_b(p, of_a.corner), clamp_to_box(of_b.corner, p.half_a));

  AxisMasksOf<V> edge_a, edge_b;
  choose_edges(edges.number, edge_a, edge_b);
  Lanes3<V> on_a, on_b;
  facing_edges(p, from_a_to_b(p, edge_normal(p, edges, edge_a, edge_b)), edge_a, edge_b, on_a,
               on_b);
  const Lanes3<V> way = on_b - on_a;
  return select(hn::Lt(dot(way, way), least), on_a, x);
}

// Coordinates strictly inside the box: 0 corner, 1 edge, 2 face, 3 interior.
template <class V>
HWY_INLINE V free_axes(const Lanes3<V>& x, const Lanes3<V>& half) {
  const auto is_free = [](V coordinate, V limit) HWY_ATTR {
    return hn::IfThenElseZero(hn::Lt(hn::Abs(coordinate), limit), splat_as<V>(1));
  };
  return hn::Add(hn::Add(is_free(x.x, half.x), is_free(x.y, half.y)), is_free(x.z, half.z));
}

// The gap along a unit vector from A to B.
template <class V>
HWY_INLINE V gap_along(const BoxPairOf<V>& p, const Lanes3<V>& n) {
  const V reach_a = dot(abs(n), p.half_a);
  const V reach_b = dot(abs(rotate_back(p.turn, n)), p.half_b);
  return hn::Sub(dot(n, p.centre), hn::Add(reach_a, reach_b));
}

// The distance of separate boxes, their normal and nearest points.
template <class V>
HWY_INLINE void distance_of(const BoxPairOf<V>& p, const BestEdgesOf<V>& edges,
                            const SeparatingAxisOf<V>& axis, V& distance, Lanes3<V>& normal,
                            Lanes3<V>& on_a, Lanes3<V>& on_b, MaskOf<V>& unsure) {
  Lanes3<V> x = start_on_a(p, edges);
  for (int round = 0; round < 2; ++round) {
    x = clamp_to_box(from_b(p, clamp_to_box(to_b(p, x), p.half_b)), p.half_a);
  }
  const Lanes3<V> q = to_b(p, x);
  const Lanes3<V> q_on_b = clamp_to_box(q, p.half_b);
  const Lanes3<V> y = from_b(p, q_on_b);
  const MaskOf<V> in_frame_b = hn::Gt(free_axes(q, p.half_b), free_axes(y, p.half_a));
  const Lanes3<V> way =
      select(in_frame_b, rotate(p.turn, q_on_b - q), y - clamp_to_box(y, p.half_a));
  const V length = hn::Sqrt(dot(way, way));
  const Lanes3<V> direction = way * hn::Div(splat_as<V>(1), length);

  // The better normal is the one with the greater gap. Rounding tilts short vectors.
  const V gap = gap_along(p, direction);
  const MaskOf<V> by_points = hn::Gt(gap, axis.gap);
  const MaskOf<V> tilted =
      hn::Lt(gap, hn::Sub(length, splat_as<V>(CoreTolerance<hn::TFromV<V>>::kTilt)));
  Lanes3<V> axis_on_a, axis_on_b;
  MaskOf<V> axis_unsure;
  witness_along(p, axis, axis_on_a, axis_on_b, axis_unsure);
  distance = hn::IfThenElse(by_points, length, axis.gap);
  normal = select(by_points, direction, axis.normal);
  on_a = select(by_points, y - direction * length, axis_on_a);
  on_b = select(by_points, y, axis_on_b);
  unsure = hn::Or(hn::And(by_points, tilted), hn::AndNot(by_points, axis_unsure));
}

// --- Reports ---

// Reports results in the frame of A, turned to world axes. `centre_a`: relative to A's position.
template <class V, class Report>
HWY_INLINE void report_boxes(const BoxPairOf<V>& p, const RotationOf<V>& turn_a,
                             const Lanes3<V>& centre_a, V axis_gap, V separation,
                             const Lanes3<V>& normal, const Lanes3<V>& on_a, const Lanes3<V>& on_b,
                             MaskOf<V> unsure, Report& report) {
  report(hn::Le(separation, splat_as<V>(0)), hn::Or(is_near_touch(axis_gap), unsure),
         no_lanes_of<V>(), separation, rotate(turn_a, normal), rotate(turn_a, on_a) + centre_a,
         rotate(turn_a, on_b - p.centre));
}

// Decision and, of overlapping boxes, all.
template <class V, class Report>
HWY_INLINE void test_boxes(const BoxPairOf<V>& p, const RotationOf<V>& turn_a,
                           const Lanes3<V>& centre_a, Report& report) {
  report.template fetch<0>();
  const BestEdgesOf<V> edges = best_edges(p);
  report.template fetch<1>();
  const SeparatingAxisOf<V> axis = best_axis(p, edges);
  report.template fetch<2>();
  Lanes3<V> on_a = p.centre, on_b = p.centre;
  MaskOf<V> unsure = no_lanes_of<V>();
  if constexpr (Report::kHasContact) witness_along(p, axis, on_a, on_b, unsure);
  const MaskOf<V> overlap = hn::Le(axis.gap, splat_as<V>(0));
  report.template fetch<3>();
  report_boxes(p, turn_a, centre_a, axis.gap, axis.gap, axis.normal, on_a, on_b,
               hn::And(unsure, overlap), report);
}

// The distance pass: all results of separate boxes. In doubles, boxes that overlap are unsure.
template <class V, class Report>
HWY_INLINE void measure_boxes(const BoxPairOf<V>& p, const RotationOf<V>& turn_a,
                              const Lanes3<V>& centre_a, Report& report) {
  const BestEdgesOf<V> edges = best_edges(p);
  const SeparatingAxisOf<V> axis = best_axis(p, edges);
  V distance;
  Lanes3<V> normal, on_a, on_b;
  MaskOf<V> unsure;
  distance_of(p, edges, axis, distance, normal, on_a, on_b, unsure);
  if constexpr (std::is_same_v<V, D>) unsure = hn::Or(unsure, hn::Le(axis.gap, splat_double(0)));
  report_boxes(p, turn_a, centre_a, axis.gap, distance, normal, on_a, on_b, unsure, report);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_BOXES_CONTACT_INL_H_
