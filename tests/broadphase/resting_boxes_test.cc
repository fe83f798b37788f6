// Histories: a finder that keeps resting boxes finds the same pairs as a plain search, frame after
// frame.
#include "broadphase/resting/resting_boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstring>

#include "carom/base/thread_arena.h"
#include "tests/support/boxes.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

constexpr TestBox kEverywhere = {{-kInfinity, -kInfinity, -kInfinity},
                                 {kInfinity, kInfinity, kInfinity}};
constexpr TestBox kEmpty = {{kInfinity, kInfinity, kInfinity},
                            {-kInfinity, -kInfinity, -kInfinity}};

// How often the histories took each path.
struct Coverage {
  size_t frames = 0;
  size_t pairs = 0;
  size_t rested = 0;         // nothing changed, nothing was searched
  size_t woke = 0;           // few boxes changed, most pairs were kept
  size_t idle = 0;           // boxes were searched although none changed
  size_t settled = 0;        // searched from scratch, in a frame that repeats the last one
  size_t settled_again = 0;  // boxes that came to rest joined the resting ones
  size_t restless = 0;       // kept pairs were given up
  size_t shrank = 0;         // boxes were removed while others rested
  size_t filtered = 0;       // a filter changed while most boxes rested
  size_t unsorted = 0;       // pairs came in another order
  size_t told = 0;           // the finder was told which boxes changed, and searched for some
};

// A world in which most boxes rest, its finder, and counts of what the finder did.
class History {
 public:
  History(uint64_t seed, size_t count, BoxFamily family)
      : maker_(seed), family_(family), boxes_(make_boxes(family, count, seed)) {
    add_filters();
    parts_ = random_parts();
  }

  const Boxes& boxes() const { return boxes_; }
  PairFilter filter() const { return filters_.view(parts_); }
  const Coverage& coverage() const { return coverage_; }

  // Makes one of many changes between two frames.
  void step(uint64_t choice) {
    if (boxes_.empty()) return appear(1 + random().below(40));
    switch (choice % 40) {
      case 0:
        return appear(1 + random().below(1 + boxes_.size() / 4));
      case 1:
        return go(1 + random().below(1 + boxes_.size() / 4));
      case 2:
        return replace_some(0.1, [&](TestBox& box) { box = maker_.spoilt(box); });
      case 3:
        return replace_some(0.15, [&](TestBox& box) { box = fresh(); });
      case 4:
        return replace_some(0.03, [&](TestBox& box) { box = kEverywhere; });
      case 5:
        return replace_some(0.03, [&](TestBox& box) { box = kEmpty; });
      case 6:
        return replace_some(0.05,
                            [&](TestBox& box) { box = boxes_[random().below(boxes_.size())]; });
      case 7:
        return replace_some(0.02, [&](TestBox& box) { box = maker_.in_cube(1e6, 1e7); });
      case 8:
        return replace_some(0.9, [&](TestBox& box) { drift(box, 0.3); });
      case 9:
        finder_.forget();
        return;
      case 10:
        finder_ = PairFinder(std::move(finder_));
        return;
      case 11:
        parts_ = random_parts();
        return;
      case 12:
      case 13:
      case 20:
      case 21:
      case 22:
        return change_filters(0.05);
      case 14:
        method_ = kAllMethods[random().below(4)];
        return;
      case 15:
        record_ = random().below(2) * 24 + random().below(3) * 4;
        return;
      case 16:
        return flip_zeros();
      case 17:
        return replace_some(0.15, [&](TestBox& box) { drift(box, 0.1); });
      case 18:
        for (int i = 0; i < 9; ++i) step(random().below(18));
        return;
      case 19:
        return go(random().below(boxes_.size() + 1));
      default:
        if (choice % 40 < 30) return;  // all rest
        return replace_some(0.04, [&](TestBox& box) { drift(box, 0.3); });
    }
  }

  // The pairs that the finder finds; counts the path that it took.
  std::vector<Pair> find(Parallelism parallelism = Parallelism::none) {
    std::vector<Pair> pairs = {{9, 9}};
    const std::vector<uint32_t> changed = list_changed();
    const bool tells = random().chance(0.5);
    const auto find_in = [&](const BoundsView& view) {
      return tells ? finder_.find_changed(view, filter(), changed, pairs, method_, parallelism)
                   : finder_.find(view, filter(), pairs, method_, parallelism);
    };
    if (random().chance(0.05)) change_order();
    PairSearch search;
    if (record_ == 0 || record_ >= sizeof(TestBox)) {
      const LaidOutBoxes memory(boxes_, record_);
      search = find_in(memory.view());
    } else {  // too short for guarded memory
      search = find_in(view_of_records());
    }
    count(search, pairs.size());
    if (order_ == PairOrder::any) {
      coverage_.unsorted += !std::ranges::is_sorted(pairs);
      std::ranges::sort(pairs);
    }
    coverage_.told += tells && search.method == BroadphaseMethod::grid && search.searched > 0 &&
                      search.searched < boxes_.size();
    method_ = BroadphaseMethod::grid;
    return pairs;
  }

  PairSearch last() const { return last_; }

 private:
  Random& random() { return maker_.random(); }
  unsigned random_parts() { return static_cast<unsigned>(random().below(Filters::kAllParts)); }
  TestBox fresh() { return make_box(family_, maker_, random().below(1000), boxes_.size()); }

  BoundsView view_of_records() const {
    const TestBox* boxes = boxes_.data();
    if (boxes_.empty()) return {};
    return {{&boxes->lower[0], &boxes->lower[1], &boxes->lower[2]},
            {&boxes->upper[0], &boxes->upper[1], &boxes->upper[2]},
            boxes_.size(),
            sizeof(TestBox)};
  }

  void change_order() {
    order_ = order_ == PairOrder::any ? PairOrder::sorted : PairOrder::any;
    finder_.set_order(order_);
  }

  // The boxes that differ from the last call, by themselves or by their filters, and some others.
  std::vector<uint32_t> list_changed() {
    std::vector<uint32_t> changed;
    for (uint32_t i = 0; i < boxes_.size(); ++i) {
      const bool known = i < told_boxes_.size();
      const bool differs =
          known && (std::memcmp(&boxes_[i], &told_boxes_[i], sizeof(TestBox)) != 0 ||
                    filters_.of(i) != told_filters_.of(i));
      if (differs || random().chance(0.05)) changed.push_back(i);
    }
    told_boxes_ = boxes_;
    told_filters_ = filters_;
    return changed;
  }

  template <class Replace>
  void replace_some(double share, const Replace& replace) {
    replace(boxes_[random().below(boxes_.size())]);
    for (TestBox& box : boxes_) {
      if (random().chance(share)) replace(box);
    }
  }

  void drift(TestBox& box, double distance) {
    for (int axis = 0; axis < 3; ++axis) {
      const float way = maker_.uniform(-distance, distance);
      box.lower[axis] += way;
      box.upper[axis] += way;
    }
  }

  void appear(size_t count) {
    for (size_t i = 0; i < count; ++i) boxes_.push_back(fresh());
    add_filters();
  }

  void go(size_t count) {
    boxes_.resize(boxes_.size() - std::min(count, boxes_.size()));
    went_ = true;
  }

  void flip_zeros() {
    for (TestBox& box : boxes_) {
      for (float* corner : {box.lower, box.upper}) {
        if (corner[0] == 0) corner[0] = -corner[0];
      }
    }
  }

  // Filters are never shorter than the boxes. Filters of removed boxes are removed.
  void add_filters() {
    const Filters more(boxes_.size(), random().bits());
    for (size_t i = filters_.layer.size(); i < boxes_.size(); ++i) {
      filters_.layer.push_back(more.layer[i]);
      filters_.mask.push_back(more.mask[i]);
      filters_.owner.push_back(more.owner[i]);
      filters_.motion.push_back(more.motion[i]);
      filters_.group.push_back(more.group[i]);
      filters_.space.push_back(more.space[i]);
    }
  }

  void change_filters(double share) {
    const Filters other(boxes_.size(), random().bits());
    for (size_t i = 0; i < boxes_.size(); ++i) {
      if (!random().chance(share)) continue;
      switch (random().below(6)) {
        case 0:
          filters_.layer[i] = other.layer[i];
          break;
        case 1:
          filters_.mask[i] = other.mask[i];
          break;
        case 2:
          filters_.owner[i] = other.owner[i];
          break;
        case 3:
          filters_.group[i] = other.group[i];
          break;
        case 4:
          filters_.space[i] = other.space[i];
          break;
        default:
          filters_.motion[i] = other.motion[i];
      }
    }
    filters_changed_ = (parts_ & 31) != 0;
    filters_.exclude_some(plain_pairs(boxes_), boxes_.size(), random().bits());
  }

  void count(const PairSearch& search, size_t pairs) {
    ++coverage_.frames;
    coverage_.pairs += pairs;
    if (search.method != BroadphaseMethod::grid) return;
    const size_t all = boxes_.size();
    const bool afresh = search.changed == all && all > 0;
    const bool kept_before = kept_;
    kept_ = !afresh;
    if (afresh) {
      kept_before ? ++coverage_.restless : ++coverage_.settled;
    } else {
      coverage_.rested += search.changed == 0 && search.searched == 0;
      coverage_.woke += search.changed > 0 && search.searched < all;
      coverage_.idle += search.changed == 0 && search.searched > 0;
      const bool fewer_move = kept_before && last_.searched < all &&
                              (search.searched <= search.changed || search.searched == all);
      coverage_.settled_again += !went_ && last_.searched > search.changed && fewer_move;
      coverage_.shrank += went_;
      coverage_.filtered += filters_changed_ && search.changed > 0;
    }
    last_ = search;
    went_ = filters_changed_ = false;
  }

  BoxMaker maker_;
  BoxFamily family_;
  Boxes boxes_;
  Filters filters_;
  unsigned parts_ = 0;
  BroadphaseMethod method_ = BroadphaseMethod::grid;
  size_t record_ = 4;
  PairFinder finder_;
  PairOrder order_ = PairOrder::sorted;
  Boxes told_boxes_;  // those of the last call
  Filters told_filters_;

  PairSearch last_;
  bool kept_ = false, went_ = false, filters_changed_ = false;
  Coverage coverage_;
};

Coverage operator+(Coverage a, const Coverage& b) {
  a.frames += b.frames;
  a.pairs += b.pairs;
  a.rested += b.rested;
  a.woke += b.woke;
  a.idle += b.idle;
  a.settled += b.settled;
  a.settled_again += b.settled_again;
  a.restless += b.restless;
  a.shrank += b.shrank;
  a.filtered += b.filtered;
  a.told += b.told;
  a.unsorted += b.unsorted;
  return a;
}

// Runs a history and compares every frame; false after a failure.
bool run_history(uint64_t seed, size_t most_boxes, int frames, Parallelism parallelism,
                 Coverage& coverage) {
  Random random(seed);
  const auto family = static_cast<BoxFamily>(random.below(kBoxFamilies));
  History history(seed, random.below(most_boxes), family);
  for (int frame = 0; frame < frames; ++frame) {
    if (frame > 2) history.step(random.bits());
    const std::vector<Pair> got = history.find(parallelism);
    const std::vector<Pair> expected = plain_pairs(history.boxes(), history.filter());
    if (got != expected) {
      ADD_FAILURE() << "seed " << seed << ", frame " << frame << ", " << name(family) << ", "
                    << difference(got, expected, history.boxes());
      return false;
    }
  }
  coverage = coverage + history.coverage();
  return true;
}

void expect_covered(const Coverage& coverage, size_t least) {
  EXPECT_GT(coverage.pairs, coverage.frames);
  EXPECT_GE(coverage.rested, least);
  EXPECT_GE(coverage.woke, least);
  EXPECT_GE(coverage.idle, least);
  EXPECT_GE(coverage.settled, least);
  EXPECT_GE(coverage.settled_again, least);
  EXPECT_GE(coverage.restless, least);
  EXPECT_GE(coverage.shrank, least);
  EXPECT_GE(coverage.filtered, least);
  EXPECT_GE(coverage.told, least);
  EXPECT_GE(coverage.unsorted, least);
  for (const auto& [what, times] : std::initializer_list<std::pair<const char*, size_t>>{
           {"frames", coverage.frames},
           {"rested", coverage.rested},
           {"woke", coverage.woke},
           {"idle", coverage.idle},
           {"settled", coverage.settled},
           {"settled_again", coverage.settled_again},
           {"restless", coverage.restless},
           {"shrank", coverage.shrank},
           {"filtered", coverage.filtered},
           {"told", coverage.told},
           {"unsorted", coverage.unsorted}}) {
    testing::Test::RecordProperty(what, std::to_string(times));
  }
}

TEST(RestingBoxes, ThroughThousandsOfHistories) {
  Coverage coverage;
  for (uint64_t seed = 0; seed < rounds(4000); ++seed) {
    ASSERT_TRUE(run_history(seed, seed % 10 == 0 ? 200 : 50, 30, Parallelism::none, coverage));
  }
  expect_covered(coverage, rounds(2000));
}

TEST(RestingBoxes, OnEveryInstructionSet) {
  for_each_isa([] {
    Coverage coverage;
    for (uint64_t seed = 5000; seed < 5200; ++seed) {
      ASSERT_TRUE(run_history(seed, 90, 30, Parallelism::none, coverage));
    }
    expect_covered(coverage, 40);
  });
}

TEST(RestingBoxes, OnSeveralThreads) {
  ThreadArena arena(4);
  arena.run([&] {
    Coverage coverage;
    for (uint64_t seed = 0; seed < rounds(100, 30); ++seed) {
      ASSERT_TRUE(run_history(6000 + seed, 600, 20, arena.parallelism(), coverage));
    }
    expect_covered(coverage, rounds(20, 4));
  });
}

// The same for RapidCheck, which reduces a failing history to the steps that matter.
RC_GTEST_PROP(RestingBoxes, ThroughAnyHistory,
              (const std::vector<uint8_t>& steps, uint64_t seed, uint8_t boxes)) {
  History history(seed, boxes % 64, static_cast<BoxFamily>(seed % kBoxFamilies));
  for (const uint8_t step : steps) {
    history.step(step);
    RC_ASSERT(history.find() == plain_pairs(history.boxes(), history.filter()));
  }
}

// --- Cases that random histories do not reach ---

// A lattice of boxes that do not touch, and a finder that knows them as resting.
class Lattice {
 public:
  explicit Lattice(size_t side) {
    for (size_t i = 0; i < side * side * side; ++i) {
      TestBox box;
      const size_t at[3] = {i % side, i / side % side, i / (side * side)};
      for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = 2 * static_cast<float>(at[axis]);
        box.upper[axis] = box.lower[axis] + 1;
      }
      boxes.push_back(box);
    }
    for (int repeat = 0; repeat < 3; ++repeat) find();
  }

  std::vector<Pair> find(const PairFilter& filter = {}) {
    const LaidOutBoxes memory(boxes);
    std::vector<Pair> pairs;
    search = finder.find(memory.view(), filter, pairs, BroadphaseMethod::grid);
    return pairs;
  }

  Boxes boxes;
  PairFinder finder;
  PairSearch search;
};

// A box that stopped resting is gone from its old place: not even an infinite box meets it there.
TEST(RestingBoxes, ThatLeftMeetNothingWhereTheyWere) {
  for (const TestBox& where : {kEverywhere, kEmpty, TestBox{{0, 0, 0}, {40, 40, 40}}}) {
    Lattice world(6);
    world.boxes[10] = where;
    EXPECT_TRUE(world.find() == plain_pairs(world.boxes));
    world.boxes[20] = kEverywhere;
    EXPECT_TRUE(world.find() == plain_pairs(world.boxes));
    world.boxes[30].lower[1] = kNan;
    EXPECT_TRUE(world.find() == plain_pairs(world.boxes));
    world.boxes.resize(200);
    EXPECT_TRUE(world.find() == plain_pairs(world.boxes));
    EXPECT_LT(world.search.searched, 10u) << "the others rest";
  }
}

TEST(RestingBoxes, AreAllSearchedForUntilTheyRest) {
  const Boxes boxes = make_boxes(BoxFamily::random, 700);
  const LaidOutBoxes memory(boxes);
  PairFinder finder;
  std::vector<Pair> pairs;
  std::vector<size_t> searched;
  for (int frame = 0; frame < 4; ++frame) {
    searched.push_back(finder.find(memory.view(), {}, pairs).searched);
  }
  EXPECT_EQ(searched, (std::vector<size_t>{700, 700, 0, 0}));
}

TEST(RestingBoxes, AreSearchedForOnlyIfTheyChange) {
  Lattice world(8);
  world.find();
  EXPECT_EQ(world.search.changed, 0u);
  EXPECT_EQ(world.search.searched, 0u);
  world.boxes[100].upper[0] += 0.5f;
  world.boxes[7].lower[0] = -0.5f;
  world.find();
  EXPECT_EQ(world.search.changed, 2u);
  EXPECT_EQ(world.search.searched, 2u);
  world.find();
  EXPECT_EQ(world.search.changed, 0u);
  EXPECT_EQ(world.search.searched, 2u) << "they have not settled yet";
  size_t from_scratch = 0;
  for (int frame = 0; frame < 300; ++frame) {
    world.find();
    from_scratch += world.search.searched == world.boxes.size();
  }
  EXPECT_EQ(world.search.searched, 0u) << "now they have";
  EXPECT_EQ(from_scratch, 1u);
}

// If too many boxes move, the finder starts anew each frame, and keeps pairs again once most boxes
// rest.
TEST(RestingBoxes, AreForgottenWhileMostBoxesMove) {
  Lattice world(8);
  for (int frame = 0; frame < 4; ++frame) {
    for (TestBox& box : world.boxes) box.upper[1] += 0.4f;
    EXPECT_TRUE(world.find() == plain_pairs(world.boxes));
    EXPECT_EQ(world.search.searched, world.boxes.size());
  }
  for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(world.find() == plain_pairs(world.boxes));
  EXPECT_EQ(world.search.searched, 0u);
}

// The filter belongs to the resting state: a box whose filter changed is searched again.
TEST(RestingBoxes, MeetOthersWhenTheirFilterChanges) {
  Lattice world(6);
  for (TestBox& box : world.boxes) box.upper[0] += 1;  // now neighbours touch
  Filters filters(world.boxes.size(), 1);
  std::fill(filters.owner.begin(), filters.owner.end(), 1u);
  const PairFilter filter = filters.view(2);
  for (int frame = 0; frame < 4; ++frame) EXPECT_TRUE(world.find(filter).empty());
  filters.owner[43] = 2;
  EXPECT_TRUE(world.find(filter) == plain_pairs(world.boxes, filter));
  EXPECT_EQ(world.search.pairs, 2u);
  EXPECT_EQ(world.search.changed, 1u);
  filters.owner[43] = 1;
  EXPECT_TRUE(world.find(filter).empty());
  EXPECT_TRUE(world.find() == plain_pairs(world.boxes)) << "without a filter";
  EXPECT_TRUE(world.find(filter).empty());
}

TEST(RestingBoxes, InALargeWorldOnOneThreadAndFour) {
  BoxMaker maker(11);
  Random& random = maker.random();
  for (const BoxFamily family : {BoxFamily::random, BoxFamily::decades}) {
    Boxes boxes = make_boxes(family, 20000);
    ThreadArena arena(4);
    arena.run([&] {
      PairFinder one, four, sweep;
      size_t kept = 0;
      for (int frame = 0; frame < 30; ++frame) {
        for (size_t i = 0; i < boxes.size() / 100; ++i) {
          const size_t body = frame < 20 ? i * 97 : random.below(boxes.size());
          boxes[body] = make_box(family, maker, body, boxes.size());
        }
        const LaidOutBoxes memory(boxes);
        std::vector<Pair> a, b, expected;
        sweep.find(memory.view(), {}, expected, BroadphaseMethod::sweep);
        const PairSearch search = one.find(memory.view(), {}, a, BroadphaseMethod::grid);
        four.find(memory.view(), {}, b, BroadphaseMethod::grid, arena.parallelism());
        ASSERT_TRUE(a == expected) << name(family) << ", frame " << frame;
        ASSERT_TRUE(b == expected) << name(family) << ", frame " << frame << ", four threads";
        kept += search.searched < boxes.size() / 4 && search.changed < boxes.size();
      }
      EXPECT_GE(kept, 25u);
    });
  }
}

}  // namespace
}  // namespace carom::test
