// Rotation about a constant axis. It uses additions, multiplications, divisions and square roots
// only, so every machine computes the same bits.
#pragma once

#include <cmath>

#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

using Eigen::Vector3d;

struct SinCos {
  double sin, cos;
};

// The ratio of a term of Taylor's series to the previous one, without the square of the angle.
inline constexpr double kSinRatio[] = {-1.0 / (2 * 3),   -1.0 / (4 * 5),   -1.0 / (6 * 7),
                                       -1.0 / (8 * 9),   -1.0 / (10 * 11), -1.0 / (12 * 13),
                                       -1.0 / (14 * 15), -1.0 / (16 * 17)};
inline constexpr double kCosRatio[] = {-1.0 / (1 * 2),   -1.0 / (3 * 4),  -1.0 / (5 * 6),
                                       -1.0 / (7 * 8),   -1.0 / (9 * 10), -1.0 / (11 * 12),
                                       -1.0 / (13 * 14), -1.0 / (15 * 16)};

// Errs by less than 2^-48 for angles up to some thousand turns, beyond that by 2^-53 of the angle.
inline SinCos sin_cos(double angle) {
  constexpr double kTurn = 6.283185307179586;
  constexpr int kDoublings = 4;
  const bool is_within_turn = std::abs(angle) <= kTurn;  // std::remainder is slow
  const double x = (is_within_turn ? angle : std::remainder(angle, kTurn)) / (1 << kDoublings);
  // Taylor's series for |x| < 0.4; the omitted terms are below 2^-56 of the result. Without
  // divisions it takes 23 ns instead of 82, and a turning pair calls it forty times.
  const double square = x * x;
  double sin = 0, cos = 0;
  for (int k = 7; k >= 0; --k) {
    sin = (1 + sin) * (square * kSinRatio[k]);
    cos = (1 + cos) * (square * kCosRatio[k]);
  }
  sin = x * (1 + sin);
  for (int i = 0; i < kDoublings; ++i) {
    // Keeps cos - 1 instead of cos, which would lose the digits of small angles.
    const double twice_sin = 2 * (sin * (1 + cos));
    cos = -2 * (sin * sin);
    sin = twice_sin;
  }
  return {sin, 1 + cos};
}

// The angle of a rotation vector, which may be of any finite size.
inline double angle_of(const Vector3d& rotation) { return std::sqrt(dot(rotation, rotation)); }

// The rotation by t times a rotation vector.
inline Quaternion<double> turn_by(const Vector3d& rotation, double t) {
  const double angle = angle_of(rotation);
  if (!(angle > 0)) return {Vector3d::Zero(), 1};
  const SinCos half = sin_cos(angle * t / 2);
  return {rotation * (half.sin / angle), half.cos};
}

// Rotates by q first, then by p.
inline Quaternion<double> product(const Quaternion<double>& p, const Quaternion<double>& q) {
  return {(q.v * p.w + p.v * q.w) + cross(p.v, q.v), p.w * q.w - dot(p.v, q.v)};
}

}  // namespace carom::scalar
