// World bounds of all kinds that turn and have no parts: they have the bits of
// the reference on every ISA, alone and mixed with spheres and aabbs. tests/reference tests the
// reference itself.
#include <gtest/gtest.h>

#include "carom/base/thread_arena.h"
#include "carom/bounds/bounds.h"
#include "tests/bounds/bounds_memory.h"
#include "tests/support/float_modes.h"
#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/layouts.h"
#include "tests/support/show.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

using Bodies = std::vector<PlacedShape>;

constexpr ShapeKind kTurningKinds[] = {
    ShapeKind::capsule,   ShapeKind::box,         ShapeKind::dop,         ShapeKind::hull,
    ShapeKind::triangle,  ShapeKind::halfspace,   ShapeKind::cylinder,    ShapeKind::cone,
    ShapeKind::ellipsoid, ShapeKind::rounded_box, ShapeKind::rounded_hull};

// Half of the bodies come from the family, the others have random bits.
Bodies make_kind(const ConvexFamily& family, ShapeKind kind, PositionType positions, size_t count,
                 uint64_t seed = 1) {
  const KindPair kinds{ShapeKind::sphere, kind};
  const size_t few = fewer_if_slow(kinds, count / 2 + 1);
  const std::vector<TestPair> pairs = make_kind_pairs(family, kinds, positions, few, seed);
  const std::vector<TestPair> nonsense = make_kind_nonsense(kinds, few, seed);
  Bodies bodies;
  for (size_t i = 0; i < count; ++i) {
    bodies.push_back((i < count / 2 ? pairs : nonsense)[i % few].b);
  }
  return bodies;
}

Bodies make_mixed_bodies(PositionType positions, size_t count) {
  std::vector<Bodies> kinds;
  for (const ShapeKind kind : kConvexKinds) {
    kinds.push_back(make_kind({.name = ""}, kind, positions, count));
  }
  for (const ShapeKind kind : kRoundKinds) {
    kinds.push_back(make_kind({.name = ""}, kind, positions, count));
  }
  Random random(7);
  Bodies bodies;
  for (size_t i = 0; i < count; ++i) bodies.push_back(kinds[random.below(kinds.size())][i]);
  return bodies;
}

void expect_reference_bounds(const Bodies& bodies, const Layout& layout,
                             const FloatMode& mode = kDefaultMode,
                             Parallelism parallelism = Parallelism::none) {
  const LaidOut set(bodies, layout);
  BoundsMemory memory(bodies.size());
  const size_t invalid = [&] {
    const ScopedFloatMode scoped(mode);
    return compute_bounds(set.view(), memory.out(), parallelism);
  }();
  size_t expected_invalid = 0;
  for (size_t i = 0; i < bodies.size(); ++i) {
    const auto expected = reference::bounds(bodies[i].shape, bodies[i].pose(), layout.positions);
    expected_invalid += expected.lower.x() > expected.upper.x();
    const reference::Box got = memory.box(i);
    ASSERT_TRUE(same_bits(got, expected))
        << "body " << i << " of " << bodies.size() << ", " << show(layout) << ", " << mode.name
        << "\n"
        << show(bodies[i]) << "\n"
        << hex3(got.lower) << " .. " << hex3(got.upper) << "\ninstead of\n"
        << hex3(expected.lower) << " .. " << hex3(expected.upper);
  }
  EXPECT_EQ(invalid, expected_invalid);
}

std::vector<Layout> layouts(PositionType positions) {
  const Layout plain{.positions = positions};
  std::vector<Layout> all(6, plain);
  all[1].orientation_stride = 0;
  all[2].rows = RowOrder::backwards;
  all[3].rows = RowOrder::shared;
  all[3].orientation_stride = 20;
  all[4].orientation_stride = 48;
  all[4].stride = 64;
  all[4].box_slots = true;
  all[5].radius = RadiusLayout::column;
  all[5].always_kinds = true;
  return all;
}

TEST(KindsBounds, AreThoseOfTheReferenceOnEveryIsa) {
  for (const ConvexFamily& family : convex_families()) {
    SCOPED_TRACE(family.name);
    for (const ShapeKind kind : kTurningKinds) {
      for (const PositionType positions : kPositionTypes) {
        const Bodies bodies = make_kind(family, kind, positions, 90);
        for_each_isa([&] {
          for (const Layout& layout : layouts(positions)) expect_reference_bounds(bodies, layout);
        });
        if (HasFailure()) return;
      }
    }
  }
}

TEST(KindsBounds, OfAnyBits) {
  for (const ShapeKind kind : kTurningKinds) {
    const Bodies bodies = make_kind({.name = ""}, kind, PositionType::float32, 6000, 5);
    for_each_isa([&] {
      for (const PositionType positions : kPositionTypes) {
        expect_reference_bounds(bodies, {.positions = positions});
      }
    });
  }
}

TEST(KindsBounds, OfMixedKinds) {
  for (const PositionType positions : kPositionTypes) {
    const Bodies bodies = make_mixed_bodies(positions, 700);
    for_each_isa([&] {
      for (const Layout& layout : layouts(positions)) expect_reference_bounds(bodies, layout);
    });
  }
}

TEST(KindsBounds, OfAnyCount) {
  std::vector<size_t> counts = {63, 64, 65, 255, 256, 257, 1023, 1024, 1025};
  for (size_t count = 0; count <= 35; ++count) counts.push_back(count);
  for (const ShapeKind kind : kTurningKinds) {
    for (const PositionType positions : kPositionTypes) {
      const Bodies bodies = make_kind({.name = ""}, kind, positions, 1025);
      for_each_isa([&] {
        for (const size_t count : counts) {
          expect_reference_bounds({bodies.begin(), bodies.begin() + static_cast<ptrdiff_t>(count)},
                                  {.positions = positions});
        }
      });
    }
  }
}

// Bodies of one kind whose corners are known are computed in lanes.
TEST(KindsBounds, OfDopsWithTheirCorners) {
  for (const PositionType positions : kPositionTypes) {
    Bodies bodies;
    for (const ConvexFamily& family : convex_families()) {
      for (PlacedShape& body : make_kind(family, ShapeKind::dop, positions, 12)) {
        Dop& dop = std::get<Dop>(body.shape);
        dop.geometry = dop_geometry(dop);
        if (dop.geometry) bodies.push_back(body);
      }
    }
    ASSERT_GT(bodies.size(), 100u);
    for_each_isa([&] {
      for (const Layout& layout : layouts(positions)) expect_reference_bounds(bodies, layout);
      for (size_t count = 0; count <= 35; ++count) {
        expect_reference_bounds({bodies.begin(), bodies.begin() + static_cast<ptrdiff_t>(count)},
                                {.positions = positions});
      }
    });
  }
}

TEST(KindsBounds, DoNotDependOnTheFloatModeOfTheCaller) {
  for (const ShapeKind kind : kTurningKinds) {
    for (const ConvexFamily& family : convex_families()) {
      if (family.smallest > 1e-30) continue;
      const Bodies bodies = make_kind(family, kind, PositionType::float32, 70);
      for_each_isa([&] {
        for (const FloatMode& mode : float_modes()) expect_reference_bounds(bodies, {}, mode);
      });
    }
  }
}

TEST(KindsBounds, AreTheSameOnThreads) {
  for (const int threads : {1, 2, 4}) {
    ThreadArena arena(threads);
    arena.run([&] {
      for (const PositionType positions : kPositionTypes) {
        expect_reference_bounds(make_mixed_bodies(positions, 3000), {.positions = positions},
                                kDefaultMode, arena.parallelism());
      }
    });
  }
}

TEST(KindsBounds, OfHalfspacesAreInfinite) {
  const Bodies bodies = {halfspace({1, 2, 3}, {0, 0, 1}, 4),
                         halfspace({1e30, 2, 3}, {1, 2, 3}, -4)};
  for_each_isa([&] {
    const LaidOut set(bodies, {});
    BoundsMemory memory(bodies.size());
    EXPECT_EQ(compute_bounds(set.view(), memory.out()), 0u);
    for (size_t i = 0; i < bodies.size(); ++i) {
      EXPECT_EQ(memory.box(i).lower, Eigen::Vector3f::Constant(-kInfinity));
      EXPECT_EQ(memory.box(i).upper, Eigen::Vector3f::Constant(kInfinity));
    }
  });
}

}  // namespace
}  // namespace carom::test
