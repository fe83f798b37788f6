// Clips two polygons seen along a line: the region that both cover, and the gap between them there
// (Liang and Barsky 1984). clip_scalar.h is the scalar form.
#if defined(CAROM_NARROWPHASE_MANIFOLDS_CLIP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_CLIP_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_CLIP_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_CLIP_INL_H_
#endif

#include <limits>

#include "narrowphase/manifolds/polygon-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// An unused place has kNoPoint as its s. Its x is NaN, so it fails every comparison.
HWY_INLINE Mask is_point(F s) { return hn::Lt(s, splat(kNoPoint)); }

HWY_INLINE F s_where(Mask is_one, F s) { return hn::IfThenElse(is_one, s, splat(kNoPoint)); }

// Points in the plane of a face. s is the height of the other polygon above each point, along the
// view.
template <size_t kCount>
struct ClipPoints {
  F x[kCount], y[kCount], s[kCount];

  // Stores a point in the lanes of `is_one` where its s is at most `touching`.
  HWY_INLINE void put(size_t i, Mask is_one, F at_x, F at_y, F at_s, F touching) {
    const Mask counts = hn::And(is_one, hn::Le(at_s, touching));
    x[i] = hn::IfThenElse(counts, at_x, splat(std::numeric_limits<float>::quiet_NaN()));
    y[i] = at_y;
    s[i] = s_where(counts, at_s);
  }
};

// A face seen along m, a unit vector.
struct FaceView {
  const FaceFrame& frame;
  F along_x, along_y, inverse;
  Mask is_open;  // the face is not seen edge-on

  HWY_INLINE FaceView(const FaceFrame& of, const F3& m)
      : frame(of), along_x(dot(of.u, m)), along_y(dot(of.v, m)) {
    const F along_n = dot(of.n, m);
    inverse = hn::Div(splat(1), along_n);
    is_open = hn::Gt(hn::Abs(along_n), splat(kEdgeOn));
  }

  HWY_INLINE void project(const F3& point, F& x, F& y, F& s) const {
    const F3 r = point - frame.origin;
    shear(r, hn::Sub(dot(frame.n, r), frame.height), x, y, s);
  }
  HWY_INLINE void project_way(const F3& way, F& x, F& y, F& s) const {
    shear(way, dot(frame.n, way), x, y, s);
  }
  HWY_INLINE void shear(const F3& r, F above, F& x, F& y, F& s) const {
    s = hn::Mul(above, inverse);
    x = hn::Sub(dot(frame.u, r), hn::Mul(s, along_x));
    y = hn::Sub(dot(frame.v, r), hn::Mul(s, along_y));
  }
};

// Corners of the other polygon, projected along the view into coordinates of the face.
template <size_t kCount>
struct Seen {
  F x[kCount], y[kCount], s[kCount];
};

// An edge of the other polygon: corner `to` minus corner `from`.
struct SeenWay {
  F x, y, s;
};

HWY_INLINE F crossing(F rate) {
  return hn::IfThenElse(hn::Gt(hn::Abs(rate), splat(kLeastCrossing)), rate, splat(kLeastCrossing));
}

// Clips an edge to the strip between two parallel sides, widened by kClipSlack.
HWY_INLINE void clip_between(F from, F rate, F lower, F upper, F& near, F& far) {
  const F slack = splat(kClipSlack);
  const F inverse = hn::Div(splat(1), crossing(rate));
  const F t_lower = hn::Mul(hn::Sub(hn::Sub(lower, slack), from), inverse);
  const F t_upper = hn::Mul(hn::Sub(hn::Add(upper, slack), from), inverse);
  near = max(near, min(t_lower, t_upper));
  far = min(far, max(t_lower, t_upper));
}

// Clips an edge to the face. The rest goes from `near` to `far`, as shares of the edge.
template <size_t kSeen>
HWY_INLINE void clip_edge(const Rectangle& face, const Seen<kSeen>& seen, size_t from, size_t,
                          const SeenWay& way, F& near, F& far) {
  clip_between(seen.x[from], way.x, face.lower_x, face.upper_x, near, far);
  clip_between(seen.y[from], way.y, face.lower_y, face.upper_y, near, far);
}

// Twice the area of the triangle between an edge (dx, dy) and the point (x, y), both from the
// edge's start. Positive on the left.
HWY_INLINE F area_left(F dx, F dy, F x, F y) { return hn::Sub(hn::Mul(dx, y), hn::Mul(dy, x)); }

// How far below zero that area may be for a point that still counts as inside.
HWY_INLINE F slack_of_edge(F dx, F dy) {
  return hn::Mul(splat(kClipSlack), hn::Add(hn::Abs(dx), hn::Abs(dy)));
}

// The slack of two sides would lengthen a sharp corner a lot, so the extent of the corners limits
// it.
template <size_t kSeen>
HWY_INLINE void clip_to_extent(const TriangleFace& face, const Seen<kSeen>& seen, size_t from,
                               const SeenWay& way, F& near, F& far) {
  clip_between(seen.x[from], way.x, splat(0), face.x[1], near, far);
}
template <size_t kMost, size_t kSeen>
HWY_INLINE void clip_to_extent(const PolygonFace<kMost>& face, const Seen<kSeen>& seen, size_t from,
                               const SeenWay& way, F& near, F& far) {
  clip_between(seen.x[from], way.x, face.lower_x, face.upper_x, near, far);
  clip_between(seen.y[from], way.y, face.lower_y, face.upper_y, near, far);
}

template <class Face, size_t kSeen>
HWY_INLINE void clip_edge(const Face& face, const Seen<kSeen>& seen, size_t from, size_t to,
                          const SeenWay& way, F& near, F& far) {
  constexpr size_t kSides = Face::kCorners;
  const Mask every = hn::Not(no_lanes());
  clip_to_extent(face, seen, from, way, near, far);
  for (size_t k = 0; k < kSides; ++k) {
    const F a_x = face.x[k];
    const F a_y = face.y[k];
    const F side_x = hn::Sub(face.x[(k + 1) % kSides], a_x);
    const F side_y = hn::Sub(face.y[(k + 1) % kSides], a_y);
    const F slack = slack_of_edge(side_x, side_y);
    const auto inward = [&](F p_x, F p_y) HWY_ATTR {
      return hn::Add(area_left(side_x, side_y, hn::Sub(p_x, a_x), hn::Sub(p_y, a_y)), slack);
    };
    const F start = inward(seen.x[from], seen.y[from]);
    const F rate = crossing(hn::Sub(inward(seen.x[to], seen.y[to]), start));
    const F t = hn::Div(hn::Neg(start), rate);
    const Mask enters = hn::Gt(rate, splat(0));
    near = hn::IfThenElse(face.where(k, enters), max(near, t), near);
    far = hn::IfThenElse(face.where(k, hn::AndNot(enters, every)), min(far, t), far);
  }
}

// Moves an end of a clipped edge onto the face, by less than the slack.
HWY_INLINE void confine(const Rectangle& face, F& x, F& y) {
  x = clamp(x, face.lower_x, face.upper_x);
  y = clamp(y, face.lower_y, face.upper_y);
}
template <class Face>
HWY_INLINE void confine(const Face&, F&, F&) {}

// Clips an edge to the face and stores the ends as points `first` and `first + 1`. An end that was
// not clipped is exact.
template <class Face, size_t kCount, size_t kSeen>
HWY_INLINE void put_edge(const Face& face, Mask is_open, const Seen<kSeen>& seen, size_t from,
                         size_t to, const SeenWay& way, F touching, size_t first,
                         ClipPoints<kCount>& out) {
  F near = splat(0);
  F far = splat(1);
  clip_edge(face, seen, from, to, way, near, far);
  const Mask in_sight = hn::And(is_open, hn::Le(near, far));
  const F rest = hn::Sub(splat(1), far);
  F near_x = hn::Add(seen.x[from], hn::Mul(way.x, near));
  F near_y = hn::Add(seen.y[from], hn::Mul(way.y, near));
  F far_x = hn::Sub(seen.x[to], hn::Mul(way.x, rest));
  F far_y = hn::Sub(seen.y[to], hn::Mul(way.y, rest));
  const F near_s = hn::Add(seen.s[from], hn::Mul(way.s, near));
  const F far_s = hn::Sub(seen.s[to], hn::Mul(way.s, rest));
  confine(face, near_x, near_y);
  confine(face, far_x, far_y);
  out.put(first, in_sight, near_x, near_y, near_s, touching);
  out.put(first + 1, in_sight, far_x, far_y, far_s, touching);
}

template <size_t kSeen>
HWY_INLINE void way_between(const Seen<kSeen>& seen, size_t from, size_t to, SeenWay& way) {
  way.x = hn::Sub(seen.x[to], seen.x[from]);
  way.y = hn::Sub(seen.y[to], seen.y[from]);
  way.s = hn::Sub(seen.s[to], seen.s[from]);
}

// Stores the corners of the face that a polygon with this normal covers, from point kFirst on.
template <size_t kFirst, class Face, size_t kSeen, size_t kCount>
HWY_INLINE void put_corners(const Face& face, Mask is_open, const F3& normal, const F3& m,
                            const Seen<kSeen>& seen, const SeenWay (&ways)[kSeen], F touching,
                            ClipPoints<kCount>& out) {
  const F zero = splat(0);
  const F facing = dot(normal, m);
  F area =
      area_left(ways[0].x, ways[0].y, hn::Sub(seen.x[2], seen.x[0]), hn::Sub(seen.y[2], seen.y[0]));
  for (size_t i = 3; i < kSeen; ++i) {
    const F last_x = hn::Sub(seen.x[i - 1], seen.x[0]), last_y = hn::Sub(seen.y[i - 1], seen.y[0]);
    area = hn::Add(area, area_left(last_x, last_y, hn::Sub(seen.x[i], seen.x[0]),
                                   hn::Sub(seen.y[i], seen.y[0])));
  }
  const F side = hn::IfThenElse(hn::Lt(area, zero), splat(-1), splat(1));
  const F slope_x = hn::Div(dot(face.frame.u, normal), facing);
  const F slope_y = hn::Div(dot(face.frame.v, normal), facing);
  F slack[kSeen];
  F all_slack = zero;
  F lower_x = seen.x[0], lower_y = seen.y[0], upper_x = seen.x[0], upper_y = seen.y[0];
  for (size_t i = 0; i < kSeen; ++i) {
    slack[i] = slack_of_edge(ways[i].x, ways[i].y);
    all_slack = hn::Add(all_slack, slack[i]);
    lower_x = min(lower_x, seen.x[i]);
    lower_y = min(lower_y, seen.y[i]);
    upper_x = max(upper_x, seen.x[i]);
    upper_y = max(upper_y, seen.y[i]);
  }
  lower_x = hn::Sub(lower_x, splat(kClipSlack));
  lower_y = hn::Sub(lower_y, splat(kClipSlack));
  upper_x = hn::Add(upper_x, splat(kClipSlack));
  upper_y = hn::Add(upper_y, splat(kClipSlack));
  const Mask has_area = hn::And(hn::Gt(hn::Mul(area, side), all_slack),
                                hn::And(is_open, hn::Gt(hn::Abs(facing), splat(kEdgeOn))));
  for (size_t k = 0; k < Face::kCorners; ++k) {
    const F x = face.corner_x(k);
    const F y = face.corner_y(k);
    const Mask in_x = hn::And(hn::Ge(x, lower_x), hn::Le(x, upper_x));
    const Mask in_y = hn::And(hn::Ge(y, lower_y), hn::Le(y, upper_y));
    Mask covered = face.where(k, hn::And(has_area, hn::And(in_x, in_y)));
    for (size_t i = 0; i < kSeen; ++i) {
      const F left = area_left(ways[i].x, ways[i].y, hn::Sub(x, seen.x[i]), hn::Sub(y, seen.y[i]));
      covered = hn::And(covered, hn::Ge(hn::Add(hn::Mul(left, side), slack[i]), zero));
    }
    const F rise =
        hn::Add(hn::Mul(hn::Sub(seen.x[0], x), slope_x), hn::Mul(hn::Sub(seen.y[0], y), slope_y));
    out.put(kFirst + k, covered, x, y, hn::Add(seen.s[0], rise), touching);
  }
}

// The corners of the region that a face and another polygon cover, seen along m, a unit vector.
// Corners where the other one is more than `touching` above are left out. Its normal is zero if it
// has no area.
template <class Face, class OtherFace, size_t kCount>
HWY_INLINE void clip(const Face& face, const FaceSide<OtherFace>& other, const F3& m, F touching,
                     ClipPoints<kCount>& out) {
  constexpr size_t kSeen = OtherFace::kCorners;
  static_assert(kCount == 2 * kSeen + Face::kCorners);
  const FaceView view(face.frame, m);
  Seen<kSeen> seen;
  SeenWay ways[kSeen];
  for (size_t i = 0; i < kSeen; ++i) {
    view.project(other.corners[i], seen.x[i], seen.y[i], seen.s[i]);
  }
  for (size_t i = 0; i < kSeen; ++i) {
    const size_t next = (i + 1) % kSeen;
    way_between(seen, i, next, ways[i]);
    put_edge(face, other.face.where(i, view.is_open), seen, i, next, ways[i], touching, 2 * i, out);
  }
  put_corners<2 * kSeen>(face, view.is_open, other.face.frame.n, m, seen, ways, touching, out);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_CLIP_INL_H_
