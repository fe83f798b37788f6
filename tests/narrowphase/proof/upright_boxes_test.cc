// Decisions about boxes along the world axes, against those in exact numbers.
#include "narrowphase/proof/upright_boxes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "narrowphase/proof/exact_overlap.h"
#include "oracle/random.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Quaternion = Eigen::Quaternionf;

// A body in columns of its own. It must not move.
struct StoredBody {
  std::array<double, 4> position;
  std::array<float, 4> orientation, row;
  std::array<float, 3> lower, upper;
  Collidables view;

  StoredBody(ShapeKind kind, const Eigen::Vector3d& at, const Eigen::Vector3f& half,
             const Quaternion& q = Quaternion::Identity())
      : position{at.x(), at.y(), at.z(), 0},
        orientation{q.x(), q.y(), q.z(), q.w()},
        row{half.x(), half.y(), half.z(), 0},
        lower{-half.x(), -half.y(), -half.z()},
        upper{half.x(), half.y(), half.z()} {
    view.count = 1;
    view.uniform_kind = kind;
    view.position.data = position.data();
    view.position.stride = sizeof position;
    view.position.type = PositionType::float64;
    view.orientation = {orientation.data(), sizeof orientation};
    view.rows.data = row.data();
    for (size_t axis = 0; axis < 3; ++axis) {
      view.boxes.lower[axis] = &lower[axis];
      view.boxes.upper[axis] = &upper[axis];
    }
  }
  StoredBody(const StoredBody&) = delete;
  StoredBody& operator=(const StoredBody&) = delete;

  std::optional<UprightBox> upright() const {
    UprightBox box;
    if (!read_upright_box(BodyReader{view}, 0, box)) return std::nullopt;
    return box;
  }
  StatedBody stated() const { return carom::stated_body(BodyReader{view}, 0); }
};

// All orientations whose components are zero or equal but for signs.
std::vector<Quaternion> even_orientations(float size) {
  std::vector<Quaternion> all;
  for (int k = 0; k < 81; ++k) {
    const auto digit = [k](int place) { return static_cast<float>(k / place % 3 - 1); };
    all.emplace_back(size * digit(1), size * digit(3), size * digit(9), size * digit(27));
  }
  return all;
}

long nonzero_count(const Quaternion& q) { return (q.coeffs().array() != 0).count(); }

std::vector<Quaternion> quarter_turns(float size) {
  std::vector<Quaternion> turns;
  for (const Quaternion& q : even_orientations(size)) {
    if (nonzero_count(q) != 0 && nonzero_count(q) != 3) turns.push_back(q);
  }
  return turns;
}

TEST(UprightBoxes, AreThoseOfQuarterTurns) {
  const Eigen::Vector3f half(1, 2, 3);
  for (const float size : {1.0f, 0.70710677f, 0x1p-100f, 3e30f}) {
    EXPECT_EQ(quarter_turns(size).size(), 48u);  // 24 rotations, each by two quaternions
    for (const Quaternion& q : even_orientations(size)) {
      const StoredBody body(ShapeKind::box, {0, 0, 0}, half, q);
      const auto box = body.upright();
      ASSERT_EQ(box.has_value(), nonzero_count(q) != 0 && nonzero_count(q) != 3);
      if (!box) continue;
      const Quaternion unit(q.w() / size, q.x() / size, q.y() / size, q.z() / size);
      const Eigen::Vector3f extent =
          unit.normalized().toRotationMatrix().array().round().abs().matrix() * half;
      for (size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(box->upper[axis], extent[static_cast<int>(axis)]) << q.coeffs().transpose();
        EXPECT_EQ(box->lower[axis], -box->upper[axis]);
      }
    }
  }
  const Quaternion hardly(1, 0x1p-20f, 0, 0), nearly(0.70710677f, 0.7071067f, 0, 0);
  EXPECT_FALSE(StoredBody(ShapeKind::box, {0, 0, 0}, half, hardly).upright());
  EXPECT_FALSE(StoredBody(ShapeKind::box, {0, 0, 0}, half, nearly).upright());
  EXPECT_FALSE(StoredBody(ShapeKind::sphere, {0, 0, 0}, half).upright());
}

TEST(UprightBoxes, AreDecidedAsInExactNumbers) {
  oracle::Random random(11);
  const std::vector<Quaternion> turns = quarter_turns(0.5f);
  size_t overlaps = 0, touching = 0, count = 0;
  for (const float unit : {1.0f, 0.1f, 0x1p-100f, 1e30f}) {
    for (const double origin : {0.0, 1.0, 1e9, 1e250}) {
      for (size_t i = 0; i < rounds(400); ++i) {
        const auto half = [&] {
          const auto one = [&] { return unit * static_cast<float>(random.below(4)); };
          return Eigen::Vector3f(one(), one(), one());
        };
        Eigen::Vector3d at_a, at_b;
        for (int axis = 0; axis < 3; ++axis) {
          const auto step = [&] { return double{unit} * static_cast<double>(random.below(4)); };
          at_a[axis] = origin * unit + step();
          at_b[axis] = at_a[axis] + step();
          if (random.chance(0.3)) {
            at_b[axis] = std::nextafter(at_b[axis], random.chance(0.5) ? HUGE_VAL : -HUGE_VAL);
          }
        }
        const ShapeKind kind = random.chance(0.3) ? ShapeKind::aabb : ShapeKind::box;
        const StoredBody a(ShapeKind::box, at_a, half(), turns[random.below(turns.size())]);
        const StoredBody b(kind, at_b, half(), turns[random.below(turns.size())]);
        const bool expected = exact_overlap(a.stated(), b.stated());
        ASSERT_EQ(do_overlap(*a.upright(), *b.upright()), expected);
        ASSERT_EQ(do_overlap(*b.upright(), *a.upright()), expected);
        const Eigen::Vector3d way = (at_b - at_a).cwiseAbs();
        for (size_t axis = 0; axis < 3; ++axis) {
          const double reach = double{a.upright()->upper[axis]} + double{b.upright()->upper[axis]};
          if (way[static_cast<int>(axis)] == reach) ++touching;
        }
        overlaps += expected;
        ++count;
      }
    }
  }
  EXPECT_GT(overlaps, count / 5);
  EXPECT_LT(overlaps, count * 4 / 5);
  EXPECT_GT(touching, count / 20);
}

// The sum of a position and a half axis rounds to where the other box begins.
TEST(UprightBoxes, SeeGapsBelowRounding) {
  const auto overlap = [](double x, float half_x) {
    const StoredBody a(ShapeKind::box, {0, 0, 0}, {1, 1, 1});
    const StoredBody b(ShapeKind::box, {x, 0, 0}, {half_x, 1, 1});
    return do_overlap(*a.upright(), *b.upright());
  };
  EXPECT_TRUE(overlap(2, 1));
  EXPECT_FALSE(overlap(std::nextafter(2.0, 3.0), 1));
  EXPECT_FALSE(overlap(2, std::nextafter(1.0f, 0.0f)));
  EXPECT_TRUE(overlap(1, 0x1p-149f));
  EXPECT_FALSE(overlap(std::nextafter(1.0, 2.0), 0x1p-149f));
}

}  // namespace
}  // namespace carom::test
