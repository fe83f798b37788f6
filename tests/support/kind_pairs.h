// Random pairs of every two kinds that have a kernel.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <tuple>
#include <vector>

#include "carom/narrowphase/collide.h"
#include "oracle/convex_families.h"
#include "tests/support/pairs.h"

namespace carom::test {

using namespace oracle;

// All supported pairs of kinds, in both orders.
std::vector<KindPair> supported_kind_pairs();
// Those of them that ConvexOracle solves: no round shapes.
std::vector<KindPair> solved_kind_pairs();

// The name of a family in GoogleTest.
std::string family_name(const testing::TestParamInfo<ConvexFamily>& info);

bool has_halfspace(const KindPair& kinds);

TestPair as_test_pair(const ConvexPair& pair);

std::vector<TestPair> make_kind_pairs(const ConvexFamily& family, const KindPair& kinds,
                                      PositionType positions, size_t count, uint64_t seed = 1);

// Pairs of all kinds in turn, so that neighbours never share a kind. Half-spaces are only among the
// second bodies, since two half-spaces have no test.
std::vector<TestPair> make_mixed_kind_pairs(const ConvexFamily& family, PositionType positions,
                                            size_t count, uint64_t seed = 1,
                                            std::vector<KindPair> kinds = supported_kind_pairs());

// Gives a quarter of all cylinders, cones and ellipsoids a rounding.
void round_some(std::vector<TestPair>& pairs, uint64_t seed = 1);

// One pair of each family.
std::vector<TestPair> make_pairs_of_families(const KindPair& kinds, PositionType positions,
                                             size_t count_each = 1, uint64_t seed = 1);

// A hull with every point changed on its own, and the same faces and rounding.
template <class Change>
Hull with_points(const Hull& hull, const Change& change) {
  std::vector<Eigen::Vector3f> points(hull.geometry->points().begin(),
                                      hull.geometry->points().end());
  for (Eigen::Vector3f& point : points) change(point);
  std::vector<std::vector<uint32_t>> faces;
  for (const HullGeometry::Face& face : hull.geometry->faces()) {
    const auto corners = hull.geometry->corners(face);
    faces.emplace_back(corners.begin(), corners.end());
  }
  return {*make_hull(points, faces), nullptr, hull.rounding};
}

// Replaces numbers of a body by floats with random bits; most bodies stay valid.
class Spoiler {
 public:
  explicit Spoiler(uint64_t seed) : random_(seed) {}

  void spoil(TestPair& pair);

 private:
  void spoil(PlacedShape& body);

  void spoil(float& x);
  void spoil(Eigen::Vector3f& v);
  void spoil_size(float& x);
  // A shape without a rounding keeps none: with one it would be of another kind.
  void spoil_rounding(float& x);

  void spoil_shape(Sphere& sphere) { spoil_size(sphere.radius); }
  void spoil_shape(Aabb& box);
  void spoil_shape(Capsule& capsule);
  void spoil_shape(Box& box);
  void spoil_shape(Cylinder& cylinder);
  void spoil_shape(Cone& cone);
  void spoil_shape(Ellipsoid& ellipsoid);
  void spoil_shape(Triangle& triangle);
  void spoil_shape(Halfspace& halfspace);
  void spoil_shape(Dop& dop);

  // If no hull can be made of the new points, the old ones stay. The faces are the old ones, even
  // if they no longer fit: that must do no harm.
  void spoil_shape(Hull& hull);
  void spoil_shape(Mesh& /*tested by its parts*/) {}
  void spoil_shape(HeightField& /*tested by its parts*/) {}
  void spoil_shape(Compound& /*tested by its parts*/) {}

  Random random_;
};

// Pairs with random bits: tests can only compare bits.
std::vector<TestPair> make_kind_nonsense(const KindPair& kinds, size_t count, uint64_t seed = 1);

// Makes triangles one-sided and gives them inner edges, at random.
void vary_triangles(std::vector<TestPair>& pairs, uint64_t seed = 1);

}  // namespace carom::test
