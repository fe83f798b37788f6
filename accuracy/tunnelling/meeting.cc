#include "accuracy/tunnelling/meeting.h"

#include <algorithm>
#include <cmath>

#include "oracle/convex_oracle.h"

namespace carom::accuracy {
namespace {

using Eigen::Vector3d;
using Vec = oracle::Vec3<double>;

// The rounding of doubles, as a share of the sum of all lengths involved.
constexpr double kRounding = 1e-14;
// The width of the bracket of the first time: motion within it, as a share of the same sum.
constexpr double kFine = 1e-13;
constexpr double kLeastInterval = 0x1p-50;
// Tolerance for a time that is a whole number of substeps.
constexpr double kSameSubstep = 1e-6;

// Ignores half-spaces, which have no size.
double graze_of(const MovingPart& a, const MovingPart& b) {
  double size = kNever;
  for (const MovingPart* part : {&a, &b}) {
    if (!part->own().is_halfspace) size = std::min(size, part->own().bounding_radius);
  }
  return kGrazeShare * size;
}

// One part against another. B starts at `from` relative to A and moves by `way` relative to A.
class PartMeeting {
 public:
  PartMeeting(const MovingPart& a, const MovingPart& b, const Vector3d& from, const Vector3d& way)
      : a_(a), b_(b), from_(from), way_(way), solid_a_(a.own()), solid_b_(b.own()) {
    turned_ = a.turned_way() + b.turned_way();
    travel_ = way.norm() + turned_;
    const double extent = from.norm() + travel_ + a.own().bounding_radius + b.own().bounding_radius;
    rounding_ = kRounding * extent;
    fine_ = kFine * extent;
    graze_ = std::max(graze_of(a, b), 16 * fine_);
    found_.travel = travel_;
  }

  MeetingTime find(int substeps) {
    substeps_ = substeps;
    const bool touch = find_first();
    if (touch && passes_from_behind(found_.by)) return {};
    if (touch && gets_deep()) {
      found_.meeting = Meeting::certain;
    } else if (found_.least <= graze_) {
      found_.meeting = Meeting::grazing;
    }
    return found_;
  }

  size_t poses() const { return poses_; }

 private:
  // The gap at time t. `closing` bounds how fast the gap may shrink after t, and `opening` how fast
  // it may have grown before t. (The gap along the normal at t is a lower bound; translation
  // changes it by the velocity along the normal, and rotation at most by the paths of the points.)
  struct Look {
    double t;
    double gap;
    double closing;
    double opening;
  };

  Look look(double t) {
    ++poses_;
    place(t);
    const auto separation = oracle::separation_with_normal(solid_a_, solid_b_);
    found_.least = std::min(found_.least, separation.value);
    const double along = dot(separation.normal, oracle::vec3_as<double>(way_));
    return {t, separation.value, std::max(-along, 0.0) + turned_, std::max(along, 0.0) + turned_};
  }

  void place(double t) {
    a_.turn_to(t, solid_a_);
    b_.turn_to(t, solid_b_);
    solid_b_.translate(oracle::vec3_as<double>(Vector3d(from_ + way_ * t)));
  }

  // A lower bound of all separations between the two times.
  static double least_between(const Look& from, const Look& to) {
    const double closing = from.closing, opening = to.opening;
    if (!(closing + opening > 0)) return std::max(from.gap, to.gap);
    const double way = closing * opening * (to.t - from.t);
    return (from.gap * opening + to.gap * closing - way) / (closing + opening);
  }

  // Looks at the first substep after `now` at which the gap may have fallen to `goal`.
  Look next(const Look& now, double goal) {
    const double substep = now.closing / substeps_;
    const double all = substeps_;
    const double begun = std::floor(now.t * all + kSameSubstep);
    const double ahead = (now.gap - goal) / substep;  // infinite if nothing moves
    const double safe = std::isfinite(ahead) ? std::clamp(std::floor(ahead), 1.0, all) : all;
    return look(std::min(begun + safe, all) / all);
  }

  bool find_first() {
    Look now = look(0);
    if (now.gap < -rounding_) {
      found_.until = found_.by = 0;
      return true;
    }
    while (now.t < 1) {
      const Look then = next(now, graze_);
      if (find_first_between(now, then)) return true;
      now = then;
    }
    return false;
  }

  bool find_first_between(const Look& from, const Look& to) {
    // Once a graze was seen, only an overlap is new.
    const double goal = found_.least <= graze_ ? -rounding_ : graze_;
    if (least_between(from, to) > goal) return false;
    const bool is_over = to.gap < -rounding_;
    const double reach = travel_ * (to.t - from.t);
    if (!is_over && reach <= graze_ / 8) return false;
    if (is_over && (reach <= fine_ || to.t - from.t <= kLeastInterval)) {
      found_.until = from.t;
      found_.by = to.t;
      return true;
    }
    const Look middle = look((from.t + to.t) / 2);
    return find_first_between(from, middle) || find_first_between(middle, to);
  }

  // Whether the parts overlap by more than a graze at any time from the first overlap on.
  bool gets_deep() {
    Look now = look(found_.by);
    while (now.gap >= -graze_ && now.t < 1) {
      const Look then = next(now, -graze_);
      if (gets_deep_between(now, then)) return true;
      now = then;
    }
    return now.gap < -graze_;
  }

  bool gets_deep_between(const Look& from, const Look& to) {
    if (to.gap < -graze_) return true;
    if (least_between(from, to) > -graze_) return false;
    if (travel_ * (to.t - from.t) <= graze_ / 8) return false;
    const Look middle = look((from.t + to.t) / 2);
    return gets_deep_between(from, middle) || gets_deep_between(middle, to);
  }

  bool passes_from_behind(double t) {
    place(t);
    const Vec apart = oracle::vec3_as<double>(Vector3d(from_ + way_ * t));
    return lies_behind(a_, solid_a_, b_.middle_at(t) + apart, solid_b_) ||
           lies_behind(b_, solid_b_, a_.middle_at(t), solid_a_);
  }

  static bool lies_behind(const MovingPart& part, const Solid& triangle, const Vec& middle,
                          const Solid& other) {
    if (!part.is_one_sided()) return false;
    const auto& corners = triangle.points;
    const Vec front = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
    if (other.is_halfspace) return dot(front, other.normal) > 0;
    return dot(front, middle - corners[0]) < -part.thickness();
  }

  const MovingPart& a_;
  const MovingPart& b_;
  Vector3d from_;
  Vector3d way_;
  Solid solid_a_, solid_b_;  // at the time of the last look(), relative to the position of A then
  double turned_;            // bound of how far points move by rotation
  double travel_;            // bound of the relative movement of points
  double graze_;
  double rounding_;
  double fine_;
  int substeps_ = 1;
  size_t poses_ = 0;
  MeetingTime found_;
};

bool boxes_meet(const MovingPart& a, const MovingPart& b, const Vector3d& from) {
  // Leaves room for rounding and for grazes.
  const Vector3d gap = (b.lower() + from - a.upper()).cwiseMax(a.lower() - from - b.upper());
  const double room = 2 * graze_of(a, b) + kFine * from.norm();
  return !(gap.maxCoeff() > room);
}

}  // namespace

MeetingTime MeetingSearch::operator()(const MovingBody& a, std::span<const MovingPart> parts_a,
                                      const MovingBody& b, std::span<const MovingPart> parts_b) {
  const Vector3d from = b.desc.position - a.desc.position;
  const Vector3d way = b.sweep.displacement.cast<double>() - a.sweep.displacement.cast<double>();
  MeetingTime first;
  for (const MovingPart& part_a : parts_a) {
    for (const MovingPart& part_b : parts_b) {
      if (!boxes_meet(part_a, part_b, from)) continue;
      PartMeeting meeting(part_a, part_b, from, way);
      const MeetingTime found = meeting.find(substeps_);
      poses_ += meeting.poses();
      if (found.meeting == Meeting::none) continue;
      first.meeting = std::max(first.meeting, found.meeting);
      first.until = std::min(first.until, found.until);
      first.by = std::min(first.by, found.by);
      first.least = std::min(first.least, found.least);
      first.travel = std::max(first.travel, found.travel);
    }
  }
  return first;
}

}  // namespace carom::accuracy
