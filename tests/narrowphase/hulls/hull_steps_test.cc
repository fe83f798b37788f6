// The steps of the penetration search in lanes: the same bits as the scalar form on every
// instruction set.
#include <gtest/gtest.h>

#include <cstring>

#include "narrowphase/hulls/hull_steps.h"
#include "narrowphase/hulls/hull_steps_scalar.h"
#include "tests/support/hulls.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;
using oracle::Random;
using scalar::HullShape;

template <class T>
void expect_same_bits(const T& expected, const T& found) {
  EXPECT_EQ(std::memcmp(&expected, &found, sizeof expected), 0);
}

TEST(HullSteps, OfPointsAreThoseOfTheReferenceOnEveryIsa) {
  for_each_isa([] {
    const HullSteps& lanes = hull_steps_in_lanes();
    const HullSteps& scalar = scalar::kHullSteps;
    Random random(4);
    for (size_t count = 1; count <= 35; ++count) {
      SCOPED_TRACE(count);
      Points points = round_points(count, {1, 1, 1}, random);
      // Some points are equally far along z.
      for (size_t i = 0; i < count; i += 3) points[i].z() = 1;
      const Hull hull{*make_hull(points, {})};
      const Vector3f axis_of_turn = random.direction().cast<float>();
      const auto turn = scalar::rotation_of(scalar::Quaternion<float>{axis_of_turn, 0.5f});
      const Vector3f offset = random.direction().cast<float>();
      HullPoints expected, found;
      Solid solid;
      solid.point_count = count;
      for (size_t axis = 0; axis < 3; ++axis) solid.point[axis] = hull.geometry->column(axis);
      solid.scale = 0.5f;
      scalar.place(solid, turn, offset, expected);
      lanes.place(solid, turn, offset, found);
      ASSERT_EQ(expected.count, found.count);
      for (size_t i = 0; i < count; ++i) EXPECT_EQ(expected[i], found[i]) << i;
      for (const Vector3f& way : {turn.z, Vector3f(-turn.z), offset}) {
        const FacingPoints facing = scalar.facing(expected, way);
        const FacingPoints facing_in_lanes = lanes.facing(found, way);
        EXPECT_EQ(facing.furthest.index, facing_in_lanes.furthest.index);
        expect_same_bits(facing.furthest.height, facing_in_lanes.furthest.height);
        EXPECT_EQ(facing.count, facing_in_lanes.count);
      }
    }
  });
}

void expect_same(const BestFace& expected, const BestFace& found) {
  EXPECT_EQ(expected.face, found.face);
  expect_same_bits(expected.gap, found.gap);
}

// By definition: no ball is low enough over both faces of an open edge.
std::vector<uint16_t> open_edges(const Solid& solid, float gap, const FaceBounds& bounds) {
  std::vector<uint16_t> open;
  for (size_t e = 0; e < solid.edge_count; ++e) {
    bool is_open = true;
    for (size_t ball = 0; ball < bounds.count; ++ball) {
      const float* const between = bounds.between(ball);
      is_open &= !(between[solid.side[0][e]] <= gap && between[solid.side[1][e]] <= gap);
    }
    if (is_open) open.push_back(static_cast<uint16_t>(e));
  }
  return open;
}

struct EdgeCounts {
  size_t open = 0, all = 0;
};

void expect_open_alike(const Solid& solid, FaceBounds& expected, FaceBounds& found,
                       EdgeCounts& counts) {
  for (const float gap : {-0.5f, 0.0f, 0.5f}) {
    const std::vector<uint16_t> by_definition = open_edges(solid, gap, expected);
    OpenEdges edges, edges_in_lanes;
    scalar::find_open_edges(solid, gap, expected, edges);
    hull_steps_in_lanes().find_open(solid, gap, found, edges_in_lanes);
    const auto listed = [](const OpenEdges& some) -> std::vector<uint16_t> {
      return {some.index.begin(), some.index.begin() + static_cast<ptrdiff_t>(some.count)};
    };
    EXPECT_EQ(listed(edges), by_definition);
    EXPECT_EQ(listed(edges_in_lanes), by_definition);
    counts.open += by_definition.size();
    counts.all += solid.edge_count;
  }
}

TEST(HullSteps, OfFacesAreThoseOfTheReferenceOnEveryIsa) {
  for_each_isa([] {
    Random random(5);
    EdgeCounts counts;
    // Up to the most points that a search takes.
    for (size_t count = 4; count <= kMostLanePoints; count += count < 30 ? 1 : 49) {
      SCOPED_TRACE(count);
      const Hull hull = oracle::hull_of(round_points(count, {1, 0.5f, 1}, random));
      const SolidHull hull_solid(HullShape<float>{hull.geometry.get(), 0.5});
      const Solid& solid = hull_solid.view();
      ASSERT_TRUE(solid.is_known());
      FaceBounds expected, found;
      expected.begin(solid);
      found.begin(solid);
      for (size_t i = 0; i < 4; ++i) {
        const Ball ball{random.direction().cast<float>(), i == 0 ? 0.25f : 0};
        const BestFace best = scalar::bound_faces(solid, ball, expected);
        expect_same(best, hull_steps_in_lanes().bound(solid, ball, found));
        ASSERT_EQ(expected.count, found.count);
        for (size_t f = 0; f < solid.face_count; ++f) {
          expect_same_bits(expected.gap[f], found.gap[f]);
          expect_same_bits(expected.between(i)[f], found.between(i)[f]);
        }
      }
      expect_open_alike(solid, expected, found, counts);

      const scalar::Rotation<float> unturned{Vector3f::UnitX(), Vector3f::UnitY(),
                                             Vector3f::UnitZ()};
      const Vector3f offset = random.direction().cast<float>();
      HullPoints points, points_in_lanes;
      scalar::place_points(solid, unturned, offset, points);
      hull_steps_in_lanes().place(solid, unturned, offset, points_in_lanes);
      // More balls than one row of bits holds.
      for (size_t i = 0; i < 16; ++i) {
        const size_t face = random.below(solid.face_count);
        const TriedFace tried = scalar::try_face(solid, points, face, expected);
        const TriedFace in_lanes =
            hull_steps_in_lanes().try_face(solid, points_in_lanes, face, found);
        expect_same_bits(tried.gap, in_lanes.gap);
        expect_same(tried.next, in_lanes.next);
        // The point that a face finds bounds it by its own gap.
        EXPECT_LE(expected.gap[face], tried.gap);
      }
      expect_open_alike(solid, expected, found, counts);
      if (points.count > FaceBounds::kMostBalls) continue;
      expect_same(scalar::try_all_faces(solid, points, expected),
                  hull_steps_in_lanes().try_all(solid, points_in_lanes, found));
      expect_open_alike(solid, expected, found, counts);
    }
    EXPECT_GT(counts.open, counts.all / 20);
    EXPECT_LT(counts.open, counts.all / 20 * 19);
  });
}

TEST(HullSteps, OfPointsInsideAreThoseOfTheReferenceOnEveryIsa) {
  for_each_isa([] {
    Random random(11);
    size_t inside = 0, all = 0;
    for (size_t count = 4; count <= 20; ++count) {
      const Hull hull = oracle::hull_of(round_points(count, {1, 1, 1}, random));
      const SolidHull hull_solid(HullShape<float>{hull.geometry.get(), 0.5});
      const Solid& solid = hull_solid.view();
      // About the plane of each face, so that the last face has to be looked at.
      for (size_t f = 0; f < solid.face_count; ++f) {
        for (const float above : {-0x1p-18f, 0.0f, 0x1p-20f, 0x1p-18f, 0.5f}) {
          const Vector3f corner =
              solid.corner(hull.geometry->corners(hull.geometry->faces()[f])[0]);
          const Vector3f point =
              corner + (solid.middle * solid.scale - corner) * 0x1p-10f + solid.normal(f) * above;
          const bool expected = scalar::is_inside(solid, point);
          EXPECT_EQ(hull_steps_in_lanes().is_inside(solid, point), expected);
          inside += expected;
          ++all;
        }
      }
    }
    EXPECT_GT(inside, all / 10);
    EXPECT_LT(inside, all / 10 * 9);
  });
}

}  // namespace
}  // namespace carom::test
