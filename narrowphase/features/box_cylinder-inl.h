// The widest gap between a box and a cylinder, a pair a lane. box_cylinder_scalar.h is the scalar
// form, says how the search goes, and gives the same bits.
#if defined(CAROM_NARROWPHASE_FEATURES_BOX_CYLINDER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_BOX_CYLINDER_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_BOX_CYLINDER_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_BOX_CYLINDER_INL_H_
#endif

#include <array>

#include "base/tolerances.h"
#include "narrowphase/features/box_cylinder_scalar.h"
#include "narrowphase/features/edge_arc-inl.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/features/solid_contact-inl.h"
#include "simd/compress-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

HWY_INLINE F3 cycled(const F3& v, size_t first) {
  if (first == 0) return v;
  return first == 1 ? F3{v.y, v.z, v.x} : F3{v.z, v.x, v.y};
}
HWY_INLINE F3 cycled(const F3& v, Mask from_y, Mask from_z) {
  return select(from_z, cycled(v, 2), select(from_y, cycled(v, 1), v));
}

struct CylinderAtBoxLanes {
  F3 half, middle;
  AxialCoreLanes core;

  HWY_INLINE CylinderAtBoxLanes(const F3& half_extents, const F3& centre,
                                const AxialCoreLanes& cylinder)
      : half(half_extents), middle(centre), core(cylinder) {
    core.axis = negate_if(hn::Lt(dot(core.axis, middle), splat(0)), core.axis);
  }

  HWY_INLINE F gap(const F3& n) const {
    const F3 across = cross(n, core.axis);
    const F reach = hn::Add(hn::Mul(core.half_length, hn::Abs(dot(n, core.axis))),
                            hn::Mul(core.rim, hn::Sqrt(dot(across, across))));
    const F height = dot(half, {hn::Abs(n.x), hn::Abs(n.y), hn::Abs(n.z)});
    return hn::Sub(hn::Sub(dot(n, middle), reach), height);
  }
};

struct BoxWayLanes {
  F gap;
  F3 n, on_box;
  Mask has_point, has_ended;

  static HWY_INLINE BoxWayLanes none() {
    const F zero = splat(0);
    const Mask no = no_lanes();
    return {splat(-FLT_MAX), {zero, zero, splat(1)}, {zero, zero, zero}, no, hn::Not(no)};
  }
  HWY_INLINE F rank() const {
    return hn::Sub(gap, hn::IfThenZeroElse(has_ended, splat(kNotEnded)));
  }

  // Directions that no search found. The other lanes, and those that are not wider, keep what they
  // have.
  HWY_INLINE void keep_if_wider(F wide, const F3& way) {
    const Mask wider = hn::Gt(wide, gap);
    gap = hn::IfThenElse(wider, wide, gap);
    n = select(wider, way, n);
  }
  HWY_INLINE void keep_if_wider(F wide, const F3& way, const F3& point) {
    const Mask wider = hn::Gt(wide, gap);
    gap = hn::IfThenElse(wider, wide, gap);
    n = select(wider, way, n);
    on_box = select(wider, point, on_box);
    has_point = hn::Or(has_point, wider);
  }
  HWY_INLINE void keep_if_wider(Mask may, F wide, const F3& way, Mask ended) {
    const F next = hn::Sub(wide, hn::IfThenZeroElse(ended, splat(kNotEnded)));
    const Mask wider = hn::And(may, hn::Gt(next, rank()));
    gap = hn::IfThenElse(wider, wide, gap);
    n = select(wider, way, n);
    has_point = hn::AndNot(wider, has_point);
    has_ended = hn::Or(hn::And(wider, ended), hn::AndNot(wider, has_ended));
  }
};

struct BoxEdgeLanes {
  F u_sign, v_sign;
  EdgeArcLanes arc;

  // The same edge in all lanes.
  static HWY_INLINE BoxEdgeLanes at(const CylinderAtBoxLanes& cylinder, size_t e) {
    const size_t first = e / 4;
    return of(cylinder, cycled(cylinder.middle, first), cycled(cylinder.half, first),
              cycled(cylinder.core.axis, first), splat(e & 1 ? -1.0f : 1.0f),
              splat(e & 2 ? -1.0f : 1.0f));
  }
  // One edge a lane: along x unless it is along another axis, between faces of these signs.
  static HWY_INLINE BoxEdgeLanes at(const CylinderAtBoxLanes& cylinder, Mask along_y, Mask along_z,
                                    F u_sign, F v_sign) {
    return of(cylinder, cycled(cylinder.middle, along_y, along_z),
              cycled(cylinder.half, along_y, along_z), cycled(cylinder.core.axis, along_y, along_z),
              u_sign, v_sign);
  }

 private:
  static HWY_INLINE BoxEdgeLanes of(const CylinderAtBoxLanes& cylinder, const F3& middle,
                                    const F3& half, const F3& axis, F u_sign, F v_sign) {
    return {u_sign,
            v_sign,
            {hn::Sub(hn::Mul(middle.y, u_sign), half.y),
             hn::Sub(hn::Mul(middle.z, v_sign), half.z),
             axis.x,
             hn::Mul(axis.y, u_sign),
             hn::Mul(axis.z, v_sign),
             cylinder.core.half_length,
             cylinder.core.rim,
             {splat(0), splat(1)}}};
  }
};

// A search over the widest gap of a vector of pairs.
class BoxWaySearch {
 public:
  // Not inlined: two kinds of boxes call it, and it is long.
  static HWY_NOINLINE void find(const CylinderAtBoxLanes& cylinder, BoxWayLanes& best) {
    try_faces(cylinder, best);
    const F3 axis = cylinder.core.axis;
    const F3& half = cylinder.half;
    best.keep_if_wider(
        cylinder.gap(axis), axis,
        {hn::CopySign(half.x, axis.x), hn::CopySign(half.y, axis.y), hn::CopySign(half.z, axis.z)});
    for (size_t i = 0; i < 3; ++i) try_crossing(cylinder, i, best);
    for (size_t i = 0; i < 8; ++i) {
      const F3 corner = {i & 1 ? hn::Neg(half.x) : half.x, i & 2 ? hn::Neg(half.y) : half.y,
                         i & 4 ? hn::Neg(half.z) : half.z};
      const F3 n = way_from_corner(corner, cylinder.middle, cylinder.core);
      best.keep_if_wider(cylinder.gap(n), n, corner);
    }
    search_edges(cylinder, best);
  }

 private:
  static HWY_INLINE void try_faces(const CylinderAtBoxLanes& cylinder, BoxWayLanes& best) {
    const F zero = splat(0), one = splat(1);
    for (size_t i = 0; i < 3; ++i) {
      const F3 middle = cycled(cylinder.middle, i);
      const F3 n = cycled({hn::CopySign(one, middle.x), zero, zero}, (3 - i) % 3);
      best.keep_if_wider(cylinder.gap(n), n);
    }
  }

  static HWY_INLINE void try_crossing(const CylinderAtBoxLanes& cylinder, size_t first,
                                      BoxWayLanes& best) {
    const F3 axis = cycled(cylinder.core.axis, first);
    const F3 middle = cycled(cylinder.middle, first), half = cycled(cylinder.half, first);
    const F squared = hn::Add(hn::Mul(axis.y, axis.y), hn::Mul(axis.z, axis.z));
    const F over = hn::Div(splat(1), hn::Sqrt(squared));
    F u = hn::Neg(hn::Mul(axis.z, over)), v = hn::Mul(axis.y, over);
    const Mask is_behind = hn::Lt(hn::Add(hn::Mul(u, middle.y), hn::Mul(v, middle.z)), splat(0));
    u = hn::IfThenElse(is_behind, hn::Neg(u), u);
    v = hn::IfThenElse(is_behind, hn::Neg(v), v);
    const F along = hn::Sub(hn::Mul(axis.y, v), hn::Mul(axis.z, u));
    const F u_edge = hn::CopySign(half.y, u), v_edge = hn::CopySign(half.z, v);
    const F aside =
        hn::Sub(hn::Mul(hn::Sub(u_edge, middle.y), v), hn::Mul(hn::Sub(v_edge, middle.z), u));
    const F t = hn::Add(middle.x, hn::Div(hn::Mul(axis.x, aside), along));
    const size_t back = (3 - first) % 3;
    const F3 n = cycled({splat(0), u, v}, back);
    const Mask may = hn::Gt(squared, splat(kLeastWay));
    best.keep_if_wider(hn::IfThenElse(may, cylinder.gap(n), splat(-FLT_MAX)), n,
                       cycled({t, u_edge, v_edge}, back));
  }

  static constexpr size_t kEdges = scalar::BoxEdge::kCount;

  static HWY_INLINE void search_edges(const CylinderAtBoxLanes& cylinder, BoxWayLanes& best) {
    const FloatTag tag;
    HWY_ALIGN float bounds[kEdges][kLanes];
    F known = best.gap;
    const ArcPlaceLanes middle = in_all_lanes(scalar::kQuarterMiddle);
    for (size_t e = 0; e < kEdges; ++e) {
      F gap;
      hn::Store(bound_on_arc(BoxEdgeLanes::at(cylinder, e).arc, middle, gap), tag, bounds[e]);
      known = max(known, hn::Sub(gap, splat(kNotEnded)));
    }
    F searched = splat(-1);
    for (;;) {
      F most = splat(-FLT_MAX), place = splat(0);
      for (size_t e = 0; e < kEdges; ++e) {
        const F index = splat(static_cast<float>(e));
        const F bound =
            hn::IfThenElse(hn::Eq(index, searched), splat(-FLT_MAX), hn::Load(tag, bounds[e]));
        hn::Store(bound, tag, bounds[e]);
        const Mask more = hn::Gt(bound, most);
        most = hn::IfThenElse(more, bound, most);
        place = hn::IfThenElse(more, index, place);
      }
      const Mask is_open = hn::Gt(most, max(known, best.rank()));
      if (hn::AllFalse(tag, is_open)) return;
      search_edge(cylinder, place, is_open, best);
      searched = hn::IfThenElse(is_open, place, splat(-1));
    }
  }

  // `place`: which edge of each lane.
  static HWY_INLINE void search_edge(const CylinderAtBoxLanes& cylinder, F place, Mask may,
                                     BoxWayLanes& best) {
    const Mask along_z = hn::Ge(place, splat(8));
    const Mask along_y = hn::AndNot(along_z, hn::Ge(place, splat(4)));
    const I bits = hn::ConvertTo(IntTag(), place);
    const F u_sign = sign_of_bit<0>(bits), v_sign = sign_of_bit<1>(bits);
    const BoxEdgeLanes edge = BoxEdgeLanes::at(cylinder, along_y, along_z, u_sign, v_sign);
    std::array<ArcPlaceLanes, scalar::kQuarterPlaces.size()> places;
    for (size_t i = 0; i < places.size(); ++i) places[i] = in_all_lanes(scalar::kQuarterPlaces[i]);
    ArcStartsLanes starts(edge.arc, places);
    climb_arcs({edge.arc, splat(1), starts.front}, {edge.arc, splat(-1), starts.back});
    for (const ArcFoundLanes* found : {&starts.front, &starts.back}) {
      const F3 way = {splat(0), hn::Mul(found->n.u, u_sign), hn::Mul(found->n.v, v_sign)};
      // Back to the frame of the box: of an edge along y, y is the first coordinate.
      best.keep_if_wider(may, found->gap, cycled(way, along_z, along_y), found->has_ended);
    }
  }

  template <int kBit>
  static HWY_INLINE F sign_of_bit(I bits) {
    const FloatTag tag;
    const auto sign = hn::And(hn::ShiftLeft<31 - kBit>(hn::BitCast(IndexTag(), bits)),
                              hn::Set(IndexTag(), 0x80000000u));
    return hn::CopySign(splat(1), hn::BitCast(tag, sign));
  }
};

HWY_INLINE F3 clamped_to_box(const F3& p, const F3& half) {
  return {clamp(p.x, hn::Neg(half.x), half.x), clamp(p.y, hn::Neg(half.y), half.y),
          clamp(p.z, hn::Neg(half.z), half.z)};
}

HWY_INLINE SolidContactLanes contact_along(const CylinderAtBoxLanes& cylinder,
                                           const BoxWayLanes& way) {
  const F gap = cylinder.gap(way.n);
  const F3 to_cylinder = way.n * gap;
  const auto is_held = [&](const F3& on_box) HWY_ATTR {
    return holds(cylinder.core, (on_box + to_cylinder) - cylinder.middle, kBesideSolid);
  };
  const F3 on_cylinder = cylinder.middle - furthest_point(cylinder.core, way.n);
  const F3 nearest = clamped_to_box(on_cylinder - to_cylinder, cylinder.half);
  const F3 known = clamped_to_box(way.on_box, cylinder.half);
  const Mask is_known = hn::And(way.has_point, is_held(known));
  const F3 on_box = select(is_known, known, nearest);
  const Mask is_same = hn::Le(hn::Abs(hn::Sub(gap, way.gap)), splat(kBesideSolid));
  return {gap, way.n, on_box, hn::And(hn::And(way.has_ended, is_same), is_held(on_box))};
}

HWY_INLINE Mask has_common_point(const CylinderAtBoxLanes& cylinder,
                                 const SolidContactLanes& contact) {
  const F3 common = contact.on_solid + contact.normal * hn::Mul(contact.separation, splat(0.5f));
  const F3 inside = {hn::Sub(cylinder.half.x, hn::Abs(common.x)),
                     hn::Sub(cylinder.half.y, hn::Abs(common.y)),
                     hn::Sub(cylinder.half.z, hn::Abs(common.z))};
  return hn::And(hn::Ge(min(min(inside.x, inside.y), inside.z), splat(kSureGap)),
                 holds(cylinder.core, common - cylinder.middle, -kSureGap));
}

// The test of a box whose centre lies at `offset` from the position of A.
template <class Report>
HWY_INLINE void test_box_cylinder(const CylinderAtBoxLanes& cylinder, const Rotation& turn,
                                  const F3& offset, F rounding, const F3& d, Report& report) {
  BoxWayLanes way = BoxWayLanes::none();
  BoxWaySearch::find(cylinder, way);
  const SolidContactLanes contact = contact_along(cylinder, way);
  report_solid(contact, turn, offset, rounding, d, report);
  if (HWY_LIKELY(!report.marks_unsure())) return;
  const Mask is_apart = hn::Gt(contact.separation, splat(0));
  report.mark_unproven(hn::Not(hn::Or(is_apart, has_common_point(cylinder, contact))));
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_BOX_CYLINDER_INL_H_
