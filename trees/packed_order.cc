// Sorts boxes along a Morton curve, then divides runs of them in space.
#include "trees/packed_order.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>

#include "base/radix_sort.h"

namespace carom {
namespace {

constexpr size_t kItemsPerBlock = 32768;  // a power of eight, for full nodes

float middle_of(const TreeBox& box, size_t axis) {
  return 0.5f * box.lower[axis] + 0.5f * box.upper[axis];
}

// NaN gives 0.
uint32_t floor_between(float x, float most) {
  return static_cast<uint32_t>(x > 0 ? std::min(x, most) : 0);
}

// Keys by which the boxes are sorted: first by size class, the large boxes first, since they would
// spoil the nodes of small ones; then along the curve. The grid covers most of a sample of the
// boxes. A few boxes far away do not matter: they belong to its outermost cells.
class PlaceKeys {
 public:
  static constexpr uint32_t kEmpty = ~0u;  // greater than all keys

  PlaceKeys(std::span<const TreeBox> boxes, const PartOfItem& part) {
    std::array<float, 3> width{};
    for (size_t axis = 0; axis < 3; ++axis) width[axis] = lay_out(boxes, part, axis);
    widest_ = *std::max_element(width.begin(), width.end());
    share_bits(width);
    for (size_t axis = 0; axis < 3; ++axis) {
      const float cells = std::ldexp(1.0f, static_cast<int>(cell_bits_[axis]));
      most_[axis] = std::nextafter(cells, 0.0f);
      scale_[axis] = width[axis] > 0 ? std::min(cells / width[axis], FLT_MAX) : 0;
    }
  }

  uint32_t key(const TreeBox& box) const {
    if (is_empty(box)) return kEmpty;
    std::array<uint32_t, 3> cell;
    float extent = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      cell[axis] = floor_between((middle_of(box, axis) - low_[axis]) * scale_[axis], most_[axis]);
      extent = std::max(extent, box.upper[axis] - box.lower[axis]);
    }
    return size_class(extent) << kBits | interleaved(cell);
  }

 private:
  static constexpr size_t kBits = 30;
  static constexpr size_t kSamples = 1024;

  // Sets where the grid begins on this axis, and returns how wide it is.
  float lay_out(std::span<const TreeBox> boxes, const PartOfItem& part, size_t axis) {
    const size_t step = std::max<size_t>(1, boxes.size() / kSamples);
    std::vector<float> sample;
    for (size_t i = 0; i < boxes.size(); i += step) {
      const float at = middle_of(boxes[i], axis);
      if (part.has(i) && !is_empty(boxes[i]) && std::isfinite(at)) sample.push_back(at);
    }
    if (sample.empty()) return 0;
    std::sort(sample.begin(), sample.end());
    const size_t left_out = sample.size() / 32;
    const float first = sample[left_out];
    const float width = sample[sample.size() - 1 - left_out] - first;
    low_[axis] = first - width / 16;
    return width + width / 8;
  }

  // Gives each bit of the key to the axis on which cells are longest at that point.
  void share_bits(std::array<float, 3> cell) {
    for (size_t bit = kBits; bit-- > 0;) {
      const size_t axis =
          static_cast<size_t>(std::max_element(cell.begin(), cell.end()) - cell.begin());
      cell[axis] /= 2;
      place_of_bit_[axis][cell_bits_[axis]++] = static_cast<uint8_t>(bit);
    }
  }

  uint32_t size_class(float extent) const {
    if (extent > widest_ / 4) return 0;
    return extent > widest_ / 32 ? 1 : 2;
  }

  uint32_t interleaved(const std::array<uint32_t, 3>& cell) const {
    uint32_t key = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      const size_t bits = cell_bits_[axis];
      for (size_t i = 0; i < bits; ++i) {
        key |= (cell[axis] >> (bits - 1 - i) & 1) << place_of_bit_[axis][i];
      }
    }
    return key;
  }

  std::array<float, 3> low_{}, scale_{}, most_{};
  float widest_ = 0;
  std::array<size_t, 3> cell_bits_{};
  std::array<std::array<uint8_t, kBits>, 3> place_of_bit_{};  // the highest bit of a cell first
};

// Puts the items of a run in the order of a tree that divides space: halves along the axis on which
// the run is longest, at full nodes (T. Lee, S. Lee, OMT: Overlap Minimizing Top-down Bulk Loading
// Algorithm for R-tree, 2003). The curve alone has neighbours far apart where it jumps.
class RunDivider {
 public:
  RunDivider(std::span<const TreeBox> boxes, std::span<uint64_t> run) {
    places_.reserve(run.size());
    for (uint32_t i = 0; i < run.size(); ++i) {
      const TreeBox& box = boxes[static_cast<uint32_t>(run[i])];
      places_.push_back({{middle_of(box, 0), middle_of(box, 1), middle_of(box, 2)}, i});
    }
    divide_to_nodes(places_);
    const std::vector<uint64_t> before(run.begin(), run.end());
    for (size_t i = 0; i < run.size(); ++i) run[i] = before[places_[i].row];
  }

 private:
  struct Place {
    std::array<float, 3> middle;
    uint32_t row;  // of the run
  };

  static void divide_to_nodes(std::span<Place> places) {
    if (places.size() <= BoxTree::kChildren) return;
    size_t node = BoxTree::kChildren;  // the items of a full child
    while (node * BoxTree::kChildren < places.size()) node *= BoxTree::kChildren;
    divide(places, node);
  }

  static void divide(std::span<Place> places, size_t node) {
    if (places.size() <= node) return divide_to_nodes(places);
    const size_t half = block_count(places.size(), node) / 2 * node;
    const size_t axis = longest_axis(places);
    std::nth_element(places.begin(), places.begin() + static_cast<ptrdiff_t>(half), places.end(),
                     [axis](const Place& a, const Place& b) {
                       if (a.middle[axis] != b.middle[axis]) return a.middle[axis] < b.middle[axis];
                       return a.row < b.row;
                     });
    divide(places.first(half), node);
    divide(places.subspan(half), node);
  }

  static size_t longest_axis(std::span<const Place> places) {
    TreeBox box = kNothing;
    for (const Place& place : places) {
      for (size_t axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::min(box.lower[axis], place.middle[axis]);
        box.upper[axis] = std::max(box.upper[axis], place.middle[axis]);
      }
    }
    size_t longest = 0;
    for (size_t axis = 1; axis < 3; ++axis) {
      if (box.upper[axis] - box.lower[axis] > box.upper[longest] - box.lower[longest]) {
        longest = axis;
      }
    }
    return longest;
  }

  std::vector<Place> places_;
};

}  // namespace

std::vector<uint64_t> packed_order(std::span<const TreeBox> boxes, const PartOfItem& part,
                                   Parallelism parallelism) {
  const PlaceKeys keys(boxes, part);
  std::vector<uint64_t> items(boxes.size()), scratch;
  for_each_block(boxes.size(), kItemsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const uint32_t key = part.has(i) ? keys.key(boxes[i]) : PlaceKeys::kEmpty;
      items[i] = uint64_t{key} << 32 | i;
    }
  });
  std::vector<uint32_t> histograms;
  radix_sort_by_key(items, scratch, histograms, parallelism);
  const auto empty =
      std::lower_bound(items.begin(), items.end(), uint64_t{PlaceKeys::kEmpty} << 32);
  items.erase(empty, items.end());
  for_each_block(items.size(), kItemsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    RunDivider(boxes, std::span(items).subspan(begin, end - begin));
  });
  return items;
}

}  // namespace carom
