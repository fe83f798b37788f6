// Boxes that stand for hulls: they are as near as stated, and no nearer.
#include "ladders/box_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "carom/hulls/build_hull.h"
#include "carom/ladders/build_ladder.h"
#include "tests/support/composites.h"
#include "tests/support/hulls.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using ladders::BoxModel;
using oracle::Random;

// Corners in the frame in which two shapes are compared.
using Corners = std::vector<Vector3d>;

Corners placed_corners(const Points& points, const Vector3f& position, const Orientation& turn) {
  const Eigen::Quaterniond exact = turn.cast<double>().normalized();
  Corners corners;
  for (const Vector3f& p : points) {
    corners.push_back(position.cast<double>() + exact * p.cast<double>());
  }
  return corners;
}

Corners corners_of(const CompoundChild& child) {
  const Box* box = std::get_if<Box>(&child.shape);
  const Points points = box ? box_corners(box->half) : points_of(std::get<Hull>(child.shape));
  return placed_corners(points, child.position, child.orientation);
}

// The Hausdorff distance of two convex solids is the greatest difference of how far they reach in a
// direction. Many directions give nearly all of it, and never more.
double sampled_reach(const Corners& a, const Corners& b) {
  const auto reach = [](const Corners& corners, const Vector3d& n) {
    double most = -HUGE_VAL;
    for (const Vector3d& p : corners) most = std::max(most, n.dot(p));
    return most;
  };
  Random random(5);
  double most = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d n = random.direction();
    most = std::max(most, std::fabs(reach(a, n) - reach(b, n)));
  }
  return most;
}

// The stated error is not less than the distance, and more by what is allowed for rounding alone.
void check_box(const CompoundChild& hull, const BoxModel& model) {
  const double sampled = sampled_reach(corners_of(hull), corners_of(model.box));
  const double size = double{std::get<Hull>(hull.shape).geometry->size()};
  EXPECT_GE(model.error, sampled);
  EXPECT_LE(model.error, 1.1 * sampled + 1e-5 * size);
}

Hull hull_from(const Points& points) { return {build_hull(points)->geometry}; }

// Checks the box about the origin of a hull, and gives its error.
double error_of_body(const Points& points) {
  const Hull hull = hull_from(points);
  const std::optional<BoxModel> model = ladders::box_of_body(*hull.geometry);
  if (!model) return HUGE_VAL;
  EXPECT_TRUE(model->box.position.isZero(0));
  EXPECT_EQ(model->box.orientation.coeffs(), Orientation::Identity().coeffs());
  check_box({.shape = hull}, *model);
  return model->error;
}

double error_of_child(const Points& points) {
  const Hull hull = hull_from(points);
  const std::optional<BoxModel> model = ladders::box_of_child(*hull.geometry);
  if (!model) return HUGE_VAL;
  check_box({.shape = hull}, *model);
  return model->error;
}

Orientation random_turn(Random& random) {
  return Eigen::AngleAxisf(static_cast<float>(random.uniform(-3, 3)),
                           random.direction().cast<float>()) *
         Eigen::Quaternionf::Identity();
}

Points turned(const Points& points, const Vector3f& position, const Orientation& turn) {
  Points result;
  for (const Vector3d& p : placed_corners(points, position, turn)) {
    result.push_back(p.cast<float>());
  }
  return result;
}

// A point on a box with round edges.
Vector3f on_rounded_box(const Vector3f& half, Random& random) {
  const Vector3f n = random.direction().cast<float>();
  return half.cwiseProduct(n / std::pow(n.array().pow(8).sum(), 0.125f));
}

// The box whose faces lie as far inside those of the hull as its corners lie outside.
TEST(BoxModel, OfBevelledBoxesLiesInTheMiddleOfTheBevel) {
  for (const float bevel : {0.001f, 0.02f, 0.1f}) {
    for (const Vector3f& half : {Vector3f(1, 1, 1), Vector3f(0.3f, 1, 2)}) {
      for (const float scale : {1e-6f, 1e-3f, 1.0f, 1e6f}) {
        const double unit = double{bevel} * double{scale};
        const double error = error_of_body(scaled(bevelled_corners(half, bevel), scale));
        EXPECT_NEAR(error, 2 / (3 + std::sqrt(3.0)) * unit, 1e-3 * unit + 1e-5 * double{scale});
      }
    }
  }
}

TEST(BoxModel, OfExactBoxesIsTheBox) {
  for (const float scale : {1e-6f, 1.0f, 1e6f}) {
    const Vector3f half = Vector3f(0.25f, 1, 3) * scale;
    const Hull hull = hull_from(box_corners(half));
    for (const auto& model :
         {ladders::box_of_body(*hull.geometry), ladders::box_of_child(*hull.geometry)}) {
      ASSERT_TRUE(model);
      EXPECT_LE(model->error, 2e-5 * double{scale});
      EXPECT_GT(model->error, 0);
      Vector3f sorted = std::get<Box>(model->box.shape).half;
      std::sort(sorted.data(), sorted.data() + 3);  // a child may be turned by right angles
      EXPECT_LE((sorted - half).norm(), 1e-5f * scale);
    }
  }
}

// Round edges, corners that are off, and both seen from anywhere.
TEST(BoxModel, IsNearWhateverIsNearlyABox) {
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    const Vector3f half(1, static_cast<float>(random.uniform(0.3, 2)), 0.7f);
    Points round, off = box_corners(half);
    for (int i = 0; i < 400; ++i) round.push_back(on_rounded_box(half, random));
    for (Vector3f& p : off) p += 0.01f * random.direction().cast<float>();
    const double error_of_round = error_of_body(round), error_of_off = error_of_body(off);
    EXPECT_LE(error_of_round, 0.2);
    EXPECT_LE(error_of_off, 0.015);
    const Vector3f position = 3 * random.direction().cast<float>();
    const Orientation turn = random_turn(random);
    EXPECT_LE(error_of_child(turned(round, position, turn)), 1.2 * error_of_round);
    EXPECT_LE(error_of_child(turned(off, position, turn)), 1.3 * error_of_off);
    EXPECT_GE(error_of_body(turned(round, position, turn)), 1);
  }
}

// Those of bodies lie about the origin along the axes. What a hull does not, counts.
TEST(BoxModel, OfBodiesCountsTheOffsetAndTheTurn) {
  const Points cube = cube_corners();
  for (const float offset : {0.001f, 0.01f, 0.5f}) {
    const Points moved = turned(cube, {0, offset, 0}, Orientation::Identity());
    EXPECT_NEAR(error_of_body(moved), double{offset}, 1e-5);
    EXPECT_LE(error_of_child(moved), 1e-5);
    const Orientation turn(Eigen::Quaternionf(Eigen::AngleAxisf(offset, Vector3f::UnitZ())));
    EXPECT_GE(error_of_body(turned(cube, Vector3f::Zero(), turn)), 0.4 * double{offset});
    EXPECT_LE(error_of_child(turned(cube, Vector3f::Zero(), turn)), 1e-5);
  }
}

TEST(BoxModel, IsFarFromWhatIsNoBox) {
  Random random(1);
  const auto far = [](const Points& points) {
    return std::min(error_of_body(points), error_of_child(points)) > 0.2;
  };
  EXPECT_TRUE(far(round_points(300, Vector3f::Ones(), random)));
  EXPECT_TRUE(far(pyramid(1)));
  const Points tetrahedron = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  EXPECT_TRUE(far(tetrahedron));
  EXPECT_TRUE(far(scaled(tetrahedron, 3e38f)));  // along its faces its extents are no floats
}

TEST(BoxModel, IsNotForHullsWithoutVolume) {
  const Points square = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  for (const Points& flat : {square, {{0, 0, 0}, {1, 0, 0}}, {{1, 2, 3}}}) {
    const Hull hull = hull_from(flat);
    EXPECT_FALSE(ladders::box_of_body(*hull.geometry));
    EXPECT_FALSE(ladders::box_of_child(*hull.geometry));
  }
  // A little volume is enough, however large the rest is.
  for (const float thickness : {1e-5f, 1e-30f}) {
    EXPECT_LE(error_of_body(box_corners({1, 1, thickness})), 1e-5);
    EXPECT_LE(error_of_child(box_corners({1, 1, thickness})), 1e-5);
  }
}

TEST(BoxModel, HasTheSameBitsEachTime) {
  Random random(2);
  Points points;
  for (int i = 0; i < 100; ++i) points.push_back(on_rounded_box({1, 2, 3}, random));
  const auto bits = [&] {
    const BoxModel model = *ladders::box_of_child(*hull_from(points).geometry);
    const Vector3f half = std::get<Box>(model.box.shape).half;
    std::vector<double> numbers = {model.error};
    for (int i = 0; i < 3; ++i) numbers.insert(numbers.end(), {half[i], model.box.position[i]});
    for (int i = 0; i < 4; ++i) numbers.push_back(model.box.orientation.coeffs()[i]);
    return numbers;
  };
  EXPECT_EQ(bits(), bits());
}

TEST(BoxModel, OfPlacedHullsCountsTheRoundingOfThePlace) {
  Random random(3);
  for (const float distance : {0.0f, 1.0f, 1e5f}) {
    for (int i = 0; i < 4; ++i) {
      CompoundChild child;
      child.shape = hull_from(turned(bevelled_corners({0.01f, 0.02f, 0.03f}, 0.001f),
                                     {0.01f, 0, 0.02f}, random_turn(random)));
      child.position = distance * random.direction().cast<float>();
      child.orientation.coeffs() = 3 * random_turn(random).coeffs();  // need not be a unit one
      const BoxModel own = *ladders::box_of_child(*std::get<Hull>(child.shape).geometry);
      const BoxModel model = ladders::placed(own, child);
      EXPECT_GE(model.error, sampled_reach(corners_of(child), corners_of(model.box)));
      EXPECT_LE(model.error, own.error + 1e-8 + 1e-7 * double{distance});
    }
  }
}

TEST(BoxModel, IsARungOfLadders) {
  const Hull hull = hull_from(bevelled_corners({1, 0.5f, 0.7f}, 0.1f));
  const auto laddered = build_ladder(hull, std::vector{1e-4, 0.05, 0.06});
  const LadderReport& report = laddered->report;
  EXPECT_FALSE(report.entries[0].is_box);
  for (size_t i = 1; i < 3; ++i) {
    EXPECT_TRUE(report.entries[i].is_box);
    EXPECT_FALSE(report.entries[i].is_capsule);
    EXPECT_EQ(report.entries[i].pieces, 1u);
  }
  const std::vector<Rung>& rungs = ladder_of(laddered->shape)->rungs;
  ASSERT_EQ(rungs.size(), 1u);
  EXPECT_EQ(rungs[0].error, ladders::box_of_body(*hull.geometry)->error);
  EXPECT_TRUE(std::holds_alternative<Box>(rungs[0].shape));
}

TEST(BoxModel, StandsForChildrenOfCompounds) {
  Random random(4);
  const Hull hull = hull_from(
      turned(bevelled_corners({1, 0.5f, 0.7f}, 0.1f), {0.2f, 0.3f, 0}, random_turn(random)));
  std::vector<CompoundChild> children(3);
  for (CompoundChild& child : children) {
    child.shape = hull;
    child.position = 2 * random.direction().cast<float>();
    child.orientation = random_turn(random);
  }
  children[1].position *= 1e6f;  // float32 cannot place a box there
  children[2].shape = Sphere{1};
  const LadderedShape laddered = *build_ladder(compound_of(children), std::vector{0.05});
  ASSERT_TRUE(ladder_of(laddered.shape));
  const Rung& rung = ladder_of(laddered.shape)->rungs.front();
  EXPECT_FALSE(laddered.report.entries[0].is_box);
  EXPECT_EQ(laddered.report.entries[0].pieces, 1u + 24u + 1u);
  const auto models = std::get<Compound>(rung.shape).geometry->children();
  EXPECT_TRUE(std::holds_alternative<Box>(models[0].shape));
  EXPECT_EQ(std::get<Hull>(models[1].shape).geometry, hull.geometry);
  const double sampled = sampled_reach(corners_of(children[0]), corners_of(models[0]));
  EXPECT_GE(rung.error, sampled);
  EXPECT_LE(rung.error, 1.1 * sampled + 1e-5);
}

}  // namespace
}  // namespace carom::test
