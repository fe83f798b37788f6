// Builds a tree in two steps. First it divides the items in two, again and again, where the surface
// area heuristic says (J. D. MacDonald, K. S. Booth, Heuristics for Ray Tracing Using Space
// Subdivision, The Visual Computer 6, 1990; binned as in I. Wald, On fast Construction of SAH-based
// Bounding Volume Hierarchies, 2007). Then it joins divisions to nodes of eight children, so that a
// search visits as few as possible (H. Ylitie, T. Karras, S. Laine, Efficient Incoherent Ray
// Traversal on GPUs Through Compressed Wide BVHs, 2017, section 3.1).
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

bool is_item(uint32_t child) { return child >= BoxTree::kItem; }

class TreeBuilder {
 public:
  TreeBuilder(std::span<const TreeBox> boxes, std::vector<BoxTree::Node>& nodes)
      : boxes_(boxes), nodes_(nodes) {
    for (uint32_t i = 0; i < boxes.size(); ++i) {
      if (!is_empty(boxes[i])) order_.push_back(i);
    }
  }

  void build() {
    if (order_.empty()) return;
    divisions_.reserve(order_.size() - 1);
    Costs costs;
    add_node(divide({0, order_.size()}, costs));
    nodes_.shrink_to_fit();
  }

 private:
  static constexpr size_t kBins = 16;
  static constexpr size_t kMost = BoxTree::kChildren;

  // costs[i]: how many nodes a search visits on average, up to a factor, if some items become at
  // most i children of a node.
  using Costs = std::array<double, kMost + 1>;

  // Items divided in two. A part is the index of a division, or kItem + the index of an item.
  struct Division {
    TreeBox box;
    std::array<uint32_t, 2> part;
    // first[i]: the first part becomes so many of at most i children; 0 if all items become one.
    std::array<uint8_t, kMost + 1> first;
  };

  // Returns the division of a group, or its only item.
  uint32_t divide(Group group, Costs& costs) {
    if (group.count() == 1) {
      costs.fill(0);
      return order_[group.begin] + BoxTree::kItem;
    }
    const auto index = static_cast<uint32_t>(divisions_.size());
    divisions_.emplace_back();
    const size_t at = split(group);
    Costs first, second;
    const std::array<uint32_t, 2> part = {divide({group.begin, at}, first),
                                          divide({at, group.end}, second)};
    Division& division = divisions_[index];
    division.part = part;
    division.box = box_of(part[0]);
    include(box_of(part[1]), division.box);
    for (size_t most = 2; most <= kMost; ++most) {
      const size_t best = cheapest_share(first, second, most);
      division.first[most] = static_cast<uint8_t>(best);
      costs[most] = first[best] + second[most - best];
    }
    costs[1] = half_area(division.box) + costs[kMost];
    for (size_t most = 2; most < kMost; ++most) {
      if (!(costs[1] <= costs[most])) continue;
      costs[most] = costs[1];
      division.first[most] = 0;
    }
    return index;
  }

  // How many of `most` children the first part gets.
  static size_t cheapest_share(const Costs& first, const Costs& second, size_t most) {
    size_t best = 1;
    for (size_t i = 2; i < most; ++i) {
      if (first[i] + second[most - i] < first[best] + second[most - best]) best = i;
    }
    return best;
  }

  // Adds the node of a division, or of a single item, and all nodes below.
  uint32_t add_node(uint32_t part) {
    const auto index = static_cast<uint32_t>(nodes_.size());
    nodes_.emplace_back();
    std::array<uint32_t, kMost> children;
    size_t count = 0;
    add_children(part, kMost, children, count);
    for (size_t i = 0; i < kMost; ++i) {
      set_box(index, i, i < count ? box_of(children[i]) : kNothing);
      nodes_[index].child[i] = BoxTree::kItem;
    }
    for (size_t i = 0; i < count; ++i) {
      const uint32_t child = is_item(children[i]) ? children[i] : add_node(children[i]);
      nodes_[index].child[i] = child;
    }
    return index;
  }

  // Makes at most `most` children of a part.
  void add_children(uint32_t part, size_t most, std::array<uint32_t, kMost>& children,
                    size_t& count) const {
    const size_t first = is_item(part) || most == 1 ? 0 : divisions_[part].first[most];
    if (first == 0) {
      children[count++] = part;
      return;
    }
    add_children(divisions_[part].part[0], first, children, count);
    add_children(divisions_[part].part[1], most - first, children, count);
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

  TreeBox box_of(uint32_t part) const {
    return is_item(part) ? boxes_[part - BoxTree::kItem] : divisions_[part].box;
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
  std::vector<Division> divisions_;
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

// A place in a tree: a node or an item, and its box.
struct Place {
  uint32_t child;
  TreeBox box;
};

// The children of a place that is a node; an item alone. Returns how many they are.
size_t children_of(std::span<const BoxTree::Node> nodes, const Place& place,
                   std::array<Place, BoxTree::kChildren>& children) {
  if (is_item(place.child)) {
    children[0] = place;
    return 1;
  }
  const BoxTree::Node& node = nodes[place.child];
  size_t count = 0;
  for (size_t i = 0; i < BoxTree::kChildren; ++i) {
    if (!is_empty(node.box(i))) children[count++] = {node.child[i], node.box(i)};
  }
  return count;
}

// The squared distance of the middles.
double middle_distance(const TreeBox& a, const TreeBox& b) {
  double sum = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double way = middle(a, axis) - middle(b, axis);
    sum += way * way;
  }
  return sum;
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

// Goes down in both trees at once, always to the two children whose boxes are nearest, and of those
// that touch to the ones whose middles are.
ItemPair near_items(const BoxTree& a, const BoxTree& b, const FrameChange& b_to_a) {
  Place place_a = {0, kNothing}, place_b = {0, kNothing};
  while (!is_item(place_a.child) || !is_item(place_b.child)) {
    std::array<Place, BoxTree::kChildren> of_a, of_b;
    const size_t count_a = children_of(a.nodes(), place_a, of_a);
    const size_t count_b = children_of(b.nodes(), place_b, of_b);
    std::pair least(HUGE_VAL, HUGE_VAL);
    place_a = of_a[0];
    place_b = of_b[0];
    for (size_t j = 0; j < count_b; ++j) {
      const TreeBox seen = b_to_a.around(of_b[j].box, 0);
      for (size_t i = 0; i < count_a; ++i) {
        const std::pair cost(distance(of_a[i].box, seen), middle_distance(of_a[i].box, seen));
        if (!(cost < least)) continue;
        least = cost;
        place_a = of_a[i];
        place_b = of_b[j];
      }
    }
  }
  return {place_a.child - BoxTree::kItem, place_b.child - BoxTree::kItem};
}

BoxTree::BoxTree(std::span<const TreeBox> boxes) { TreeBuilder(boxes, nodes_).build(); }

void BoxTree::find_below(const Double3& normal, double limit,
                         FunctionRef<void(uint32_t)> found) const {
  if (!is_empty()) carom::find_below(nodes_, 0, normal, limit, found);
}

void BoxTree::find_admitted(FunctionRef<bool(const TreeBox& box)> admits, ItemsFound found) const {
  std::vector<uint32_t> waiting;
  if (!is_empty()) waiting.push_back(0);
  while (!waiting.empty()) {
    const Node& node = nodes_[waiting.back()];
    waiting.pop_back();
    std::array<uint32_t, kChildren> items;
    size_t count = 0;
    for (size_t i = 0; i < kChildren; ++i) {
      if (carom::is_empty(node.box(i)) || !admits(node.box(i))) continue;
      if (is_item(node.child[i])) {
        items[count++] = node.child[i] - kItem;
      } else {
        waiting.push_back(node.child[i]);
      }
    }
    if (count > 0) found(std::span<const uint32_t>(items).first(count));
  }
}

uint32_t BoxTree::near_item(const TreeBox& box) const {
  return best_item(nodes_, [&](const TreeBox& each) { return distance(each, box); });
}

uint32_t BoxTree::low_item(const Double3& normal) const {
  return best_item(nodes_, [&](const TreeBox& each) { return lowest(each, normal); });
}

}  // namespace carom
