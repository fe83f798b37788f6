// Vectors of any real type, for the oracle.
#pragma once

#include <cmath>

namespace carom::oracle {

template <class R>
struct Vec3 {
  R x{0}, y{0}, z{0};

  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(const Vec3& a, const R& s) { return {a.x * s, a.y * s, a.z * s}; }
};

template <class R, class Vector>
Vec3<R> vec3_as(const Vector& v) {
  return {R(v[0]), R(v[1]), R(v[2])};
}

template <class R>
R dot(const Vec3<R>& a, const Vec3<R>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class R>
Vec3<R> cross(const Vec3<R>& a, const Vec3<R>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class R>
R length(const Vec3<R>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

// A zero vector stays zero.
template <class R>
Vec3<R> normalized(const Vec3<R>& a) {
  const R size = length(a);
  return size > 0 ? a * (1 / size) : Vec3<R>{};
}

// The component of `a` perpendicular to the unit vector u.
template <class R>
Vec3<R> across(const Vec3<R>& a, const Vec3<R>& u) {
  return a - u * dot(a, u);
}

// The unit vector perpendicular to two unit vectors; zero if they are parallel. Even for nearly
// parallel vectors the result is perpendicular to u up to rounding. The error is then a rotation
// about u, where v has next to no extent.
template <class R>
Vec3<R> common_normal(const Vec3<R>& u, const Vec3<R>& v) {
  return normalized(across(normalized(across(normalized(cross(u, v)), u)), u));
}

}  // namespace carom::oracle
