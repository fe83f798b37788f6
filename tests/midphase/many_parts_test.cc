// Pairs of bodies in which more parts touch than contacts are made of: the deepest ones count, and
// the others are left out.
#include <gtest/gtest.h>

#include <cmath>

#include "base/tolerances.h"
#include "tests/midphase/region_checks.h"
#include "tests/support/composites.h"
#include "tests/support/fine_meshes.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

static_assert(kMostPartsOfManifold == 4096, "as Contact::left_out says");

// Small balls or boxes in a cube of this half side.
Compound swarm(size_t count, float half, bool boxes, oracle::Random& random) {
  std::vector<CompoundChild> children(count);
  for (CompoundChild& child : children) {
    const auto size = static_cast<float>(random.uniform(0.5, 0.6));
    child.shape = boxes ? Shape(Box{{size, 0.75f * size, size}}) : Shape(Sphere{size});
    for (int axis = 0; axis < 3; ++axis) {
      child.position[axis] = static_cast<float>(random.uniform(-half, half));
    }
    if (boxes) child.orientation = Eigen::Quaternionf(1, 0.1f, child.position.x(), 0);
  }
  return compound_of(children);
}

// Two swarms, and swarms and a box in bumpy ground, in all of which more than 4,096 parts touch.
std::vector<TestPair> pairs_of_many_parts() {
  oracle::Random random(31);
  const auto bumps = [&](float, float) { return random.uniform(-0.05, 0.05); };
  const Mesh ground = grid_mesh(10, 0.06f, bumps), wide = grid_mesh(48, 0.05f, bumps);
  const Eigen::Quaternionf turn(0.9f, 0.1f, 0.3f, -0.2f);
  return {
      {{swarm(72, 0.1f, false, random)}, {swarm(70, 0.1f, false, random), {0.3, 0.2, 0.5}, turn}},
      {{swarm(72, 0.1f, true, random), {5, 6, 7}},
       {swarm(70, 0.1f, true, random), {5.3, 6.2, 7.5}, turn}},
      {{ground}, {swarm(30, 0.1f, false, random), {0, 0, 0.2}}},
      {{swarm(30, 0.1f, true, random), {0, 0, 0.25}}, {ground}},
      {{wide}, {Box{{2, 2, 0.5f}}, {0, 0, 0.4}}},
  };
}

TEST(ManyParts, EqualTheReference) {
  const std::vector<TestPair> pairs = pairs_of_many_parts();
  RegionCounts counts;
  for (const RegionLimits& limits :
       {RegionLimits{}, RegionLimits{.cosine = 0.9999, .most = 3}, RegionLimits{.most = 65535}}) {
    for (const float distance : {0.0f, 0.1f}) {
      CollideOptions options{.frame = WitnessFrame::body, .contact_distance = distance};
      options.region_limits = limits;
      const Listed listed = list_contacts(pairs, PositionType::float64, options);
      expect_reference_contacts(pairs, PositionType::float64, listed.regions, options, counts);
      for (size_t i = 0; i < pairs.size(); ++i) {
        EXPECT_GT(listed.regions.contacts[listed.regions.first[i]].left_out, 100) << i;
      }
      ASSERT_FALSE(HasFailure());
    }
  }
  EXPECT_GT(counts.several, 20u);
}

// Bodies in bumpy ground, of which some meet more triangles than a batch holds. Most triangles
// need no depth, since others are surely deeper.
TEST(ManyParts, TheDeepestTriangleIsThatOfTheReference) {
  oracle::Random random(33);
  const auto bumps = [&](float, float) { return random.uniform(-0.05, 0.05); };
  const Mesh wide = grid_mesh(48, 0.05f, bumps), coarse = grid_mesh(10, 0.4f, bumps);
  oracle::ConvexRandom shapes({}, random);
  std::vector<TestPair> pairs;
  for (uint32_t i = 0; i < rounds(40, 10); ++i) {
    for (const ShapeKind kind :
         {ShapeKind::box, ShapeKind::hull, ShapeKind::capsule, ShapeKind::sphere}) {
      const Shape shape = shapes.shape(kind, i % 5 == 0 ? 2 : 0.3);
      const Eigen::Quaternionf turn = shapes.orientation();
      const double x = random.uniform(-0.3, 0.3), y = random.uniform(-0.3, 0.3);
      const double z = random.uniform(0, 0.5);
      const PlacedShape body = {shape, {x, y, z}, turn}, ground = {i % 2 == 0 ? wide : coarse};
      pairs.push_back(i % 3 == 0 ? TestPair{ground, body} : TestPair{body, ground});
    }
  }
  Call call = call_with(PositionType::float64);
  call.detail = Detail::contact;
  expect_reference(pairs, call);
}

// Two meshes that meet in many pairs of triangles, of which most cannot be the deepest: closed and
// open surfaces, fine and coarse, far from the origin, with rules and without.
TEST(ManyParts, TheDeepestPairOfTrianglesIsThatOfTheReference) {
  oracle::Random random(35);
  const auto bumps = [&](float, float) { return random.uniform(-0.05, 0.05); };
  const auto bumpy = [](double x, double y, double z) {
    return 0.6 + 0.1 * std::sin(5 * x) * std::cos(4 * y + z);
  };
  const std::vector<Mesh> meshes = {grid_mesh(12, 0.1f, bumps), ball_mesh(9, bumpy),
                                    ball_mesh(5, bumpy), grid_mesh(5, 0.3f, bumps),
                                    ball_mesh(8, bumpy, {.thickness = 0.02f})};
  oracle::ConvexRandom shapes({}, random);
  std::vector<TestPair> pairs;
  for (uint32_t i = 0; i < rounds(60, 10); ++i) {
    const Mesh &a = meshes[random.below(meshes.size())], &b = meshes[random.below(meshes.size())];
    const Eigen::Vector3d place = (i % 4 == 0 ? 50.0 : 0.0) * random.direction();
    const Eigen::Vector3d way = random.uniform(0, 0.7) * random.direction();
    const Eigen::Quaternionf turn_a = shapes.orientation(), turn_b = shapes.orientation();
    pairs.push_back({{a, place, turn_a}, {b, place + way, turn_b}});
  }
  Call call = call_with(PositionType::float64);
  call.detail = Detail::contact;
  expect_reference(pairs, call);
}

// Bodies whose points lie far from their own origins, so that tests round by more than their sizes.
TEST(ManyParts, TheDeepestTriangleIsThatOfTheReferenceFarFromTheOrigin) {
  oracle::Random random(34);
  const auto bumps = [&](float, float) { return random.uniform(-0.001, 0.001); };
  const Mesh ground = grid_mesh(24, 0.05f, bumps);
  std::vector<TestPair> pairs;
  for (uint32_t i = 0; i < rounds(200, 50); ++i) {
    const auto draw = [&](double most) {
      const double x = random.uniform(-most, most), y = random.uniform(-most, most);
      return Eigen::Vector3d(x, y, random.uniform(-most, most));
    };
    const Eigen::Vector3f off = draw(i % 2 == 0 ? 3e3 : 1e4).cast<float>();
    const Eigen::Vector3f half = Eigen::Vector3f::Constant(0.2f) + 0.1f * draw(1).cast<float>();
    const Eigen::Vector3d position = draw(0.2) - off.cast<double>();
    pairs.push_back({{Aabb{off - half, off + half}, position}, {ground}});
    pairs.push_back({{Capsule{off - half, off + half, 0.1f}, position}, {ground}});
  }
  Call call = call_with(PositionType::float64);
  call.detail = Detail::contact;
  expect_reference(pairs, call);
}

// All balls of two swarms touch, and all contacts are one region: then what is left out are the
// pairs of balls beyond 4,096, as many as a Contact can say.
TEST(ManyParts, CountWhatIsLeftOut) {
  oracle::Random random(32);
  const size_t sizes[][2] = {{64, 64}, {64, 65}, {80, 120}, {272, 256}, {272, 257}};
  for (const auto& [a, b] : sizes) {
    const TestPair pair{{swarm(a, 0.1f, false, random)},
                        {swarm(b, 0.1f, false, random), {0, 0, 0.5}}};
    CollideOptions options;
    options.region_limits = {.cosine = -1, .most = 1};
    const Listed listed = list_contacts({&pair, 1}, PositionType::float64, options);
    ASSERT_EQ(listed.regions.contacts.size(), 1u);
    EXPECT_EQ(listed.regions.contacts[0].left_out, std::min<size_t>(a * b - 4096, 65535)) << a * b;
  }
}

// Where no two parts share a contact, contacts are the deepest parts one by one, wherever these are
// among the others.
TEST(ManyParts, TheDeepestAreKept) {
  for (const uint32_t count : {5000u, 9000u}) {
    std::vector<CompoundChild> balls;
    for (uint32_t i = 0; i < count; ++i) {
      const float depth = 0.001f + 0.00001f * static_cast<float>(i);
      const float x = 0.001f * static_cast<float>(7919 * i % count);
      balls.push_back({Sphere{0.25f}, {x, 0, 0.25f - depth}});
    }
    const TestPair pair{{Box{{20, 1, 0.5f}}, {0, 0, -0.5}}, {compound_of(balls)}};
    CollideOptions options;
    options.region_limits = {.cosine = 2, .most = 65535};
    const Listed listed = list_contacts({&pair, 1}, PositionType::float64, options);
    ASSERT_EQ(listed.regions.contacts.size(), 4096u);
    EXPECT_EQ(listed.regions.contacts[0].left_out, count - 4096);
    for (uint32_t k = 0; k < 4096; ++k) {
      ASSERT_EQ(listed.regions.contacts[k].sub_b, count - 1 - k);
    }
  }
}

}  // namespace
}  // namespace carom::test
