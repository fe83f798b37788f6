// The gap of two ellipsoids, scalar form, in the frame of A.
//
// Along a unit vector n it is n . t - |D n| - |M n|: D holds the semi-axes of A, the rows of M
// those of B, and t leads from the middle of A to that of B. The separation is the greatest gap of
// all directions. Newton's method on the sphere finds it from some directions: a few steps from
// each of the best that lie apart, and more from the best of these. At a saddle both curvatures are
// lowered first, so that the step leads upwards.
//
// Every direction that is tried gives a gap that does part the shapes. A pair is sure if two points
// face each other along the best one: then no direction has a greater gap, if the shapes are apart.
// That the greatest of several maxima is found is not proven of shapes that overlap;
// docs/accuracy.md has figures.
#pragma once

#include <array>

#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/features/start_directions_scalar.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

struct EllipsoidContact {
  float separation;
  Vector3<float> normal;  // unit, from A to B
  Vector3<float> on_a;    // relative to the middle of A
  bool is_sure;
};

// The searches miss too many best directions of ellipsoids that are nearly discs or segments: where
// the shortest axis is a smaller share of the longest, nothing is sure.
inline constexpr float kLeastWidth = 0x1p-5f;

inline bool has_width(const Vector3<float>& semi_axes) {
  const float least = min(min(semi_axes.x(), semi_axes.y()), semi_axes.z());
  const float most = max(max(semi_axes.x(), semi_axes.y()), semi_axes.z());
  return least >= kLeastWidth * most;
}

// Two directions across n, which is a unit vector.
struct TangentPlane {
  Vector3<float> one, two;

  // Source: T. Duff and others, Building an Orthonormal Basis, Revisited, JCGT 6 (1), 2017.
  explicit TangentPlane(const Vector3<float>& n) {
    const float sign = std::copysign(1.0f, n.z());
    const float a = -1 / (sign + n.z());
    const float b = (n.x() * n.y()) * a;
    one = {1 + sign * ((n.x() * n.x()) * a), sign * b, -(sign * n.x())};
    two = {b, sign + (n.y() * n.y()) * a, -n.y()};
  }
};

class EllipsoidPair {
 public:
  EllipsoidPair(const Vector3<float>& semi_axes_a, const std::array<Vector3<float>, 3>& rows_b,
                const Vector3<float>& t)
      : a_(semi_axes_a), b_(rows_b), t_(t) {}

  EllipsoidContact find() const {
    Starts starts(*this);
    Vector3<float> best(0, 0, 1);
    float most = -kLargest;
    for (size_t i = 0; i < kEllipsoidStarts; ++i) {
      Vector3<float> n = starts.take_best(kEllipsoidsApart);
      for (size_t k = 0; k < kEllipsoidFirstSteps; ++k) step(n);
      const float wide = gap(n);
      if (!(wide > most)) continue;
      most = wide;
      best = n;
    }
    bool has_ended = false;
    for (size_t k = 0; k < kEllipsoidLastSteps; ++k) has_ended = step(best);
    const Reach reach(*this, best);
    const float separation = dot(best, t_) - (reach.height_a + reach.height_b);
    const Vector3<float> aside = ((t_ - reach.on_a) - reach.on_b) - best * separation;
    const bool is_facing = dot(aside, aside) <= kBesideCore * kBesideCore;
    return {separation, best, reach.on_a, has_ended && is_facing};
  }

 private:
  Vector3<float> on_rows(const Vector3<float>& n) const {
    return {dot(b_[0], n), dot(b_[1], n), dot(b_[2], n)};
  }
  Vector3<float> on_axes(const Vector3<float>& n) const {
    return {a_.x() * n.x(), a_.y() * n.y(), a_.z() * n.z()};
  }
  float gap(const Vector3<float>& n) const {
    const Vector3<float> of_a = on_axes(n), of_b = on_rows(n);
    return dot(n, t_) - (std::sqrt(dot(of_a, of_a)) + std::sqrt(dot(of_b, of_b)));
  }

  // How far both reach along n, and their furthest points; that of B against n, from its middle,
  // with the sign changed.
  struct Reach {
    float height_a, height_b;
    float over_a, over_b;
    Vector3<float> on_a, on_b;

    Reach(const EllipsoidPair& pair, const Vector3<float>& n) {
      const Vector3<float> of_a = pair.on_axes(n), of_b = pair.on_rows(n);
      height_a = std::sqrt(dot(of_a, of_a));
      height_b = std::sqrt(dot(of_b, of_b));
      over_a = 1 / max(height_a, kLeastRim);
      over_b = 1 / max(height_b, kLeastRim);
      on_a = pair.on_axes(of_a) * over_a;
      on_b = ((pair.b_[0] * of_b.x() + pair.b_[1] * of_b.y()) + pair.b_[2] * of_b.z()) * over_b;
    }
  };

  // Between the middles, along the axes of both, and across one axis of each.
  class Starts : public StartDirections<16> {
   public:
    explicit Starts(const EllipsoidPair& pair) : pair_(pair) {
      add(pair.t_);
      for (const Vector3<float>& row : pair.b_) add(row);
      add({1, 0, 0});
      add({0, 1, 0});
      add({0, 0, 1});
      for (const Vector3<float>& row : pair.b_) {
        add({0, -row.z(), row.y()});
        add({row.z(), 0, -row.x()});
        add({-row.y(), row.x(), 0});
      }
    }

   private:
    // Towards B, or away from A.
    void add(const Vector3<float>& way) {
      StartDirections::add(way, dot(way, pair_.t_), true,
                           [this](const Vector3<float>& n) { return pair_.gap(n); });
    }

    const EllipsoidPair& pair_;
  };

  // A step of Newton's method in the plane across n. Returns whether it was short, and at a peak.
  bool step(Vector3<float>& n) const {
    const Reach reach(*this, n);
    const TangentPlane plane(n);
    const Vector3<float> way = (t_ - reach.on_a) - reach.on_b;
    const float height = dot(way, n), slope_one = dot(way, plane.one),
                slope_two = dot(way, plane.two);
    const Vector3<float> a_one = on_axes(plane.one), a_two = on_axes(plane.two);
    const Vector3<float> b_one = on_rows(plane.one), b_two = on_rows(plane.two);
    const float on_a_one = dot(reach.on_a, plane.one), on_a_two = dot(reach.on_a, plane.two);
    const float on_b_one = dot(reach.on_b, plane.one), on_b_two = dot(reach.on_b, plane.two);
    const float bend_one = (dot(a_one, a_one) - on_a_one * on_a_one) * reach.over_a +
                           (dot(b_one, b_one) - on_b_one * on_b_one) * reach.over_b;
    const float bend_both = (dot(a_one, a_two) - on_a_one * on_a_two) * reach.over_a +
                            (dot(b_one, b_two) - on_b_one * on_b_two) * reach.over_b;
    const float bend_two = (dot(a_two, a_two) - on_a_two * on_a_two) * reach.over_a +
                           (dot(b_two, b_two) - on_b_two * on_b_two) * reach.over_b;
    const float one = -bend_one - height, two = -bend_two - height, both = -bend_both;
    const float half = (one - two) * 0.5f, mean = (one + two) * 0.5f;
    const float spread = std::sqrt(half * half + both * both);
    const float greater = mean + spread;
    const float lower = greater < 0 ? 0.0f : (greater + kSaddleShare * spread) + kSaddle;
    const float one_one = one - lower, two_two = two - lower;
    const float over = 1 / (one_one * two_two - both * both);
    const float by_one = (both * slope_two - two_two * slope_one) * over;
    const float by_two = (both * slope_one - one_one * slope_two) * over;
    const float length = std::sqrt(by_one * by_one + by_two * by_two);
    const float share = length > kLongTurn ? kLongTurn / length : 1.0f;
    const Vector3<float> next = n + (plane.one * (by_one * share) + plane.two * (by_two * share));
    n = next * (1 / std::sqrt(dot(next, next)));
    return length <= kLastArc && greater < 0;
  }

  Vector3<float> a_;
  std::array<Vector3<float>, 3> b_;
  Vector3<float> t_;
};

}  // namespace carom::scalar
