// Clips two polygons seen along a line: the region that both cover, and the gap between them there.
//
// Source of the clipping of edges: Y.-D. Liang and B. A. Barsky, "A New Concept and Method for Line
// Clipping", ACM TOG 3(1), 1984.
#pragma once

#include "narrowphase/manifolds/polygon_scalar.h"

namespace carom::scalar {

// A point in the plane of a face. s is the height of the other polygon above it, along the view.
struct ClipPoint {
  float x, y, s;
};

// Each edge of one polygon gives up to two points, each corner of the other one point.
using ClipPoints = FewOf<ClipPoint, 3 * DopFace::kMostCorners>;

// The corners of a polygon, projected along the view.
using SeenPolygon = FewOf<ClipPoint, DopFace::kMostCorners>;

inline Point2 xy(const ClipPoint& c) { return {c.x, c.y}; }

// A face seen along m, a unit vector.
class FaceView {
 public:
  FaceView(const FaceFrame& frame, const Vector3f& m)
      : frame_(frame),
        along_x_(dot(frame.u, m)),
        along_y_(dot(frame.v, m)),
        along_n_(dot(frame.n, m)),
        inverse_(1 / along_n_) {}

  bool is_edge_on() const { return !(std::fabs(along_n_) > kEdgeOn); }

  ClipPoint project(const Vector3f& point) const {
    return project(point - frame_.origin, frame_.height);
  }
  ClipPoint project_way(const Vector3f& way) const { return project(way, 0); }

 private:
  ClipPoint project(const Vector3f& r, float height) const {
    const float s = (dot(frame_.n, r) - height) * inverse_;
    return {dot(frame_.u, r) - s * along_x_, dot(frame_.v, r) - s * along_y_, s};
  }

  const FaceFrame& frame_;
  float along_x_, along_y_, along_n_, inverse_;
};

// An edge of the other polygon, in coordinates of the face.
struct SeenEdge {
  ClipPoint from, to;
  ClipPoint way;  // to - from
};

inline SeenEdge edge_between(const ClipPoint& from, const ClipPoint& to) {
  return {from, to, {to.x - from.x, to.y - from.y, to.s - from.s}};
}

struct Extent2 {
  Point2 lower, upper;

  bool holds(Point2 p) const {
    return p.x >= lower.x - kClipSlack && p.x <= upper.x + kClipSlack &&
           p.y >= lower.y - kClipSlack && p.y <= upper.y + kClipSlack;
  }
};

template <class Points>
Extent2 extent_of(const Points& points) {
  Extent2 extent{{points[0].x, points[0].y}, {points[0].x, points[0].y}};
  for (size_t i = 1; i < points.size(); ++i) {
    extent.lower = {min(extent.lower.x, points[i].x), min(extent.lower.y, points[i].y)};
    extent.upper = {max(extent.upper.x, points[i].x), max(extent.upper.y, points[i].y)};
  }
  return extent;
}

// The part of an edge that is left after clipping, as shares of the edge.
struct Span {
  float near = 0;
  float far = 1;
};

inline float crossing(float rate) {
  return std::fabs(rate) > kLeastCrossing ? rate : kLeastCrossing;
}

// Clips an edge to the strip between two parallel sides, widened by kClipSlack.
inline void clip_between(float from, float rate, float lower, float upper, Span& span) {
  const float inverse = 1 / crossing(rate);
  const float t_lower = ((lower - kClipSlack) - from) * inverse;
  const float t_upper = ((upper + kClipSlack) - from) * inverse;
  span.near = max(span.near, min(t_lower, t_upper));
  span.far = min(span.far, max(t_lower, t_upper));
}

inline Span clip_edge(const Rectangle& face, const SeenEdge& edge) {
  Span span;
  clip_between(edge.from.x, edge.way.x, face.lower.x, face.upper.x, span);
  clip_between(edge.from.y, edge.way.y, face.lower.y, face.upper.y, span);
  return span;
}

// Twice the area of the triangle a, b, (x, y). Positive if the point is to the left of the edge.
inline float area_left(Point2 a, Point2 b, float x, float y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

// How far below zero that area may be for a point that still counts as inside.
inline float slack_of_edge(Point2 a, Point2 b) {
  return kClipSlack * (std::fabs(b.x - a.x) + std::fabs(b.y - a.y));
}

// The slack of two sides would lengthen a sharp corner a lot, so the extent of the corners limits
// it.
inline void clip_to_extent(const TriangleFace& face, const SeenEdge& edge, Span& span) {
  clip_between(edge.from.x, edge.way.x, 0, face.points[1].x, span);
}
inline void clip_to_extent(const PolygonFace& face, const SeenEdge& edge, Span& span) {
  const Extent2 extent = extent_of(face.points);
  clip_between(edge.from.x, edge.way.x, extent.lower.x, extent.upper.x, span);
  clip_between(edge.from.y, edge.way.y, extent.lower.y, extent.upper.y, span);
}

template <AnyPolygon Face>
Span clip_edge(const Face& face, const SeenEdge& edge) {
  Span span;
  clip_to_extent(face, edge, span);
  const size_t count = face.points.size();
  for (size_t k = 0; k < count; ++k) {
    const Point2 a = face.points[k], b = face.points[(k + 1) % count];
    const float start = area_left(a, b, edge.from.x, edge.from.y) + slack_of_edge(a, b);
    const float rate =
        crossing((area_left(a, b, edge.to.x, edge.to.y) + slack_of_edge(a, b)) - start);
    const float t = -start / rate;
    if (rate > 0) {
      span.near = max(span.near, t);
    } else {
      span.far = min(span.far, t);
    }
  }
  return span;
}

// Moves an end of a clipped edge onto the face, by less than the slack.
inline void confine(const Rectangle& face, ClipPoint& c) {
  c.x = clamp(c.x, face.lower.x, face.upper.x);
  c.y = clamp(c.y, face.lower.y, face.upper.y);
}
template <AnyPolygon Face>
void confine(const Face&, ClipPoint&) {}

inline void keep(const ClipPoint& c, float touching, ClipPoints& out) {
  if (c.s <= touching) out.push_back(c);
}

// Clips an edge to the face and adds its ends. An end that was not clipped is exact.
template <class Face>
void add_edge(const Face& face, const SeenEdge& edge, float touching, ClipPoints& out) {
  const Span span = clip_edge(face, edge);
  if (!(span.near <= span.far)) return;
  const auto& [from, to, way] = edge;
  const float rest = 1 - span.far;
  ClipPoint near = {from.x + way.x * span.near, from.y + way.y * span.near,
                    from.s + way.s * span.near};
  ClipPoint far = {to.x - way.x * rest, to.y - way.y * rest, to.s - way.s * rest};
  confine(face, near);
  confine(face, far);
  keep(near, touching, out);
  keep(far, touching, out);
}

// Adds the corners of the face that a polygon with this normal covers.
template <class Face>
void add_corners(const Face& face, const Vector3f& normal, const Vector3f& m,
                 const SeenPolygon& seen, float touching, ClipPoints& out) {
  const float facing = dot(normal, m);
  if (!(std::fabs(facing) > kEdgeOn)) return;
  const size_t count = seen.size();
  const auto next = [count](size_t i) { return i + 1 < count ? i + 1 : 0; };
  float area = area_left(xy(seen[0]), xy(seen[1]), seen[2].x, seen[2].y);
  for (size_t i = 3; i < count; ++i) {
    area += area_left(xy(seen[0]), xy(seen[i - 1]), seen[i].x, seen[i].y);
  }
  const float side = area < 0 ? -1.0f : 1.0f;
  std::array<float, SeenPolygon::kCapacity> slack;
  float all_slack = 0;
  for (size_t i = 0; i < count; ++i) {
    slack[i] = slack_of_edge(xy(seen[i]), xy(seen[next(i)]));
    all_slack = all_slack + slack[i];
  }
  if (!(area * side > all_slack)) return;
  const float slope_x = dot(face.frame.u, normal) / facing;
  const float slope_y = dot(face.frame.v, normal) / facing;
  const Extent2 extent = extent_of(seen);
  for (const Point2& corner : face.corners()) {
    bool covered = extent.holds(corner);
    for (size_t i = 0; i < count; ++i) {
      const float left = area_left(xy(seen[i]), xy(seen[next(i)]), corner.x, corner.y) * side;
      covered = covered && left + slack[i] >= 0;
    }
    const float s =
        seen[0].s + ((seen[0].x - corner.x) * slope_x + (seen[0].y - corner.y) * slope_y);
    if (covered) keep({corner.x, corner.y, s}, touching, out);
  }
}

// The corners of the region that a face and a polygon with this normal cover, seen along m, a unit
// vector. Corners where the polygon is more than `touching` above are left out. The normal is zero
// if the polygon has no area.
template <class Face, class Corners>
ClipPoints clip(const Face& face, const Corners& corners, const Vector3f& normal, const Vector3f& m,
                float touching) {
  ClipPoints out;
  const FaceView view(face.frame, m);
  if (view.is_edge_on()) return out;
  SeenPolygon seen;
  for (const Vector3f& corner : corners) seen.push_back(view.project(corner));
  for (size_t i = 0; i < seen.size(); ++i) {
    add_edge(face, edge_between(seen[i], seen[(i + 1) % seen.size()]), touching, out);
  }
  add_corners(face, normal, m, seen, touching, out);
  return out;
}

}  // namespace carom::scalar
