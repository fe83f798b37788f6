// Clips the faces of two boxes seen along a line, in lanes. Method and reasons:
// rectangles_scalar.h.
#if defined(CAROM_NARROWPHASE_MANIFOLDS_RECTANGLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_RECTANGLES_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_RECTANGLES_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_RECTANGLES_INL_H_
#endif

#include "narrowphase/manifolds/clip-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The face of a box, projected into the coordinates of another face.
struct SeenRectangle {
  Seen<4> corners;
  SeenWay u, v;  // its sides

  HWY_INLINE SeenRectangle(const FaceView& view, const Rectangle& face) {
    const FaceFrame& frame = face.frame;
    SeenWay origin;
    view.project(frame.origin + frame.n * frame.height, origin.x, origin.y, origin.s);
    view.project_way(frame.u, u.x, u.y, u.s);
    view.project_way(frame.v, v.x, v.y, v.s);
    for (size_t i = 0; i < 4; ++i) {
      const F at_x = face.corner_x(i);
      const F at_y = face.corner_y(i);
      corners.x[i] = at(origin.x, u.x, at_x, v.x, at_y);
      corners.y[i] = at(origin.y, u.y, at_x, v.y, at_y);
      corners.s[i] = at(origin.s, u.s, at_x, v.s, at_y);
    }
    lengthen(u, hn::Sub(face.upper_x, face.lower_x));
    lengthen(v, hn::Sub(face.upper_y, face.lower_y));
  }

 private:
  static HWY_INLINE F at(F origin, F u, F at_x, F v, F at_y) {
    return hn::Add(hn::Add(origin, hn::Mul(u, at_x)), hn::Mul(v, at_y));
  }
  static HWY_INLINE void lengthen(SeenWay& way, F size) {
    way.x = hn::Mul(way.x, size);
    way.y = hn::Mul(way.y, size);
    way.s = hn::Mul(way.s, size);
  }
};

enum class End { near, far };

// Stores an end of what the face covers of a side of the other one.
template <End kEnd>
HWY_INLINE void put_end(const Rectangle& face, Mask is_open, const Seen<4>& seen, size_t from,
                        size_t to, const SeenWay& way, F touching, size_t i, ClipPoints<8>& out) {
  F near = splat(0);
  F far = splat(1);
  clip_edge(face, seen, from, to, way, near, far);
  const Mask in_sight = hn::And(is_open, hn::Le(near, far));
  F x, y, s;
  if constexpr (kEnd == End::near) {
    x = hn::Add(seen.x[from], hn::Mul(way.x, near));
    y = hn::Add(seen.y[from], hn::Mul(way.y, near));
    s = hn::Add(seen.s[from], hn::Mul(way.s, near));
  } else {
    const F rest = hn::Sub(splat(1), far);
    x = hn::Sub(seen.x[to], hn::Mul(way.x, rest));
    y = hn::Sub(seen.y[to], hn::Mul(way.y, rest));
    s = hn::Sub(seen.s[to], hn::Mul(way.s, rest));
  }
  confine(face, x, y);
  out.put(i, in_sight, x, y, s, touching);
}

// Clips the sides of a face to another one that is seen as a parallelogram with an area.
class SideClip {
 public:
  HWY_INLINE SideClip(const Rectangle& face, const SeenRectangle& seen, Mask is_open)
      : face_(face), seen_(seen) {
    const SeenWay& u = seen.u;
    const SeenWay& v = seen.v;
    const F zero = splat(0);
    const F area = area_left(u.x, u.y, v.x, v.y);
    const F slack_u = slack_of_edge(u.x, u.y);
    const F slack_v = slack_of_edge(v.x, v.y);
    const F below = min(zero, area);
    const F above = max(zero, area);
    least_u_ = hn::Sub(below, slack_u);
    most_u_ = hn::Add(above, slack_u);
    least_v_ = hn::Sub(below, slack_v);
    most_v_ = hn::Add(above, slack_v);
    turns_left_ = hn::Not(hn::Lt(area, zero));
    is_open_ = hn::And(is_open, hn::Gt(hn::Abs(area), hn::Add(slack_u, slack_v)));
    slope_x_ = hn::Div(hn::Sub(hn::Mul(u.s, v.y), hn::Mul(v.s, u.y)), area);
    slope_y_ = hn::Div(hn::Sub(hn::Mul(u.x, v.s), hn::Mul(v.x, u.s)), area);
  }

  HWY_INLINE void put_ends(F touching, size_t first, ClipPoints<8>& out) const {
    F near, far;
    along_x(face_.lower_y, near, far);
    put(first, near, far, end(far, near), face_.lower_y, touching, out);
    along_y(face_.upper_x, near, far);
    put(first + 1, near, far, face_.upper_x, end(far, near), touching, out);
    along_x(face_.upper_y, near, far);
    put(first + 2, near, far, end(near, far), face_.upper_y, touching, out);
    along_y(face_.lower_x, near, far);
    put(first + 3, near, far, face_.lower_x, end(near, far), touching, out);
  }

 private:
  HWY_INLINE F end(F of_left, F of_right) const {
    return hn::IfThenElse(turns_left_, of_left, of_right);
  }

  HWY_INLINE void along_x(F y, F& near, F& far) const {
    const F beside = hn::Sub(y, seen_.corners.y[0]);
    const F by_u = hn::Div(splat(1), crossing(seen_.u.y));
    const F by_v = hn::Div(splat(1), crossing(seen_.v.y));
    const F of_u = hn::Mul(seen_.u.x, beside);
    const F of_v = hn::Mul(beside, seen_.v.x);
    const F u0 = hn::Mul(hn::Sub(of_u, least_u_), by_u);
    const F u1 = hn::Mul(hn::Sub(of_u, most_u_), by_u);
    const F v0 = hn::Mul(hn::Add(least_v_, of_v), by_v);
    const F v1 = hn::Mul(hn::Add(most_v_, of_v), by_v);
    between(u0, u1, v0, v1, seen_.corners.x[0], face_.lower_x, face_.upper_x, near, far);
  }

  HWY_INLINE void along_y(F x, F& near, F& far) const {
    const F beside = hn::Sub(x, seen_.corners.x[0]);
    const F by_u = hn::Div(splat(1), crossing(seen_.u.x));
    const F by_v = hn::Div(splat(1), crossing(seen_.v.x));
    const F of_u = hn::Mul(seen_.u.y, beside);
    const F of_v = hn::Mul(beside, seen_.v.y);
    const F u0 = hn::Mul(hn::Add(least_u_, of_u), by_u);
    const F u1 = hn::Mul(hn::Add(most_u_, of_u), by_u);
    const F v0 = hn::Mul(hn::Sub(of_v, least_v_), by_v);
    const F v1 = hn::Mul(hn::Sub(of_v, most_v_), by_v);
    between(u0, u1, v0, v1, seen_.corners.y[0], face_.lower_y, face_.upper_y, near, far);
  }

  static HWY_INLINE void between(F u0, F u1, F v0, F v1, F from, F lower, F upper, F& near,
                                 F& far) {
    near = max(hn::Add(from, max(min(u0, u1), min(v0, v1))), lower);
    far = min(hn::Add(from, min(max(u0, u1), max(v0, v1))), upper);
  }

  HWY_INLINE void put(size_t i, F near, F far, F x, F y, F touching, ClipPoints<8>& out) const {
    const F rise = hn::Add(hn::Mul(hn::Sub(x, seen_.corners.x[0]), slope_x_),
                           hn::Mul(hn::Sub(y, seen_.corners.y[0]), slope_y_));
    out.put(i, hn::And(is_open_, hn::Le(near, far)), x, y, hn::Add(seen_.corners.s[0], rise),
            touching);
  }

  const Rectangle& face_;
  const SeenRectangle& seen_;
  // Bounds of the cross product of u with a point of the parallelogram, and of a point with v.
  F least_u_, most_u_, least_v_, most_v_;
  F slope_x_, slope_y_;
  Mask turns_left_, is_open_;
};

// Seen along m, a unit vector. Corners where the other face is more than `touching` above are left
// out.
HWY_INLINE void clip(const Rectangle& face, const Rectangle& other, const F3& m, F touching,
                     ClipPoints<8>& out) {
  const FaceView view(face.frame, m);
  const SeenRectangle seen(view, other);
  const Seen<4>& corners = seen.corners;
  put_end<End::far>(face, view.is_open, corners, 0, 1, seen.u, touching, 0, out);
  put_end<End::far>(face, view.is_open, corners, 1, 2, seen.v, touching, 1, out);
  put_end<End::near>(face, view.is_open, corners, 3, 2, seen.u, touching, 2, out);
  put_end<End::near>(face, view.is_open, corners, 0, 3, seen.v, touching, 3, out);
  SideClip(face, seen, view.is_open).put_ends(touching, 4, out);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_RECTANGLES_INL_H_
