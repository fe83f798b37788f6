// Clips the faces of two boxes seen along a line: the corners of the region that both cover, and
// the gap between them there. The region is convex, and each of its corners is where one of its
// edges ends, going round. So of the four sides of each face only the end is kept.
#pragma once

#include "narrowphase/manifolds/clip_scalar.h"

namespace carom::scalar {

inline float cross2(const ClipPoint& a, const ClipPoint& b) { return a.x * b.y - a.y * b.x; }

inline float slack_of_way(const ClipPoint& way) {
  return kClipSlack * (std::fabs(way.x) + std::fabs(way.y));
}

// The face of a box, projected into the coordinates of another face.
struct SeenRectangle {
  std::array<ClipPoint, 4> corners;
  ClipPoint u, v;  // its sides

  SeenRectangle(const FaceView& view, const Rectangle& face) {
    const ClipPoint origin = view.project(face.frame.origin + face.frame.n * face.frame.height);
    const ClipPoint way_u = view.project_way(face.frame.u);
    const ClipPoint way_v = view.project_way(face.frame.v);
    const std::array<Point2, 4> at = face.corners();
    for (size_t i = 0; i < 4; ++i) {
      corners[i] = {(origin.x + way_u.x * at[i].x) + way_v.x * at[i].y,
                    (origin.y + way_u.y * at[i].x) + way_v.y * at[i].y,
                    (origin.s + way_u.s * at[i].x) + way_v.s * at[i].y};
    }
    const float size_u = face.upper.x - face.lower.x, size_v = face.upper.y - face.lower.y;
    u = {way_u.x * size_u, way_u.y * size_u, way_u.s * size_u};
    v = {way_v.x * size_v, way_v.y * size_v, way_v.s * size_v};
  }
};

enum class End { near, far };

// Adds an end of what the face covers of a side of the other one.
inline void add_end(const Rectangle& face, const SeenEdge& side, End end, float touching,
                    ClipPoints& out) {
  const Span span = clip_edge(face, side);
  if (!(span.near <= span.far)) return;
  const auto& [from, to, way] = side;
  const float near = span.near, rest = 1 - span.far;
  ClipPoint c = end == End::near
                    ? ClipPoint{from.x + way.x * near, from.y + way.y * near, from.s + way.s * near}
                    : ClipPoint{to.x - way.x * rest, to.y - way.y * rest, to.s - way.s * rest};
  confine(face, c);
  keep(c, touching, out);
}

// Clips the sides of a face to another one that is seen as a parallelogram with an area.
class SideClip {
 public:
  SideClip(const Rectangle& face, const SeenRectangle& seen)
      : face_(face),
        seen_(seen),
        area_(cross2(seen.u, seen.v)),
        slack_u_(slack_of_way(seen.u)),
        slack_v_(slack_of_way(seen.v)) {}

  bool has_area() const { return std::fabs(area_) > slack_u_ + slack_v_; }

  void add_ends(float touching, ClipPoints& out) const {
    const bool turns_left = !(area_ < 0);
    add_along_x(face_.lower.y, turns_left ? End::far : End::near, touching, out);
    add_along_y(face_.upper.x, turns_left ? End::far : End::near, touching, out);
    add_along_x(face_.upper.y, turns_left ? End::near : End::far, touching, out);
    add_along_y(face_.lower.x, turns_left ? End::near : End::far, touching, out);
  }

 private:
  // The cross products of u with a point of the parallelogram, and of a point with v, relative to
  // the first corner.
  float least(float slack) const { return min(0.0f, area_) - slack; }
  float most(float slack) const { return max(0.0f, area_) + slack; }

  void add_along_x(float y, End end, float touching, ClipPoints& out) const {
    const ClipPoint &u = seen_.u, &v = seen_.v, &from = seen_.corners[0];
    const float beside = y - from.y;
    const float by_u = 1 / crossing(u.y), by_v = 1 / crossing(v.y);
    const float u0 = (u.x * beside - least(slack_u_)) * by_u;
    const float u1 = (u.x * beside - most(slack_u_)) * by_u;
    const float v0 = (least(slack_v_) + beside * v.x) * by_v;
    const float v1 = (most(slack_v_) + beside * v.x) * by_v;
    const float near = max(from.x + max(min(u0, u1), min(v0, v1)), face_.lower.x);
    const float far = min(from.x + min(max(u0, u1), max(v0, v1)), face_.upper.x);
    if (near <= far) add(end == End::near ? near : far, y, touching, out);
  }

  void add_along_y(float x, End end, float touching, ClipPoints& out) const {
    const ClipPoint &u = seen_.u, &v = seen_.v, &from = seen_.corners[0];
    const float beside = x - from.x;
    const float by_u = 1 / crossing(u.x), by_v = 1 / crossing(v.x);
    const float u0 = (least(slack_u_) + u.y * beside) * by_u;
    const float u1 = (most(slack_u_) + u.y * beside) * by_u;
    const float v0 = (beside * v.y - least(slack_v_)) * by_v;
    const float v1 = (beside * v.y - most(slack_v_)) * by_v;
    const float near = max(from.y + max(min(u0, u1), min(v0, v1)), face_.lower.y);
    const float far = min(from.y + min(max(u0, u1), max(v0, v1)), face_.upper.y);
    if (near <= far) add(x, end == End::near ? near : far, touching, out);
  }

  void add(float x, float y, float touching, ClipPoints& out) const {
    const ClipPoint &u = seen_.u, &v = seen_.v, &from = seen_.corners[0];
    const float slope_x = (u.s * v.y - v.s * u.y) / area_;
    const float slope_y = (u.x * v.s - v.x * u.s) / area_;
    const float s = from.s + ((x - from.x) * slope_x + (y - from.y) * slope_y);
    keep({x, y, s}, touching, out);
  }

  const Rectangle& face_;
  const SeenRectangle& seen_;
  float area_, slack_u_, slack_v_;
};

// Seen along m, a unit vector. Corners where the other face is more than `touching` above are left
// out.
inline ClipPoints clip(const Rectangle& face, const Rectangle& other, const Vector3f& m,
                       float touching) {
  ClipPoints out;
  const FaceView view(face.frame, m);
  if (view.is_edge_on()) return out;
  const SeenRectangle seen(view, other);
  const auto& c = seen.corners;
  add_end(face, {c[0], c[1], seen.u}, End::far, touching, out);
  add_end(face, {c[1], c[2], seen.v}, End::far, touching, out);
  add_end(face, {c[3], c[2], seen.u}, End::near, touching, out);
  add_end(face, {c[0], c[3], seen.v}, End::near, touching, out);
  const SideClip sides(face, seen);
  if (sides.has_area()) sides.add_ends(touching, out);
  return out;
}

}  // namespace carom::scalar
