// Pairs of half-spaces and boxes: against exact arithmetic, against the reference, and on every
// ISA.
#include "broadphase/halfspace_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "carom/base/thread_arena.h"
#include "reference/pairs.h"
#include "tests/support/boxes.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Rational3 = std::array<Rational, 3>;

struct PlacedHalfspace {
  Halfspace shape;
  Pose pose;
};

// Only the half-space at index `body` is readable.
WorldHalfspace placed(const PlacedHalfspace& halfspace, uint32_t body, PositionType positions) {
  std::vector<float> records32;
  std::vector<double> records64;
  for (int i = 0; i < 4; ++i) {
    const double x = i < 3 ? halfspace.pose.position[i] : 0;
    records32.push_back(static_cast<float>(x));
    records64.push_back(x);
  }
  const Eigen::Vector4f q = halfspace.pose.orientation.coeffs();
  const auto rows = shape_rows(halfspace.shape);
  const uint32_t first = 0;
  Collidables view;
  view.count = 1;
  view.uniform_kind = ShapeKind::halfspace;
  view.position.type = positions;
  view.position.stride = positions == PositionType::float64 ? 32 : 16;
  view.position.data = positions == PositionType::float64
                           ? static_cast<const void*>(records64.data())
                           : static_cast<const void*>(records32.data());
  view.orientation.data = q.data();
  view.rows = {rows[0].data(), &first};
  WorldHalfspace result = world_halfspace(view, 0);
  result.body = body;
  return result;
}

// --- Exactly ---

struct ExactPlane {
  Rational3 normal;
  Rational limit;
  Rational size;  // magnitude of the summands, per unit of |x| + |y| + |z|
  Rational limit_size;
};

Rational dot(const Rational3& a, const Rational3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

ExactPlane exact_plane(const PlacedHalfspace& halfspace, PositionType positions) {
  const Eigen::Quaternionf& q = halfspace.pose.orientation;
  const Rational x(q.x()), y(q.y()), z(q.z()), w(q.w());
  const auto n = [&](int i) { return Rational(halfspace.shape.normal[i]); };
  const Rational3 normal = {n(0), n(1), n(2)};
  const Rational two(2);
  const Rational3 m[3] = {
      {w * w + x * x - y * y - z * z, two * (x * y - w * z), two * (x * z + w * y)},
      {two * (x * y + w * z), w * w - x * x + y * y - z * z, two * (y * z - w * x)},
      {two * (x * z - w * y), two * (y * z + w * x), w * w - x * x - y * y + z * z}};
  const Rational scale = x * x + y * y + z * z + w * w;
  Rational3 p;
  Rational p_size = 0;
  for (int i = 0; i < 3; ++i) {
    const double at = halfspace.pose.position[i];
    p[i] = Rational(positions == PositionType::float32 ? static_cast<float>(at) : at);
    p_size += abs(p[i]);
  }
  ExactPlane plane;
  plane.normal = {dot(m[0], normal), dot(m[1], normal), dot(m[2], normal)};
  plane.limit = Rational(halfspace.shape.offset) * scale + dot(plane.normal, p);
  plane.size = scale * (abs(normal[0]) + abs(normal[1]) + abs(normal[2]));
  plane.limit_size = abs(Rational(halfspace.shape.offset)) * scale + plane.size * p_size;
  return plane;
}

struct Height {
  Rational above;  // height of the lowest corner over the plane, times the length of the normal
  Rational size;   // magnitude of the summands of `above`
};

Height exact_height(const TestBox& box, const ExactPlane& plane) {
  Rational3 corner;
  Rational size = 0;
  for (int i = 0; i < 3; ++i) {
    corner[i] = Rational(plane.normal[i] > 0 ? box.lower[i] : box.upper[i]);
    size += Rational(std::max(std::abs(box.lower[i]), std::abs(box.upper[i])));
  }
  return {dot(plane.normal, corner) - plane.limit, plane.size * size + plane.limit_size};
}

// --- Random half-spaces and boxes ---

class PlaneMaker {
 public:
  explicit PlaneMaker(uint64_t seed) : random_(seed) {}

  Random& random() { return random_; }

  PlacedHalfspace next() {
    PlacedHalfspace h;
    h.shape.normal = direction();
    h.shape.normal *= scale();
    h.shape.offset = static_cast<float>(number() * h.shape.normal.norm());
    h.pose.orientation.coeffs() = quaternion() * scale();
    for (int i = 0; i < 3; ++i) h.pose.position[i] = number();
    return h;
  }

 private:
  Eigen::Vector3f direction() {
    if (random_.chance(0.5)) return random_.direction().cast<float>();
    Eigen::Vector3f axis = Eigen::Vector3f::Zero();
    axis[static_cast<int>(random_.below(3))] = random_.chance(0.5) ? 1.0f : -1.0f;
    return axis;
  }

  Eigen::Vector4f quaternion() {
    Eigen::Vector4f q;
    for (int i = 0; i < 4; ++i) q[i] = static_cast<float>(random_.uniform(-1, 1));
    switch (random_.below(4)) {
      case 0:
        return {0, 0, 0, 1};
      case 1:  // an exact quarter turn about an axis
        return {1, 0, 0, 1};
      case 2:  // almost unturned
        return {1e-7f * q[0], 1e-7f * q[1], 1e-7f * q[2], 1};
      default:
        return q;
    }
  }

  float scale() {
    return random_.chance(0.7) ? 1 : static_cast<float>(random_.log_uniform(1e-15, 1e15));
  }

  double number() {
    constexpr double kSizes[] = {0, 1, 1e3, 1e-6, 1e9};
    return random_.uniform(-1, 1) * kSizes[random_.below(5)];
  }

  Random random_;
};

// A box whose lowest corner is about on the plane.
TestBox box_at(const PlacedHalfspace& h, Random& random) {
  const Eigen::Quaterniond q = h.pose.orientation.cast<double>().normalized();
  const Eigen::Vector3d n = (q * h.shape.normal.cast<double>()).normalized();
  const double height =
      h.shape.offset / h.shape.normal.cast<double>().norm() + n.dot(h.pose.position);
  const Eigen::Vector3d along = n.cross(random.direction()) * random.log_uniform(1e-3, 1e3);
  const Eigen::Vector3d lowest = n * height + along;
  TestBox box;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<float>(lowest[i]);
    const auto size = static_cast<float>(random.uniform(0, 2));
    box.lower[i] = n[i] > 0 ? at : at - size;
    box.upper[i] = n[i] > 0 ? at + size : at;
  }
  return box;
}

bool meets(const WorldHalfspace& halfspace, const Boxes& boxes, HalfspaceSearch& search) {
  const LaidOutBoxes memory(boxes);
  std::vector<Pair> pairs;
  return search.find({&halfspace, 1}, memory.view(), {}, 10, Parallelism::none, pairs) > 0;
}

TEST(HalfspacePairs, NoneIsLostAndThoseTooManyAreWithinRounding) {
  const Rational tolerance(0x1p-45);
  size_t near = 0, far = 0, too_many = 0;
  for (const PositionType positions : kPositionTypes) {
    PlaneMaker maker(positions == PositionType::float64 ? 1 : 2);
    HalfspaceSearch search;
    for (int i = 0; i < static_cast<int>(rounds(6000)); ++i) {
      const PlacedHalfspace h = maker.next();
      const TestBox box = box_at(h, maker.random());
      const Height height = exact_height(box, exact_plane(h, positions));
      const bool met = meets(placed(h, 1, positions), {box}, search);
      const bool reaches = height.above <= 0;
      if (reaches) {
        ASSERT_TRUE(met) << i;
        ++near;
      } else {
        ++far;
        too_many += met;
        if (met) {
          ASSERT_LE(height.above, tolerance * height.size) << i;
        }
      }
    }
  }
  EXPECT_GT(near, rounds(2000));
  EXPECT_GT(far, rounds(2000));
  EXPECT_LT(too_many, far / 10);
}

TEST(HalfspacePairs, TouchingIsMeeting) {
  HalfspaceSearch search;
  PlacedHalfspace floor;
  floor.pose.position = {5, 6, 0.25};
  const WorldHalfspace h = placed(floor, 1, PositionType::float32);
  EXPECT_TRUE(meets(h, {{{0, 0, 0.25f}, {1, 1, 1}}}, search));
  EXPECT_FALSE(meets(h, {{{0, 0, std::nextafter(0.25f, 1.0f)}, {1, 1, 1}}}, search));
  EXPECT_TRUE(meets(h, {{{1e30f, -1e30f, -kLargest}, {1e30f, 1e30f, -kLargest}}}, search));
}

// Numbers whose squares overflow or underflow float32.
TEST(HalfspacePairs, OfTheSmallestAndLargestNumbers) {
  HalfspaceSearch search;
  for (const float scale : {0x1p-149f, 0x1p-126f, 1.0f, 0x1p127f}) {
    for (const float turn : {0x1p-149f, 1.0f, 0x1p127f}) {
      PlacedHalfspace h;
      h.shape.normal = {0, 0, scale};
      h.pose.orientation.coeffs() = Eigen::Vector4f(turn, 0, 0, 0);  // upside down
      for (const PositionType positions : kPositionTypes) {
        const WorldHalfspace placed_one = placed(h, 1, positions);
        const float unit = 0x1p-149f;
        EXPECT_TRUE(meets(placed_one, {{{0, 0, -1}, {0, 0, 0}}}, search));
        EXPECT_TRUE(meets(placed_one, {{{0, 0, unit}, {0, 0, unit}}}, search));
        EXPECT_FALSE(meets(placed_one, {{{0, 0, -unit}, {0, 0, -unit}}}, search));
        EXPECT_TRUE(meets(placed_one, {{{0, 0, -kLargest}, {0, 0, kLargest}}}, search));
        EXPECT_FALSE(meets(placed_one, {{{0, 0, -kLargest}, {0, 0, -kLargest}}}, search));
      }
    }
  }
  // Double precision overflows here, so the pair must be kept.
  PlacedHalfspace far;
  far.shape.normal = {1, 1, 1};
  far.pose.position = {-1e308, -1e308, -1e308};
  EXPECT_TRUE(meets(placed(far, 1, PositionType::float64), {{{0, 0, 0}, {1, 1, 1}}}, search));
}

// --- Against the reference ---

reference::Box as_reference(const TestBox& box) {
  return {Eigen::Vector3f(box.lower[0], box.lower[1], box.lower[2]),
          Eigen::Vector3f(box.upper[0], box.upper[1], box.upper[2])};
}

bool takes_part(const TestBox& box) { return overlap(box, box); }

std::vector<Pair> plain_pairs(std::span<const PlacedHalfspace> halfspaces,
                              std::span<const uint32_t> bodies, const Boxes& boxes,
                              PositionType positions, const PairFilter& filter) {
  std::vector<Pair> pairs;
  for (size_t h = 0; h < halfspaces.size(); ++h) {
    const reference::Plane plane =
        reference::world_plane(halfspaces[h].shape, halfspaces[h].pose, positions);
    for (uint32_t i = 0; i < boxes.size(); ++i) {
      if (!takes_part(boxes[i]) || !reference::may_reach(as_reference(boxes[i]), plane)) continue;
      const Pair pair = {std::min(i, bodies[h]), std::max(i, bodies[h])};
      if (test::may_meet(filter, pair.a, pair.b)) pairs.push_back(pair);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// Boxes, some of whose rows belong to half-spaces.
struct Setting {
  Setting(BoxFamily family, size_t count, size_t planes, PositionType type, uint64_t seed)
      : boxes(make_boxes(family, count, seed)), filters(count, seed), positions(type) {
    PlaneMaker maker(seed);
    const TestBox empty = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
    for (uint32_t body = 0; body < count && halfspaces.size() < planes; ++body) {
      if (!maker.random().chance(0.5)) continue;
      halfspaces.push_back(maker.next());
      if (maker.random().chance(0.5)) {  // its plane cuts one of the boxes
        const TestBox& box = boxes[maker.random().below(count)];
        for (int i = 0; i < 3; ++i) halfspaces.back().pose.position[i] = box.lower[i];
        if (!halfspaces.back().pose.position.allFinite()) halfspaces.back().pose = {};
      }
      bodies.push_back(body);
      placed_ones.push_back(placed(halfspaces.back(), body, positions));
    }
    for (const uint32_t body : bodies) boxes[body] = empty;
  }

  void expect_pairs(unsigned filter_parts, Parallelism parallelism, size_t record = 0) {
    const PairFilter filter = filters.view(filter_parts);
    const LaidOutBoxes memory(boxes, record);
    const std::vector<Pair> expected = plain_pairs(halfspaces, bodies, boxes, positions, filter);
    std::vector<Pair> pairs = {{7, 7}};
    EXPECT_EQ(search.find(placed_ones, memory.view(), filter, expected.size(), parallelism, pairs),
              expected.size());
    EXPECT_TRUE(pairs == expected)
        << boxes.size() << " boxes: " << pairs.size() << " pairs instead of " << expected.size();
  }

  Boxes boxes;
  Filters filters;
  PositionType positions;
  std::vector<PlacedHalfspace> halfspaces;
  std::vector<uint32_t> bodies;
  std::vector<WorldHalfspace> placed_ones;
  HalfspaceSearch search;
};

TEST(HalfspacePairs, OfEveryFamilyAndCount) {
  for_each_isa([] {
    for (int family = 0; family < kBoxFamilies; ++family) {
      SCOPED_TRACE(name(static_cast<BoxFamily>(family)));
      for (const size_t count : {0, 1, 2, 3, 7, 16, 33, 255, 256, 300}) {
        const PositionType positions = kPositionTypes[count % 2];
        Setting setting(static_cast<BoxFamily>(family), count, 5, positions, count + 1);
        setting.expect_pairs(0, Parallelism::none);
        setting.expect_pairs(7, Parallelism::none, 40);
      }
    }
  });
}

TEST(HalfspacePairs, AreTheSameOnThreads) {
  Setting setting(BoxFamily::random, 30000, 7, PositionType::float32, 1);
  for (const int threads : {1, 2, 4}) {
    ThreadArena arena(threads);
    arena.run([&] {
      for (const unsigned parts : {0u, 1u, 2u, 4u, 7u}) {
        setting.expect_pairs(parts, arena.parallelism());
      }
    });
  }
}

TEST(HalfspacePairs, BeyondTheLimitAreCountedAndNotGiven) {
  Setting setting(BoxFamily::random, 5000, 3, PositionType::float32, 2);
  const LaidOutBoxes memory(setting.boxes);
  std::vector<Pair> pairs;
  const auto find = [&](size_t most) {
    return setting.search.find(setting.placed_ones, memory.view(), {}, most, Parallelism::none,
                               pairs);
  };
  const size_t all = find(1 << 20);
  ASSERT_GT(all, 100u);
  EXPECT_EQ(pairs.size(), all);
  EXPECT_EQ(find(all - 1), all);
  EXPECT_TRUE(pairs.empty());
  EXPECT_EQ(find(0), all);
  EXPECT_TRUE(pairs.empty());
  EXPECT_EQ(find(all), all);
  EXPECT_EQ(pairs.size(), all);
}

}  // namespace
}  // namespace carom::test
