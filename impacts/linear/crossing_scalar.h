// Times at which a point that moves along a line comes within reach of a ball, an edge or a face.
// The hull of some points, grown by a radius, is a union of these, so the first one met gives the
// time.
//
// Sources: C. Ericson, Real-Time Collision Detection, 2005, section 5.3; E. Haines et al.,
// "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019, for the distance
// from the ball's centre to the line in place of the discriminant, which rounds far less.
#pragma once

#include <cmath>

#include "impacts/slack.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

using Eigen::Vector3d;

inline constexpr double kNever = HUGE_VAL;

inline double inverse_or_zero(double x) { return x > 0 ? 1 / x : 0; }

// The first time of [entry, exit] that lies in [0, 1], or kNever.
inline double first_time(double entry, double exit, bool meets) {
  const double t = max(entry, 0.0);
  return meets && exit >= 0 && t <= 1 ? t : kNever;
}

// A point at `from` + t * `way`, relative to the feature that it may meet.
struct MovingPoint {
  Vector3d from, way;
  double inverse;  // 1 / |way|^2; 0 if the point stands still

  MovingPoint(const Vector3d& start, const Vector3d& motion)
      : from(start), way(motion), inverse(inverse_or_zero(dot(motion, motion))) {}

  MovingPoint seen_from(const Vector3d& place) const {
    MovingPoint result = *this;
    result.from = from - place;
    return result;
  }
};

// The times between which the point is within reach of zero. They are infinite if it stands still.
struct Crossing {
  double entry, exit;
  bool meets;

  Crossing(const MovingPoint& point, double reach) {
    const double nearest = -dot(point.from, point.way) * point.inverse;
    const Vector3d across = point.from + point.way * nearest;
    const double under = reach * reach - dot(across, across);
    const double half = point.inverse > 0 ? std::sqrt(max(under, 0.0) * point.inverse) : kNever;
    entry = nearest - half;
    exit = nearest + half;
    meets = under >= 0;
  }
};

inline double meets_ball(const MovingPoint& point, double reach) {
  const Crossing crossing(point, reach);
  return first_time(crossing.entry, crossing.exit, crossing.meets);
}

// An edge from zero: only the cylinder around it, without the balls at its ends.
inline double meets_edge(const MovingPoint& point, const Vector3d& edge, double reach) {
  const double inverse = inverse_or_zero(dot(edge, edge));
  const double start = dot(point.from, edge) * inverse, rate = dot(point.way, edge) * inverse;
  const Crossing crossing({point.from - edge * start, point.way - edge * rate}, reach);
  const double t = first_time(crossing.entry, crossing.exit, crossing.meets);
  const double along = start + rate * max(crossing.entry, 0.0);
  return along >= -kSeam && along <= 1 + kSeam ? t : kNever;
}

// A face with a corner at zero.
struct Face {
  Vector3d u, v;    // its sides
  Vector3d normal;  // not a unit vector
  double squared;   // |normal|^2
  double sides;     // |u|^2 |v|^2
  bool is_thin;
  bool is_slanted;  // not thin, but its normal is too rounded

  Face(const Vector3d& side_u, const Vector3d& side_v)
      : u(side_u), v(side_v), normal(cross(side_u, side_v)), squared(dot(normal, normal)) {
    sides = dot(u, u) * dot(v, v);
    is_thin = !(squared > (kThinFace * kThinFace) * sides);
    is_slanted = !is_thin && squared < (kSlantedFace * kSlantedFace) * sides;
  }

  // A thin face is not tested; its edges are grown by this width instead.
  double width() const {
    return is_thin ? std::sqrt(squared * inverse_or_zero(max(dot(u, u), dot(v, v)))) : 0.0;
  }
};

enum class FaceKind { parallelogram, triangle };

// `slack`: the error of all lengths.
inline double meets_face(const MovingPoint& point, const Face& face, FaceKind kind, double reach,
                         double slack) {
  const double height = dot(face.normal, point.from), rate = dot(face.normal, point.way);
  const double limit = reach * std::sqrt(face.squared) + kFaceSlack * slack * std::sqrt(face.sides);
  const bool stands = rate == 0;
  const double inverse = stands ? 0 : 1 / rate;
  const double middle = -(height * inverse), half = limit * std::fabs(inverse);
  const bool meets = !face.is_thin && (!stands || std::fabs(height) <= limit);
  const double t = first_time(middle - half, middle + half, meets);
  const Vector3d at = point.from + point.way * max(middle - half, 0.0);
  const double area = inverse_or_zero(face.squared);
  const double along_u = dot(cross(at, face.v), face.normal) * area;
  const double along_v = dot(cross(face.u, at), face.normal) * area;
  const double most = kind == FaceKind::triangle ? along_u + along_v : max(along_u, along_v);
  return along_u >= -kSeam && along_v >= -kSeam && most <= 1 + kSeam ? t : kNever;
}

}  // namespace carom::scalar
