// The widest gap between a box and a cylinder, a pair a lane. box_cylinder_scalar.h is the scalar
// form, says how the search goes, and gives the same bits.
#if defined(CAROM_NARROWPHASE_FEATURES_BOX_CYLINDER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_BOX_CYLINDER_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_BOX_CYLINDER_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_BOX_CYLINDER_INL_H_
#endif

#include "base/tolerances.h"
#include "narrowphase/features/solid_contact-inl.h"
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

class BoxEdgeLanes {
 public:
  static constexpr size_t kCount = 12;

  // The same edge in all lanes.
  HWY_INLINE BoxEdgeLanes(const CylinderAtBoxLanes& cylinder, size_t e)
      : BoxEdgeLanes(cylinder, cycled(cylinder.middle, e / 4), cycled(cylinder.half, e / 4),
                     cycled(cylinder.core.axis, e / 4), splat(e & 1 ? -1.0f : 1.0f),
                     splat(e & 2 ? -1.0f : 1.0f)) {}
  // One edge a lane. The frame begins at the x axis unless it does at another; signs of normals.
  HWY_INLINE BoxEdgeLanes(const CylinderAtBoxLanes& cylinder, Mask from_y, Mask from_z, F sign_u,
                          F sign_v)
      : BoxEdgeLanes(cylinder, cycled(cylinder.middle, from_y, from_z),
                     cycled(cylinder.half, from_y, from_z),
                     cycled(cylinder.core.axis, from_y, from_z), sign_u, sign_v) {}

  struct Place {
    F u, v;
  };

  HWY_INLINE F along_axis(const Place& n) const {
    return hn::Add(hn::Mul(n.u, u_axis), hn::Mul(n.v, v_axis));
  }
  HWY_INLINE F aside(const Place& n) const {
    return hn::Sub(hn::Mul(n.u, v_axis), hn::Mul(n.v, u_axis));
  }
  HWY_INLINE F off_axis(const Place& n) const { return hypot_of(along, aside(n)); }
  HWY_INLINE F gap(const Place& n) const {
    const F height = hn::Add(hn::Mul(n.u, u_way), hn::Mul(n.v, v_way));
    const F reach =
        hn::Add(hn::Mul(half_length, hn::Abs(along_axis(n))), hn::Mul(rim, off_axis(n)));
    return hn::Sub(height, reach);
  }

  F u_sign, v_sign, u_way, v_way, along, u_axis, v_axis, half_length, rim;

 private:
  HWY_INLINE BoxEdgeLanes(const CylinderAtBoxLanes& cylinder, const F3& middle, const F3& half,
                          const F3& axis, F sign_u, F sign_v)
      : u_sign(sign_u),
        v_sign(sign_v),
        u_way(hn::Sub(hn::Mul(middle.y, sign_u), half.y)),
        v_way(hn::Sub(hn::Mul(middle.z, sign_v), half.z)),
        along(axis.x),
        u_axis(hn::Mul(axis.y, sign_u)),
        v_axis(hn::Mul(axis.z, sign_v)),
        half_length(cylinder.core.half_length),
        rim(cylinder.core.rim) {}
};

// Returns the bound.
HWY_INLINE F bound_on_quarter(const BoxEdgeLanes& edge, F& gap) {
  const F diagonal = splat(kArcCosines[kArcSamples / 2]);
  const BoxEdgeLanes::Place n = {diagonal, diagonal};
  const F x = edge.along_axis(n);
  const F bend = hn::Div(edge.rim, max(edge.off_axis(n), splat(kLeastRim)));
  const F reach = hn::CopySign(edge.half_length, x);
  const F u = hn::Sub(hn::Sub(edge.u_way, hn::Mul(reach, edge.u_axis)),
                      hn::Mul(hn::Sub(n.u, hn::Mul(x, edge.u_axis)), bend));
  const F v = hn::Sub(hn::Sub(edge.v_way, hn::Mul(reach, edge.v_axis)),
                      hn::Mul(hn::Sub(n.v, hn::Mul(x, edge.v_axis)), bend));
  gap = hn::Add(hn::Mul(u, n.u), hn::Mul(v, n.v));
  return hn::IfThenElse(hn::Gt(min(u, v), splat(0)), hypot_of(u, v), max(u, v));
}

struct QuarterStartLanes {
  F gap;
  BoxEdgeLanes::Place n;

  static HWY_INLINE QuarterStartLanes none() { return {splat(-FLT_MAX), {splat(1), splat(0)}}; }
  HWY_INLINE void keep_if_wider(Mask may, F wide, const BoxEdgeLanes::Place& next) {
    const Mask wider = hn::And(may, hn::Gt(wide, gap));
    gap = hn::IfThenElse(wider, wide, gap);
    n.u = hn::IfThenElse(wider, next.u, n.u);
    n.v = hn::IfThenElse(wider, next.v, n.v);
  }
};

struct QuarterStartsLanes {
  QuarterStartLanes front, back;

  explicit HWY_INLINE QuarterStartsLanes(const BoxEdgeLanes& edge)
      : front(QuarterStartLanes::none()), back(QuarterStartLanes::none()) {
    const Mask all = hn::Not(no_lanes());
    for (size_t i = 1; i + 1 < kArcSamples; ++i) {
      try_place(edge, {splat(kArcCosines[i]), splat(kArcCosines[kArcSamples - 1 - i])}, all, all);
    }
    const Mask is_inside = hn::Gt(hn::Mul(edge.u_axis, edge.v_axis), splat(0));
    const F over = hn::Div(splat(1), hypot_of(edge.u_axis, edge.v_axis));
    try_place(edge, {hn::Mul(hn::Abs(edge.u_axis), over), hn::Mul(hn::Abs(edge.v_axis), over)},
              is_inside, is_inside);
    const F none = splat(-FLT_MAX), zero = splat(0), one = splat(1);
    const Mask has_no_front = hn::Eq(front.gap, none), has_no_back = hn::Eq(back.gap, none);
    try_place(edge, {one, zero}, has_no_front, has_no_back);
    try_place(edge, {zero, one}, has_no_front, has_no_back);
  }

 private:
  HWY_INLINE void try_place(const BoxEdgeLanes& edge, const BoxEdgeLanes::Place& n, Mask may_front,
                            Mask may_back) {
    const F x = edge.along_axis(n), wide = edge.gap(n);
    front.keep_if_wider(hn::And(may_front, hn::Ge(x, splat(0))), wide, n);
    back.keep_if_wider(hn::And(may_back, hn::Le(x, splat(0))), wide, n);
  }
};

HWY_INLINE Mask step_on_quarter(const BoxEdgeLanes& edge, float sign, BoxEdgeLanes::Place& n) {
  const F zero = splat(0);
  const F reach = hn::Mul(splat(sign), edge.half_length);
  const F u_way = hn::Sub(edge.u_way, hn::Mul(reach, edge.u_axis));
  const F v_way = hn::Sub(edge.v_way, hn::Mul(reach, edge.v_axis));
  const F x = edge.along_axis(n), y = edge.aside(n);
  const F off = max(edge.off_axis(n), splat(kLeastRim));
  const F over = hn::Div(splat(1), off);
  const F bend = hn::Mul(edge.rim, over), tilt = hn::Mul(hn::Mul(x, y), over);
  const F slope =
      hn::Add(hn::Sub(hn::Mul(n.u, v_way), hn::Mul(n.v, u_way)), hn::Mul(edge.rim, tilt));
  const F turned = hn::Add(hn::Sub(hn::Mul(y, y), hn::Mul(x, x)), hn::Mul(tilt, tilt));
  const F curve = hn::Sub(hn::Mul(bend, turned), hn::Add(hn::Mul(n.u, u_way), hn::Mul(n.v, v_way)));
  const F step = hn::IfThenElse(hn::Lt(curve, zero), hn::Div(hn::Neg(slope), curve),
                                hn::CopySign(splat(kShortArc), slope));
  const F most = min(splat(kLongTurn), hn::Mul(splat(kRimStep), off));
  const F turn = clamp(step, hn::Neg(most), most);
  const F u = max(hn::Sub(n.u, hn::Mul(n.v, turn)), zero);
  const F v = max(hn::Add(n.v, hn::Mul(n.u, turn)), zero);
  const F to_unit = hn::Div(splat(1), hypot_of(u, v));
  const BoxEdgeLanes::Place next = {hn::Mul(u, to_unit), hn::Mul(v, to_unit)};
  const F moved = hn::Sub(hn::Mul(n.u, next.v), hn::Mul(n.v, next.u));
  n = next;
  return hn::Le(hn::Abs(moved), splat(kLastArc));
}

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

  static HWY_INLINE void search_edges(const CylinderAtBoxLanes& cylinder, BoxWayLanes& best) {
    const FloatTag tag;
    HWY_ALIGN float bounds[BoxEdgeLanes::kCount][kLanes];
    F known = best.gap;
    for (size_t e = 0; e < BoxEdgeLanes::kCount; ++e) {
      F gap;
      hn::Store(bound_on_quarter(BoxEdgeLanes(cylinder, e), gap), tag, bounds[e]);
      known = max(known, hn::Sub(gap, splat(kNotEnded)));
    }
    F searched = splat(-1);
    for (;;) {
      F most = splat(-FLT_MAX), place = splat(0);
      for (size_t e = 0; e < BoxEdgeLanes::kCount; ++e) {
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
    const Mask from_z = hn::Ge(place, splat(8));
    const Mask from_y = hn::AndNot(from_z, hn::Ge(place, splat(4)));
    const IntTag tag;
    const I bits = hn::ConvertTo(tag, place);
    const F u_sign = sign_of_bit<0>(bits), v_sign = sign_of_bit<1>(bits);
    const BoxEdgeLanes edge(cylinder, from_y, from_z, u_sign, v_sign);
    const QuarterStartsLanes starts(edge);
    BoxEdgeLanes::Place front = starts.front.n, back = starts.back.n;
    Mask front_ended = no_lanes(), back_ended = no_lanes();
    for (size_t i = 0; i < kSolidArcSteps; ++i) {
      front_ended = step_on_quarter(edge, 1, front);
      back_ended = step_on_quarter(edge, -1, back);
    }
    const auto keep = [&](const QuarterStartLanes& start, const BoxEdgeLanes::Place& n,
                          Mask ended) HWY_ATTR {
      const F none = splat(-FLT_MAX);
      const F gap = hn::IfThenElse(hn::Gt(start.gap, none), edge.gap(n), none);
      const F3 way = {splat(0), hn::Mul(n.u, u_sign), hn::Mul(n.v, v_sign)};
      // Back to the frame of the box: from y, the first coordinate is y.
      best.keep_if_wider(may, gap, cycled(way, from_z, from_y), ended);
    };
    keep(starts.front, front, front_ended);
    keep(starts.back, back, back_ended);
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
