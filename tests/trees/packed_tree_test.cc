// Trees made by sorting: every box is in its place, for any number of threads.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "carom/base/thread_arena.h"
#include "tests/support/boxes.h"
#include "trees/tree.h"

namespace carom::test {
namespace {

std::vector<TreeBox> tree_boxes(const Boxes& boxes) {
  std::vector<TreeBox> result;
  for (const TestBox& box : boxes) {
    result.push_back(
        {{box.lower[0], box.lower[1], box.lower[2]}, {box.upper[0], box.upper[1], box.upper[2]}});
  }
  return result;
}

bool holds(const TreeBox& outer, const TreeBox& inner) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (!(outer.lower[axis] <= inner.lower[axis] && inner.upper[axis] <= outer.upper[axis])) {
      return false;
    }
  }
  return true;
}

bool takes_part(const TreeBox& box) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (!(box.lower[axis] <= box.upper[axis])) return false;
  }
  return true;
}

// Counts the items below the node, whose boxes must be those of the list and inside `around`.
void check_below(const BoxTree& tree, uint32_t index, const TreeBox& around,
                 const std::vector<TreeBox>& boxes, std::vector<int>& seen) {
  const BoxTree::Node& node = tree.nodes()[index];
  for (size_t i = 0; i < BoxTree::kChildren; ++i) {
    const TreeBox box = node.box(i);
    if (!takes_part(box)) continue;
    ASSERT_TRUE(holds(around, box));
    if (node.child[i] < BoxTree::kItem) {
      check_below(tree, node.child[i], box, boxes, seen);
      continue;
    }
    const uint32_t item = node.child[i] - BoxTree::kItem;
    ASSERT_TRUE(holds(box, boxes[item]) && holds(boxes[item], box));
    ++seen[item];
  }
}

TEST(PackedTree, HasEveryBoxInItsPlace) {
  constexpr TreeBox kAll = {{-kInfinity, -kInfinity, -kInfinity},
                            {kInfinity, kInfinity, kInfinity}};
  for (int family = 0; family < kBoxFamilies; ++family) {
    SCOPED_TRACE(name(static_cast<BoxFamily>(family)));
    for (const size_t count : {0, 1, 7, 8, 9, 63, 64, 65, 513, 3000}) {
      const std::vector<TreeBox> boxes =
          tree_boxes(make_boxes(static_cast<BoxFamily>(family), count));
      const BoxTree tree = BoxTree::packed(boxes, Parallelism::none);
      std::vector<int> seen(count);
      if (!tree.is_empty()) check_below(tree, 0, kAll, boxes, seen);
      for (size_t i = 0; i < count; ++i) EXPECT_EQ(seen[i], takes_part(boxes[i]) ? 1 : 0) << i;
    }
  }
}

TEST(PackedTree, IsTheSameOnThreads) {
  const std::vector<TreeBox> boxes = tree_boxes(make_boxes(BoxFamily::decades, 70'000));
  const BoxTree expected = BoxTree::packed(boxes, Parallelism::none);
  for (const int threads : {1, 2, 4}) {
    ThreadArena arena(threads);
    arena.run([&] {
      const BoxTree tree = BoxTree::packed(boxes, arena.parallelism());
      ASSERT_EQ(tree.nodes().size(), expected.nodes().size());
      EXPECT_EQ(
          std::memcmp(tree.nodes().data(), expected.nodes().data(), tree.nodes().size_bytes()), 0);
    });
  }
}

}  // namespace
}  // namespace carom::test
