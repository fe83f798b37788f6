// Manifolds of capsules in lanes: at most two points.
#if defined(CAROM_NARROWPHASE_MANIFOLDS_LINE_CONTACT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_LINE_CONTACT_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_LINE_CONTACT_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_LINE_CONTACT_INL_H_
#endif

#include "narrowphase/manifolds/clip-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The contact in scaled units.
struct ContactLanes {
  F separation;
  F3 normal;  // from A to B
  F3 arm_a;
  F reach;  // the contact distance, at most kGreatestReach

  // The greatest s of a point, for shapes of a size.
  HWY_INLINE F touching(F size) const { return max(hn::Mul(splat(kTouchingPoint), size), reach); }
  HWY_INLINE F touching() const { return max(splat(kTouchingPoint), reach); }
};

// Points on A, the used ones first. s is the gap from there to B along the normal. With fewer than
// two used points the manifold is the witness point alone.
struct PointLanes {
  F3 point[4];
  F s[4];
  Mask used[4];
};

HWY_INLINE void witness_only(PointLanes& out) {
  for (size_t k = 0; k < 4; ++k) {
    out.point[k] = splat3(0);
    out.s[k] = splat(0);
    out.used[k] = no_lanes();
  }
}

// Two candidate points on A; s is kNoPoint for a point that does not exist.
struct TwoPoints {
  F3 point[2];
  F s[2];
};

// Takes the deeper of the two points if it is as deep as the witness point, up to `same_depth`,
// else the witness point; then the point farthest from that. `limit`: see reduce().
HWY_INLINE void reduce_line(const ContactLanes& contact, const TwoPoints& two, F same_depth,
                            F limit, PointLanes& out) {
  witness_only(out);
  const Mask second_is_deeper = hn::Lt(two.s[1], two.s[0]);
  const F deepest = hn::IfThenElse(second_is_deeper, two.s[1], two.s[0]);
  const Mask is_witness =
      hn::Not(hn::And(is_point(deepest), hn::Le(deepest, hn::Add(contact.separation, same_depth))));
  const F3 first =
      select(is_witness, contact.arm_a, select(second_is_deeper, two.point[1], two.point[0]));
  out.point[0] = first;
  out.s[0] = hn::IfThenElse(is_witness, contact.separation, deepest);
  out.used[0] = hn::Not(no_lanes());

  const auto squared_way = [&](size_t i) HWY_ATTR {
    const F3 way = two.point[i] - first;
    return hn::IfThenElseZero(is_point(two.s[i]), dot(way, way));
  };
  const F to_a = squared_way(0);
  const F to_b = squared_way(1);
  const Mask takes_b = hn::Gt(to_b, to_a);
  out.point[1] = select(takes_b, two.point[1], two.point[0]);
  out.s[1] = hn::IfThenElse(takes_b, two.s[1], two.s[0]);
  out.used[1] = hn::Gt(hn::IfThenElse(takes_b, to_b, to_a), limit);
}

// A line on the surface of a capsule, parallel to its axis.
struct SurfaceLine {
  F3 a, b;
  Mask exists;
};

// The line that faces `m`, a unit vector. A capsule seen along its axis has none.
HWY_INLINE void line_towards(const F3& m, const CapsuleLanes& capsule, const Placed& placed,
                             SurfaceLine& line) {
  const F3 a = rotate(placed.turn, capsule.a) + placed.origin;
  const F3 b = rotate(placed.turn, capsule.b) + placed.origin;
  const F3 axis = b - a;
  const F3 across = m - axis * hn::Div(dot(m, axis), dot(axis, axis));
  const F squared = dot(across, across);
  const F3 way = across * hn::Div(capsule.radius, hn::Sqrt(squared));
  line.a = a + way;
  line.b = b + way;
  line.exists = hn::Gt(squared, splat(kEndOn));
}

// A capsule (A) on a face of B.
template <class Face>
HWY_INLINE void touch_face(const SurfaceLine& line, const Face& face, const ContactLanes& contact,
                           PointLanes& out) {
  const F3 m = -contact.normal;
  const FaceView view(face.frame, m);
  Seen<2> ends;
  SeenWay way;
  ClipPoints<2> clipped;
  view.project(line.a, ends.x[0], ends.y[0], ends.s[0]);
  view.project(line.b, ends.x[1], ends.y[1], ends.s[1]);
  way_between(ends, 0, 1, way);
  put_edge(face, hn::And(line.exists, view.is_open), ends, 0, 1, way, contact.touching(), 0,
           clipped);
  TwoPoints two;
  for (size_t i = 0; i < 2; ++i) {
    two.point[i] = face.frame.point(clipped.x[i], clipped.y[i]) + m * clipped.s[i];
    two.s[i] = clipped.s[i];
  }
  reduce_line(contact, two, splat(kTouchingPoint), splat(kSamePoint), out);
}

// A capsule (A) on a plane. Tolerances follow the capsule's own size, not the distance of the
// plane's body.
HWY_INLINE void touch_plane(const CapsuleLanes& capsule, const Placed& placed,
                            const ContactLanes& contact, PointLanes& out) {
  const F3& m = contact.normal;
  SurfaceLine line;
  line_towards(m, capsule, placed, line);
  const F size = capsule.extent();
  const F touching = contact.touching(size);
  const F end_a = dot(m, rotate(placed.turn, capsule.a));
  const F end_b = dot(m, rotate(placed.turn, capsule.b));
  const F lowest = hn::Add(max(end_a, end_b), capsule.radius);
  TwoPoints two;
  two.point[0] = line.a;
  two.point[1] = line.b;
  for (size_t i = 0; i < 2; ++i) {
    const F s = hn::Add(contact.separation, hn::Sub(lowest, dot(m, two.point[i])));
    two.s[i] = s_where(hn::And(line.exists, hn::Le(s, touching)), s);
  }
  reduce_line(contact, two, hn::Mul(splat(kTouchingPoint), size),
              hn::Mul(splat(kSamePoint), hn::Mul(size, size)), out);
}

// The length along n from a point to the cylinder around an axis; kNoPoint if it misses, or hits
// beyond the ends.
HWY_INLINE F enter_cylinder(const F3& point, const F3& n, const F3& start, const F3& axis, F radius,
                            Mask exists, F touching) {
  const F zero = splat(0);
  const F one = splat(1);
  const F squared = dot(axis, axis);
  const F3 r = point - start;
  const F3 n_across = n - axis * hn::Div(dot(n, axis), squared);
  const F3 r_across = r - axis * hn::Div(dot(r, axis), squared);
  const F nn = dot(n_across, n_across);
  const F k = hn::Div(dot(r_across, n_across), nn);
  const F3 aside = r_across - n_across * k;
  const F left = hn::Sub(hn::Mul(radius, radius), dot(aside, aside));
  const F s = hn::Sub(hn::Neg(k), hn::Sqrt(hn::Div(max(left, zero), nn)));
  const F t = hn::Div(dot(r + n * s, axis), squared);
  const F over = max(max(hn::Neg(t), hn::Sub(t, one)), zero);
  const F reach = hn::Add(hn::Mul(splat(kOverhang), radius), splat(kClipSlack));
  const Mask ends_well = hn::Le(hn::Mul(hn::Mul(over, over), squared), hn::Mul(reach, reach));
  const Mask hit = hn::And(hn::And(hn::Ge(left, zero), ends_well), exists);
  return s_where(hn::And(hit, hn::Le(s, touching)), s);
}

// Two capsules. They have two points if their axes are nearly parallel.
HWY_INLINE void touch_capsule(const CapsuleLanes& capsule_a, const Placed& placed_a,
                              const CapsuleLanes& capsule_b, const Placed& placed_b,
                              const ContactLanes& contact, PointLanes& out) {
  const F3& n = contact.normal;
  SurfaceLine line;
  line_towards(n, capsule_a, placed_a, line);
  const F3 along = line.b - line.a;
  const F3 ends[2] = {rotate(placed_b.turn, capsule_b.a) + placed_b.origin,
                      rotate(placed_b.turn, capsule_b.b) + placed_b.origin};
  const F3 axis = ends[1] - ends[0];
  const F3 turn = cross(along, axis);
  const F squares = hn::Mul(dot(along, along), dot(axis, axis));
  const Mask same_direction = hn::And(
      hn::Gt(squares, splat(0)), hn::Le(dot(turn, turn), hn::Mul(splat(kSameDirection), squares)));
  const Mask exists = hn::And(line.exists, same_direction);
  const F rate = dot(along, axis);
  const F3 shift = line.a + n * contact.separation;
  TwoPoints two;
  for (size_t i = 0; i < 2; ++i) {
    const F t = clamp(hn::Div(dot(ends[i] - shift, axis), rate), splat(0), splat(1));
    two.point[i] = line.a + along * t;
    two.s[i] = enter_cylinder(two.point[i], n, ends[0], axis, capsule_b.radius, exists,
                              contact.touching());
  }
  reduce_line(contact, two, splat(kTouchingPoint), splat(kSamePoint), out);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_LINE_CONTACT_INL_H_
