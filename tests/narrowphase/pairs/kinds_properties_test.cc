// Properties of every pair of kinds that need no oracle.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/run.h"
#include "tests/support/textbook.h"

namespace carom::test {
namespace {

using Result = reference::PairResult;

double size_of(const TestPair& pair) {
  return bounding_radius(pair.a.shape) + bounding_radius(pair.b.shape);
}

// Twice the stated error.
double rounding(const TestPair& pair, const Result& result) {
  return 4e-6 * (size_of(pair) + std::fabs(result.separation)) + 0x1p-143;
}

// NaN equals NaN here: a body behind a one-sided triangle has a NaN normal.
void expect_same(const Eigen::Vector3f& x, const Eigen::Vector3f& y) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(x[i] == y[i] || (std::isnan(x[i]) && std::isnan(y[i]))) << hex3(x) << "\n"
                                                                        << hex3(y);
  }
}

void expect_close(const TestPair& pair, const Result& result, const Result& other) {
  if (result.separation == other.separation) return;
  EXPECT_NEAR(result.separation, other.separation, rounding(pair, result));
  if (std::fabs(result.separation) > rounding(pair, result)) {
    EXPECT_EQ(result.overlap, other.overlap);
  }
}

// Pairs of every two kinds from every family.
template <class Check>
void for_each_pair(size_t count_each, const Check& check) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    for (const PositionType positions : kPositionTypes) {
      std::vector<TestPair> pairs =
          make_pairs_of_families(kinds, positions, fewer_if_slow(kinds, count_each));
      vary_triangles(pairs);
      for (const TestPair& pair : pairs) {
        const ShownIfFailed shown([&] { return show(pair) + "\n" + name(positions); });
        check(pair, positions);
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

// One kernel serves both orders of two kinds, so the results are mirrored.
void expect_mirrored(const Result& result, const Result& other) {
  EXPECT_EQ(result.overlap, other.overlap);
  EXPECT_EQ(result.status, other.status);
  EXPECT_EQ(result.separation, other.separation);
  expect_same(result.normal, -other.normal);
  expect_same(result.arm_a, other.arm_b);
  expect_same(result.arm_b, other.arm_a);
  EXPECT_EQ(result.manifold_count, other.manifold_count);
  EXPECT_EQ(result.manifold.separation, other.manifold.separation);
}

// Points on A, moved to B along the normal, are the points of the other order.
void expect_mirrored_points(const TestPair& pair, PositionType positions, const Result& result,
                            const Result& other) {
  const Eigen::Vector3d d = stored(pair.b.position, positions) - stored(pair.a.position, positions);
  for (size_t i = 0; i < result.manifold_count; ++i) {
    const Eigen::Vector3d on_a =
        Eigen::Map<const Eigen::Vector3f>(result.manifold.point[i].data()).cast<double>();
    const Eigen::Vector3d on_b =
        Eigen::Map<const Eigen::Vector3f>(other.manifold.point[i].data()).cast<double>();
    const Eigen::Vector3d way = result.normal.cast<double>() * result.manifold.separation[i];
    // The sum of position and arm is in float32, and bodies may be far from a half-space.
    const double tolerance = rounding(pair, result) + 0x1p-22 * d.norm();
    EXPECT_LE((on_a + way - d - on_b).norm(), tolerance) << "manifold point " << i;
  }
}

TEST(KindsProperties, TheOtherOrderIsTheOtherSide) {
  for_each_pair(20, [](const TestPair& pair, PositionType positions) {
    const Result result = reference_result(pair, positions);
    const Result other = reference_result(swapped(pair), positions);
    if (kind_of(pair.a.shape) == kind_of(pair.b.shape)) {
      EXPECT_EQ(result.status, other.status);
      expect_close(pair, result, other);
    } else {
      expect_mirrored(result, other);
      expect_mirrored_points(pair, positions, result, other);
    }
  });
}

TEST(KindsProperties, OverlapIsTheDecisionOfContactAndManifold) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    const std::vector<TestPair> pairs =
        make_pairs_of_families(kinds, PositionType::float32, fewer_if_slow(kinds, 25));
    for_each_isa([&] {
      const auto rows_at = [&](Detail detail) {
        Call call;
        call.detail = detail;
        return run_rows(pairs, call);
      };
      const std::vector<Row> overlap = rows_at(Detail::overlap);
      const std::vector<Row> contact = rows_at(Detail::contact);
      const std::vector<Row> manifold = rows_at(Detail::manifold);
      for (size_t i = 0; i < pairs.size() && !testing::Test::HasFailure(); ++i) {
        const ShownIfFailed shown([&] { return show(pairs[i]); });
        EXPECT_EQ(overlap[i].overlap, contact[i].overlap);
        EXPECT_EQ(overlap[i].status, contact[i].status);
        EXPECT_EQ(contact[i].overlap, contact[i].separation <= 0);
        EXPECT_EQ(std::memcmp(&contact[i].separation, &manifold[i].separation, 40), 0);
        EXPECT_EQ(manifold[i].manifold_count > 0, manifold[i].overlap == 1);
      }
    });
  }
}

TEST(KindsProperties, ThePlaceInTheListDoesNotMatter) {
  const std::vector<TestPair> pairs =
      make_mixed_kind_pairs({.name = ""}, PositionType::float32, 2000);
  Call call;
  call.detail = Detail::manifold;
  for_each_isa([&] {
    Random random(7);
    std::vector<size_t> order(pairs.size());
    std::iota(order.begin(), order.end(), 0);
    const std::vector<Row> rows = run_list(pairs, call);
    for (int round = 0; round < 3; ++round) {
      for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
      std::vector<TestPair> shuffled_pairs;
      std::vector<Row> shuffled_rows;
      for (const size_t i : order) {
        shuffled_pairs.push_back(pairs[i]);
        shuffled_rows.push_back(rows[i]);
      }
      EXPECT_TRUE(same_rows(shuffled_rows, run_list(shuffled_pairs, call), shuffled_pairs));
    }
  });
}

// Multiples of 2^-10 keep their difference exactly when both positions move by a power of two.
// Every bit then stays the same, except for the rounding of world points.
TEST(KindsProperties, ThePlaceInTheWorldDoesNotMatter) {
  const auto to_grid = [](double x) { return std::round(x * 0x1p10) * 0x1p-10 + 0.0; };  // not -0
  for (const PositionType positions : kPositionTypes) {
    std::vector<TestPair> pairs = make_mixed_kind_pairs({.name = ""}, positions, 1000);
    for (TestPair& pair : pairs) {
      pair.a.position = pair.a.position.unaryExpr(to_grid);
      pair.b.position = pair.b.position.unaryExpr(to_grid);
    }
    Call call = call_with(positions);
    call.frame = WitnessFrame::body;
    call.detail = Detail::manifold;
    const std::vector<Row> rows = run_list(pairs, call);
    const double largest = positions == PositionType::float32 ? 0x1p12 : 0x1p40;
    for (double offset = 1; offset <= largest; offset *= 4) {
      std::vector<TestPair> moved = pairs;
      for (TestPair& pair : moved) {
        pair.a.position += Eigen::Vector3d(offset, -offset, offset);
        pair.b.position += Eigen::Vector3d(offset, -offset, offset);
      }
      EXPECT_TRUE(same_rows(rows, run_list(moved, call), moved));
    }
  }
}

struct Scaled {
  float factor;

  void operator()(Sphere& sphere) const { sphere.radius *= factor; }
  void operator()(Aabb& box) const { box.lower *= factor, box.upper *= factor; }
  void operator()(Capsule& c) const { c.a *= factor, c.b *= factor, c.radius *= factor; }
  void operator()(Box& box) const { box.half *= factor; }
  void operator()(Cylinder& c) const { c.radius *= factor, c.half_length *= factor; }
  void operator()(Cone& c) const { c.radius *= factor, c.half_length *= factor; }
  void operator()(Ellipsoid& e) const { e.semi_axes *= factor; }
  void operator()(Triangle& triangle) const {
    for (Eigen::Vector3f& corner : triangle.corners) corner *= factor;
    triangle.thickness *= factor;
  }
  void operator()(Halfspace& halfspace) const { halfspace.offset *= factor; }
  void operator()(Dop& dop) const {
    for (float& end : dop.lower) end *= factor;
    for (float& end : dop.upper) end *= factor;
  }
  void operator()(Hull& hull) const {
    hull = with_points(hull, [this](Eigen::Vector3f& point) { point *= factor; });
  }
  void operator()(Mesh& /*tested by its parts*/) const {}
  void operator()(HeightField& /*tested by its parts*/) const {}
  void operator()(Compound& /*tested by its parts*/) const {}

  void operator()(PlacedShape& body) const {
    body.position *= factor;
    std::visit(*this, body.shape);
    std::visit(
        [this](auto& shape) {
          if constexpr (requires { shape.rounding; }) shape.rounding *= factor;
        },
        body.shape);
  }
};

void expect_scaled(const Result& result, const Result& other, float factor) {
  EXPECT_EQ(other.overlap, result.overlap);
  EXPECT_EQ(other.status, result.status);
  EXPECT_EQ(other.separation, result.separation * factor);
  expect_same(other.normal, result.normal);
  expect_same(other.arm_a, result.arm_a * factor);
  expect_same(other.arm_b, result.arm_b * factor);
  ASSERT_EQ(other.manifold_count, result.manifold_count);
  for (size_t i = 0; i < result.manifold_count; ++i) {
    EXPECT_EQ(other.manifold.separation[i], result.manifold.separation[i] * factor);
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(other.manifold.point[i][k], result.manifold.point[i][k] * factor);
    }
  }
}

// Whether scaling keeps all numbers of the body in the range of floats.
bool is_ordinary(const PlacedShape& body) {
  return ((body.position.array() == 0) || (body.position.array().abs() > 1e-20)).all();
}

// Scaling by a power of two is exact, so the result scales exactly.
TEST(KindsProperties, ScalingByAPowerOfTwoScalesTheResult) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    for (const ConvexFamily& family : convex_families()) {
      if (family.smallest < 0.1 || family.largest > 10) continue;
      std::vector<TestPair> pairs =
          make_kind_pairs(family, kinds, PositionType::float32, fewer_if_slow(kinds, 15));
      vary_triangles(pairs);
      for (const TestPair& pair : pairs) {
        if (!is_ordinary(pair.a) || !is_ordinary(pair.b)) continue;
        const ShownIfFailed shown([&] { return std::string(family.name) + "\n" + show(pair); });
        const Result result = reference_result(pair, PositionType::float32);
        for (const float factor : {0x1p-40f, 0x1p-3f, 0x1p-1f, 0x1p1f, 0x1p7f, 0x1p40f}) {
          SCOPED_TRACE(factor);
          TestPair scaled = pair;
          Scaled{factor}(scaled.a);
          Scaled{factor}(scaled.b);
          expect_scaled(result, reference_result(scaled, PositionType::float32), factor);
        }
        if (HasFailure()) return;
      }
    }
  }
}

// The body after an exact quarter turn about z: position, box and orientation.
PlacedShape quarter_turned(PlacedShape body) {
  body.position = {-body.position.y(), body.position.x(), body.position.z()};
  if (auto* box = std::get_if<Aabb>(&body.shape)) {
    const Aabb before = *box;
    box->lower.head<2>() << -before.upper.y(), before.lower.x();
    box->upper.head<2>() << -before.lower.y(), before.upper.x();
  }
  const Eigen::Vector4f q = body.orientation.coeffs();
  // (0, 0, 1, 1) times q, of twice the squared length.
  body.orientation.coeffs() << q.x() - q.y(), q.y() + q.x(), q.z() + q.w(), q.w() - q.z();
  return body;
}

// The result turns, too, up to the rounding of the quaternion.
TEST(KindsProperties, AQuarterTurnOfBothTurnsTheResult) {
  for (const char* which : {"plain", "aspect", "lattice", "near parallel"}) {
    for (const ConvexFamily& family : convex_families()) {
      if (std::string(family.name) != which) continue;
      for (const KindPair& kinds : supported_kind_pairs()) {
        for (const TestPair& pair :
             make_kind_pairs(family, kinds, PositionType::float64, fewer_if_slow(kinds, 60))) {
          const ShownIfFailed shown([&] { return show(pair); });
          const TestPair turned{quarter_turned(pair.a), quarter_turned(pair.b)};
          expect_close(pair, reference_result(pair, PositionType::float64),
                       reference_result(turned, PositionType::float64));
          if (HasFailure()) return;
        }
      }
    }
  }
}

bool same_bits(const Result& x, const Result& y) {
  const auto bytes = [](const Result& r) {
    std::string text;
    for (const float value : {r.separation, r.normal.x(), r.normal.y(), r.normal.z(), r.arm_a.x(),
                              r.arm_a.y(), r.arm_a.z(), r.arm_b.x(), r.arm_b.y(), r.arm_b.z()}) {
      text += hex(value) + " ";
    }
    return text + show(r.manifold) + std::to_string(r.manifold_count) +
           std::to_string(static_cast<int>(r.status));
  };
  return bytes(x) == bytes(y);
}

TEST(KindsProperties, TheSizeOfAQuaternionDoesNotMatter) {
  for_each_pair(5, [](const TestPair& pair, PositionType positions) {
    const Result result = reference_result(pair, positions);
    for (const float factor : {0x1p-50f, 0x1p-31f, 0x1p-29f, 0x1p-1f, -1.0f, 0x1p1f, 0x1p29f,
                               0x1p31f, 0x1p60f, 0x1p100f}) {
      SCOPED_TRACE(factor);
      TestPair other = pair;
      other.a.orientation.coeffs() *= factor;
      other.b.orientation.coeffs() *= factor;
      EXPECT_TRUE(same_bits(result, reference_result(other, positions)));
    }
  });
}

// A capsule without length is a sphere.
TEST(KindsProperties, ACapsuleWithoutLengthIsASphere) {
  for (const ShapeKind kind : kConvexKinds) {
    if (!supports(ShapeKind::capsule, kind) || !supports(ShapeKind::sphere, kind)) continue;
    const KindPair kinds{ShapeKind::sphere, kind};
    for (TestPair pair :
         make_pairs_of_families(kinds, PositionType::float32, fewer_if_slow(kinds, 10))) {
      const ShownIfFailed shown([&] { return show(pair); });
      const Result result = reference_result(pair, PositionType::float32);
      const float radius = std::get<Sphere>(pair.a.shape).radius;
      pair.a.shape = Capsule{Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), radius};
      expect_close(pair, result, reference_result(pair, PositionType::float32));
    }
  }
}

}  // namespace
}  // namespace carom::test
