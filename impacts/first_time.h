// The first time of impact of two moving simple shapes of any kinds: by a closed form where there
// is one, by advancement otherwise.
#pragma once

#include <variant>

#include "geometries/part.h"
#include "impacts/advancement.h"
#include "impacts/linear/linear.h"
#include "narrowphase/scalar/scaled.h"

namespace carom::scalar {

// A body, or a part of one, at t = 0.
struct MovingShape {
  const Shape& shape;
  Quaternion<double> q;
  Vector3d arm;       // from the pivot to the shape's position
  Vector3d rotation;  // over the interval
};

// Whether the orientation of a kind matters.
inline bool turns(ShapeKind kind) { return kind != ShapeKind::sphere && kind != ShapeKind::aabb; }

inline bool moves_in_a_line(const MovingShape& moving) {
  return moving.rotation.isZero(0) || (!turns(kind_of(moving.shape)) && moving.arm.isZero(0));
}

// The shapes as the closed forms take them: an aabb becomes a box about its middle. linear_time()
// rules out thick triangles and rounded boxes.
struct NotLinear {};
inline SphereShape<double> linear_shape(const Sphere& s) { return shape_as<double>(s); }
inline CapsuleShape<double> linear_shape(const Capsule& c) { return shape_as<double>(c); }
inline BoxShape<double> linear_shape(const carom::Box& b) { return shape_as<double>(b); }
inline TriangleShape<double> linear_shape(const Triangle& t) { return shape_as<double>(t); }
inline HalfspaceShape<double> linear_shape(const Halfspace& h) { return shape_as<double>(h); }
inline BoxShape<double> linear_shape(const Aabb& box) {
  return {(box.upper.cast<double>() - box.lower.cast<double>()) * 0.5};
}
template <class Other>
NotLinear linear_shape(const Other&) {
  return {};
}

inline bool has_linear_form(const Shape& shape) {
  const auto* triangle = std::get_if<Triangle>(&shape);
  return !(triangle && triangle->thickness > 0) && !is_rounded(kind_of(shape));
}

// From the body's position to the middle of the linear shape.
inline Vector3d linear_offset(const Shape& shape) {
  const auto* box = std::get_if<Aabb>(&shape);
  if (!box) return Vector3d::Zero();
  return (box->lower.cast<double>() + box->upper.cast<double>()) * 0.5;
}

// The orientation; the identity for kinds whose orientation does not matter.
inline Quaternion<double> linear_turn(const MovingShape& moving) {
  return turns(kind_of(moving.shape)) ? moving.q : Quaternion<double>{Vector3d::Zero(), 1};
}

// The greatest coordinate of a linear shape; for a half-space its offset.
inline double linear_size(const Shape& shape) {
  return std::visit(
      [](const auto& s) -> double {
        const auto linear = linear_shape(s);
        if constexpr (std::is_same_v<decltype(linear), const NotLinear>) {
          return 0;
        } else {
          return linear.size();
        }
      },
      shape);
}

template <class A, class B>
concept HasLinearTime = requires(A a, B b, LinearPose pose) {
  linear_time(a, b, pose);
};

// The time of impact by a closed form, or kNoClosedForm.
inline double linear_time(const MovingShape& a, const MovingShape& b, const Vector3d& from,
                          const Vector3d& way) {
  if (!moves_in_a_line(a) || !moves_in_a_line(b) || !has_linear_form(a.shape) ||
      !has_linear_form(b.shape)) {
    return kNoClosedForm;
  }
  const Vector3d between = (from + linear_offset(b.shape)) - linear_offset(a.shape);
  const double lengths = (largest_component(between) + largest_component(way)) +
                         (linear_size(a.shape) + linear_size(b.shape));
  const LinearPose pose{between, way, linear_turn(a), linear_turn(b), kSweepSlack * lengths};
  const LinearPose flipped_pose{-between, -way, pose.b, pose.a, pose.slack};
  return std::visit(
      [&](const auto& shape_a, const auto& shape_b) -> double {
        const auto x = linear_shape(shape_a);
        const auto y = linear_shape(shape_b);
        if constexpr (HasLinearTime<decltype(x), decltype(y)>) {
          return linear_time(x, y, pose);
        } else if constexpr (HasLinearTime<decltype(y), decltype(x)>) {
          return linear_time(y, x, flipped_pose);
        } else {
          return kNoClosedForm;
        }
      },
      a.shape, b.shape);
}

// --- All other pairs, in units in which the greatest coordinate is between one and two ---

inline double size_of_shape(const Shape& shape) {
  return std::visit([](const auto& s) { return shape_as<double>(s).size(); }, shape);
}

// Makes the core of a body relative to its own position. Half-spaces and composites have none.
inline void make_core(const MovingShape& moving, double scale, Core& core) {
  std::visit(
      [&](const auto& s) {
        using Scaled = decltype(shape_as<double>(s));
        if constexpr (!std::is_same_v<Scaled, HalfspaceShape<double>> &&
                      !std::is_same_v<Scaled, CompositeShape<double>>) {
          make_core(shape_as<double>(s).scaled(scale), moving.q, Vector3d::Zero(), core);
        }
      },
      moving.shape);
}

// The arm, which is of no matter for a body that does not rotate.
inline Vector3d arm_in_time(const MovingShape& moving) {
  return moving.rotation.isZero(0) ? Vector3d(Vector3d::Zero()) : moving.arm;
}

inline const MovingCore& moving_core(const MovingShape& moving, double scale, KeptCore& kept) {
  if (kept.scale == scale) return kept.moving;
  make_core(moving, scale, kept.core);
  kept.moving = moving_core(kept.core, arm_in_time(moving) * scale, moving.rotation,
                            turns(kind_of(moving.shape)));
  kept.scale = scale;
  return kept.moving;
}

// Shapes that are this close count as touching, in these units. It exceeds the touching distance of
// GJK and the rounding of the arithmetic.
inline double meeting_distance(const MovingPair& pair) {
  const double lengths = largest_component(pair.from) + largest_component(pair.way) +
                         (pair.a.reach + pair.b.reach) + pair.radii;
  return 0x1p-38 + 4 * kSweepSlack * lengths;
}

// The scale at which the greatest of these is between one and two.
inline double scale_down(double size, const Vector3d& from, const Vector3d& way) {
  if (!(size > 0)) size = max(largest_component(from), largest_component(way));
  return scale_of(size).down;
}

inline double size_with_arm(const MovingShape& moving) {
  return max(size_of_shape(moving.shape), largest_component(arm_in_time(moving)));
}

inline MovingPair pair_of(const MovingShape& a, const MovingShape& b, const Vector3d& from,
                          const Vector3d& way, double scale) {
  MovingPair pair;
  pair.from = (from + (arm_in_time(a) - arm_in_time(b))) * scale;
  pair.way = way * scale;
  return pair;
}

// A is a half-space.
inline AdvancementResult time_over_halfspace(const MovingShape& a, const MovingShape& b,
                                             const Vector3d& from, const Vector3d& way,
                                             FurthestPoint furthest, CoreScratch& scratch) {
  scratch.clear();
  const double scale = scale_down(size_with_arm(b), from, way);
  MovingPair pair = pair_of(a, b, from, way, scale);
  pair.furthest = furthest;
  const HalfspaceShape<double> half = shape_as<double>(std::get<Halfspace>(a.shape));
  const Vector3d normal = rotate(rotation_of(a.q), half.normal);
  Core& plane = scratch.placed_a;
  make_core_of_points(std::array{Vector3d(normal * (half.offset * scale))}, Vector3d::Zero(),
                      plane);
  pair.a = turning_plane(plane, a.rotation);
  pair.b = moving_core(b, scale, scratch.b);
  pair.radii = scratch.b.core.radius;
  return time_over_plane(pair, normal, meeting_distance(pair));
}

// A time after `latest` may be never. `scratch` may hold cores of these two bodies.
inline AdvancementResult advancement_time(const MovingShape& a, const MovingShape& b,
                                          const Vector3d& from, const Vector3d& way,
                                          FurthestPoint furthest, double latest,
                                          CoreScratch& scratch) {
  if (kind_of(a.shape) == ShapeKind::halfspace) {
    return time_over_halfspace(a, b, from, way, furthest, scratch);
  }
  if (kind_of(b.shape) == ShapeKind::halfspace) {
    return time_over_halfspace(b, a, -from, -way, furthest, scratch);
  }
  const double scale = scale_down(max(size_with_arm(a), size_with_arm(b)), from, way);
  MovingPair pair = pair_of(a, b, from, way, scale);
  pair.furthest = furthest;
  pair.latest = latest;
  pair.a = moving_core(a, scale, scratch.a);
  pair.b = moving_core(b, scale, scratch.b);
  pair.radii = scratch.a.core.radius + scratch.b.core.radius;
  return time_of_cores(pair, meeting_distance(pair), scratch);
}

// --- One-sided triangles ---

inline bool is_one_sided(const Shape& shape) {
  const auto* triangle = std::get_if<Triangle>(&shape);
  return triangle && triangle->one_sided;
}

// The middle of a shape in world axes, relative to its position.
inline Vector3d middle_of(const MovingShape& moving, double scale) {
  if (const auto* triangle = std::get_if<Triangle>(&moving.shape)) {
    return polytope_of(shape_as<double>(*triangle).scaled(scale), moving.q).middle;
  }
  Core& core = core_scratch_of_thread().placed_a;
  make_core(moving, scale, core);
  return eigen_vector(core.middle);
}

// How B moves past A at the time of impact.
struct Passage {
  Vector3d from;            // from the position of A to that of B, at that time
  Vector3d way;             // of B seen from A, over the interval
  Vector3d turn_a, turn_b;  // rotations over the interval
  double slack;             // of places, at least
  bool has_begun;           // whether the time is later than the start

  Passage flipped() const { return {-from, -way, turn_b, turn_a, slack, has_begun}; }
};

// Whether B comes from behind the triangle A. Both are given at the time of impact. The middle of B
// lies behind the plane then. If it lies in the plane, as that of a point does, its way decides.
inline bool passes_from_behind(const MovingShape& a, const MovingShape& b, const Passage& passage) {
  if (!is_one_sided(a.shape)) return false;
  const auto triangle = shape_as<double>(std::get<Triangle>(a.shape));
  if (const auto* plane = std::get_if<Halfspace>(&b.shape)) {
    const Vector3d n = rotate(rotation_of(b.q), shape_as<double>(*plane).normal);
    const double scale = scale_of(triangle.size()).down;
    return dot(polytope_of(triangle.scaled(scale), a.q).rules.front, n) > kInPlane;
  }
  const double scale = scale_of(max(triangle.size(), size_of_shape(b.shape))).down;
  const FrontRules rules = polytope_of(triangle.scaled(scale), a.q).rules;
  const Vector3d in_b = middle_of(b, scale), middle = in_b + passage.from * scale;
  if (comes_from_behind(rules, middle)) return true;

  const double height = dot(rules.front, Vector3d(middle - rules.corner)) + rules.thickness;
  if (!passage.has_begun || height > kInPlane + passage.slack * scale) return false;
  // The middle of B moves like this seen from the triangle; both turn about their pivots.
  const Vector3d arm_b = b.arm * scale + in_b, arm_a = a.arm * scale + middle;
  const Vector3d velocity =
      (passage.way * scale + cross(passage.turn_b, arm_b)) - cross(passage.turn_a, arm_a);
  return dot(rules.front, velocity) > kInPlane * largest_component(velocity);
}

// The shape at time t, relative to its pivot, with its orientation rounded as that of its contact
// is. Otherwise a triangle could be met by a body that its contact says is behind it.
inline MovingShape at_time(const MovingShape& moving, double t) {
  if (moving.rotation.isZero(0)) return moving;
  const Quaternion<double> turn = turn_by(moving.rotation, t);
  const auto row_of = [](const Quaternion<double>& q) -> Row {
    return {static_cast<float>(q.v.x()), static_cast<float>(q.v.y()), static_cast<float>(q.v.z()),
            static_cast<float>(q.w)};
  };
  const Row q = carom::product(row_of(turn), row_of(moving.q));
  return {moving.shape,
          {Vector3d(q[0], q[1], q[2]), q[3]},
          rotate(rotation_of(turn), moving.arm),
          Vector3d::Zero()};
}

inline bool passes_one_sided(const MovingShape& a, const MovingShape& b, const Vector3d& from,
                             const Vector3d& way, double t) {
  if (!is_one_sided(a.shape) && !is_one_sided(b.shape)) return false;
  const MovingShape then_a = at_time(a, t), then_b = at_time(b, t);
  const double lengths = (largest_component(from) + largest_component(way)) +
                         (largest_component(a.arm) + largest_component(b.arm));
  const Passage passage = {
      (from + way * t) + ((then_b.arm - b.arm) - (then_a.arm - a.arm)),
      way,
      a.rotation,
      b.rotation,
      kSweepSlack * lengths,
      t > 0,
  };
  return passes_from_behind(then_a, then_b, passage) ||
         passes_from_behind(then_b, then_a, passage.flipped());
}

}  // namespace carom::scalar
