// The small types that all stages share.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "carom/base/result.h"
#include "carom/results/contact.h"
#include "carom/results/event.h"
#include "carom/results/pair.h"
#include "carom/shapes/body.h"
#include "carom/shapes/shape.h"
#include "shapes/body_reader.h"
#include "tests/support/layouts.h"

namespace carom::test {
namespace {

TEST(ShapeKind, HasANameForEveryCode) {
  const char* const names[] = {"sphere",       "capsule",  "aabb",        "box",
                               "dop",          "hull",     "mesh",        "compound",
                               "halfspace",    "cylinder", "cone",        "ellipsoid",
                               "height_field", "triangle", "rounded_box", "rounded_hull"};
  for (int code = 0; code < kShapeKindCount; ++code) {
    EXPECT_STREQ(carom::name(static_cast<ShapeKind>(code)), names[code]);
  }
  for (int code = kShapeKindCount; code < 256; ++code) {
    EXPECT_STREQ(carom::name(static_cast<ShapeKind>(code)), "unknown");
  }
}

TEST(Aabb, FromHalfExtentsIsCentred) {
  const Aabb box = Aabb::from_half_extents({1, 2, 3});
  EXPECT_EQ(box.lower, Eigen::Vector3f(-1, -2, -3));
  EXPECT_EQ(box.upper, Eigen::Vector3f(1, 2, 3));
}

TEST(Pair, OrdersLikeItsKey) {
  const Pair pairs[] = {{0, 0}, {0, 1}, {0, 0xffffffffu}, {1, 0}, {0xffffffffu, 2}};
  for (const Pair& x : pairs) {
    for (const Pair& y : pairs) EXPECT_EQ(x < y, pair_key(x) < pair_key(y));
  }
}

TEST(BodyId, OfNobodyEqualsNoOther) {
  EXPECT_NE(BodyId{}, (BodyId{0, 0}));
  EXPECT_NE((BodyId{1, 0}), (BodyId{1, 1}));
  EXPECT_LT((BodyId{1, 9}), (BodyId{2, 0}));
}

TEST(Result, HoldsAValueOrAReason) {
  Result<std::string> value(std::string("yes"));
  ASSERT_TRUE(value);
  EXPECT_EQ(*value, "yes");
  EXPECT_EQ(value->size(), 3u);
  const Result<std::string> none(Error{"no"});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "no");
  EXPECT_TRUE(Result<void>());
  EXPECT_EQ(Result<void>(Error{"no"}).error().message, "no");
}

// The reader's validity rule equals that of the reference, in every layout.
TEST(BodyReader, ReadsWhatWasWritten) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<PlacedShape> bodies = {sphere(1, 2, 3, 4),         sphere(nan, 0, 0, 1),
                                           sphere(0, 0, 0, -1),        box({1, 2, 3}, {4, 5, 6}),
                                           box({0, 0, 0}, {1, -1, 1}), sphere(1e38, 0, 0, 0)};
  for (const PositionType positions : kPositionTypes) {
    for (const bool slots : {false, true}) {
      const LaidOut set(bodies, {.positions = positions, .stride = 40, .box_slots = slots});
      const BodyReader reader{set.view()};
      for (size_t i = 0; i < bodies.size(); ++i) {
        EXPECT_EQ(reader.kind(i), kind_of(bodies[i].shape));
        EXPECT_EQ(reader.is_valid(i),
                  reference::is_valid(bodies[i].shape, bodies[i].pose(), positions));
      }
      EXPECT_EQ(reader.position<double>(0).z, 3);
      EXPECT_EQ(reader.radius(0), 4);
      EXPECT_EQ(reader.lower(1, 3), -5);
      EXPECT_EQ(reader.upper(2, 3), 6);
    }
  }
}

std::vector<PlacedShape> bodies_with_rows() {
  const Eigen::Quaternionf turned(1, 2, 3, 4);
  const std::array<Eigen::Vector3f, 3> corners = {
      Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(4, 5, 6), Eigen::Vector3f(7, 8, 10)};
  PlacedShape prism = triangle({1, 2, 3}, corners);
  std::get<Triangle>(prism.shape) = {corners, 0.5f, true, 5};
  return {oriented_box({1, 2, 3}, {4, 5, 6}, turned), capsule({1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 10),
          prism, halfspace({1, 2, 3}, {4, 5, 6}, 7), sphere(1, 2, 3, 4)};
}

TEST(BodyReader, ReadsRowsAndOrientations) {
  std::vector<PlacedShape> bodies = bodies_with_rows();
  const size_t valid = bodies.size();
  bodies.push_back(oriented_box({0, 0, 0}, {1, -1, 1}));
  bodies.push_back(oriented_box({0, 0, 0}, {1, 1, 1}, Eigen::Quaternionf(0, 0, 0, 0)));
  bodies.push_back(capsule({0, 0, 0}, {0, 0, 0}, {1, 1, 1}, -1));
  bodies.push_back(halfspace({0, 0, 0}, {0, 0, 0}, 1));
  for (const RowOrder order : {RowOrder::dense, RowOrder::backwards, RowOrder::shared}) {
    const LaidOut set(bodies, {.orientation_stride = 28, .rows = order});
    const BodyReader reader{set.view()};
    for (size_t i = 0; i < bodies.size(); ++i) {
      EXPECT_EQ(reader.rows(i), shape_rows(bodies[i].shape));
      EXPECT_EQ(reader.is_valid(i), i < valid);
      EXPECT_EQ(reader.is_valid(i),
                reference::is_valid(bodies[i].shape, bodies[i].pose(), PositionType::float32));
    }
    EXPECT_EQ(reader.orientation(0), (std::array<float, 4>{2, 3, 4, 1}));
  }
}

TEST(ShapeRows, HoldAllOfAShape) {
  for (const PlacedShape& body : bodies_with_rows()) {
    if (!has_rows(body.shape)) continue;
    const ShapeKind kind = kind_of(body.shape);
    const auto rows = shape_rows(body.shape);
    const Shape again = shape_from_rows(kind, rows.data());
    EXPECT_EQ(kind_of(again), kind);
    EXPECT_EQ(shape_rows(again), rows);
  }
}

}  // namespace
}  // namespace carom::test
