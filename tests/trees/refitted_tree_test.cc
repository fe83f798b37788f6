// Refitted trees find what a test of every box finds, however the boxes have moved.
#include "trees/refitted_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "carom/base/thread_arena.h"
#include "oracle/random.h"

namespace carom::test {
namespace {

TreeBox box_about(const std::array<double, 3>& middle, double half) {
  TreeBox box;
  for (size_t axis = 0; axis < 3; ++axis) {
    box.lower[axis] = static_cast<float>(middle[axis] - half);
    box.upper[axis] = static_cast<float>(middle[axis] + half);
  }
  return box;
}

TreeBox random_box(oracle::Random& random, double half) {
  return box_about({random.uniform(0, 20), random.uniform(0, 20), random.uniform(0, 20)}, half);
}

void move(TreeBox& box, oracle::Random& random, double distance) {
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto way = static_cast<float>(random.uniform(-distance, distance));
    box.lower[axis] += way;
    box.upper[axis] += way;
  }
}

bool boxes_touch(const TreeBox& a, const TreeBox& b) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (!(a.lower[axis] <= b.upper[axis] && b.lower[axis] <= a.upper[axis])) return false;
  }
  return true;
}

// Returns how many items were found.
size_t expect_all_found(const BoxTree& tree, const std::vector<TreeBox>& boxes,
                        const std::vector<uint8_t>& parts, oracle::Random& random) {
  size_t count = 0;
  for (int i = 0; i < 20; ++i) {
    const TreeBox query = random_box(random, 2);
    std::vector<uint32_t> found, expected;
    tree.find_touching({query}, [&](std::span<const uint32_t> items) {
      found.insert(found.end(), items.begin(), items.end());
    });
    for (uint32_t k = 0; k < boxes.size(); ++k) {
      if (parts[k] < RefittedTree::kParts && boxes_touch(boxes[k], query)) expected.push_back(k);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    count += found.size();
  }
  return count;
}

TEST(RefittedTree, FollowsItsBoxes) {
  for (const size_t count : {0, 1, 7, 8, 9, 65, 2000}) {
    oracle::Random random(count);
    std::vector<TreeBox> boxes;
    std::vector<uint8_t> parts;
    for (size_t i = 0; i < count; ++i) {
      boxes.push_back(random_box(random, random.uniform(0, 0.5)));
      parts.push_back(static_cast<uint8_t>(random.below(3)));  // 2: in no part
    }
    RefittedTree tree;
    tree.build(0, boxes, parts, Parallelism::none);
    size_t found = expect_all_found(tree.tree(), boxes, parts, random);
    for (int step = 0; step < 12; ++step) {
      const size_t part = static_cast<size_t>(step) % RefittedTree::kParts;
      for (size_t i = 0; i < count; ++i) {
        if (parts[i] != part) continue;
        move(boxes[i], random, step < 6 ? 0.3 : 8);
        if (random.chance(0.05)) boxes[i] = kNothing;
      }
      if (step % 5 == 4) {
        // Empty boxes leave the tree when their part is built.
        tree.build(part, boxes, parts, Parallelism::none);
      } else {
        tree.refit(part, boxes, Parallelism::none);
      }
      found += expect_all_found(tree.tree(), boxes, parts, random);
    }
    EXPECT_EQ(found > 1000, count == 2000);
  }
}

TEST(RefittedTree, IsWornOnceBoxesHaveMixed) {
  oracle::Random random(1);
  std::vector<TreeBox> boxes;
  for (int i = 0; i < 5000; ++i) boxes.push_back(random_box(random, 0.2));
  const std::vector<uint8_t> parts(boxes.size(), 1);
  RefittedTree tree;
  tree.build(0, boxes, parts, Parallelism::none);
  EXPECT_FALSE(tree.is_worn(0) || tree.is_worn(1));
  for (TreeBox& box : boxes) move(box, random, 0.05);
  tree.refit(1, boxes, Parallelism::none);
  EXPECT_FALSE(tree.is_worn(1));
  for (TreeBox& box : boxes) move(box, random, 5);
  tree.refit(1, boxes, Parallelism::none);
  EXPECT_TRUE(tree.is_worn(1));
  EXPECT_FALSE(tree.is_worn(0));
  tree.build(1, boxes, parts, Parallelism::none);
  EXPECT_FALSE(tree.is_worn(1));
}

TEST(RefittedTree, IsTheSameOnThreads) {
  oracle::Random random(2);
  std::vector<TreeBox> boxes;
  std::vector<uint8_t> parts;
  for (int i = 0; i < 40'000; ++i) {
    boxes.push_back(random_box(random, 0.1));
    parts.push_back(static_cast<uint8_t>(random.below(2)));
  }
  std::vector<TreeBox> later = boxes;
  for (TreeBox& box : later) move(box, random, 0.1);
  const auto run = [&](Parallelism parallelism) {
    RefittedTree tree;
    tree.build(0, boxes, parts, parallelism);
    for (size_t part = 0; part < RefittedTree::kParts; ++part) tree.refit(part, later, parallelism);
    return tree;
  };
  const RefittedTree expected = run(Parallelism::none);
  ThreadArena arena(4);
  arena.run([&] {
    const RefittedTree tree = run(arena.parallelism());
    ASSERT_EQ(tree.tree().nodes().size(), expected.tree().nodes().size());
    EXPECT_EQ(std::memcmp(tree.tree().nodes().data(), expected.tree().nodes().data(),
                          tree.tree().nodes().size_bytes()),
              0);
  });
}

}  // namespace
}  // namespace carom::test
