// Bounds over the interval contain every point of the bodies at every time, and are hardly larger.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cfloat>

#include "carom/bounds/bounds.h"
#include "oracle/support_pair.h"
#include "shapes/dop_polytope.h"
#include "tests/support/composites.h"
#include "tests/support/rounds.h"
#include "tests/world/crowds.h"
#include "world/motion/swept_bounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kTimes = 64;

// Points in the body's frame. Balls of `radius` about them have the same smallest world box as the
// turned shape.
struct Skeleton {
  std::vector<Vector3d> points;
  double radius = 0;
};

Skeleton skeleton_of(const Shape& shape);

Skeleton points_with(std::span<const Vector3f> points, double radius = 0) {
  Skeleton skeleton{.points = {}, .radius = radius};
  for (const Vector3f& p : points) skeleton.points.push_back(p.cast<double>());
  return skeleton;
}

Skeleton corners_with(const Vector3f& lower, const Vector3f& upper) {
  Skeleton skeleton;
  for (int i = 0; i < 8; ++i) {
    skeleton.points.emplace_back((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(),
                                 (i & 4 ? upper : lower).z());
  }
  return skeleton;
}

// The corners of the mesh's valid triangles.
Skeleton skeleton_of(const MeshGeometry& mesh) {
  std::vector<Vector3f> corners;
  for (size_t i = 0; i < mesh.triangles().size(); ++i) {
    if (mesh.is_degenerate(i)) continue;
    for (const Vector3f& corner : mesh.corners(i)) corners.push_back(corner);
  }
  return points_with(corners);
}

// Stands in for the balls of children: the corners of boxes that lie inside them.
Skeleton skeleton_of(const Compound& compound) {
  Skeleton all;
  for (const CompoundChild& child : compound.geometry->children()) {
    const Eigen::Matrix3d turn =
        std::holds_alternative<Aabb>(child.shape)
            ? Eigen::Matrix3d::Identity().eval()
            : child.orientation.cast<double>().normalized().toRotationMatrix();
    const Skeleton part = skeleton_of(child.shape);
    for (const Vector3d& p : part.points) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1, 1}) {
          all.points.push_back(child.position.cast<double>() + turn * p +
                               side * part.radius * Vector3d::Unit(axis));
        }
      }
    }
  }
  return all;
}

// Points of a round shape's surface.
Skeleton round_skeleton(const Shape& shape) {
  const oracle::SupportShape round = oracle::support_shape(shape, {});
  Random random(1);
  Skeleton skeleton;
  for (int i = 0; i < 100; ++i) {
    const auto p = round.furthest(oracle::vec3_as<long double>(random.direction()));
    skeleton.points.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y),
                                 static_cast<double>(p.z));
  }
  return skeleton;
}

Skeleton skeleton_of(const Shape& shape) {
  if (is_round(kind_of(shape))) return round_skeleton(shape);
  if (const auto* s = std::get_if<Sphere>(&shape)) return {{Vector3d::Zero()}, s->radius};
  if (const auto* s = std::get_if<Aabb>(&shape)) return corners_with(s->lower, s->upper);
  if (const auto* s = std::get_if<Capsule>(&shape)) {
    return points_with(std::array{s->a, s->b}, s->radius);
  }
  if (const auto* s = std::get_if<Box>(&shape)) return corners_with(-s->half, s->half);
  if (const auto* s = std::get_if<Triangle>(&shape)) return points_with(s->corners);
  if (const auto* s = std::get_if<Hull>(&shape)) return points_with(s->geometry->points());
  if (const auto* s = std::get_if<Mesh>(&shape)) return skeleton_of(*s->geometry);
  if (const auto* s = std::get_if<HeightField>(&shape)) {
    return corners_with(s->geometry->lower(), s->geometry->upper());
  }
  if (const auto* s = std::get_if<Compound>(&shape)) return skeleton_of(*s);
  Skeleton skeleton;
  const DopPolytope polytope(DopSlabs(std::get<Dop>(shape)));
  for (size_t i = 0; i < polytope.point_count(); ++i) {
    const Double3 p = polytope.point(i);
    skeleton.points.emplace_back(p[0], p[1], p[2]);
  }
  return skeleton;
}

struct Boxes {
  std::array<std::vector<float>, 6> columns;

  explicit Boxes(size_t count) {
    for (auto& column : columns) column.resize(count);
  }
  BoundsColumns out() {
    return {{columns[0].data(), columns[1].data(), columns[2].data()},
            {columns[3].data(), columns[4].data(), columns[5].data()}};
  }
  BoundsView view() const {
    return {{columns[0].data(), columns[1].data(), columns[2].data()},
            {columns[3].data(), columns[4].data(), columns[5].data()},
            columns[0].size()};
  }
};

// The swept bounds of a store over one second.
class Swept {
 public:
  explicit Swept(const BodyStore& bodies) : now_(bodies.rows()) {
    compute_bounds(bodies.view(), now_.out());
    sweeps_.update(bodies, 1, 0.5f, Parallelism::none);
    bounds_.update(bodies.view(), sweeps_, now_.view(), Parallelism::none);
  }

  Eigen::AlignedBox3d now(size_t i) const { return box(now_.view(), i); }
  Eigen::AlignedBox3d over(size_t i) const { return box(bounds_.view(), i); }

 private:
  static Eigen::AlignedBox3d box(const BoundsView& view, size_t i) {
    Eigen::AlignedBox3d box;
    for (int axis = 0; axis < 3; ++axis) {
      box.min()[axis] = view.lower[axis][i];
      box.max()[axis] = view.upper[axis][i];
    }
    return box;
  }

  Boxes now_;
  Sweeps sweeps_;
  SweptBounds bounds_;
};

// The smallest box that contains the body at time t, in double precision.
Eigen::AlignedBox3d box_at(double t, const BodyStore& bodies, const Shape& shape, bool turns) {
  const Vector3d rotation = bodies.angular_velocity(0).cast<double>();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (turns) {
    turn = bodies.orientation(0).cast<double>().normalized().toRotationMatrix();
    const double angle = rotation.norm();
    if (angle > 0) turn = Eigen::AngleAxisd(t * angle, rotation / angle) * turn;
  }
  const Skeleton skeleton = skeleton_of(shape);
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : skeleton.points) {
    box.extend((turn * p - Vector3d::Constant(skeleton.radius)).eval());
    box.extend((turn * p + Vector3d::Constant(skeleton.radius)).eval());
  }
  return box.translate(bodies.position(0) + t * bodies.linear_velocity(0).cast<double>());
}

double share_beyond(const Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& limits) {
  return std::max((limits.min() - box.min()).maxCoeff(), (box.max() - limits.max()).maxCoeff());
}

void expect_held(ShapeKind kind, PositionType positions, uint64_t seed) {
  SCOPED_TRACE(testing::Message() << name(kind) << ", seed " << seed);
  Composites shapes(seed);
  Random& random = shapes.random();
  const double far = seed % 3 == 0 ? 1e6 : 3;
  BodyStore bodies(positions);
  const Shape shape = shapes.shape(kind, random.log_uniform(0.01, 10));
  bodies.add({.shape = shape,
              .position = far * random.direction(),
              .orientation = shapes.orientation(),
              .linear_velocity = (random.direction() * random.log_uniform(1e-3, 100)).cast<float>(),
              .angular_velocity = (random.direction() * random.log_uniform(1e-4, 30)).cast<float>(),
              .detection = Detection::swept});
  if (seed % 5 == 0) bodies.set_linear_velocity(0, Vector3f::Zero());
  if (seed % 7 == 0) bodies.set_angular_velocity(0, Vector3f::Zero());
  const Swept swept(bodies);
  const double size = swept.now(0).sizes().maxCoeff();
  const double rounding = 1e-12 * (size + far + bodies.linear_velocity(0).norm());
  for (int k = 0; k <= kTimes; ++k) {
    const auto box = box_at(double(k) / kTimes, bodies, shape, row_count(kind) > 0);
    ASSERT_LE(share_beyond(box, swept.over(0)), rounding) << "at " << k << " of " << kTimes;
  }
}

TEST(SweptBounds, HoldEveryKindAtAllTimes) {
  for (const ShapeKind kind : kEveryKind) {
    if (kind == ShapeKind::halfspace) continue;
    for (uint64_t seed = 0; seed < rounds(60); ++seed) {
      expect_held(kind, seed % 2 ? PositionType::float64 : PositionType::float32, seed);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(SweptBounds, OfWhatDoesNotMoveAreThoseOfNow) {
  BodyStore bodies(PositionType::float64);
  bodies.add({.shape = Box{{1, 2, 3}},
              .position = {1e9 + 0.1, 0, 0},
              .orientation = {1, 2, 3, 4},
              .detection = Detection::continuous});
  const Swept swept(bodies);
  EXPECT_EQ(swept.now(0).min(), swept.over(0).min());
  EXPECT_EQ(swept.now(0).max(), swept.over(0).max());
}

// A straight motion adds nothing but rounding.
TEST(SweptBounds, OfWhatGoesStraightAreTheSmallest) {
  BodyStore bodies(PositionType::float32);
  bodies.add({.shape = Sphere{0.5f},
              .position = {1, 2, 3},
              .linear_velocity = {4, -8, 0},
              .angular_velocity = {1, 1, 1},
              .detection = Detection::swept});
  const Swept swept(bodies);
  EXPECT_EQ(swept.over(0).min(), Vector3d(0.5, -6.5, 2.5));
  EXPECT_EQ(swept.over(0).max(), Vector3d(5.5, 2.5, 3.5));
}

// A slow turn adds its angle times the radius, a fast turn needs the whole ball.
TEST(SweptBounds, OfWhatTurnsGrowWithTheAngle) {
  const auto reach = [](float angle) {
    BodyStore bodies(PositionType::float32);
    bodies.add({.shape = Box{{3, 4, 0}},
                .angular_velocity = {0, 0, angle},
                .detection = Detection::swept});
    return Swept(bodies).over(0).max();
  };
  EXPECT_NEAR((reach(0.01f) - Vector3d(3.05, 4.05, 0.05)).norm(), 0, 1e-5);
  EXPECT_NEAR((reach(9) - Vector3d(5, 5, 5)).norm(), 0, 1e-5);
}

TEST(SweptBounds, OfBodiesThatAreSetAsideAreThoseOfNow) {
  BodyStore bodies(PositionType::float32);
  bodies.add({.shape = Sphere{1}, .linear_velocity = {NAN, 1, 1}, .detection = Detection::swept});
  bodies.add({.shape = Sphere{-1}, .linear_velocity = {1, 1, 1}, .detection = Detection::swept});
  const Swept swept(bodies);
  EXPECT_EQ(swept.over(0).min(), Vector3d(-1, -1, -1));
  EXPECT_TRUE(swept.over(1).isEmpty());
}

// Beyond the range of float32 the bounds are infinite, so that no pair is lost.
TEST(SweptBounds, OfGiantsAreUnbounded) {
  BodyStore bodies(PositionType::float32);
  bodies.add({.shape = Box{{3e38f, 3e38f, 3e38f}},
              .linear_velocity = {3e38f, 0, 0},
              .angular_velocity = {0, 0, 1},
              .detection = Detection::swept});
  bodies.add(
      {.shape = Sphere{3e38f}, .linear_velocity = {3e38f, 0, 0}, .detection = Detection::swept});
  const Swept swept(bodies);
  EXPECT_EQ(swept.over(0).max().x(), INFINITY);
  EXPECT_EQ(swept.over(0).min().y(), -INFINITY);
  EXPECT_EQ(swept.over(1).max().x(), INFINITY);
  EXPECT_EQ(swept.over(1).min().x(), double{-3e38f});
}

}  // namespace
}  // namespace carom::test
