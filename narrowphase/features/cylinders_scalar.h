// The gap of two cylinders, or of a segment and a cylinder, scalar form.
//
// The gap along a unit vector n is n . t - half_a |n . u| - rim_a |n x u| - half_b |n . v| - rim_b
// |n x v|, for axes u and v and a vector t from the middle of A to that of B. The separation is the
// greatest gap of all directions. As for boxes (S. Gottschalk, M. C. Lin, D. Manocha, OBBTree,
// SIGGRAPH 1996), it lies where two features face each other, and every pair of features has its
// own direction:
// - a cap: along its axis;
// - two sides: across both axes;
// - a side and a rim: the best direction of the circle across the axis, by Newton's method from the
//   best of some samples. The other quarters of the circle mirror that of t; it may have two
//   maxima, so that each of its halves has a search;
// - two rims: the best in the cone of t and both axes (a projection onto it makes no product
//   smaller), by Newton's method on the sphere. It starts from sums of the axes and the way between
//   two caps, from the ways of either rim to the other shape's furthest point and, of axes that are
//   nearly parallel, from where the rims cross: a few steps from each of the best that lie apart,
//   and more from the best of these. At a saddle both curvatures are lowered first, so that the
//   step leads upwards.
//
// Every direction that is tried gives a gap that does part the shapes. A pair is sure if two points
// face each other along the best one: then no direction has a greater gap, if the shapes are apart.
// That the greatest of several maxima is found is not proven of shapes that overlap;
// docs/accuracy.md has figures.
#pragma once

#include <array>

#include "narrowphase/features/axial_core_scalar.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/features/segment_scalar.h"
#include "narrowphase/features/start_directions_scalar.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

struct CylinderContact {
  float separation;
  Vector3<float> normal;  // unit, from A to B
  Vector3<float> on_a;    // relative to the middle of A
  bool is_sure;
};

// Two cylinders in the frame of their axes: x along A's, z across both, and t.z >= 0. That may be
// a mirror image.
class CylinderPair {
 public:
  CylinderPair(const AxialCore& a, const AxialCore& b, const Vector3<float>& t)
      : half_a_(a.half_length), rim_a_(a.rim), half_b_(b.half_length), rim_b_(b.rim), x_(a.axis) {
    const float along = dot(a.axis, b.axis);
    const Vector3<float> b_axis = along < 0 ? Vector3<float>(-b.axis) : b.axis;
    const Vector3<float> across = cross(a.axis, b_axis);
    cosine_ = std::fabs(along);
    sine_ = std::sqrt(dot(across, across));
    const Vector3<float> up = across_axes(a.axis, across, t);
    y_ = cross(up, a.axis);
    const float height = dot(up, t);
    z_ = height < 0 ? Vector3<float>(-up) : up;
    t_ = {dot(a.axis, t), dot(y_, t), std::fabs(height)};
  }

  // A search that has not ended counts a little less, so that it does not win by rounding.
  struct Found {
    float gap = -kLargest;
    Vector3<float> n{0, 0, 1};
    bool is_flat_a = false, is_flat_b = false;  // more than one point of it faces the other one
    bool has_ended = false;                     // of a search

    void keep_if_wider(const Found& next) {
      if (next.rank() > rank()) *this = next;
    }
    float rank() const { return gap - (has_ended ? 0.0f : kNotEnded); }
  };

  float sine() const { return sine_; }
  Vector3<float> in_world(const Vector3<float>& n) const {
    return (x_ * n.x() + y_ * n.y()) + z_ * n.z();
  }
  // Where the axes cross, seen along z: on A, from its middle.
  float crossing() const { return t_.x() - cosine_ * (t_.y() / sine_); }

  Found find() const {
    Found best;
    try_caps(best);
    best.keep_if_wider({t_.z() - (rim_a_ + rim_b_), {0, 0, 1}, true, true, true});
    try_sides(best);
    try_rims(best);
    return best;
  }

 private:
  // A unit vector across both axes: of parallel ones towards t. What rounding leaves along A's axis
  // is taken away.
  Vector3<float> across_axes(const Vector3<float>& axis, const Vector3<float>& across,
                             const Vector3<float>& t) const {
    Vector3<float> way = across * (1 / sine_);
    if (!(sine_ >= kParallelAxes)) {
      const Vector3<float> aside = part_across(t, axis, dot(t, axis));
      const float squared = dot(aside, aside);
      way = squared > kLeastWay ? Vector3<float>(aside * (1 / std::sqrt(squared)))
                                : any_perpendicular(axis);
    }
    way -= axis * dot(axis, way);
    return way * (1 / std::sqrt(dot(way, way)));
  }

  float gap(const Vector3<float>& n) const {
    const float along_b = cosine_ * n.x() + sine_ * n.y();
    const float across_b = cosine_ * n.y() - sine_ * n.x();
    const float square = n.z() * n.z();
    const float reach_a = half_a_ * std::fabs(n.x()) + rim_a_ * std::sqrt(n.y() * n.y() + square);
    const float reach_b =
        half_b_ * std::fabs(along_b) + rim_b_ * std::sqrt(across_b * across_b + square);
    return dot(n, t_) - (reach_a + reach_b);
  }

  void try_caps(Found& best) const {
    const float sign_a = std::copysign(1.0f, t_.x());
    const Vector3<float> cap_a(sign_a, 0, 0);
    best.keep_if_wider({gap(cap_a), cap_a, true, false, true});
    const float sign_b = std::copysign(1.0f, cosine_ * t_.x() + sine_ * t_.y());
    const Vector3<float> cap_b(sign_b * cosine_, sign_b * sine_, 0);
    best.keep_if_wider({gap(cap_b), cap_b, false, true, true});
  }

  // A direction c along, s across.
  struct Arc {
    float c, s;
    bool has_ended;
  };

  // The best direction of a quarter for (a, b) and an ellipse of half axes rim * cosine and rim,
  // from the best of some samples.
  Arc best_of_arc(float a, float b, float rim, size_t first, size_t last) const {
    const float flat = cosine_ * cosine_, rise = rim * (sine_ * sine_);
    Arc arc{1, 0, false};
    float most = -kLargest;
    for (size_t i = first; i < last; ++i) {
      const float c = kArcCosines[i], s = kArcCosines[kArcSamples - 1 - i];
      const float gap = (a * c + b * s) - rim * std::sqrt(s * s + flat * (c * c));
      if (!(gap > most)) continue;
      most = gap;
      arc.c = c;
      arc.s = s;
    }
    for (size_t i = 0; i < kArcSteps; ++i) {
      const float c = arc.c, s = arc.s;
      const float over_w = 1 / max(std::sqrt(s * s + flat * (c * c)), kLeastRim);
      const float sc = s * c, bend = rise * over_w;
      const float slope = (b * c - a * s) - bend * sc;
      const float tilt = sc * (sine_ * over_w);
      const float curve = -(a * c + b * s) - bend * ((c * c - s * s) - tilt * tilt);
      const float step = curve < 0 ? -slope / curve : std::copysign(kShortArc, slope);
      const float turn = clamp(step, -kLongArc, kLongArc);
      const float c2 = max(c - turn * s, 0.0f), s2 = max(s + turn * c, 0.0f);
      const float to_unit = 1 / std::sqrt(c2 * c2 + s2 * s2);
      arc.c = c2 * to_unit;
      arc.s = s2 * to_unit;
      arc.has_ended = std::fabs(c * arc.s - s * arc.c) <= kLastArc;
    }
    return arc;
  }

  void try_sides(Found& best) const {
    const float across = cosine_ * t_.y() - sine_ * t_.x();
    const float beside_a = std::fabs(t_.y()) - half_b_ * sine_;
    const float beside_b = std::fabs(across) - half_a_ * sine_;
    for (const size_t first : {size_t{0}, kArcSamples / 2}) {
      const size_t last = first + kArcSamples / 2 + 1;
      const Arc of_a = best_of_arc(beside_a, t_.z(), rim_b_, first, last);
      const Vector3<float> n(0, std::copysign(of_a.c, t_.y()), of_a.s);
      best.keep_if_wider({gap(n), n, true, false, of_a.has_ended});
      const Arc of_b = best_of_arc(beside_b, t_.z(), rim_a_, first, last);
      const float c = std::copysign(of_b.c, across);
      const Vector3<float> m(-(sine_ * c), cosine_ * c, of_b.s);
      best.keep_if_wider({gap(m), m, false, true, of_b.has_ended});
    }
  }

  // From the middle of A's cap to that of B's.
  Vector3<float> between_caps(float sign_a, float sign_b) const {
    const float b = sign_b * half_b_;
    return {(t_.x() - sign_a * half_a_) - b * cosine_, t_.y() - b * sine_, t_.z()};
  }

  class Starts : public StartDirections<19> {
   public:
    explicit Starts(const CylinderPair& pair) : pair_(pair) {
      for (const float sign_a : {1.0f, -1.0f}) {
        for (const float sign_b : {1.0f, -1.0f}) add_between(sign_a, sign_b);
      }
      add_cap_of_a();
      add_cap_of_b();
      add_crossing_rims();
    }

   private:
    void add(const Vector3<float>& way, bool may = true) {
      StartDirections::add(way, 1, may, [this](const Vector3<float>& n) { return pair_.gap(n); });
    }

    // Sums of the vector between two caps and the axes.
    void add_between(float sign_a, float sign_b) {
      const Vector3<float> way = pair_.between_caps(sign_a, sign_b);
      const Vector3<float> q = way * (1 / std::sqrt(max(dot(way, way), kLeastWay)));
      const Vector3<float> a(sign_a, 0, 0);
      const Vector3<float> b(sign_b * pair_.cosine_, sign_b * pair_.sine_, 0);
      const Vector3<float> all = q + a + b;
      add(q);
      add(all);
      add(all + a);
      add(all + b);
    }

    // From A's rim to the point of B that is furthest along A's axis, if that lies beside the cap.
    void add_cap_of_a() {
      const float cosine = pair_.cosine_, sine = pair_.sine_;
      const Vector3<float>& t = pair_.t_;
      const float sign = std::copysign(1.0f, t.x());
      const float half = sign * pair_.half_b_, rim = sign * pair_.rim_b_;
      const Vector3<float> p((t.x() - half * cosine) - rim * sine,
                             (t.y() - half * sine) + rim * cosine, t.z());
      const float above = sign * p.x() - pair_.half_a_;
      const float from_axis = std::sqrt(p.y() * p.y() + p.z() * p.z());
      const float share = (from_axis - pair_.rim_a_) / max(from_axis, kLeastRim);
      add({sign * above, p.y() * share, p.z() * share}, min(above, share) > 0);
    }

    // The same from B's rim.
    void add_cap_of_b() {
      const float cosine = pair_.cosine_, sine = pair_.sine_;
      const Vector3<float>& t = pair_.t_;
      const float sign = std::copysign(1.0f, cosine * t.x() + sine * t.y());
      const Vector3<float> w(t.x() - sign * pair_.half_a_, t.y() - sign * pair_.rim_a_, t.z());
      const float above = sign * (cosine * w.x() + sine * w.y()) - pair_.half_b_;
      const float across = cosine * w.y() - sine * w.x();
      const float from_axis = std::sqrt(across * across + w.z() * w.z());
      const float share = (from_axis - pair_.rim_b_) / max(from_axis, kLeastRim);
      const float along = sign * above, beside = across * share;
      add({cosine * along - sine * beside, sine * along + cosine * beside, w.z() * share},
          min(above, share) > 0);
    }

    // Caps that face each other, nearly parallel: where their rims cross, seen along A's axis. The
    // gap along (sign, w) is then about c . w - rim_a |w| - rim_b |w - tilt|, for a vector c
    // between the middles of the caps, so that the crossing gives the directions of w and w - tilt.
    void add_crossing_rims() {
      const float sign = std::copysign(1.0f, pair_.t_.x());
      const float tilt = sign * pair_.sine_, rim_a = pair_.rim_a_, rim_b = pair_.rim_b_;
      const float c_y = pair_.t_.y() - pair_.half_b_ * tilt, c_z = pair_.t_.z();
      const float squared = max(c_y * c_y + c_z * c_z, kLeastWay);
      const float share = 0.5f * (1 + (rim_a - rim_b) * (rim_a + rim_b) / squared);
      const float aside = rim_a * rim_a / squared - share * share;
      const float half = std::sqrt(max(aside, kLeastWay));
      const float p_y = share * c_y + sign * (half * c_z), p_z = share * c_z - sign * (half * c_y);
      const float length = pair_.sine_ * (c_z - p_z) / (half * squared);
      const bool may = pair_.sine_ < kNearAxes && aside > 0 && p_z > 0 && p_z < c_z;
      add({sign, length * p_y, length * p_z}, may);
    }

    const CylinderPair& pair_;
  };

  // Takes a few steps from each of some starts; the best one goes on.
  void try_rims(Found& best) const {
    Starts starts(*this);
    Vector3<float> of_best(0, 0, 0);  // the q of the best
    Found rims;
    for (size_t i = 0; i < kRimStarts; ++i) {
      Vector3<float> n = starts.take_best(kRimApart);
      const float along_b = cosine_ * n.x() + sine_ * n.y();
      const Vector3<float> q =
          between_caps(std::copysign(1.0f, n.x()), std::copysign(1.0f, along_b));
      for (size_t k = 0; k < kRimFirstSteps; ++k) step(q, n);
      const float wide = gap(n);
      if (!(wide > rims.gap)) continue;
      rims.gap = wide;
      rims.n = n;
      of_best = q;
    }
    for (size_t k = 0; k < kRimLastSteps; ++k) rims.has_ended = step(of_best, rims.n);
    rims.gap = gap(rims.n);
    best.keep_if_wider(rims);
  }

  // A step of Newton's method for n . q - rim_a |n x u| - rim_b |n x v|, in the plane across n.
  // Returns whether it was short.
  bool step(const Vector3<float>& q, Vector3<float>& n) const {
    const float along_b = cosine_ * n.x() + sine_ * n.y();
    const float across_b = cosine_ * n.y() - sine_ * n.x();
    const float square = n.z() * n.z();
    const float off_a = max(std::sqrt(n.y() * n.y() + square), kLeastRim);
    const float off_b = max(std::sqrt(across_b * across_b + square), kLeastRim);
    const float over_a = 1 / off_a, over_b = 1 / off_b;
    const Vector3<float> b_axis(cosine_, sine_, 0);
    // One direction of the plane is across A's axis, too.
    const Vector3<float> first(0, -(n.z() * over_a), n.y() * over_a), second = cross(n, first);
    const Vector3<float> side = cross(b_axis, n) * over_b;
    const float c = dot(side, first), s = dot(side, second);
    const Vector3<float> out_a(0, n.y() * over_a, n.z() * over_a);
    const Vector3<float> out_b = (n - b_axis * along_b) * over_b;
    const Vector3<float> way = (q - out_a * rim_a_) - out_b * rim_b_;
    const float height = dot(way, n), slope_one = dot(way, first), slope_two = dot(way, second);
    const float bend_a = rim_a_ * over_a, bend_b = rim_b_ * over_b;
    const float one = -(bend_a + bend_b * (c * c)) - height;
    const float two = -(bend_b * (s * s)) - height, both = -(bend_b * (c * s));
    const float half = (one - two) * 0.5f, mean = (one + two) * 0.5f;
    const float spread = std::sqrt(half * half + both * both);
    const float greater = mean + spread;
    const float lower = greater < 0 ? 0.0f : (greater + kSaddleShare * spread) + kSaddle;
    const float one_one = one - lower, two_two = two - lower;
    const float over = 1 / (one_one * two_two - both * both);
    const float by_one = (both * slope_two - two_two * slope_one) * over;
    const float by_two = (both * slope_one - one_one * slope_two) * over;
    const float length = std::sqrt(by_one * by_one + by_two * by_two);
    const float most = kRimStep * min(off_a, off_b);
    const float share = length > most ? most / length : 1.0f;
    Vector3<float> next = n + (first * (by_one * share) + second * (by_two * share));
    next.z() = max(next.z(), 0.0f);
    n = next * (1 / std::sqrt(dot(next, next)));
    return length <= kLastArc;
  }

  float half_a_, rim_a_, half_b_, rim_b_;
  Vector3<float> x_, y_, z_, t_;
  float cosine_, sine_;
};

// `t`: from the middle of A to that of B.
inline CylinderContact cylinder_contact(const AxialCore& a, const AxialCore& b,
                                        const Vector3<float>& t) {
  const CylinderPair pair(a, b, t);
  const CylinderPair::Found found = pair.find();
  const Vector3<float> way = pair.in_world(found.n);
  const Vector3<float> n = way * (1 / std::sqrt(dot(way, way)));
  const Vector3<float> from_a = furthest_point(a, n), from_b = t - furthest_point(b, n);
  const float separation = dot(n, t) - (reach(a, n) + reach(b, n));
  const Spread spread_a(a, n), spread_b(b, n);
  const bool are_parallel = pair.sine() < kCrossingLines;
  Vector3<float> on_a = from_a;
  if (are_parallel && spread_a.is_disc && spread_b.is_disc) {
    on_a = between_discs(a, b, n, t);
  } else if (are_parallel && spread_a.is_line && spread_b.is_line) {
    on_a = a.axis * middle_of_both(a.half_length, dot(a.axis, t), b.half_length) + n * a.rim;
  } else if (found.is_flat_a) {
    on_a = found.is_flat_b ? Vector3<float>(a.axis * pair.crossing() + n * a.rim)
                           : Vector3<float>(from_b - n * separation);
  }
  const Vector3<float> on_b = (on_a + n * separation) - t;
  const bool is_sure = found.has_ended && holds(a, on_a) && holds(b, on_b);
  return {separation, n, on_a, is_sure};
}

}  // namespace carom::scalar
