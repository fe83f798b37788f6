// World bounds: every instruction set against scalar sums, the sums against rational numbers, and
// both against the reference.
#include "carom/bounds/bounds.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstring>

#include "base/outward.h"
#include "bounds/bounds_columns.h"
#include "bounds/some_bounds.h"
#include "carom/base/thread_arena.h"
#include "tests/bounds/bounds_memory.h"
#include "tests/support/families.h"
#include "tests/support/float_modes.h"
#include "tests/support/isas.h"
#include "tests/support/layouts.h"
#include "tests/support/rounds.h"
#include "tests/support/show.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Bodies = std::vector<PlacedShape>;

// --- Scalar sums ---

template <class T>
void expect_outward(T a, T b) {
  SCOPED_TRACE(hex(a) + " + " + hex(b));
  const Rational exact = Rational(a) + Rational(b);
  const float below = sum_downwards(a, b);
  const float above = sum_upwards(a, b);
  if (below != -kInfinity) {
    EXPECT_LE(Rational(below), exact);
  }
  if (below < FLT_MAX) {
    EXPECT_GT(Rational(next_up(below)), exact);
  }
  if (above != kInfinity) {
    EXPECT_GE(Rational(above), exact);
  }
  if (above > -FLT_MAX) {
    EXPECT_LT(Rational(next_down(above)), exact);
  }
  EXPECT_FALSE(std::isnan(below) || std::isnan(above));
}

TEST(OutwardSum, IsTheNearestFloatOnItsSide) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const float a = random.any_float();
    if (!std::isnormal(a)) continue;
    // Exponents near each other, so that both summands matter.
    const int exponent = std::ilogb(a) + static_cast<int>(random.below(60)) - 30;
    const float b = random.chance(0.5)
                        ? random.any_float()
                        : std::ldexp(static_cast<float>(random.uniform(-1, 1)), exponent);
    if (!std::isfinite(b)) continue;
    expect_outward(a, b);
    expect_outward<double>(a, b);
    expect_outward(double{a} * (1 + random.uniform(0, 1e-9)), double{b});
    ASSERT_FALSE(HasFailure());
  }
}

RC_GTEST_PROP(OutwardSum, IsTheNearestFloatForAnyBits, (uint64_t a, uint32_t b)) {
  const double x = std::bit_cast<double>(a);
  const float y = std::bit_cast<float>(b);
  RC_PRE(std::isfinite(x) && std::isfinite(y));
  expect_outward<double>(x, y);
  RC_ASSERT(!testing::Test::HasFailure());
}

// --- Bodies ---

template <class T>
reference::Box scalar_sums(const PlacedShape& body) {
  reference::Box box;
  for (int i = 0; i < 3; ++i) {
    const T position = static_cast<T>(body.position[i]);
    if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
      box.lower[i] = sum_downwards<T>(position, -sphere->radius);
      box.upper[i] = sum_upwards<T>(position, sphere->radius);
    } else {
      box.lower[i] = sum_downwards<T>(position, std::get<Aabb>(body.shape).lower[i]);
      box.upper[i] = sum_upwards<T>(position, std::get<Aabb>(body.shape).upper[i]);
    }
  }
  return box;
}

reference::Box expected_bounds(const PlacedShape& body, PositionType positions) {
  if (!reference::is_valid(body.shape, body.pose(), positions)) {
    return {Eigen::Vector3f::Constant(kInfinity), Eigen::Vector3f::Constant(-kInfinity)};
  }
  return positions == PositionType::float32 ? scalar_sums<float>(body) : scalar_sums<double>(body);
}

void expect_bounds(const Bodies& bodies, const Layout& layout, const FloatMode& mode = kDefaultMode,
                   Parallelism parallelism = Parallelism::none) {
  const LaidOut set(bodies, layout);
  BoundsMemory memory(bodies.size());
  const size_t invalid = [&] {
    const ScopedFloatMode scoped(mode);
    return compute_bounds(set.view(), memory.out(), parallelism);
  }();
  size_t expected_invalid = 0;
  for (size_t i = 0; i < bodies.size(); ++i) {
    const reference::Box expected = expected_bounds(bodies[i], layout.positions);
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

  // A few of them alone.
  std::vector<uint32_t> some;
  for (size_t i = bodies.size() % 3; i < bodies.size(); i += 3) {
    some.push_back(static_cast<uint32_t>(i));
  }
  BoundsMemory few(bodies.size());
  compute_some_bounds(set.view(), some, few.out());
  for (const uint32_t i : some) ASSERT_TRUE(same_bits(few.box(i), memory.box(i))) << "body " << i;
}

std::vector<Layout> sphere_layouts() {
  std::vector<Layout> layouts;
  for (const PositionType positions : kPositionTypes) {
    layouts.push_back({.positions = positions});
    layouts.push_back({.positions = positions, .stride = 48});
    layouts.push_back({.positions = positions, .always_kinds = true});
    layouts.push_back({.positions = positions, .radius = RadiusLayout::column});
    layouts.push_back({.positions = positions,
                       .radius = RadiusLayout::column,
                       .stride = 40,
                       .radius_stride = 12});
  }
  return layouts;
}

std::vector<Layout> box_layouts() {
  std::vector<Layout> layouts;
  for (const PositionType positions : kPositionTypes) {
    layouts.push_back({.positions = positions});
    layouts.push_back({.positions = positions, .box_stride = 24, .box_slots = true});
    layouts.push_back({.positions = positions, .box_stride = 0, .box_slots = true});
    layouts.push_back({.positions = positions, .radius = RadiusLayout::none, .stride = 56});
    layouts.push_back(
        {.positions = positions, .radius = RadiusLayout::none, .stride = 56, .box_stride = 0});
  }
  return layouts;
}

// Half of the bodies come from the family, the others have random bits.
Bodies make_bodies(Sides sides, const Family& family, PositionType positions, size_t count,
                   uint64_t seed = 1) {
  Bodies bodies;
  for (const TestPair& pair : make_pairs(family, sides, positions, count / 2, seed)) {
    bodies.push_back(pair.b);
  }
  for (const TestPair& pair : make_nonsense(sides, count - count / 2, seed)) {
    bodies.push_back(pair.b);
  }
  return bodies;
}

TEST(Bounds, AreTheScalarSumsOnEveryIsa) {
  for_each_isa([] {
    for (const Family& family : families()) {
      SCOPED_TRACE(family.name);
      for (const Layout& layout : sphere_layouts()) {
        expect_bounds(
            make_bodies(Sides::sphere_sphere, family, layout.positions, rounds_of_pairs(150)),
            layout);
      }
      for (const Layout& layout : box_layouts()) {
        expect_bounds(make_bodies(Sides::aabb_aabb, family, layout.positions, rounds_of_pairs(150)),
                      layout);
      }
      ASSERT_FALSE(HasFatalFailure());
    }
  });
}

TEST(Bounds, OfMixedKinds) {
  for_each_isa([] {
    for (Layout layout : {Layout{}, Layout{.box_slots = true},
                          Layout{.positions = PositionType::float64, .box_slots = true},
                          Layout{.radius = RadiusLayout::column, .radius_stride = 8}}) {
      Bodies bodies = make_bodies(Sides::aabb_aabb, {.name = ""}, layout.positions, 200);
      const Bodies spheres = make_bodies(Sides::sphere_sphere, {.name = ""}, layout.positions, 200);
      for (size_t i = 0; i < bodies.size(); i += 3) bodies[i] = spheres[i];
      expect_bounds(bodies, layout);
    }
  });
}

// Whole vectors of one kind between vectors of both kinds.
TEST(Bounds, OfKindsInRuns) {
  for_each_isa([] {
    Random random(7);
    for (const PositionType positions : kPositionTypes) {
      Bodies bodies = make_bodies(Sides::aabb_aabb, {.name = ""}, positions, 1500);
      const Bodies spheres = make_bodies(Sides::sphere_sphere, {.name = ""}, positions, 1500);
      for (size_t i = 0; i < bodies.size();) {
        const bool is_sphere = random.chance(0.5);
        const size_t end = std::min<size_t>(i + 1 + random.below(40), bodies.size());
        for (; i < end; ++i) {
          if (is_sphere) bodies[i] = spheres[i];
        }
      }
      expect_bounds(bodies, {.positions = positions});
      expect_bounds(bodies, {.positions = positions, .box_slots = true});
    }
  });
}

// Box slots in order, nearly in order and in random order.
TEST(Bounds, OfBoxesWithSlots) {
  constexpr size_t kCount = 300;
  Random random(8);
  std::vector<std::vector<uint32_t>> orders(4, std::vector<uint32_t>(kCount));
  for (uint32_t i = 0; i < kCount; ++i) {
    orders[0][i] = orders[1][i] = i;
    orders[2][i] = (i + 100) % kCount;
    orders[3][i] = static_cast<uint32_t>(random.below(kCount));
  }
  for (size_t i = 0; i + 1 < kCount; i += 1 + random.below(50)) {
    std::swap(orders[1][i], orders[1][i + 1]);
  }
  for_each_isa([&] {
    for (const PositionType positions : kPositionTypes) {
      const Bodies bodies = make_bodies(Sides::aabb_aabb, {.name = ""}, positions, kCount);
      const LaidOut set(bodies, {.positions = positions});
      for (const std::vector<uint32_t>& slots : orders) {
        Collidables view = set.view();
        view.box_slot = slots.data();
        BoundsMemory memory(kCount);
        compute_bounds(view, memory.out());
        for (size_t i = 0; i < kCount; ++i) {
          const PlacedShape body = {bodies[slots[i]].shape, bodies[i].position};
          ASSERT_TRUE(same_bits(memory.box(i), expected_bounds(body, positions))) << i;
        }
      }
    }
  });
}

TEST(Bounds, OfAnyCount) {
  std::vector<size_t> counts;
  for (size_t count = 0; count <= rounds(70, 20); ++count) counts.push_back(count);
  for (const size_t block : {kBodiesPerBlock, 2 * kBodiesPerBlock}) {
    for (const size_t count : {block - 17, block - 1, block, block + 1, block + 17}) {
      counts.push_back(count);
    }
  }
  for_each_isa([&] {
    for (const size_t count : counts) {
      for (const PositionType positions : kPositionTypes) {
        const Layout layout{.positions = positions};
        expect_bounds(make_bodies(Sides::sphere_sphere, {.name = ""}, positions, count), layout);
        expect_bounds(make_bodies(Sides::aabb_aabb, {.name = ""}, positions, count), layout);
      }
    }
  });
}

TEST(Bounds, OfPointsAndOfBoxesInWorldCoordinates) {
  for_each_isa([] {
    Bodies points = make_bodies(Sides::sphere_sphere, {.name = ""}, PositionType::float32, 99);
    for (PlacedShape& point : points) point.shape = Sphere{0};
    expect_bounds(points, {.radius = RadiusLayout::none});

    Bodies boxes = make_bodies(Sides::aabb_aabb, {.name = ""}, PositionType::float32, 99);
    for (PlacedShape& body : boxes) body.position.setZero();
    const LaidOut set(boxes, {});
    BoundsMemory memory(boxes.size());
    compute_bounds(world_boxes(set.view().boxes, boxes.size()), memory.out());
    for (size_t i = 0; i < boxes.size(); ++i) {
      EXPECT_TRUE(same_bits(memory.box(i), expected_bounds(boxes[i], PositionType::float32)));
    }
  });
}

TEST(Bounds, InvalidBodiesAreEmptyAndCounted) {
  const Bodies bodies = {sphere(0, 0, 0, -1),
                         sphere(0, 0, 0, -1e-45f),
                         sphere(0, 0, 0, kInfinity),
                         sphere(0, 0, 0, kNan),
                         sphere(kNan, 0, 0, 1),
                         sphere(0, -kInfinity, 0, 1),
                         sphere(0, 0, kInfinity, 1),
                         sphere(0, 0, 0, -0.0f),
                         box({0, 0, 0}, {1, -1, 1}),
                         box({0, 0, 0}, {1, 1, kNan}),
                         box({0, 0, 0}, {kInfinity, 1, 1})};
  for_each_isa([&] {
    for (size_t repeat = 0; repeat < 3; ++repeat) {
      Bodies many;
      for (size_t i = 0; i <= repeat * 9; ++i)
        many.insert(many.end(), bodies.begin(), bodies.end());
      for (const FloatMode& mode : float_modes()) {
        for (const PositionType positions : kPositionTypes) {
          expect_bounds(many, {.positions = positions}, mode);
        }
      }
    }
  });
  // The position overflows float32, but not float64.
  expect_bounds(Bodies(1, sphere(1e39, 0, 0, 1)), {.positions = PositionType::float64});
}

// Positions and sizes at the limits of float32.
Bodies extremes() {
  const float values[] = {0.0f, -0.0f,         1e-45f,  -1e-45f, 0x1p-126f, -0x1p-126f, 1,
                          -1,   0x1.fffffep0f, 0x1p24f, FLT_MAX, -FLT_MAX,  3e38f,      -3e38f};
  Bodies bodies;
  for (const float position : values) {
    for (const float radius : values) bodies.push_back(sphere(position, -position, 0, radius));
    for (const float lower : values) {
      for (const float upper : values) {
        bodies.push_back(
            {Aabb{{lower, lower, lower}, {upper, upper, upper}}, {position, position, 0}});
      }
    }
  }
  return bodies;
}

TEST(Bounds, AtTheLimitsOfFloats) {
  const Bodies bodies = extremes();
  for_each_isa([&] {
    for (const FloatMode& mode : float_modes()) {
      for (const PositionType positions : kPositionTypes) {
        expect_bounds(bodies, {.positions = positions}, mode);
      }
    }
  });
}

TEST(Bounds, AreThoseOfTheReference) {
  for (const PositionType positions : kPositionTypes) {
    Bodies bodies = extremes();
    for (const Family& family : families()) {
      const Bodies more = make_bodies(Sides::aabb_aabb, family, positions, 200);
      bodies.insert(bodies.end(), more.begin(), more.end());
    }
    for (const PlacedShape& body : bodies) {
      const reference::Box expected = reference::bounds(body.shape, body.pose(), positions);
      const reference::Box got = expected_bounds(body, positions);
      EXPECT_TRUE(same_bits(got, expected))
          << show(body) << ", " << name(positions) << "\n"
          << hex3(got.lower) << " .. " << hex3(got.upper) << ", reference\n"
          << hex3(expected.lower) << " .. " << hex3(expected.upper);
      if (HasFailure()) return;
    }
  }
}

TEST(Bounds, AreTheSameOnThreads) {
  for (const int threads : {1, 2, 4}) {
    ThreadArena arena(threads);
    arena.run([&] {
      for (const PositionType positions : kPositionTypes) {
        const Bodies bodies = make_bodies(Sides::aabb_aabb, {.name = ""}, positions, 5000);
        for (const FloatMode& mode : float_modes()) {
          expect_bounds(bodies, {.positions = positions}, mode, arena.parallelism());
        }
      }
    });
  }
}

}  // namespace
}  // namespace carom::test
