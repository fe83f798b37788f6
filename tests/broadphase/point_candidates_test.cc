#include "broadphase/point_candidates.h"

#include <gtest/gtest.h>

#include "carom/base/thread_arena.h"
#include "tests/support/boxes.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

struct Point {
  float xyz[3];
};

// Most points are inside the volume of the boxes; some are corners of boxes or not finite.
std::vector<Point> make_points(const Boxes& boxes, size_t count, uint64_t seed) {
  BoxMaker maker(seed);
  Random& random = maker.random();
  std::vector<Point> points(count);
  for (Point& point : points) {
    for (float& x : point.xyz) x = maker.uniform(0, side_for(boxes.size()));
    if (!boxes.empty() && random.chance(0.3)) {
      const TestBox& box = boxes[random.below(boxes.size())];
      for (int i = 0; i < 3; ++i) {
        point.xyz[i] = random.chance(0.5) ? box.lower[i] : box.upper[i];
      }
    }
    if (random.chance(0.05)) point.xyz[random.below(3)] = random.any_float();
    if (random.chance(0.05)) point.xyz[random.below(3)] = kNan;
  }
  return points;
}

std::vector<Pair> plain_candidates(const std::vector<Point>& points, const Boxes& boxes) {
  std::vector<Pair> pairs;
  for (uint32_t i = 0; i < points.size(); ++i) {
    TestBox as_box;
    for (int axis = 0; axis < 3; ++axis) {
      as_box.lower[axis] = as_box.upper[axis] = points[i].xyz[axis];
    }
    for (uint32_t b = 0; b < boxes.size(); ++b) {
      if (overlap(as_box, boxes[b])) pairs.push_back({i, b});
    }
  }
  return pairs;
}

void expect_candidates(const std::vector<Point>& points, const Boxes& boxes,
                       Parallelism parallelism = Parallelism::none) {
  const std::vector<Pair> expected = plain_candidates(points, boxes);
  for (const size_t stride : {12, 16, 40}) {
    GuardedArray memory(points.size(), sizeof(Point), stride);
    for (size_t i = 0; i < points.size(); ++i) memory.set(i, points[i]);
    const LaidOutBoxes laid_out(boxes);
    EXPECT_TRUE(find_point_candidates(memory.as<float>(), points.size(), stride, laid_out.view(),
                                      parallelism) == expected)
        << points.size() << " points, " << boxes.size() << " boxes, stride " << stride;
  }
}

TEST(PointCandidates, OfEveryFamilyAndCount) {
  for_each_isa([] {
    for (int family = 0; family < kBoxFamilies; ++family) {
      SCOPED_TRACE(name(static_cast<BoxFamily>(family)));
      for (const size_t count : {0, 1, 3, 16, 33, 70, 300}) {
        const Boxes boxes = make_boxes(static_cast<BoxFamily>(family), count);
        for (const size_t points : {0, 1, 15, 64, 100}) {
          expect_candidates(make_points(boxes, points, count + points), boxes);
        }
      }
    }
  });
}

TEST(PointCandidates, AreTheSameOnThreads) {
  const Boxes boxes = make_boxes(BoxFamily::random, 9000);
  const std::vector<Point> points = make_points(boxes, 500, 1);
  for (const int threads : {1, 2, 4}) {
    ThreadArena arena(threads);
    arena.run([&] { expect_candidates(points, boxes, arena.parallelism()); });
  }
}

}  // namespace
}  // namespace carom::test
