// Trees of boxes: a search finds the same items as brute force, on every ISA.
#include "trees/tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <limits>
#include <set>

#include "oracle/random.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

using oracle::Random;
using Items = std::vector<uint32_t>;
using ItemPairs = std::vector<ItemPair>;

constexpr TreeBox kEmpty = {{1, 1, 1}, {-1, -1, -1}};

bool touch(const TreeBox& a, const TreeBox& b) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (!(a.lower[axis] <= b.upper[axis] && b.lower[axis] <= a.upper[axis])) return false;
  }
  return true;
}

struct Style {
  const char* name;
  double spread = 10;       // of middles
  double size = 1;          // of boxes
  double distance = 0;      // distance of all boxes from the origin
  bool on_lattice = false;  // many boxes at the same position
  bool flat = false;
  double empty = 0;
};

constexpr Style kStyles[] = {{.name = "plain"},
                             {.name = "flat", .flat = true},
                             {.name = "lattice", .on_lattice = true},
                             {.name = "one place", .spread = 0},
                             {.name = "points", .size = 0},
                             {.name = "some empty", .empty = 0.3},
                             {.name = "all empty", .empty = 1},
                             {.name = "tiny", .spread = 1e-40, .size = 1e-41},
                             {.name = "huge", .spread = 1e38, .size = 1e37},
                             {.name = "far", .spread = 100, .distance = 1e7}};

std::vector<TreeBox> make_boxes(const Style& style, size_t count, Random& random) {
  std::vector<TreeBox> boxes(count);
  for (TreeBox& box : boxes) {
    const size_t flat_axis = style.flat ? random.below(3) : 3;
    for (size_t axis = 0; axis < 3; ++axis) {
      double middle = random.uniform(-style.spread, style.spread);
      if (style.on_lattice) middle = std::round(middle / 4);
      const double half = axis == flat_axis ? 0 : random.uniform(0, style.size);
      box.lower[axis] = static_cast<float>(style.distance + middle - half);
      box.upper[axis] = static_cast<float>(style.distance + middle + half);
    }
    if (random.chance(style.empty)) box = kEmpty;
  }
  return boxes;
}

auto put_in(Items& all) {
  return
      [&](std::span<const uint32_t> items) { all.insert(all.end(), items.begin(), items.end()); };
}

Items found_in(const BoxTree& tree, const TreeBox& box) {
  Items found;
  tree.find_touching({box}, put_in(found));
  std::sort(found.begin(), found.end());
  return found;
}

Items brute_force(const std::vector<TreeBox>& boxes, const TreeBox& box) {
  Items found;
  for (uint32_t i = 0; i < boxes.size(); ++i) {
    if (!is_empty(boxes[i]) && touch(boxes[i], box)) found.push_back(i);
  }
  return found;
}

constexpr size_t kCounts[] = {0, 1, 2, 7, 8, 9, 15, 16, 17, 63, 64, 65, 200, 1000};

TEST(BoxTree, FindsWhatBruteForceFinds) {
  for (const Style& style : kStyles) {
    SCOPED_TRACE(style.name);
    Random random(1);
    for (const size_t count : kCounts) {
      SCOPED_TRACE(count);
      const std::vector<TreeBox> boxes = make_boxes(style, count, random);
      const BoxTree tree(boxes);
      const BoxTree packed = BoxTree::packed(boxes, Parallelism::none);
      std::vector<TreeBox> queries = make_boxes(style, 20, random);
      queries.push_back({{-FLT_MAX, -FLT_MAX, -FLT_MAX}, {FLT_MAX, FLT_MAX, FLT_MAX}});
      if (count > 0) queries.push_back(boxes[count / 2]);
      for (const TreeBox& query : queries) {
        if (is_empty(query)) continue;
        const Items expected = brute_force(boxes, query);
        for_each_isa([&] {
          EXPECT_EQ(found_in(tree, query), expected);
          EXPECT_EQ(found_in(packed, query), expected);
        });
      }
    }
  }
}

size_t depth_of(std::span<const BoxTree::Node> nodes, uint32_t index = 0) {
  size_t most = 0;
  for (const uint32_t child : nodes[index].child) {
    if (child < BoxTree::kItem) most = std::max(most, depth_of(nodes, child));
  }
  return most + 1;
}

// An eighth of the boxes, and the others a fifth as far from the corner, again and again. A node
// then has nearly all of its items in its last child, and a search leaves the others waiting.
TEST(BoxTree, SearchesOfDeepTreesFindAll) {
  std::vector<TreeBox> boxes;
  float size = 1e35f;
  for (size_t left = 300'000; left > 0; size /= 5) {
    const size_t count = size < 1e-35f ? left : left / 8 + 1;
    for (size_t i = 0; i < count; ++i) {
      const float at = -size * (1 + static_cast<float>(i) / static_cast<float>(count));
      boxes.push_back({{at, at, at}, {at, at, at}});
    }
    left -= count;
  }
  const BoxTree tree(boxes);
  EXPECT_GT(depth_of(tree.nodes()), 32u);
  const TreeBox everything = {{-FLT_MAX, -FLT_MAX, -FLT_MAX}, {0, 0, 0}};
  for_each_isa([&] { EXPECT_EQ(found_in(tree, everything).size(), boxes.size()); });
}

double squared_distance(const TreeBox& a, const TreeBox& b) {
  double sum = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double above = double{a.lower[axis]} - b.upper[axis];
    const double below = double{b.lower[axis]} - a.upper[axis];
    const double gap = std::max({above, below, 0.0});
    sum += gap * gap;
  }
  return sum;
}

// The search finds all items within the radius and hardly any beyond it. If the box is a point, the
// region is a ball.
TEST(BoxTree, FindsWhatIsNearABox) {
  for (const Style& style : kStyles) {
    SCOPED_TRACE(style.name);
    Random random(4);
    for (const size_t count : kCounts) {
      const std::vector<TreeBox> boxes = make_boxes(style, count, random);
      const BoxTree tree(boxes);
      for (int i = 0; i < 30; ++i) {
        Double3 middle, half;
        for (size_t axis = 0; axis < 3; ++axis) {
          middle[axis] = style.distance + random.uniform(-style.spread, style.spread);
          half[axis] = i % 2 == 0 ? 0 : random.uniform(0, style.size);
        }
        const double radius = random.uniform(0, style.spread / 3);
        const TreeBox box = rounded_outwards(middle, half);
        Items found;
        tree.find_touching(rounded_outwards(middle, half, radius), put_in(found));
        const bool is_round = radius > 1e-15 && radius < 1e15;
        const std::set<uint32_t> all(found.begin(), found.end());
        ASSERT_EQ(all.size(), found.size());
        for (uint32_t k = 0; k < count; ++k) {
          const double squared = squared_distance(boxes[k], box);
          const bool is_within = !is_empty(boxes[k]) && squared <= radius * radius;
          // Beyond the range of squared floats the region is a grown box, whose corners are further
          // away.
          const double most = radius * radius * (is_round ? 1 + 1e-5 : 3 + 1e-5);
          const bool is_beyond = is_empty(boxes[k]) || squared > most + 1e-80;
          ASSERT_TRUE(!is_within || all.count(k) == 1);
          ASSERT_TRUE(!is_beyond || all.count(k) == 0);
        }
        for_each_isa([&] {
          Items again;
          tree.find_touching(rounded_outwards(middle, half, radius), put_in(again));
          EXPECT_EQ(again, found);  // in the same order
        });
      }
    }
  }
}

TEST(BoxTree, FindsWhatIsBelowAPlane) {
  for (const Style& style : kStyles) {
    SCOPED_TRACE(style.name);
    Random random(2);
    const std::vector<TreeBox> boxes = make_boxes(style, 300, random);
    const BoxTree tree(boxes);
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d n = random.direction();
      const double limit = style.distance * n.sum() + random.uniform(-1, 1) * style.spread;
      Items found, expected;
      tree.find_below({n.x(), n.y(), n.z()}, limit, [&](uint32_t item) { found.push_back(item); });
      std::sort(found.begin(), found.end());
      for (uint32_t k = 0; k < boxes.size(); ++k) {
        double least = 0;
        for (int axis = 0; axis < 3; ++axis) {
          least += std::min(n[axis] * boxes[k].lower[axis], n[axis] * boxes[k].upper[axis]);
        }
        if (!is_empty(boxes[k]) && least <= limit) expected.push_back(k);
      }
      EXPECT_EQ(found, expected);
    }
  }
}

double greatest_of(const std::vector<TreeBox>& boxes) {
  double most = 0;
  for (const TreeBox& box : boxes) {
    for (size_t axis = 0; axis < 3 && !is_empty(box); ++axis) {
      most =
          std::max({most, std::fabs(double{box.lower[axis]}), std::fabs(double{box.upper[axis]})});
    }
  }
  return most;
}

// The search finds all items whose boxes touch in both frames, and only items that do up to
// rounding.
TEST(BoxTree, TwoTreesFindAllThatTouch) {
  for (const Style& style : kStyles) {
    SCOPED_TRACE(style.name);
    Random random(3);
    for (const size_t count_a : {0, 1, 8, 9, 150}) {
      for (const size_t count_b : {0, 1, 8, 20, 130}) {
        const std::vector<TreeBox> boxes_a = make_boxes(style, count_a, random);
        const std::vector<TreeBox> boxes_b = make_boxes(style, count_b, random);
        const BoxTree a(boxes_a), b(boxes_b);
        FrameChange change = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {}};
        if (random.chance(0.5)) change = {{{{0.6, -0.8, 0}, {0.8, 0.6, 0}, {0, 0, 1}}}, {}};
        change.offset[0] = random.uniform(-style.spread, style.spread);
        const double reach = random.chance(0.5) ? 0 : style.size;
        const double lengths =
            greatest_of(boxes_a) + greatest_of(boxes_b) + greatest(change.offset);
        const double most = reach + 0x1p-17 * lengths;
        ItemPairs expected;
        for (uint32_t i = 0; i < count_a; ++i) {
          for (uint32_t j = 0; j < count_b; ++j) {
            if (is_empty(boxes_a[i]) || is_empty(boxes_b[j])) continue;
            if (touch(boxes_a[i], change.around(boxes_b[j], reach)) &&
                touch(boxes_b[j], change.inverse().around(boxes_a[i], reach))) {
              expected.push_back({i, j});
            }
          }
        }
        for_each_isa([&] {
          ItemPairs found;
          find_touching_items(a, b, change, reach, [&](std::span<const ItemPair> pairs) {
            found.insert(found.end(), pairs.begin(), pairs.end());
            return reach;
          });
          std::sort(found.begin(), found.end());
          EXPECT_TRUE(std::adjacent_find(found.begin(), found.end()) == found.end());
          EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
          for (const auto& [i, j] : found) {
            EXPECT_TRUE(touch(boxes_a[i], change.around(boxes_b[j], most)));
            EXPECT_TRUE(touch(boxes_b[j], change.inverse().around(boxes_a[i], most)));
          }
        });
      }
    }
  }
}

// A query visits a small part of the tree: the number of nodes that a box touches bounds the work.
TEST(BoxTree, IsBalanced) {
  Random random(4);
  const size_t count = 20000;
  const BoxTree tree(make_boxes({.name = "", .spread = 1000}, count, random));
  EXPECT_LT(tree.nodes().size(), count / 3);
  // Centres at exponentially growing distances are the worst case for bins.
  std::vector<TreeBox> boxes(1000);
  for (size_t i = 0; i < boxes.size(); ++i) {
    const float x = std::ldexp(1.0f, static_cast<int>(i % 250) - 125);
    boxes[i] = {{x, 0, 0}, {x, 0, 0}};
  }
  const BoxTree uneven(boxes);
  for (size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_EQ(found_in(uneven, boxes[i]), brute_force(boxes, boxes[i]));
  }
}

TEST(BoxTree, SomeItemIsNear) {
  for (const Style& style : kStyles) {
    if (style.empty == 1) continue;
    Random random(5);
    for (const size_t count : {1, 8, 9, 300}) {
      const std::vector<TreeBox> boxes = make_boxes(style, count, random);
      const BoxTree tree(boxes);
      if (tree.is_empty()) continue;
      const uint32_t near = tree.near_item(boxes[0]);
      const uint32_t low = tree.low_item({0, 0, 1});
      ASSERT_LT(std::max(near, low), count);
      EXPECT_FALSE(is_empty(boxes[near]) || is_empty(boxes[low]));
      FrameChange change = {{{{0.6, -0.8, 0}, {0.8, 0.6, 0}, {0, 0, 1}}}, {style.spread, 0, 0}};
      const ItemPair both = near_items(tree, tree, change);
      ASSERT_LT(std::max(both.a, both.b), count);
      EXPECT_FALSE(is_empty(boxes[both.a]) || is_empty(boxes[both.b]));
    }
  }
}

// Searches read whole nodes, so a place without a child is memory for nothing.
TEST(BoxTree, NodesAreWellFilled) {
  Random random(8);
  const std::vector<TreeBox> boxes = make_boxes({}, 20'000, random);
  const BoxTree tree(boxes);
  size_t children = 0;
  for (const BoxTree::Node& node : tree.nodes()) {
    for (size_t i = 0; i < BoxTree::kChildren; ++i) children += !is_empty(node.box(i));
  }
  EXPECT_EQ(children, boxes.size() + tree.nodes().size() - 1);
  EXPECT_GT(children, tree.nodes().size() * 6);
}

}  // namespace
}  // namespace carom::test
