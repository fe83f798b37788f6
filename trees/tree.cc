// Builds a tree top down: it splits a node's items until there are as many groups as a node has
// children, each time the largest group in two, where the surface area heuristic says (J. D.
// MacDonald, K. S. Booth, Heuristics for Ray Tracing Using Space Subdivision, The Visual Computer
// 6, 1990; binned as in I. Wald, On fast Construction of SAH-based Bounding Volume Hierarchies,
// 2007).
#include "trees/tree.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/outward.h"

namespace carom {
namespace {

void include(const TreeBox& box, TreeBox& in) {
  for (size_t axis = 0; axis < 3; ++axis) {
    in.lower[axis] = std::min(in.lower[axis], box.lower[axis]);
    in.upper[axis] = std::max(in.upper[axis], box.upper[axis]);
  }
}

double middle(const TreeBox& box, size_t axis) {
  return (double{box.lower[axis]} + box.upper[axis]) / 2;
}

// The items at [begin, end) of the order.
struct Group {
  size_t begin, end;

  size_t count() const { return end - begin; }
};

class TreeBuilder {
 public:
  TreeBuilder(std::span<const TreeBox> boxes, std::vector<BoxTree::Node>& nodes)
      : boxes_(boxes), nodes_(nodes) {
    for (uint32_t i = 0; i < boxes.size(); ++i) {
      if (!is_empty(boxes[i])) order_.push_back(i);
    }
  }

  void build() {
    if (!order_.empty()) add_node({0, order_.size()});
    nodes_.shrink_to_fit();
  }

 private:
  static constexpr size_t kBins = 16;

  uint32_t add_node(Group all) {
    const auto index = static_cast<uint32_t>(nodes_.size());
    nodes_.emplace_back();
    std::array<Group, BoxTree::kChildren> groups;
    const size_t count = split_all(all, groups);
    for (size_t i = 0; i < BoxTree::kChildren; ++i) {
      set_box(index, i, i < count ? box_of(groups[i]) : kNothing);
      nodes_[index].child[i] = BoxTree::kItem;
    }
    for (size_t i = 0; i < count; ++i) {
      const uint32_t child =
          groups[i].count() == 1 ? order_[groups[i].begin] + BoxTree::kItem : add_node(groups[i]);
      nodes_[index].child[i] = child;
    }
    return index;
  }

  size_t split_all(Group all, std::array<Group, BoxTree::kChildren>& groups) {
    groups[0] = all;
    size_t count = 1;
    while (count < groups.size()) {
      const auto largest =
          std::max_element(groups.begin(), groups.begin() + count,
                           [](const Group& a, const Group& b) { return a.count() < b.count(); });
      if (largest->count() == 1) break;
      const size_t at = split(*largest);
      groups[count++] = {at, largest->end};
      largest->end = at;
    }
    return count;
  }

  // Splits a group in two, and returns where its second part begins. Each part gets at least an
  // eighth of the items, which bounds the depth of the tree.
  size_t split(Group group) {
    const TreeBox middles = box_of_middles(group);
    size_t best_axis = 0;
    double widest = -1;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double width = double{middles.upper[axis]} - middles.lower[axis];
      if (width > widest) {
        widest = width;
        best_axis = axis;
      }
    }
    const size_t least = group.count() / 8;
    const size_t at = group.count() > kBins ? split_by_bins(group, best_axis, middles) : 0;
    if (at > group.begin + least && at + least < group.end) return at;
    const size_t half = group.begin + group.count() / 2;
    std::nth_element(order_.begin() + group.begin, order_.begin() + half,
                     order_.begin() + group.end, [&](uint32_t a, uint32_t b) {
                       return std::pair(middle(boxes_[a], best_axis), a) <
                              std::pair(middle(boxes_[b], best_axis), b);
                     });
    return half;
  }

  size_t split_by_bins(Group group, size_t axis, const TreeBox& middles) {
    const double start = middles.lower[axis];
    const double width = middles.upper[axis] - start;
    if (!(width > 0)) return group.begin;
    const auto bin_of = [&](uint32_t item) {
      const double place = (middle(boxes_[item], axis) - start) / width * kBins;
      return static_cast<size_t>(std::clamp(place, 0.0, double{kBins - 1}));
    };
    std::array<TreeBox, kBins> box;
    std::array<size_t, kBins> count{};
    box.fill(kNothing);
    for (size_t i = group.begin; i < group.end; ++i) {
      const size_t bin = bin_of(order_[i]);
      include(boxes_[order_[i]], box[bin]);
      ++count[bin];
    }
    const size_t first = cheapest(box, count);
    const auto second = std::partition(order_.begin() + group.begin, order_.begin() + group.end,
                                       [&](uint32_t item) { return bin_of(item) < first; });
    return static_cast<size_t>(second - order_.begin());
  }

  // The bin with which the second part begins.
  static size_t cheapest(const std::array<TreeBox, kBins>& box,
                         const std::array<size_t, kBins>& count) {
    std::array<double, kBins> cost{};
    const auto add_costs = [&](bool from_start) {
      TreeBox all = kNothing;
      size_t items = 0;
      for (size_t i = 0; i + 1 < kBins; ++i) {
        const size_t bin = from_start ? i : kBins - 1 - i;
        include(box[bin], all);
        items += count[bin];
        cost[from_start ? bin + 1 : bin] += items > 0 ? half_area(all) * double(items) : 0;
      }
    };
    add_costs(true);
    add_costs(false);
    return static_cast<size_t>(std::min_element(cost.begin() + 1, cost.end()) - cost.begin());
  }

  TreeBox box_of(Group group) const {
    TreeBox all = kNothing;
    for (size_t i = group.begin; i < group.end; ++i) include(boxes_[order_[i]], all);
    return all;
  }

  TreeBox box_of_middles(Group group) const {
    TreeBox all = kNothing;
    for (size_t i = group.begin; i < group.end; ++i) {
      TreeBox point;
      for (size_t axis = 0; axis < 3; ++axis) {
        point.lower[axis] = static_cast<float>(middle(boxes_[order_[i]], axis));
        point.upper[axis] = point.lower[axis];
      }
      include(point, all);
    }
    return all;
  }

  void set_box(uint32_t node, size_t i, const TreeBox& box) {
    for (size_t axis = 0; axis < 3; ++axis) {
      nodes_[node].lower[axis][i] = box.lower[axis];
      nodes_[node].upper[axis][i] = box.upper[axis];
    }
  }

  std::span<const TreeBox> boxes_;
  std::vector<BoxTree::Node>& nodes_;
  std::vector<uint32_t> order_;
};

// The squared distance.
double distance(const TreeBox& a, const TreeBox& b) {
  double sum = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max(
        {double{a.lower[axis]} - b.upper[axis], double{b.lower[axis]} - a.upper[axis], 0.0});
    sum += gap * gap;
  }
  return sum;
}

// The lowest value of normal . x in a box.
double lowest(const TreeBox& box, const Double3& normal) {
  double sum = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    sum += std::min(normal[axis] * box.lower[axis], normal[axis] * box.upper[axis]);
  }
  return sum;
}

// Goes down from the root, always to the child with the least `cost`, and returns the item there.
template <class Cost>
uint32_t best_item(std::span<const BoxTree::Node> nodes, const Cost& cost) {
  uint32_t child = 0;
  do {
    const BoxTree::Node& node = nodes[child];
    double least = std::numeric_limits<double>::infinity();
    child = node.child[0];
    for (size_t i = 0; i < BoxTree::kChildren; ++i) {
      const TreeBox box = node.box(i);
      if (is_empty(box) || !(cost(box) < least)) continue;
      least = cost(box);
      child = node.child[i];
    }
  } while (child < BoxTree::kItem);
  return child - BoxTree::kItem;
}

// The largest float32 <= x, but never below -FLT_MAX or above FLT_MAX.
float downwards(double x) {
  return round_downwards(std::clamp(x, -double{FLT_MAX}, double{FLT_MAX}));
}

void find_below(std::span<const BoxTree::Node> nodes, uint32_t index, const Double3& normal,
                double limit, FunctionRef<void(uint32_t)> found) {
  const BoxTree::Node& node = nodes[index];
  for (size_t i = 0; i < BoxTree::kChildren; ++i) {
    const TreeBox box = node.box(i);
    if (is_empty(box) || !(lowest(box, normal) <= limit)) continue;
    if (node.child[i] >= BoxTree::kItem) {
      found(node.child[i] - BoxTree::kItem);
    } else {
      find_below(nodes, node.child[i], normal, limit, found);
    }
  }
}

}  // namespace

TreeBox rounded_outwards(const Double3& middle, const Double3& half) {
  TreeBox box;
  for (size_t axis = 0; axis < 3; ++axis) {
    box.lower[axis] = downwards(middle[axis] - half[axis]);
    box.upper[axis] = -downwards(-(middle[axis] + half[axis]));
  }
  return box;
}

RoundedBox rounded_outwards(const Double3& middle, const Double3& half, double radius) {
  constexpr double kLeast = 0x1p-60, kMost = 0x1p60;
  if (radius >= kLeast && radius <= kMost) {
    // The factor covers the rounding of distances to the box and of their squares.
    return {rounded_outwards(middle, half), static_cast<float>(radius * radius * (1 + 0x1p-18))};
  }
  return {rounded_outwards(middle, {half[0] + radius, half[1] + radius, half[2] + radius})};
}

FrameChange FrameChange::inverse() const {
  FrameChange result;
  for (size_t i = 0; i < 3; ++i) result.turn[i] = {turn[0][i], turn[1][i], turn[2][i]};
  for (size_t i = 0; i < 3; ++i) result.offset[i] = -dot(result.turn[i], offset);
  return result;
}

TreeBox FrameChange::around(const TreeBox& box, double reach) const {
  Double3 middle_of_box, half;
  for (size_t axis = 0; axis < 3; ++axis) {
    middle_of_box[axis] = middle(box, axis);
    half[axis] = (double{box.upper[axis]} - box.lower[axis]) / 2;
  }
  Double3 new_middle, new_half;
  for (size_t axis = 0; axis < 3; ++axis) {
    const Double3& r = turn[axis];
    new_middle[axis] = dot(r, middle_of_box) + offset[axis];
    new_half[axis] = dot({std::fabs(r[0]), std::fabs(r[1]), std::fabs(r[2])}, half) + reach;
  }
  return rounded_outwards(new_middle, new_half);
}

BoxTree::BoxTree(std::span<const TreeBox> boxes) { TreeBuilder(boxes, nodes_).build(); }

void BoxTree::find_below(const Double3& normal, double limit,
                         FunctionRef<void(uint32_t)> found) const {
  if (!is_empty()) carom::find_below(nodes_, 0, normal, limit, found);
}

uint32_t BoxTree::near_item(const TreeBox& box) const {
  return best_item(nodes_, [&](const TreeBox& each) { return distance(each, box); });
}

uint32_t BoxTree::low_item(const Double3& normal) const {
  return best_item(nodes_, [&](const TreeBox& each) { return lowest(each, normal); });
}

}  // namespace carom
