// Ladders: rungs are simpler, and no further away than stated.
#include "carom/ladders/build_ladder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "carom/hulls/build_hull.h"
#include "carom/shapes/compound_geometry.h"
#include "hulls/surface.h"
#include "tests/support/fine_meshes.h"
#include "tests/support/hulls.h"

namespace carom::test {
namespace {

double bumps(double x, double y, double z) {
  return 1 + 0.2 * std::sin(2 * x + 1) * std::cos(3 * y) * std::cos(z);
}

// In an ellipsoid that no capsule and no box is near.
Hull random_hull(size_t points, uint64_t seed) {
  oracle::Random random(seed);
  const Eigen::Vector3f half = {1, 1, 0.3f};
  Points all;
  for (size_t i = 0; i < points; ++i) {
    all.push_back(random.direction().cast<float>().cwiseProduct(half));
  }
  return {build_hull(all)->geometry};
}

const Rung& only_rung(const Shape& shape) {
  LadderPtr ladder;
  if (const auto* hull = std::get_if<Hull>(&shape)) ladder = hull->ladder;
  if (const auto* mesh = std::get_if<Mesh>(&shape)) ladder = mesh->ladder;
  if (const auto* compound = std::get_if<Compound>(&shape)) ladder = compound->ladder;
  if (!ladder || ladder->rungs.size() != 1) throw std::logic_error("not one rung");
  return ladder->rungs.front();
}

LadderedShape built(const Shape& shape, double error) {
  const auto result = build_ladder(shape, std::vector{error});
  EXPECT_TRUE(result) << result.error().message;
  return *result;
}

TEST(BuildLadder, OfMeshesHasFewerTrianglesWithinTheError) {
  const Mesh ball = ball_mesh(22, bumps);
  size_t last = ball.geometry->triangles().size();
  for (const double error : {0.02, 0.05, 0.12}) {
    const LadderedShape laddered = built(ball, error);
    const Rung& rung = only_rung(laddered.shape);
    const MeshGeometry& simpler = *std::get<Mesh>(rung.shape).geometry;
    EXPECT_LE(rung.error, error);
    EXPECT_LT(simpler.triangles().size(), 0.8 * static_cast<double>(last));
    last = simpler.triangles().size();
    EXPECT_EQ(laddered.report.pieces, ball.geometry->triangles().size());
    EXPECT_EQ(laddered.report.entries[0].pieces, last);
    EXPECT_EQ(laddered.report.entries[0].error, rung.error);
    const long double there = sampled_distance(simpler, *ball.geometry, 4);
    const long double back = sampled_distance(*ball.geometry, simpler, 1);
    EXPECT_LE(std::max(there, back), rung.error);
    EXPECT_GE(std::max(there, back), 0.7 * rung.error - 0.02 * error);
  }
}

TEST(BuildLadder, OfHullsHasFewerPointsWithinTheError) {
  for (const uint64_t seed : {1, 2, 3}) {
    const Hull hull = random_hull(200, seed);
    size_t last = hull.geometry->points().size();
    for (const double error : {0.02, 0.05, 0.12}) {
      const LadderedShape laddered = built(hull, error);
      const Rung& rung = only_rung(laddered.shape);
      const HullGeometry& simpler = *std::get<Hull>(rung.shape).geometry;
      EXPECT_LE(rung.error, error);
      EXPECT_LT(simpler.points().size(), last);
      last = simpler.points().size();
      // The furthest point of a convex set from another one is a corner.
      const auto reach = [](const HullGeometry& from, const HullGeometry& to) {
        const hulls::Surface surface(to);
        double most = 0;
        for (const Eigen::Vector3f& p : from.points()) {
          most = std::max(most, surface.distance(p.cast<double>()));
        }
        return most;
      };
      // Points that are inside are not far from the hull; their distance from its surface is more.
      EXPECT_GE(reach(*hull.geometry, simpler) + 1e-6, 0.2 * rung.error);
    }
  }
}

// How far two convex shapes reach in many directions.
void check_reach(const Hull& hull, const Capsule& capsule, double error) {
  oracle::Random random(9);
  double most = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d n = random.direction();
    double of_hull = -HUGE_VAL;
    for (const Eigen::Vector3f& p : hull.geometry->points()) {
      of_hull = std::max(of_hull, n.dot(p.cast<double>()));
    }
    const double of_capsule =
        std::max(n.dot(capsule.a.cast<double>()), n.dot(capsule.b.cast<double>())) +
        double{capsule.radius};
    most = std::max(most, std::fabs(of_hull - of_capsule));
  }
  EXPECT_LE(most, error);
  EXPECT_GE(most, 0.5 * error);
}

TEST(BuildLadder, OfRoundHullsHasACapsule) {
  for (const double stretch : {1.0, 1.5, 4.0}) {
    for (const uint64_t seed : {1, 2, 3}) {
      oracle::Random random(seed);
      const Eigen::Vector3d axis = random.direction(), at = random.direction();
      Points all;
      for (int i = 0; i < 120; ++i) {
        const Eigen::Vector3d p = random.direction();
        all.push_back((at + p + (stretch - 1) * axis.dot(p) * axis).cast<float>());
      }
      const Hull hull{build_hull(all)->geometry};
      const LadderedShape laddered = built(hull, 0.6);
      EXPECT_TRUE(laddered.report.entries[0].is_capsule);
      EXPECT_EQ(laddered.report.entries[0].pieces, 1u);
      const Rung& rung = only_rung(laddered.shape);
      const Capsule& capsule = std::get<Capsule>(rung.shape);
      check_reach(hull, capsule, rung.error);
      EXPECT_LE(rung.error, stretch < 2 ? 0.35 : 0.6);
      EXPECT_EQ((capsule.a - capsule.b).norm() > 0.2f, stretch > 1);
    }
  }
}

// A ball stands for whatever lies in it, where even that is near enough.
TEST(BuildLadder, WithGreatErrorsEverythingIsABall) {
  const Hull flat{build_hull(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})->geometry};
  const Compound compound = compound_of({{.shape = Sphere{1}, .position = {3, 0, 0}},
                                         {.shape = Box{{1, 1, 1}}, .position = {-1, 0, 0}}});
  for (const Shape& shape : std::initializer_list<Shape>{ball_mesh(6, bumps), compound}) {
    const LadderedShape laddered = built(shape, 10);
    EXPECT_TRUE(laddered.report.entries[0].is_capsule);
    const Rung& rung = only_rung(laddered.shape);
    EXPECT_LE(rung.error, 6);
    EXPECT_GE(rung.error, 1.2);
    EXPECT_EQ(std::get<Capsule>(rung.shape).a, std::get<Capsule>(rung.shape).b);
  }
  // No proof: a hull without volume, triangles with rules, and what has no points.
  const auto is_capsule = [](const Shape& shape) {
    return built(shape, 10).report.entries[0].is_capsule;
  };
  EXPECT_FALSE(is_capsule(flat));
  EXPECT_FALSE(is_capsule(ball_mesh(6, bumps, {.one_sided = true})));
  EXPECT_FALSE(is_capsule(compound_of({{.shape = ball_mesh(6, bumps)}})));
  EXPECT_FALSE(is_capsule(mesh_of({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}})));
  // The children of a compound have balls of their own.
  const LadderedShape laddered = built(compound_of({{.shape = ball_mesh(6, bumps)}}), 10);
  const auto child = std::get<Compound>(only_rung(laddered.shape).shape).geometry->children()[0];
  EXPECT_TRUE(std::holds_alternative<Capsule>(child.shape));
}

TEST(BuildLadder, OfCompoundsHasTheModelsOfTheirChildren) {
  const Hull hull = random_hull(100, 1);
  const Mesh ball = ball_mesh(24, bumps);
  std::vector<CompoundChild> children(4);
  children[0] = {.shape = hull, .position = {1, 0, 0}};
  children[1] = {.shape = hull, .position = {0, 2, 0}};
  children[2] = {.shape = ball};
  children[3] = {.shape = Box{{1, 1, 1}}};
  const Compound compound = compound_of(children);
  const LadderedShape laddered = built(compound, 0.05);
  const Rung& rung = only_rung(laddered.shape);
  const auto models = std::get<Compound>(rung.shape).geometry->children();
  ASSERT_EQ(models.size(), 4u);
  const auto& first = std::get<Hull>(models[0].shape).geometry;
  EXPECT_EQ(first, std::get<Hull>(models[1].shape).geometry);
  EXPECT_LT(first->points().size(), hull.geometry->points().size());
  EXPECT_LT(std::get<Mesh>(models[2].shape).geometry->triangles().size(),
            ball.geometry->triangles().size());
  EXPECT_EQ(std::get<Box>(models[3].shape).half, Eigen::Vector3f::Ones());
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(models[i].position, children[i].position);
  EXPECT_EQ(rung.error, std::max(only_rung(built(hull, 0.05).shape).error,
                                 only_rung(built(ball, 0.05).shape).error));
}

TEST(BuildLadder, RungsAscend) {
  const Mesh ball = ball_mesh(24, bumps);
  const auto laddered = build_ladder(ball, std::vector{1e-9, 0.01, 0.011, 0.1});
  ASSERT_TRUE(laddered);
  ASSERT_EQ(laddered->report.entries.size(), 4u);
  EXPECT_FALSE(laddered->report.entries[0].refused.empty());
  EXPECT_EQ(laddered->report.entries[0].error, 0);
  const std::vector<Rung>& rungs = std::get<Mesh>(laddered->shape).ladder->rungs;
  ASSERT_GE(rungs.size(), 2u);
  for (size_t i = 1; i < rungs.size(); ++i) EXPECT_GT(rungs[i].error, rungs[i - 1].error);
}

TEST(BuildLadder, IsTheSameEachTime) {
  const Mesh ball = ball_mesh(20, bumps);
  const auto numbers = [&] {
    const LadderedShape laddered = built(ball, 0.05);
    const auto vertices = std::get<Mesh>(only_rung(laddered.shape).shape).geometry->vertices();
    return std::vector<Eigen::Vector3f>(vertices.begin(), vertices.end());
  };
  EXPECT_EQ(numbers(), numbers());
}

// A rung that cannot be proved is refused, with a reason; the shape stays as it is.
TEST(BuildLadder, RefusesWhatItCannotProve) {
  const auto refusal = [](const Shape& shape) {
    const LadderedShape laddered = built(shape, 0.1);
    EXPECT_EQ(laddered.shape.index(), shape.index());
    return laddered.report.entries.at(0).refused;
  };
  EXPECT_NE(refusal(ball_mesh(16, bumps, {.one_sided = true})).find("one-sided"),
            std::string::npos);
  EXPECT_NE(refusal(ball_mesh(16, bumps, {.thickness = 0.1f})).find("thick"), std::string::npos);
  EXPECT_NE(refusal(Sphere{1}).find("kind"), std::string::npos);
  EXPECT_FALSE(refusal(mesh_of({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}})).empty());
  EXPECT_FALSE(refusal(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})).empty());
  EXPECT_FALSE(refusal(random_hull(4, 1)).empty());
  EXPECT_FALSE(
      refusal(Hull{build_hull(Points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}})->geometry}).empty());
  EXPECT_FALSE(refusal(compound_of({{.shape = Sphere{1}}})).empty());
}

TEST(BuildLadder, FailsForBadInput) {
  const Mesh ball = ball_mesh(8, bumps);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& errors :
       {std::vector{0.0}, {-1.0}, {nan}, {HUGE_VAL}, {0.2, 0.1}, {0.1, 0.1}}) {
    EXPECT_FALSE(build_ladder(ball, errors));
  }
  EXPECT_FALSE(build_ladder(Mesh{}, std::vector{0.1}));
  EXPECT_FALSE(build_ladder(Hull{}, std::vector{0.1}));
  EXPECT_TRUE(build_ladder(ball, {}));
}

}  // namespace
}  // namespace carom::test
