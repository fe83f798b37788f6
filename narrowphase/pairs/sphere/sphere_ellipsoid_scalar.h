// Sphere (A) against ellipsoid (B): the nearest point of the surface to the centre, in its frame.
//
// Source: D. Eberly, Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid,
// Geometric Tools, 2013: the nearest point is x_i = a_i^2 y_i / (t + a_i^2) for the greatest root t
// of sum (a_i y_i / (t + a_i^2))^2 = 1. The unknown here is s = t + the least a_i^2, which no
// subtraction touches. The step is Newton's for the inverse root of the sum, which is nearly a line
// (J. J. More, D. C. Sorensen, Computing a Trust Region Step, 1983).
//
// The separation is the gap along the normal found, which an error of that normal changes by its
// square only.
#pragma once

#include "narrowphase/features/profile_scalar.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// The steps start where the largest term of the sum is one.
struct EllipsoidSearch {
  Vector3<float> beyond;  // the squares of the semi-axes less the least of them
  float s;
  bool is_found = false;

  EllipsoidSearch(const Vector3<float>& semi_axes, const Vector3<float>& y) {
    const float least = min(min(semi_axes.x(), semi_axes.y()), semi_axes.z());
    Vector3<float> reached;
    for (int i = 0; i < 3; ++i) {
      reached[i] = semi_axes[i] * y[i];
      beyond[i] = (semi_axes[i] - least) * (semi_axes[i] + least);
    }
    const Vector3<float> start = reached - beyond;
    s = max(max(max(start.x(), start.y()), start.z()), kLeastShift);
    if (!(s > kLeastShift)) return;
    for (size_t i = 0; i < kMostEllipsoidSteps && !is_found; ++i) step(reached);
  }

 private:
  void step(const Vector3<float>& reached) {
    Vector3<float> share, squares;
    for (int i = 0; i < 3; ++i) {
      share[i] = 1 / (s + beyond[i]);
      const float q = reached[i] * share[i];
      squares[i] = q * q;
    }
    const float sum = (squares.x() + squares.y()) + squares.z();
    const float rate = dot(squares, share);
    s = max(s + sum * (std::sqrt(sum) - 1) / rate, kLeastShift);
    is_found = std::fabs(sum - 1) <= kNearSurface;
  }
};

inline bool is_at_thin_rim(const Vector3<float>& semi_axes, const EllipsoidSearch& search,
                           const Vector3<float>& gradient) {
  float of_rim = 0, most = 0;
  for (int i = 0; i < 3; ++i) {
    const float q = semi_axes[i] * gradient[i];
    of_rim += search.beyond[i] > search.s ? q * q : 0.0f;
    most = max(most, search.beyond[i]);
  }
  return search.s < kThinRim * most && of_rim > kMostOfSum;
}

inline WayOut way_out_of_ellipsoid(const Vector3<float>& semi_axes, const Vector3<float>& point) {
  const Vector3<float> y = point.cwiseAbs();
  const EllipsoidSearch search(semi_axes, y);
  Vector3<float> gradient, h;
  for (int i = 0; i < 3; ++i) gradient[i] = y[i] / (search.s + search.beyond[i]);
  const Vector3<float> n = gradient * (1 / std::sqrt(dot(gradient, gradient)));
  for (int i = 0; i < 3; ++i) h[i] = semi_axes[i] * n[i];
  const float gap = dot(n, y) - std::sqrt(dot(h, h));
  const Vector3<float> out(std::copysign(n.x(), point.x()), std::copysign(n.y(), point.y()),
                           std::copysign(n.z(), point.z()));
  return {gap, out, !search.is_found || is_at_thin_rim(semi_axes, search, gradient)};
}

inline Separation separation(const SphereShape<float>& sphere,
                             const EllipsoidShape<float>& ellipsoid, const PairPose<float>& pose) {
  const Rotation<float> turn = rotation_of(pose.b);
  const Vector3<float> centre = rotate_back<float>(turn, -pose.d);
  return ball_separation(centre, sphere.radius, ellipsoid.rounding, turn,
                         way_out_of_ellipsoid(ellipsoid.semi_axes, centre));
}

}  // namespace carom::scalar
