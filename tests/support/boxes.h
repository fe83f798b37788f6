// Families of boxes, their layout in a caller's memory, and a brute-force search to compare with.
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "carom/broadphase/find_pairs.h"
#include "oracle/random.h"
#include "tests/support/guarded.h"
#include "tests/support/show.h"
#include "tests/support/special_floats.h"

namespace carom::test {

using namespace oracle;

struct TestBox {
  float lower[3];
  float upper[3];
};

using Boxes = std::vector<TestBox>;

bool overlap(const TestBox& a, const TestBox& b);

// --- In memory: six columns, or records of 24 bytes or more ---

class LaidOutBoxes {
 public:
  // record 0: dense columns.
  explicit LaidOutBoxes(const Boxes& boxes, size_t record = 0);

  const BoundsView& view() const { return view_; }

 private:
  std::vector<GuardedArray> memory_;
  BoundsView view_;
};

// --- Families ---

class BoxMaker {
 public:
  explicit BoxMaker(uint64_t seed) : random_(seed) {}

  float uniform(double low, double high) { return static_cast<float>(random_.uniform(low, high)); }
  Random& random() { return random_; }

  // A box anywhere in a cube of this side, so that it meets a few others.
  TestBox in_cube(double side, double size = 1.5);

  // Not a box: NaN, empty, inverted.
  TestBox spoilt(const TestBox& box);

 private:
  Random random_;
};

double side_for(size_t count);

enum class BoxFamily {
  random,
  clustered,
  lattice,     // closed boxes that touch
  equal_keys,  // the same lower corner on all axes but one, and few values on that one
  one_point,
  flat,   // no extent on one axis or more
  plane,  // all boxes in one plane
  giant,  // one box as large as the world
  far_cluster,
  huge,  // coordinates up to the largest float
  infinite,
  spoilt,
  subnormal,
  decades,  // sizes over six decades
  line,     // boxes along one axis, far longer than other worlds
  outlier,  // a few boxes far away from the rest
  any_bits,
};

inline constexpr int kBoxFamilies = 17;

const char* name(BoxFamily family);

TestBox make_box(BoxFamily family, BoxMaker& maker, size_t i, size_t count);

Boxes make_boxes(BoxFamily family, size_t count, uint64_t seed = 1);

// --- Filters ---

struct Filters {
  std::vector<uint32_t> layer, mask, owner;
  std::vector<Motion> motion;
  std::vector<int32_t> group;
  std::vector<uint32_t> space;
  std::vector<Pair> excluded;  // sorted
  PairPredicate predicate = drops_some;

  Filters() = default;
  // Random columns; no pair is excluded.
  Filters(size_t count, uint64_t seed);

  // Excludes some of these pairs and as many that need not meet, of `count` boxes.
  void exclude_some(const std::vector<Pair>& pairs, size_t count, uint64_t seed);

  // The entries of a box in all columns.
  auto of(size_t i) const {
    return std::tuple(layer[i], mask[i], owner[i], motion[i], group[i], space[i]);
  }

  // The filters whose bits are set: bit 0 layers and masks, 1 owners, 2 motion, 3 groups, 4 spaces,
  // 5 FilterRule::either, 6 excluded pairs, 7 the predicate.
  PairFilter view(unsigned parts) const;
  static constexpr unsigned kAllParts = 256;

  // A predicate that drops about one pair in four.
  static void drops_some(std::span<const Pair> pairs, std::span<uint8_t> keep);
};

// Slow and plain: asks the predicate about one pair.
bool may_meet(const PairFilter& f, uint32_t a, uint32_t b);

// --- The brute-force search ---

std::vector<Pair> plain_pairs(const Boxes& boxes, const PairFilter& filter = {});

std::vector<Pair> found_pairs(PairFinder& finder, const Boxes& boxes, BroadphaseMethod method,
                              const PairFilter& filter = {},
                              Parallelism parallelism = Parallelism::none, size_t record = 0);

std::vector<Pair> found_pairs(const Boxes& boxes, BroadphaseMethod method,
                              const PairFilter& filter = {},
                              Parallelism parallelism = Parallelism::none, size_t record = 0);

inline constexpr BroadphaseMethod kAllMethods[] = {BroadphaseMethod::automatic,
                                                   BroadphaseMethod::brute, BroadphaseMethod::sweep,
                                                   BroadphaseMethod::grid};

// The first difference as text.
std::string difference(const std::vector<Pair>& got, const std::vector<Pair>& expected,
                       const Boxes& boxes);

}  // namespace carom::test
