// Walks of moving boxes through a tree, and searches for neighbours, against every box one by one.
#include "broadphase/tree_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>

#include "base/outward.h"
#include "tests/support/boxes.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

using Items = std::vector<uint32_t>;
using Real = long double;

struct Probe {
  TreeBox box;
  std::array<float, 3> displacement{};
};

TreeBox tree_box(const TestBox& box) {
  return {{box.lower[0], box.lower[1], box.lower[2]}, {box.upper[0], box.upper[1], box.upper[2]}};
}

std::vector<TreeBox> boxes_of(BoxFamily family, size_t count) {
  std::vector<TreeBox> boxes;
  for (const TestBox& box : make_boxes(family, count)) boxes.push_back(tree_box(box));
  return boxes;
}

bool takes_part(const TreeBox& box) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (!(box.lower[axis] <= box.upper[axis])) return false;
  }
  return true;
}

// Directed sums decide here; they are exact even where exponents are far apart.
bool reaches(const Probe& probe, const TreeBox& box, size_t axis) {
  const float d = probe.displacement[axis];
  return sum_downwards(probe.box.lower[axis], std::min(d, 0.0f)) <= box.upper[axis] &&
         sum_upwards(probe.box.upper[axis], std::max(d, 0.0f)) >= box.lower[axis];
}

// When the probe meets the box, if it does. With a slack a near miss within that share of the path
// counts, too.
std::optional<Real> time_of_meeting(const Probe& probe, const TreeBox& box, Real slack) {
  if (!takes_part(box)) return std::nullopt;
  Real entry = 0, exit = 1;
  for (size_t axis = 0; axis < 3; ++axis) {
    const Real d = probe.displacement[axis];
    const Real to_lower = Real(box.lower[axis]) - probe.box.upper[axis];
    const Real to_upper = Real(box.upper[axis]) - probe.box.lower[axis];
    const Real margin = slack * std::abs(d);
    if (slack == 0 && !reaches(probe, box, axis)) return std::nullopt;
    if (d == 0 || std::abs(d) < 0x1p-120L) {
      if (to_lower > std::max(d, Real(0)) + margin) return std::nullopt;
      if (to_upper < std::min(d, Real(0)) - margin) return std::nullopt;
      if (d == 0 || slack > 0) continue;
    }
    entry = std::max(entry, (d > 0 ? to_lower : to_upper) / d);
    exit = std::min(exit, (d > 0 ? to_upper : to_lower) / d);
  }
  const Real latest = slack > 0 ? exit + slack * (1 + std::abs(exit)) : exit;
  if (entry > latest) return std::nullopt;
  return entry;
}

// Probes through the volume of the boxes: most of them random, some along an axis, from corner to
// corner, far too long, very short, or of length zero.
std::vector<Probe> make_probes(const std::vector<TreeBox>& boxes, size_t count, uint64_t seed) {
  Random random(seed);
  std::vector<Probe> probes(count);
  const double side = side_for(boxes.size());
  for (Probe& probe : probes) {
    const float size = random.chance(0.5) ? 0 : static_cast<float>(random.uniform(0, 1));
    const double scale = random.chance(0.2) ? random.log_uniform(1e-44, 1e37) : side;
    for (size_t axis = 0; axis < 3; ++axis) {
      probe.box.lower[axis] = static_cast<float>(random.uniform(0, side));
      probe.displacement[axis] = static_cast<float>(random.uniform(-scale, scale));
      if (random.chance(0.2)) probe.displacement[axis] = random.chance(0.5) ? 0.0f : -0.0f;
    }
    if (!boxes.empty() && random.chance(0.5)) {
      const TreeBox& from = boxes[random.below(boxes.size())];
      const TreeBox& to = boxes[random.below(boxes.size())];
      for (size_t axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(from.lower[axis]) || !std::isfinite(to.upper[axis])) continue;
        probe.box.lower[axis] = from.lower[axis];
        if (random.chance(0.7)) probe.displacement[axis] = to.upper[axis] - from.lower[axis];
      }
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(probe.displacement[axis])) probe.displacement[axis] = FLT_MAX;
      probe.box.upper[axis] = probe.box.lower[axis] + size;
    }
  }
  return probes;
}

Items all_met(const BoxTree& tree, const Probe& probe, size_t most, float limit = 1) {
  TreeWalk walk;
  Items items;
  walk.start(tree);
  MovingBox moving;
  moving.set(probe.box, probe.displacement);
  while (!walk.is_done()) {
    const size_t before = items.size();
    walk_met(tree, moving, limit, most, walk, items);
    EXPECT_TRUE(walk.is_done() || items.size() == before + most);
  }
  return items;
}

Items sorted(Items items) {
  std::sort(items.begin(), items.end());
  return items;
}

std::string show(const Probe& probe, const TreeBox& box) {
  std::ostringstream out;
  for (size_t axis = 0; axis < 3; ++axis) {
    out << "\n"
        << std::hexfloat << probe.box.lower[axis] << " to " << probe.box.upper[axis] << " moves by "
        << probe.displacement[axis] << ", box from " << box.lower[axis] << " to "
        << box.upper[axis];
  }
  return out.str();
}

struct Tally {
  size_t found = 0, surely = 0, pairs = 0;
};

void check_probe(const BoxTree& tree, const std::vector<TreeBox>& boxes, const Probe& probe,
                 Tally& tally) {
  const Items items = sorted(all_met(tree, probe, ~size_t{0} / 2));
  EXPECT_EQ(std::adjacent_find(items.begin(), items.end()), items.end());
  const float limit = 0.25f;
  const Items early = sorted(all_met(tree, probe, ~size_t{0} / 2, limit));
  EXPECT_TRUE(std::includes(items.begin(), items.end(), early.begin(), early.end()));
  EXPECT_EQ(sorted(all_met(tree, probe, 1)), items);
  EXPECT_EQ(sorted(all_met(tree, probe, 3)), items);
  tally.found += items.size();
  for (uint32_t i = 0; i < boxes.size(); ++i) {
    const bool is_found = std::binary_search(items.begin(), items.end(), i);
    const std::optional<Real> time = time_of_meeting(probe, boxes[i], 0);
    if (time) {
      EXPECT_TRUE(is_found) << "box " << i << " of " << boxes.size() << show(probe, boxes[i]);
      EXPECT_TRUE(*time > limit || std::binary_search(early.begin(), early.end(), i)) << i;
      ++tally.surely;
    }
    EXPECT_TRUE(!is_found || time_of_meeting(probe, boxes[i], 0x1p-18L)) << "box " << i;
    ++tally.pairs;
  }
}

TEST(TreeWalk, MeetsWhatTheBoxMeetsOnItsWay) {
  Tally tally;
  for (int family = 0; family < kBoxFamilies; ++family) {
    SCOPED_TRACE(name(static_cast<BoxFamily>(family)));
    for (const size_t count : {0, 1, 7, 8, 9, 65, 300}) {
      const std::vector<TreeBox> boxes = boxes_of(static_cast<BoxFamily>(family), count);
      const BoxTree tree = BoxTree::packed(boxes, Parallelism::none);
      for (const Probe& probe : make_probes(boxes, 60, count))
        check_probe(tree, boxes, probe, tally);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(tally.surely, tally.pairs / 50);
}

TEST(TreeWalk, MeetsHardlyAnythingElse) {
  const std::vector<TreeBox> boxes = boxes_of(BoxFamily::random, 2000);
  const BoxTree tree = BoxTree::packed(boxes, Parallelism::none);
  Random random(1);
  Tally tally;
  for (int i = 0; i < 500; ++i) {
    Probe probe;
    for (size_t axis = 0; axis < 3; ++axis) {
      probe.box.lower[axis] = probe.box.upper[axis] = static_cast<float>(random.uniform(0, 12));
      probe.displacement[axis] = static_cast<float>(random.uniform(-12, 12));
    }
    check_probe(tree, boxes, probe, tally);
  }
  EXPECT_GT(tally.surely, 2000u);
  EXPECT_LE(tally.found, tally.surely + 5);
}

// Searches in several trees, some of them empty, go on until each has found all of its items.
TEST(TreeWalk, FindsTheSameSideBySide) {
  std::vector<std::vector<TreeBox>> boxes;
  for (const size_t count : {0, 1, 9, 300}) boxes.push_back(boxes_of(BoxFamily::random, count));
  std::vector<BoxTree> trees;
  for (const auto& list : boxes) trees.push_back(BoxTree::packed(list, Parallelism::none));
  const std::vector<Probe> probes = make_probes(boxes.back(), 40, 5);
  for_each_isa([&] {
    for (const size_t count : {0, 1, 15, 16, 17, 40}) {
      for (const size_t most : {1, 2, 5}) {
        std::vector<MovingBox> moving(count);
        std::vector<TreeWalk> walks(count);
        std::vector<uint32_t> room(count * most);
        std::vector<Items> items(count);
        for (size_t i = 0; i < count; ++i) {
          moving[i].set(probes[i].box, probes[i].displacement);
          walks[i].start(trees[i % trees.size()]);
        }
        size_t found = 1;
        while (found > 0) {
          std::vector<MetSearch> searches;
          for (size_t i = 0; i < count; ++i) {
            searches.push_back({.tree = &trees[i % trees.size()],
                                .box = &moving[i],
                                .limit = 1,
                                .walk = &walks[i],
                                .items = &room[i * most]});
          }
          walk_met(searches, most);
          found = 0;
          for (size_t i = 0; i < count; ++i) {
            EXPECT_TRUE(walks[i].is_done() || searches[i].count == most);
            items[i].insert(items[i].end(), searches[i].items,
                            searches[i].items + searches[i].count);
            found += searches[i].count;
          }
        }
        for (size_t i = 0; i < count; ++i) {
          EXPECT_EQ(items[i], all_met(trees[i % trees.size()], probes[i], most));
        }
      }
    }
  });
}

// Infinite boxes, as for half-space queries and for coordinates beyond the range of float32.
TEST(TreeWalk, OfInfiniteBoxes) {
  const std::vector<TreeBox> boxes = boxes_of(BoxFamily::infinite, 300);
  const BoxTree tree = BoxTree::packed(boxes, Parallelism::none);
  Items expected;
  for (uint32_t i = 0; i < boxes.size(); ++i) {
    if (takes_part(boxes[i])) expected.push_back(i);
  }
  const TreeBox everything = {{-kInfinity, -kInfinity, -kInfinity},
                              {kInfinity, kInfinity, kInfinity}};
  for (const std::array<float, 3>& way :
       {std::array<float, 3>{0, 0, 0}, {1, -1, 0}, {0, 1e38f, 1}}) {
    EXPECT_EQ(sorted(all_met(tree, {everything, way}, 5)), expected);
  }
}

TEST(TreeWalk, IsTheSameOnEveryIsa) {
  const std::vector<TreeBox> boxes = boxes_of(BoxFamily::decades, 500);
  const BoxTree tree = BoxTree::packed(boxes, Parallelism::none);
  const std::vector<Probe> probes = make_probes(boxes, 200, 3);
  const auto walk_all = [&] {
    Items all;
    for (const Probe& probe : probes) {
      const Items met = all_met(tree, probe, 7);
      all.insert(all.end(), met.begin(), met.end());
      TreeWalk walk;
      walk.start(tree);
      walk_near(tree, probe.box, kInfinity, ~size_t{0} / 2, walk, all);
    }
    return all;
  };
  const Items expected = walk_all();
  for_each_isa([&] { EXPECT_EQ(walk_all(), expected); });
}

Real distance(const TreeBox& a, const TreeBox& b) {
  Real squared = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const Real gap = std::max(
        {Real(a.lower[axis]) - b.upper[axis], Real(b.lower[axis]) - a.upper[axis], Real(0)});
    squared += gap * gap;
  }
  return std::sqrt(squared);
}

TEST(TreeWalk, FindsWhatIsNear) {
  for (const BoxFamily family : {BoxFamily::random, BoxFamily::decades, BoxFamily::huge,
                                 BoxFamily::subnormal, BoxFamily::spoilt, BoxFamily::outlier}) {
    SCOPED_TRACE(name(family));
    const std::vector<TreeBox> boxes = boxes_of(family, 300);
    const BoxTree tree = BoxTree::packed(boxes, Parallelism::none);
    Random random(5);
    for (const Probe& probe : make_probes(boxes, 60, 1)) {
      const TreeBox& other = boxes[random.below(boxes.size())];
      const auto limit = static_cast<float>(takes_part(other) ? distance(probe.box, other) : 1);
      TreeWalk walk;
      Items items;
      walk.start(tree);
      while (!walk.is_done()) walk_near(tree, probe.box, limit, 4, walk, items);
      items = sorted(items);
      for (uint32_t i = 0; i < boxes.size(); ++i) {
        const bool is_found = std::binary_search(items.begin(), items.end(), i);
        const Real apart = takes_part(boxes[i]) ? distance(probe.box, boxes[i]) : kInfinity;
        EXPECT_TRUE(is_found || apart > limit) << "box " << i;
        EXPECT_TRUE(!is_found || apart * (1 - 0x1p-18L) <= limit || limit > 1e19f ||
                    limit < 1e-19f);
      }
    }
  }
}

// The walk visits near boxes first, so a search that stops early has seen the nearest one.
TEST(TreeWalk, BeginsWithWhatIsFirst) {
  const std::vector<TreeBox> boxes = boxes_of(BoxFamily::random, 5000);
  const BoxTree tree = BoxTree::packed(boxes, Parallelism::none);
  size_t looked_at = 0;
  for (const Probe& probe : make_probes(boxes, 200, 2)) {
    TreeWalk walk;
    Items items;
    walk.start(tree);
    float least = kInfinity;
    while (!walk.is_done()) {
      const size_t before = items.size();
      walk_near(tree, probe.box, least, 1, walk, items);
      for (size_t i = before; i < items.size(); ++i) {
        least = std::min(least, static_cast<float>(distance(probe.box, boxes[items[i]])));
      }
    }
    for (const TreeBox& box : boxes) EXPECT_GE(distance(probe.box, box), Real(least) * 0.999999L);
    looked_at += items.size();
  }
  EXPECT_LT(looked_at, 200u * 20);
}

}  // namespace
}  // namespace carom::test
