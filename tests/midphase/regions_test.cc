// All contacts of pairs: bits against the reference on every ISA, and against brute force over the
// parts.
#include <gtest/gtest.h>

#include "tests/midphase/region_checks.h"
#include "tests/support/composites.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

TEST(Regions, EqualTheReferenceOnEveryIsa) {
  RegionCounts counts;
  Composites random(7);
  for (const auto& kinds : composite_kind_pairs()) {
    for (const PositionType positions : kPositionTypes) {
      std::vector<TestPair> pairs;
      for (size_t i = 0; i < rounds(40); ++i) {
        pairs.push_back(random.pair(kinds[0], kinds[1], positions, 1, 3));
      }
      for (const float distance : {0.0f, 0.2f}) {
        for (const uint32_t most : {16u, 2u}) {
          CollideOptions options{.frame = WitnessFrame::body, .contact_distance = distance};
          options.region_limits = {.cosine = most == 2 ? 0.999 : 0.95, .most = most};
          for_each_isa([&] {
            const Listed listed = list_contacts(pairs, positions, options);
            expect_reference_contacts(pairs, positions, listed.regions, options, counts);
          });
          ASSERT_FALSE(HasFatalFailure());
        }
      }
    }
  }
  EXPECT_GT(counts.several, rounds(1000));
  EXPECT_GT(counts.left_out, rounds(1000));
}

// With the default angle the first contact is that of detail manifold, and rows are equal in both
// frames.
TEST(Regions, RowsAreThoseOfManifolds) {
  Composites random(8);
  for (const auto& kinds : composite_kind_pairs()) {
    std::vector<TestPair> pairs;
    for (size_t i = 0; i < rounds(40); ++i) {
      pairs.push_back(random.pair(kinds[0], kinds[1], PositionType::float32, 1, 3));
    }
    const LaidOut a(side_a(pairs), {}), b(side_b(pairs), {});
    for (const WitnessFrame frame : {WitnessFrame::world, WitnessFrame::body}) {
      const Listed listed = list_contacts(pairs, PositionType::float32, {.frame = frame});
      ResultArrays rows(pairs.size(), Detail::manifold, {ColumnRole::sub_shape});
      ASSERT_TRUE(bool(
          collide_rows(a.view(), b.view(), Detail::manifold, rows.columns(), {.frame = frame})));
      for (size_t i = 0; i < pairs.size(); ++i) {
        ASSERT_TRUE(same_bits(result_row(listed.rows.columns(), i), result_row(rows.columns(), i)));
      }
    }
  }
}

// A box that is pushed into a corner of three planes.
TEST(Regions, ACornerHasThreePlanes) {
  const Mesh corner = mesh_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}},
                              {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}, {.one_sided = true});
  const TestPair pair{{corner, {0, 0, 0}}, {Box{{0.5f, 0.5f, 0.5f}}, {0.4375, 0.46875, 0.484375}}};
  const Listed listed = list_contacts({&pair, 1}, PositionType::float64, {});
  ASSERT_EQ(listed.regions.contacts.size(), 3u);
  const float depths[] = {0.0625f, 0.03125f, 0.015625f};
  for (int axis = 0; axis < 3; ++axis) {
    const Contact& contact = listed.regions.contacts[static_cast<size_t>(axis)];
    EXPECT_EQ(contact.separation, -depths[axis]);  // the deepest first
    EXPECT_EQ(contact.normal, Vector3f::Unit(axis));
    EXPECT_GE(contact.manifold_count, 3);
    EXPECT_EQ(contact.left_out, 0);
  }
  CollideOptions one;
  one.region_limits.most = 1;
  const Listed limited = list_contacts({&pair, 1}, PositionType::float64, one);
  ASSERT_EQ(limited.regions.contacts.size(), 1u);
  EXPECT_EQ(limited.regions.contacts[0].left_out, 2);
}

// Moved along the normals by the separations, bodies in a groove no longer overlap by more than
// rounding; with the deepest contact alone they do.
TEST(Regions, ResolveAGroove) {
  const Mesh groove =
      mesh_of({{-4, -4, 2}, {-4, 4, 2}, {0, -4, 0}, {0, 4, 0}, {4, -4, 2}, {4, 4, 2}},
              {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}});
  const Sphere ball{1};
  Vector3d at(0, 0, 1.05);
  for (int round = 0; round < 50; ++round) {
    const TestPair pair{{groove, {0, 0, 0}}, {ball, at}};
    const Listed listed = list_contacts({&pair, 1}, PositionType::float64, {});
    if (round == 0) {
      ASSERT_EQ(listed.regions.contacts.size(), 2u);
    }
    if (listed.regions.contacts.empty()) break;
    for (const Contact& contact : listed.regions.contacts) {
      at -= 0.5 * double{contact.separation} * contact.normal.cast<double>();
    }
  }
  EXPECT_NEAR(at.x(), 0, 1e-6);
  EXPECT_NEAR(at.z(), std::sqrt(1.25), 1e-4);  // the ball touches both slopes
}

// Every touching pair of parts whose contact is not over an inner edge has a region with a normal
// within the angle, and each region is as deep as its deepest part.
TEST(Regions, CoverAllParts) {
  Composites random(9);
  size_t covered = 0;
  // Boxes along the axes of a compound turn with it, and meshes have parts themselves.
  const auto is_plain = [](const Shape& shape) {
    return !std::holds_alternative<Aabb>(shape) && !std::holds_alternative<Mesh>(shape);
  };
  for (size_t i = 0; i < rounds(1000); ++i) {
    const TestPair pair =
        random.pair(ShapeKind::compound, ShapeKind::compound, PositionType::float64, 1, 2);
    CollideOptions options;
    options.region_limits.most = 1000;
    const Listed listed = list_contacts({&pair, 1}, PositionType::float64, options);
    const auto& a = *std::get<Compound>(pair.a.shape).geometry;
    const auto& b = *std::get<Compound>(pair.b.shape).geometry;
    const Vector3d offset = pair.b.position - pair.a.position;
    for (const CompoundChild& x : a.children()) {
      for (const CompoundChild& y : b.children()) {
        if (!is_plain(x.shape) || !is_plain(y.shape)) continue;
        const auto placed = [](const PlacedShape& body, const CompoundChild& child,
                               const Vector3d& from) {
          const Eigen::Quaternionf q = body.orientation;
          return Pose{from + (q.normalized() * child.position).template cast<double>(),
                      Eigen::Quaternionf(q * Eigen::Quaternionf(child.orientation))};
        };
        const reference::PairResult part =
            reference::collide(x.shape, placed(pair.a, x, Vector3d::Zero()), y.shape,
                               placed(pair.b, y, offset), PositionType::float64);
        if (!part.overlap || part.separation > -1e-4f) continue;
        const bool is_covered = std::any_of(listed.regions.contacts.begin(),
                                            listed.regions.contacts.end(), [&](const Contact& c) {
                                              return c.normal.dot(part.normal) > 0.95f - 1e-3f &&
                                                     c.separation <= part.separation + 1e-4f;
                                            });
        EXPECT_TRUE(is_covered);
        covered += is_covered;
      }
    }
  }
  EXPECT_GT(covered, rounds(300));
}

TEST(Regions, OfNoPairsAndOfSimplePairs) {
  const Listed none = list_contacts({}, PositionType::float32, {});
  EXPECT_EQ(none.regions.first, std::vector<uint64_t>{0});
  const std::vector<TestPair> pairs = {{sphere(0, 0, 0, 1), sphere(1, 0, 0, 1)},
                                       {sphere(0, 0, 0, 1), sphere(3, 0, 0, 1)},
                                       {sphere(0, 0, 0, NAN), sphere(0, 0, 0, 1)}};
  const Listed simple = list_contacts(pairs, PositionType::float32, {});
  EXPECT_EQ(simple.regions.first, (std::vector<uint64_t>{0, 1, 1, 1}));
  const Listed near = list_contacts(pairs, PositionType::float32, {.contact_distance = 1});
  EXPECT_EQ(near.regions.first, (std::vector<uint64_t>{0, 1, 2, 2}));
}

}  // namespace
}  // namespace carom::test
