// Rotation about a constant axis, with the same bits wherever it is computed: from additions,
// multiplications, divisions and square roots alone.
#pragma once

#include <cmath>

#include "narrowphase/vector_ref.h"

namespace carom::reference {

using Eigen::Vector3d;

struct SinCos {
  double sin, cos;
};

// Within 2^-48 for angles up to some thousand turns; further out within 2^-53 of the angle.
inline SinCos sin_cos(double angle) {
  constexpr double kTurn = 6.283185307179586;
  constexpr int kDoublings = 4;
  const double x = std::remainder(angle, kTurn) / (1 << kDoublings);  // |x| < 0.2
  const double square = x * x;
  // Taylor's series; the last terms are below 2^-56.
  double sin = 0, cos = 0;
  for (int k = 8; k >= 1; --k) {
    sin = -square * (1 + sin) / ((2 * k) * (2 * k + 1));
    cos = -square * (1 + cos) / ((2 * k - 1) * (2 * k));
  }
  sin = x * (1 + sin);
  for (int i = 0; i < kDoublings; ++i) {
    // 1 - cos is kept, not cos, which would lose the digits of small angles.
    const double twice_sin = 2 * (sin * (1 + cos));
    cos = -2 * (sin * sin);
    sin = twice_sin;
  }
  return {sin, 1 + cos};
}

// The angle of a rotation vector, which may be of any finite size.
inline double angle_of(const Vector3d& rotation) { return std::sqrt(dot(rotation, rotation)); }

// By t times a rotation vector.
inline Quaternion<double> turn_by(const Vector3d& rotation, double t) {
  const double angle = angle_of(rotation);
  if (!(angle > 0)) return {Vector3d::Zero(), 1};
  const SinCos half = sin_cos(angle * t / 2);
  return {rotation * (half.sin / angle), half.cos};
}

// First q, then p.
inline Quaternion<double> product(const Quaternion<double>& p, const Quaternion<double>& q) {
  return {(q.v * p.w + p.v * q.w) + cross(p.v, q.v), p.w * q.w - dot(p.v, q.v)};
}

}  // namespace carom::reference
