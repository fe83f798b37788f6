// NaN, infinity, negative sizes, a quaternion or a normal of zero: they spoil their own pair and no
// other, of every two kinds (65 of the cases).
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kBad[] = {kNan, kInfinity, -kInfinity};

// Bodies like `body` but for one number that is out of the question.
class SpoiltBodies {
 public:
  explicit SpoiltBodies(const PlacedShape& body) : body_(body) {
    for (const float bad : kBad) {
      for (int axis = 0; axis < 3; ++axis) {
        add([&](PlacedShape& b) { b.position[axis] = bad; });
      }
    }
    if (has_rows(body.shape)) add_orientations();
    std::visit([this](const auto& shape) { add_shapes(shape); }, body.shape);
  }

  const std::vector<PlacedShape>& all() const { return all_; }

 private:
  template <class Change>
  void add(const Change& change) {
    all_.push_back(body_);
    change(all_.back());
  }

  void add_orientations() {
    for (const float bad : kBad) {
      for (int c = 0; c < 4; ++c) {
        add([&](PlacedShape& b) { b.orientation.coeffs()[c] = bad; });
      }
    }
    add([](PlacedShape& b) { b.orientation.coeffs().setZero(); });
    add([](PlacedShape& b) { b.orientation.coeffs().setConstant(-0.0f); });
  }

  template <class T, class Change>
  void add_shape(T shape, const Change& change) {
    change(shape);
    all_.push_back(body_);
    all_.back().shape = shape;
  }
  template <class T>
  void add_vectors(const T& shape, Eigen::Vector3f T::*vector) {
    for (const float bad : kBad) {
      for (int i = 0; i < 3; ++i) add_shape(shape, [&](T& s) { (s.*vector)[i] = bad; });
    }
  }
  template <class T>
  void add_size(const T& shape, float T::*size) {
    for (const float bad : {kNan, kInfinity, -kInfinity, -1.0f, -1e-45f}) {
      add_shape(shape, [&](T& s) { s.*size = bad; });
    }
  }

  void add_shapes(const Sphere& sphere) { add_size(sphere, &Sphere::radius); }
  void add_shapes(const Aabb& box) {
    add_vectors(box, &Aabb::lower);
    add_vectors(box, &Aabb::upper);
    for (int i = 0; i < 3; ++i) {
      add_shape(box, [&](Aabb& b) { std::swap(b.lower[i], b.upper[i]); });
    }
  }
  void add_shapes(const Capsule& capsule) {
    add_vectors(capsule, &Capsule::a);
    add_vectors(capsule, &Capsule::b);
    add_size(capsule, &Capsule::radius);
  }
  void add_shapes(const Box& box) {
    add_vectors(box, &Box::half);
    for (int i = 0; i < 3; ++i) {
      add_shape(box, [&](Box& b) { b.half[i] = -1e-45f; });
    }
  }
  void add_shapes(const Triangle& triangle) {
    for (size_t corner = 0; corner < 3; ++corner) {
      for (const float bad : kBad) {
        add_shape(triangle, [&](Triangle& t) { t.corners[corner][2] = bad; });
      }
    }
    add_size(triangle, &Triangle::thickness);
    add_shape(triangle, [](Triangle& t) { t.inner_edges = 8; });
  }
  void add_shapes(const Halfspace& halfspace) {
    add_vectors(halfspace, &Halfspace::normal);
    add_shape(halfspace, [](Halfspace& h) { h.normal.setZero(); });
    for (const float bad : kBad) add_shape(halfspace, [&](Halfspace& h) { h.offset = bad; });
  }

  void add_shapes(const Dop& dop) {
    const size_t last = slab_count(dop.kind) - 1;
    for (const size_t slab : {size_t{0}, last}) {
      for (const float bad : kBad) {
        add_shape(dop, [&](Dop& d) { d.lower[slab] = bad; });
        add_shape(dop, [&](Dop& d) { d.upper[slab] = bad; });
      }
      add_shape(dop, [&](Dop& d) { std::swap(d.lower[slab], d.upper[slab]); });
    }
    for (const int kind : {0, 7, 8, 16, 200}) {
      add_shape(dop, [&](Dop& d) { d.kind = static_cast<DopKind>(kind); });
    }
    if (last < 3) return;
    add_shape(dop, [&](Dop& d) {  // in order, and nothing in common
      d.lower[last] =
          8 * (std::fabs(d.upper[1]) + std::fabs(d.lower[1]) + 1 + std::fabs(d.upper[0]) +
               std::fabs(d.lower[0]) + std::fabs(d.upper[2]) + std::fabs(d.lower[2]));
      d.upper[last] = 2 * d.lower[last];
    });
  }

  // Its numbers are checked when it is made.
  void add_shapes(const Hull& hull) {
    add_shape(hull, [](Hull& h) { h.geometry = nullptr; });
  }
  void add_shapes(const Mesh& /*tested by its parts*/) {}
  void add_shapes(const Compound& /*tested by its parts*/) {}

  PlacedShape body_;
  std::vector<PlacedShape> all_;
};

void expect_no_answer(const Row& row) {
  EXPECT_EQ(row.overlap, 0);
  EXPECT_EQ(row.status, static_cast<uint8_t>(Status::invalid));
  EXPECT_EQ(row.manifold_count, 0);
  const auto* bytes = reinterpret_cast<const char*>(&row);
  for (size_t at = offsetof(Row, separation); at < sizeof row; at += sizeof(uint32_t)) {
    uint32_t bits;
    std::memcpy(&bits, bytes + at, sizeof bits);
    const bool is_unused_point = at >= offsetof(Row, manifold);
    EXPECT_EQ(bits, is_unused_point ? 0 : 0x7fc00000u) << "byte " << at;
  }
}

// Every way to spoil either side of the pair.
std::vector<TestPair> spoilt(const TestPair& pair) {
  std::vector<TestPair> all;
  const SpoiltBodies spoilt_a(pair.a);
  const SpoiltBodies spoilt_b(pair.b);
  for (const PlacedShape& body : spoilt_a.all()) all.push_back({body, pair.b});
  for (const PlacedShape& body : spoilt_b.all()) all.push_back({pair.a, body});
  return all;
}

TEST(KindsInvalid, HasNoAnswer) {
  Call call;
  call.detail = Detail::manifold;
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const auto pair = make_kind_pairs({.name = ""}, kinds, PositionType::float32, 1)[0];
    const std::vector<TestPair> pairs = spoilt(pair);
    const auto expected = expected_rows(pairs, PositionType::float32, call.detail);
    for_each_isa([&] {
      for (const auto& run : {run_rows, run_list}) {
        const std::vector<Row> rows = run(pairs, call);
        EXPECT_TRUE(same_rows(expected, rows, pairs));
        for (size_t i = 0; i < pairs.size() && !HasFailure(); ++i) {
          SCOPED_TRACE(show(pairs[i]));
          expect_no_answer(rows[i]);
        }
      }
    });
  }
}

// Every third pair of a list is spoilt, and the others have the bits that they have without them.
TEST(KindsInvalid, SpoilsItsOwnPairAlone) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    for (const PositionType positions : kPositionTypes) {
      SCOPED_TRACE(name(kinds) + ", " + name(positions));
      std::vector<TestPair> pairs = make_kind_pairs({.name = ""}, kinds, positions, 135);
      Call call = call_with(positions);
      call.detail = Detail::manifold;
      for_each_isa([&] {
        std::vector<Row> expected = run_list(pairs, call);
        std::vector<TestPair> with_bad = pairs;
        const std::vector<TestPair> bad = spoilt(pairs[0]);
        for (size_t i = 0; i < pairs.size(); i += 3) with_bad[i] = bad[i % bad.size()];
        const std::vector<Row> rows = run_list(with_bad, call);
        for (size_t i = 0; i < pairs.size(); i += 3) {
          expect_no_answer(rows[i]);
          expected[i] = rows[i];
        }
        EXPECT_TRUE(same_rows(expected, rows, with_bad));
      });
    }
  }
}

// Spheres and boxes along the axes do not turn: any orientation will do.
TEST(KindsInvalid, OrientationsOfWhatDoesNotTurnAreIgnored) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    std::vector<TestPair> pairs = make_kind_pairs({.name = ""}, kinds, PositionType::float32, 35);
    const auto expected = expected_rows(pairs, PositionType::float32, Detail::manifold);
    for (TestPair& pair : pairs) {
      for (PlacedShape* body : {&pair.a, &pair.b}) {
        if (!has_rows(body->shape)) body->orientation.coeffs().setConstant(kNan);
      }
    }
    Call call;
    call.detail = Detail::manifold;
    for_each_isa([&] {
      EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs));
      EXPECT_TRUE(same_rows(expected, run_list(pairs, call), pairs));
    });
  }
}

}  // namespace
}  // namespace carom::test
