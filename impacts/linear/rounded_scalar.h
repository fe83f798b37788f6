// Times at which a moving point comes within reach of a segment, a parallelogram, a triangle or a
// prism. These are the differences of two cores that move in a straight line.
#pragma once

#include "impacts/linear/crossing_scalar.h"

namespace carom::scalar {

inline double meets_segment(const MovingPoint& point, const Vector3d& edge, double reach) {
  return min(meets_edge(point, edge, reach),
             min(meets_ball(point, reach), meets_ball(point.seen_from(edge), reach)));
}

// The corners are 0, u, v and u + v.
inline double meets_parallelogram(const MovingPoint& point, const Vector3d& u, const Vector3d& v,
                                  double reach, double slack) {
  const Face face(u, v);
  const double edge_reach = reach + face.width();
  const double sides =
      min(meets_edge(point, v, edge_reach), meets_edge(point.seen_from(u), v, edge_reach));
  const double ends =
      min(meets_segment(point, u, edge_reach), meets_segment(point.seen_from(v), u, edge_reach));
  const double inside = meets_face(point, face, FaceKind::parallelogram, reach, slack);
  return face.is_slanted ? kNoClosedForm : min(inside, min(sides, ends));
}

// The corners are 0, u and v; the edges are grown by edge_reach. The caller checks face.is_slanted.
inline double meets_triangle(const MovingPoint& point, const Face& face, double reach,
                             double edge_reach, double slack) {
  const MovingPoint from_u = point.seen_from(face.u);
  const double sides =
      min(meets_edge(point, face.v, edge_reach), meets_edge(from_u, face.v - face.u, edge_reach));
  const double rest = min(meets_segment(point, face.u, edge_reach),
                          meets_ball(point.seen_from(face.v), edge_reach));
  return min(meets_face(point, face, FaceKind::triangle, reach, slack), min(sides, rest));
}

// Whether the segment from `a` along `edge` pierces the triangle.
inline bool pierces(const Vector3d& a, const Vector3d& edge, const Face& face) {
  const double height = dot(face.normal, a), other = height + dot(face.normal, edge);
  if (face.is_thin || !(height * other < 0)) return false;
  const Vector3d at = a + edge * (height / (height - other));
  const double along_u = dot(cross(at, face.v), face.normal);
  const double along_v = dot(cross(face.u, at), face.normal);
  return along_u >= 0 && along_v >= 0 && along_u + along_v <= face.squared;
}

// The triangle 0, u, v, swept by `depth`.
inline double meets_prism(const MovingPoint& point, const Face& face, const Vector3d& depth,
                          double reach, double slack) {
  const Face side_u(face.u, depth), side_v(face.v, depth), side_w(face.v - face.u, depth);
  const double width = max(max(face.width(), side_u.width()), max(side_v.width(), side_w.width()));
  const double edge_reach = reach + width;
  const MovingPoint from_u = point.seen_from(face.u);
  const auto side = [&](const MovingPoint& from, const Face& of) {
    return meets_face(from, of, FaceKind::parallelogram, reach, slack);
  };
  const double faces = min(side(point, side_u), min(side(point, side_v), side(from_u, side_w)));
  const double edges = min(meets_edge(point, depth, edge_reach),
                           min(meets_edge(from_u, depth, edge_reach),
                               meets_edge(point.seen_from(face.v), depth, edge_reach)));
  const double front = meets_triangle(point, face, reach, edge_reach, slack);
  const double back = meets_triangle(point.seen_from(depth), face, reach, edge_reach, slack);
  const double first = min(min(faces, edges), min(front, back));
  if (face.is_slanted || side_u.is_slanted || side_v.is_slanted || side_w.is_slanted) {
    return kNoClosedForm;
  }
  return pierces(point.from, -depth, face) ? 0.0 : first;
}

}  // namespace carom::scalar
