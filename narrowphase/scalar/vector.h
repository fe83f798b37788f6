// Vectors and rotations of the scalar tests, in float and in double. In float every operation and
// its order is that of the kernels; in double the same tests decide pairs that float cannot.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "narrowphase/scalar/length.h"

namespace carom::scalar {

template <class Real>
using Vector3 = Eigen::Matrix<Real, 3, 1>;

inline double max(double a, double b) { return a > b ? a : b; }
inline double min(double a, double b) { return a < b ? a : b; }

// Sums beyond the range of float are clamped to its largest number; double holds all of them.
inline float finite(float x) { return clamp_to_finite(x); }
inline double finite(double x) { return x; }

template <class Real>
Real clamp(Real v, Real low, Real high) {
  return min(max(v, low), high);
}

inline double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

template <class Real>
Vector3<Real> cross(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}

// The least and the greatest of each coordinate; of two zeros the second, as in lanes.
template <class Real>
Vector3<Real> min(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {min(a.x(), b.x()), min(a.y(), b.y()), min(a.z(), b.z())};
}
template <class Real>
Vector3<Real> max(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {max(a.x(), b.x()), max(a.y(), b.y()), max(a.z(), b.z())};
}

template <class Real>
Real largest_component(const Vector3<Real>& v) {
  return max(max(std::fabs(v.x()), std::fabs(v.y())), std::fabs(v.z()));
}

// x, y, z, w; of any length but zero.
template <class Real>
struct Quaternion {
  Vector3<Real> v;
  Real w;
};

// Columns: the rotated axes.
template <class Real>
struct Rotation {
  Vector3<Real> x, y, z;
};

// M(q) / |q|^2. Source: K. Shoemake, Animating Rotation with Quaternion Curves, SIGGRAPH 1985.
template <class Real>  // inlined: a call would pass all columns through memory
[[gnu::always_inline]] inline Rotation<Real> rotation_of(const Quaternion<Real>& q) {
  const Real s = Real(2) / (dot(q.v, q.v) + q.w * q.w);
  const Vector3<Real> scaled = q.v * s;
  const Real xx = q.v.x() * scaled.x(), xy = q.v.x() * scaled.y(), xz = q.v.x() * scaled.z();
  const Real yy = q.v.y() * scaled.y(), yz = q.v.y() * scaled.z(), zz = q.v.z() * scaled.z();
  const Real wx = q.w * scaled.x(), wy = q.w * scaled.y(), wz = q.w * scaled.z();
  return {{1 - (yy + zz), xy + wz, xz - wy},
          {xy - wz, 1 - (xx + zz), yz + wx},
          {xz + wy, yz - wx, 1 - (xx + yy)}};
}

// conj(a) * b: rotates from the frame of b to that of a.
template <class Real>
Quaternion<Real> relative_rotation(const Quaternion<Real>& a, const Quaternion<Real>& b) {
  return {(b.v * a.w - a.v * b.w) - cross(a.v, b.v), a.w * b.w + dot(a.v, b.v)};
}

template <class Real>  // inlined: a call would pass all columns through memory
[[gnu::always_inline]] inline Vector3<Real> rotate(const Rotation<Real>& r,
                                                   const Vector3<Real>& v) {
  return (r.x * v.x() + r.y * v.y()) + r.z * v.z();
}

template <class Real>
Vector3<Real> rotate_back(const Rotation<Real>& r, const Vector3<Real>& v) {
  return {dot(r.x, v), dot(r.y, v), dot(r.z, v)};
}

// The position of B relative to A in world axes (d), and both orientations.
template <class Real>
struct PairPose {
  Vector3<Real> d;
  Quaternion<Real> a, b;
  Vector3<Real> back = -d;  // of A relative to B: -d but for the signs of zeros
};

// The same pose seen from B.
template <class Real>
PairPose<Real> flipped(const PairPose<Real>& pose) {
  return {pose.back, pose.b, pose.a, pose.d};
}

}  // namespace carom::scalar
