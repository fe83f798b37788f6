// When two moving bodies meet. It tests every pair of their parts, one at a time.
#include <limits>
#include <tuple>

#include "base/float_environment.h"
#include "base/outward.h"
#include "carom/reference/reference.h"
#include "impacts/first_time.h"
#include "narrowphase/doubles/furthest_scalar.h"
#include "reference/scalar.h"
#include "reference/simple_parts.h"

namespace carom::reference {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Impact without_contact(float toi, Status status) {
  const Vector3f nan = Vector3f::Constant(kNan);
  return {toi, status, kNan, nan, nan, nan};
}

Vector3d vector_of(const Double3& v) { return {v[0], v[1], v[2]}; }

MovingShape moving(const Simple& part, const Sweep& sweep) {
  const Row& q = part.placed.orientation;
  return {
      part.shape, {{q[0], q[1], q[2]}, q[3]}, vector_of(part.arm), sweep.rotation.cast<double>()};
}

// The position of B relative to A, clamped to a distance that no displacement covers.
Double3 seen_from(const Vector3d& a, const Vector3d& b) {
  constexpr double kFurthest = 1e40;
  Double3 from;
  for (size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    from[i] = std::clamp(b[axis] - a[axis], -kFurthest, kFurthest);
  }
  return from;
}

struct FirstTime {
  double t = kNever;
  Status status = Status::ok;
  const Simple *a = nullptr, *b = nullptr;

  auto order() const { return std::tuple(t, a ? a->order : 0, b ? b->order : 0); }
};

FirstTime time_of(const Simple& part_a, const Sweep& sweep_a, const Simple& part_b,
                  const Sweep& sweep_b) {
  const MovingShape a = moving(part_a, sweep_a), b = moving(part_b, sweep_b);
  const Vector3d from = vector_of(part_b.placed.position) - vector_of(part_a.placed.position);
  const Vector3d way = sweep_b.displacement.cast<double>() - sweep_a.displacement.cast<double>();
  FirstTime found{.t = linear_time(a, b, from, way), .a = &part_a, .b = &part_b};
  if (found.t == kNoClosedForm) {
    CoreScratch& scratch = core_scratch_of_thread();
    scratch.clear();
    const AdvancementResult advanced =
        advancement_time(a, b, from, way, &furthest_point, 1, scratch);
    found.t = advanced.t;
    found.status = advanced.status;
  }
  if (found.t <= 1 && passes_one_sided(a, b, from, way, found.t)) {
    found.t = kNever;
    found.status = Status::ok;
  }
  return found;
}

// The pose of the part at time t, and the vector from the body's position to the part's at that
// time.
struct PlacedInTime {
  Pose pose;
  Vector3d arm;
};

PlacedInTime place_at(const Simple& part, const Vector3d& pivot, const Sweep& sweep, double t) {
  const Vector3d displacement = sweep.displacement.cast<double>();
  const Vector3d moved = pivot + displacement * t;
  const Vector3d rotation = sweep.rotation.cast<double>();
  const Pose start = part.pose();
  const Vector3d arm = vector_of(part.arm);
  if (rotation.isZero(0)) return {{moved + arm, start.orientation}, arm};
  const Quaternion<double> turn = turn_by(rotation, t);
  const Vector3d arm_then = rotate(rotation_of(turn), arm);
  const Row as_row = {static_cast<float>(turn.v.x()), static_cast<float>(turn.v.y()),
                      static_cast<float>(turn.v.z()), static_cast<float>(turn.w)};
  const Row q = carom::product(as_row, part.placed.orientation);
  return {{moved + arm_then, Eigen::Quaternionf(q[3], q[0], q[1], q[2])}, arm_then};
}

}  // namespace

Impact time_of_impact(const Shape& shape_a, const Pose& pose_a, const Sweep& sweep_a,
                      const Shape& shape_b, const Pose& pose_b, const Sweep& sweep_b,
                      PositionType positions) {
  const FloatEnvironment environment;
  const bool are_finite = sweep_a.displacement.allFinite() && sweep_a.rotation.allFinite() &&
                          sweep_b.displacement.allFinite() && sweep_b.rotation.allFinite();
  if (!are_finite || !is_valid(shape_a, pose_a, positions) ||
      !is_valid(shape_b, pose_b, positions)) {
    return without_contact(kNan, Status::invalid);
  }
  const auto stored = [&](const Vector3d& p) -> Vector3d {
    return positions == PositionType::float32 ? Vector3d(p.cast<float>().cast<double>()) : p;
  };
  const Vector3d at_a = stored(pose_a.position), at_b = stored(pose_b.position);
  const auto parts_a = parts_of(shape_a, {}, pose_a.orientation);
  const auto parts_b = parts_of(shape_b, seen_from(at_a, at_b), pose_b.orientation);
  FirstTime first;
  for (const Simple& a : parts_a) {
    for (const Simple& b : parts_b) {
      const FirstTime found = time_of(a, sweep_a, b, sweep_b);
      if (!first.a || found.order() < first.order()) first = found;
    }
  }
  if (!(first.t <= 1)) return without_contact(static_cast<float>(first.t), first.status);

  const Vector3d pivot_a = Vector3d::Zero(), pivot_b = vector_of(seen_from(at_a, at_b));
  const PlacedInTime a = place_at(*first.a, pivot_a, sweep_a, first.t);
  const PlacedInTime b = place_at(*first.b, pivot_b, sweep_b, first.t);
  const PairResult contact =
      collide(first.a->shape, a.pose, first.b->shape, b.pose, PositionType::float64);
  return {round_downwards(first.t),
          first.status,
          contact.separation,
          contact.normal,
          (contact.arm_a.cast<double>() + a.arm).cast<float>(),
          (contact.arm_b.cast<double>() + b.arm).cast<float>(),
          first.a->sub,
          first.b->sub};
}

}  // namespace carom::reference
