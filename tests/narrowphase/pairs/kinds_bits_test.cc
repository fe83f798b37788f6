// Every pair of kinds with a kernel, on every ISA, against the reference, bit for bit.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr Detail kDetails[] = {Detail::overlap, Detail::contact, Detail::manifold};

void expect_reference_bits(std::span<const TestPair> pairs,
                           std::span<const reference::PairResult> results, Call call) {
  const LaidOutRowPairs rows(pairs, call);
  const LaidOutListPairs list(pairs, call);
  for (const Detail detail : kDetails) {
    SCOPED_TRACE("detail " + std::to_string(static_cast<int>(detail)));
    call.detail = detail;
    const std::vector<Row> expected =
        rows_of(results, pairs, call.layout_a.positions, detail, call.frame);
    for_each_isa([&] {
      EXPECT_TRUE(same_rows(expected, rows.run(call), pairs));
      EXPECT_TRUE(same_rows(expected, list.run(call), pairs));
    });
  }
}

void expect_reference_bits(std::span<const TestPair> pairs, const Call& call) {
  expect_reference_bits(pairs, reference_results(pairs, call.layout_a.positions), call);
}

class KindsBits : public testing::TestWithParam<ConvexFamily> {};

TEST_P(KindsBits, EqualReference) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    for (const PositionType positions : kPositionTypes) {
      SCOPED_TRACE(name(kinds) + ", " + name(positions));
      std::vector<TestPair> pairs =
          make_kind_pairs(GetParam(), kinds, positions, fewer_if_slow(kinds, 70));
      vary_triangles(pairs);
      expect_reference_bits(pairs, call_with(positions));
    }
  }
}

std::vector<ConvexFamily> convex_families_to_the_limits() {
  std::vector<ConvexFamily> all = convex_families();
  all.push_back({.name = "huge", .smallest = 1e30, .largest = 3e38, .distance_in_sizes = true});
  // The greatest sizes are just inside the range of floats.
  all.push_back({.name = "huge ratio", .smallest = 1e-24, .largest = 1e19, .ratio = 1e19});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Families, KindsBits, testing::ValuesIn(convex_families_to_the_limits()),
                         family_name);

TEST(KindsBits, EqualReferenceForAnyInput) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const std::vector<TestPair> pairs =
        make_kind_nonsense(kinds, fewer_if_slow(kinds, rounds(1500)));
    for (const PositionType positions : kPositionTypes) {
      expect_reference_bits(pairs, call_with(positions));
    }
  }
}

void keep_corners(Shape& shape) {
  if (Dop* dop = std::get_if<Dop>(&shape)) dop->geometry = dop_geometry(*dop);
}

// Corners that are kept are those that the reference finds in the unit of each test.
TEST(KindsBits, DopsWithTheirCorners) {
  size_t kept = 0;
  for (const ConvexFamily& family : convex_families_to_the_limits()) {
    for (const KindPair& kinds : supported_kind_pairs()) {
      if (kinds.a != ShapeKind::dop && kinds.b != ShapeKind::dop) continue;
      SCOPED_TRACE(std::string(family.name) + ", " + name(kinds));
      std::vector<TestPair> pairs =
          make_kind_pairs(family, kinds, PositionType::float32, rounds(6));
      const auto results = reference_results(pairs, PositionType::float32);
      for (TestPair& pair : pairs) {
        keep_corners(pair.a.shape);
        keep_corners(pair.b.shape);
        const Dop* dop = std::get_if<Dop>(&pair.a.shape);
        kept += dop && dop->geometry;
      }
      expect_reference_bits(pairs, results, call_with(PositionType::float32));
    }
  }
  EXPECT_GT(kept, rounds(500));
}

// Batches with k-DOPs run in parts of 256 rows.
TEST(KindsBits, DopsInSeveralParts) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    if (kinds.a != ShapeKind::dop && kinds.b != ShapeKind::dop) continue;
    SCOPED_TRACE(name(kinds));
    std::vector<TestPair> few =
        make_kind_pairs(convex_families().front(), kinds, PositionType::float32, 7);
    const auto results_of_few = reference_results(few, PositionType::float32);
    for (TestPair& pair : few) {
      keep_corners(pair.a.shape);
      keep_corners(pair.b.shape);
    }
    for (const size_t count : {255u, 256u, 257u, 600u}) {
      std::vector<TestPair> pairs;
      std::vector<reference::PairResult> results;
      for (size_t i = 0; i < count; ++i) {
        pairs.push_back(few[i % few.size()]);
        results.push_back(results_of_few[i % few.size()]);
      }
      expect_reference_bits(pairs, results, call_with(PositionType::float32));
    }
  }
}

// Found by kinds_fuzz: a quaternion of ordinary length with a tiny component was scaled, and lost
// bits of it, because its neighbour in the vector needed scaling.
TEST(KindsBits, OrientationsAreScaledEachByItself) {
  const Quaternionf tiny(-0x1.7ep-142f, -0x1.7b9998p+27f, -0x1.7c9998p-74f, -0x1.32p-142f);
  const Quaternionf huge(0x1.7ecccp+77f, -0x1.7b9998p+27f, -0x1.7c9998p-74f, 0x1.7d3332p+77f);
  const TestPair pair{{Halfspace{{-1, 0, 0}, 0.5f}, {0, 0, 0}, tiny},
                      {Capsule{{0, 0, 0x1.7fp-134f}, {0, 0, 0}, 0}, {0.7, 0.9, -0.4}, huge}};
  for (const PositionType positions : kPositionTypes) {
    expect_reference_bits({&pair, 1}, call_with(positions));
    const TestPair other = swapped(pair);
    expect_reference_bits({&other, 1}, call_with(positions));
  }
}

// The centre is so close to a corner that float32 cannot resolve the direction: double precision
// decides.
TEST(KindsBits, SphereAtACornerOfATriangle) {
  const Triangle triangles[] = {
      {.corners = {Vector3f(0, 0, 1), Vector3f(0x1p-60f, 0, 0), Vector3f(1, 0x1.333334p-2f, 0)}},
      {.corners = {Vector3f(-0x1.b71092p-1f, -0x1.b8b906p-1f, 0x1.cf7afcp-2f),
                   Vector3f(-0x1.5b22aap-79f, -0x1.bfcf24p-80f, 0x1.0e49a6p-82f),
                   Vector3f(-0x1.63a6ecp-4f, -0x1.a4405ep-1f, 0x1.b80c16p-3f)}}};
  for (const Triangle& triangle : triangles) {
    for (const PositionType positions : kPositionTypes) {
      const TestPair pair{sphere(0, 0, 0, 1), {triangle, {0, 0, 0}}};
      expect_reference_bits({&pair, 1}, call_with(positions));
      const TestPair other = swapped(pair);
      expect_reference_bits({&other, 1}, call_with(positions));
    }
  }
}

// Float64 positions beyond the range of float32; only their difference is inside it.
TEST(KindsBits, EqualReferenceForDistantFloat64Positions) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    for (const double distance : {1e12, 1e30, 1e38, 3e38}) {
      const ConvexFamily family{.name = "",
                                .smallest = 1e-6 * distance,
                                .largest = 1e-3 * distance,
                                .distance = distance};
      expect_reference_bits(make_kind_pairs(family, kinds, PositionType::float64,
                                            fewer_if_slow(kinds, rounds_of_pairs(40))),
                            call_with(PositionType::float64));
    }
  }
}

TEST(KindsBits, CountsAroundLanes) {
  std::vector<size_t> counts = {31, 32, 33, 63, 64, 65, 127, 128, 129, 255, 256, 257, 1025};
  for (size_t count = 0; count <= 17; ++count) counts.push_back(count);
  Call call;
  call.detail = Detail::manifold;
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const std::vector<TestPair> pairs = make_kind_pairs({.name = ""}, kinds, PositionType::float32,
                                                        fewer_if_slow(kinds, rounds(1025, 65)));
    const std::vector<Row> expected = expected_rows(pairs, PositionType::float32, Detail::manifold);
    for_each_isa([&] {
      for (const size_t count : counts) {
        if (count > pairs.size()) continue;
        SCOPED_TRACE(count);
        const auto first_pairs = std::span(pairs).first(count);
        const auto first_rows = std::span(expected).first(count);
        EXPECT_TRUE(same_rows(first_rows, run_rows(first_pairs, call), first_pairs));
        EXPECT_TRUE(same_rows(first_rows, run_list(first_pairs, call), first_pairs));
      }
    });
  }
}

std::vector<Layout> layouts(PositionType positions) {
  const Layout plain{.positions = positions};
  std::vector<Layout> all(6, plain);
  all[1].orientation_stride = 0;
  all[2].rows = RowOrder::backwards;
  all[3].rows = RowOrder::shared;
  all[3].orientation_stride = 20;
  all[4].box_slots = true;
  all[4].orientation_stride = 48;
  all[4].stride = 64;
  all[5].radius = RadiusLayout::column;
  all[5].always_kinds = true;
  return all;
}

TEST(KindsBits, Layouts) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    for (const PositionType positions : kPositionTypes) {
      std::vector<TestPair> pairs =
          make_kind_pairs({.name = ""}, kinds, positions, fewer_if_slow(kinds, rounds(69, 17)));
      for (size_t i = 1; i < pairs.size(); i += 3) {  // some bodies share their shapes
        pairs[i].a.shape = pairs[0].a.shape;
        pairs[i].b.shape = pairs[0].b.shape;
      }
      const std::vector<reference::PairResult> results = reference_results(pairs, positions);
      for (const Layout& layout : layouts(positions)) {
        SCOPED_TRACE(name(kinds) + ", " + show(layout));
        Call call;
        call.layout_a = call.layout_b = layout;
        expect_reference_bits(pairs, results, call);
      }
    }
  }
}

TEST(KindsBits, OrientationsAreTheIdentityWhereAbsent) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    std::vector<TestPair> pairs =
        make_kind_pairs({.name = ""}, kinds, PositionType::float32, rounds_of_pairs(40));
    for (TestPair& pair : pairs) pair.a.orientation.setIdentity();
    Call call;
    call.layout_a.orientation_stride = 0;
    const std::vector<Row> expected = expected_rows(pairs, PositionType::float32);
    for_each_isa([&] { EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs)); });
  }
}

TEST(KindsBits, MixedKindsInOneList) {
  constexpr const char* kFamilies[] = {"plain", "touch", "lattice", "degenerate"};
  for (const char* family : std::span(kFamilies).first(rounds(4))) {
    const auto families = convex_families();
    const auto found = std::find_if(families.begin(), families.end(), [&](const auto& each) {
      return std::string(each.name) == family;
    });
    ASSERT_NE(found, families.end());
    for (const PositionType positions : kPositionTypes) {
      const std::vector<TestPair> pairs = make_mixed_kind_pairs(*found, positions, 1500);
      const std::vector<reference::PairResult> results = reference_results(pairs, positions);
      for (const Layout& layout : layouts(positions)) {
        SCOPED_TRACE(std::string(family) + ", " + show(layout));
        Call call;
        call.layout_a = call.layout_b = layout;
        for (const size_t count : {1, 2, 3, 17, 1023, 1024, 1025, 1500}) {
          expect_reference_bits(std::span(pairs).first(count), results, call);
        }
      }
    }
  }
}

TEST(KindsBits, BodyFrameWitnesses) {
  for (const PositionType positions : kPositionTypes) {
    Call call = call_with(positions);
    call.frame = WitnessFrame::body;
    expect_reference_bits(make_mixed_kind_pairs({.name = "", .distance = 1e6}, positions, 700),
                          call);
  }
}

TEST(KindsBits, ColumnsLeftOut) {
  const std::vector<TestPair> pairs =
      make_mixed_kind_pairs({.name = ""}, PositionType::float32, 300);
  const std::vector<Row> complete = expected_rows(pairs, PositionType::float32, Detail::manifold);
  Call call;
  call.detail = Detail::manifold;
  for_each_isa([&] {
    for (unsigned missing = 0; missing < 1u << Columns::kColumns; missing += 1021) {
      std::vector<Row> expected = complete;
      for (Row& row : expected) forget_columns(row, missing);
      call.missing = missing;
      EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs));
      EXPECT_TRUE(same_rows(expected, run_list(pairs, call), pairs));
    }
  });
}

TEST(KindsBits, DoNotDependOnThreads) {
  const std::vector<TestPair> pairs =
      make_mixed_kind_pairs({.name = ""}, PositionType::float32, 6000);
  const std::vector<Row> expected = expected_rows(pairs, PositionType::float32, Detail::manifold);
  Call call;
  call.detail = Detail::manifold;
  call.parallelism = Parallelism::arena;
  for_each_isa([&] {
    for (const int threads : {1, 2, 4}) {
      SCOPED_TRACE(threads);
      tbb::task_arena arena(threads);
      arena.execute([&] { EXPECT_TRUE(same_rows(expected, run_list(pairs, call), pairs)); });
    }
  });
}

TEST(KindsBits, DoNotDependOnTheFloatModeOfTheCaller) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const std::vector<TestPair> pairs =
        make_pairs_of_families(kinds, PositionType::float32, fewer_if_slow(kinds, 5));
    Call call;
    call.detail = Detail::manifold;
    call.frame = WitnessFrame::body;
    const std::vector<Row> expected =
        expected_rows(pairs, PositionType::float32, call.detail, call.frame);
    for_each_isa([&] {
      for (const FloatMode& mode : float_modes()) {
        SCOPED_TRACE(mode.name);
        call.mode = mode;
        EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs));
        EXPECT_TRUE(same_rows(expected, run_list(pairs, call), pairs));
      }
    });
  }
}

}  // namespace
}  // namespace carom::test
