// Finds the items of two trees whose boxes touch. Two boxes touch if they do along the axes of both
// frames: six of the fifteen axes of S. Gottschalk, M. Lin, D. Manocha, OBBTree, SIGGRAPH 1996,
// that a node's eight children share.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trees/tree_pair_search.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <vector>

#include "simd/lanes-inl.h"
#include "trees/pair_scale.h"
#include "trees/tree.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using PairTag = hn::CappedTag<float, BoxTree::kChildren>;
using PairVector = hn::Vec<PairTag>;
inline constexpr size_t kPairLanes = hn::MaxLanes(PairTag());
inline constexpr size_t kAll = (1u << BoxTree::kChildren) - 1;

// The boxes of a vector of children of a node.
struct BoxLanes {
  PairVector lower[3], upper[3];

  HWY_INLINE BoxLanes(const BoxTree::Node& node, size_t first) {
    for (size_t axis = 0; axis < 3; ++axis) {
      lower[axis] = hn::Load(PairTag(), node.lower[axis] + first);
      upper[axis] = hn::Load(PairTag(), node.upper[axis] + first);
    }
  }
};

// Boxes in the frame of the other tree, as columns.
struct SeenBoxes {
  alignas(32) float lower[3][BoxTree::kChildren];
  alignas(32) float upper[3][BoxTree::kChildren];
};

// Turns boxes. They are scaled before and after, so that nothing overflows.
class BoxTurner {
 public:
  BoxTurner(const FrameChange& change, const PairScale& scale)
      : half_(static_cast<float>(scale.down / 2)), up_(static_cast<float>(scale.up)) {
    set_grow(scale.grow);
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 3; ++k) {
        turn_[i][k] = static_cast<float>(change.turn[i][k]);
        size_[i][k] = std::fabs(turn_[i][k]);
      }
      offset_[i] = scale.offset(change.offset[i]);
    }
  }

  // By how much boxes grow, in units of the scale.
  void set_grow(double grow) { grow_ = static_cast<float>(grow); }

  // The boxes around turned boxes. Those of places without a child become NaN, which touches
  // nothing.
  HWY_INLINE BoxLanes turned(const BoxTree::Node& node, size_t first) const {
    const PairTag tag;
    BoxLanes boxes(node, first);
    PairVector middle[3], half[3];
    for (size_t axis = 0; axis < 3; ++axis) {
      const PairVector low = hn::Mul(boxes.lower[axis], hn::Set(tag, half_));
      const PairVector high = hn::Mul(boxes.upper[axis], hn::Set(tag, half_));
      middle[axis] = hn::Add(low, high);
      half[axis] = hn::Sub(high, low);
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      const PairVector at = hn::Add(product(turn_[axis], middle), hn::Set(tag, offset_[axis]));
      const PairVector by = hn::Add(product(size_[axis], half), hn::Set(tag, grow_));
      boxes.lower[axis] = hn::Mul(hn::Sub(at, by), hn::Set(tag, up_));
      boxes.upper[axis] = hn::Mul(hn::Add(at, by), hn::Set(tag, up_));
    }
    return boxes;
  }

 private:
  static HWY_INLINE PairVector product(const float* row, const PairVector* v) {
    const PairTag tag;
    return hn::Add(
        hn::Add(hn::Mul(hn::Set(tag, row[0]), v[0]), hn::Mul(hn::Set(tag, row[1]), v[1])),
        hn::Mul(hn::Set(tag, row[2]), v[2]));
  }

  float turn_[3][3], size_[3][3], offset_[3];
  float half_, up_, grow_;
};

// Two nodes of which some children may touch.
struct Visit {
  uint32_t a, b;
  uint32_t among_a, among_b;  // these children, as bits
};

// Bit 8 j + i: child i of A and child j of B.
using ChildPairs = uint64_t;

constexpr ChildPairs each_child_of_a(size_t children) { return children * 0x0101010101010101u; }

// All bits of byte j where bit j is set.
constexpr auto kWholeBytes = [] {
  std::array<ChildPairs, size_t{1} << BoxTree::kChildren> table{};
  for (size_t bits = 0; bits < table.size(); ++bits) {
    for (size_t j = 0; j < BoxTree::kChildren; ++j) {
      if (bits >> j & 1) table[bits] |= ChildPairs{0xff} << 8 * j;
    }
  }
  return table;
}();

// Visits that wait. `found` may start another search, which uses the part of the stack above its
// own start.
class VisitStack {
 public:
  explicit VisitStack(std::vector<Visit>& all) : all_(all), start_(all.size()) {}
  ~VisitStack() { all_.resize(start_); }
  VisitStack(const VisitStack&) = delete;
  VisitStack& operator=(const VisitStack&) = delete;

  bool is_empty() const { return all_.size() == start_; }
  void push(const Visit& visit) { all_.push_back(visit); }
  Visit pop() {
    const Visit last = all_.back();
    all_.pop_back();
    return last;
  }

 private:
  std::vector<Visit>& all_;
  const size_t start_;
};

template <class Use>
HWY_INLINE void for_each_bit(uint64_t bits, const Use& use) {
  for (; bits != 0; bits &= bits - 1) use(static_cast<size_t>(std::countr_zero(bits)));
}

// The children that are items, as bits.
HWY_INLINE size_t items_of(const BoxTree::Node& node) {
  const hn::RebindToSigned<PairTag> tag;
  size_t bits = 0;
  for (size_t i = 0; i < BoxTree::kChildren; i += kPairLanes) {
    const auto children =
        hn::BitCast(tag, hn::Load(hn::RebindToUnsigned<PairTag>(), node.child + i));
    bits |= bits_of(tag, hn::Lt(children, hn::Zero(tag))) << i;
  }
  return bits;
}

class TreePair {
 public:
  TreePair(const BoxTree& a, const BoxTree& b, const FrameChange& b_to_a, const PairScale& scale,
           ItemPairsFound found)
      : nodes_a_(a.nodes().data()),
        nodes_b_(b.nodes().data()),
        scale_(scale),
        b_to_a_(b_to_a, scale),
        a_to_b_(b_to_a.inverse(), scale),
        found_(found) {}

  void run(VisitStack& stack) {
    stack.push({0, 0, kAll, kAll});
    while (!stack.is_empty()) visit(stack.pop(), stack);
    if (count_ > 0) found_({pairs_, count_});
  }

 private:
  // So many pairs wait, or a few more, before they are handed on.
  static constexpr size_t kFirst = 64;
  static constexpr size_t kMostAtOnce = kMostItemPairs - BoxTree::kChildren * BoxTree::kChildren;

  HWY_INLINE void visit(const Visit& v, VisitStack& stack) {
    const BoxTree::Node& a = nodes_a_[v.a];
    const BoxTree::Node& b = nodes_b_[v.b];
    const ChildPairs touch = touching(a, b) & each_child_of_a(v.among_a) & kWholeBytes[v.among_b];
    if (touch == 0) return;
    const ChildPairs items_a = each_child_of_a(items_of(a));
    const size_t items_of_b = items_of(b);
    const ChildPairs items_b = kWholeBytes[items_of_b];

    for_each_bit(touch & items_a & items_b, [&](size_t k) {
      pairs_[count_++] = {a.child[k % 8] - BoxTree::kItem, b.child[k / 8] - BoxTree::kItem};
    });
    for_each_bit(touch & ~items_a & ~items_b, [&](size_t k) {
      stack.push({a.child[k % 8], b.child[k / 8], kAll, kAll});
    });
    const ChildPairs items_with_nodes = touch & items_a & ~items_b;
    if (items_with_nodes != 0) {
      for_each_bit(kAll & ~items_of_b, [&](size_t j) {
        const auto items = static_cast<uint32_t>(items_with_nodes >> 8 * j & kAll);
        if (items != 0) stack.push({v.a, b.child[j], items, kAll});
      });
    }
    const ChildPairs nodes_with_items = touch & ~items_a & items_b;
    if (nodes_with_items != 0) {
      for_each_bit(kAll & ~items_a, [&](size_t i) {
        const uint32_t items = column(nodes_with_items, i);
        if (items != 0) stack.push({a.child[i], v.b, kAll, items});
      });
    }
    if (count_ >= at_once_) hand_on();
  }

  // The first pairs may make the others fewer.
  HWY_INLINE void hand_on() {
    const double grow = scale_.grow_of(found_({pairs_, count_}));
    b_to_a_.set_grow(grow);
    a_to_b_.set_grow(grow);
    count_ = 0;
    at_once_ = std::min(2 * at_once_, kMostAtOnce);
  }

  // Bit j of the result is bit 8 j + i.
  static HWY_INLINE uint32_t column(ChildPairs pairs, size_t i) {
    return static_cast<uint32_t>((pairs >> i & 0x0101010101010101u) * 0x0102040810204080u >> 56);
  }

  // Which children touch along the axes of both frames.
  HWY_INLINE ChildPairs touching(const BoxTree::Node& a, const BoxTree::Node& b) const {
    const PairTag tag;
    SeenBoxes seen_b;
    for (size_t j = 0; j < BoxTree::kChildren; j += kPairLanes) {
      const BoxLanes boxes = b_to_a_.turned(b, j);
      for (size_t axis = 0; axis < 3; ++axis) {
        hn::Store(boxes.lower[axis], tag, seen_b.lower[axis] + j);
        hn::Store(boxes.upper[axis], tag, seen_b.upper[axis] + j);
      }
    }
    ChildPairs touch = 0;
    for (size_t i = 0; i < BoxTree::kChildren; i += kPairLanes) {
      const BoxLanes boxes(a, i), seen = a_to_b_.turned(a, i);
      for (size_t j = 0; j < BoxTree::kChildren; ++j) {
        const auto both = hn::And(touch_one(boxes, seen_b.lower[0] + j, seen_b.upper[0] + j),
                                  touch_one(seen, b.lower[0] + j, b.upper[0] + j));
        touch |= bits_of(tag, both) << (8 * j + i);
      }
    }
    return touch;
  }

  // Which boxes touch the box whose ends are every eighth number of `lower` and `upper`.
  static HWY_INLINE hn::Mask<PairTag> touch_one(const BoxLanes& boxes, const float* lower,
                                                const float* upper) {
    const PairTag tag;
    const auto along = [&](size_t axis) HWY_ATTR {
      constexpr size_t k = BoxTree::kChildren;
      return hn::And(hn::Le(boxes.lower[axis], hn::Set(tag, upper[axis * k])),
                     hn::Ge(boxes.upper[axis], hn::Set(tag, lower[axis * k])));
    };
    return hn::And(along(0), hn::And(along(1), along(2)));
  }

  const BoxTree::Node* nodes_a_;
  const BoxTree::Node* nodes_b_;
  const PairScale& scale_;
  BoxTurner b_to_a_, a_to_b_;
  const ItemPairsFound found_;
  size_t count_ = 0, at_once_ = kFirst;
  ItemPair pairs_[kMostItemPairs];
};

void touching_pairs(const BoxTree& a, const BoxTree& b, const FrameChange& b_to_a,
                    const PairScale& scale, ItemPairsFound found) {
  static thread_local std::vector<Visit> visits;
  VisitStack stack(visits);
  TreePair(a, b, b_to_a, scale, found).run(stack);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/measured_kernels.h"

namespace carom {
namespace {

// The greatest coordinate of all boxes.
double greatest_of(const BoxTree& tree) {
  const BoxTree::Node& root = tree.nodes().front();
  double most = 0;
  for (size_t i = 0; i < BoxTree::kChildren; ++i) {
    const TreeBox box = root.box(i);
    if (is_empty(box)) continue;
    for (size_t axis = 0; axis < 3; ++axis) {
      most = std::max({most, -double{box.lower[axis]}, double{box.upper[axis]}});
    }
  }
  return most;
}

}  // namespace

HWY_EXPORT(touching_pairs);

void find_touching_items(const BoxTree& a, const BoxTree& b, const FrameChange& b_to_a,
                         double reach, ItemPairsFound found) {
  if (a.is_empty() || b.is_empty()) return;
  const PairScale scale(greatest_of(a), greatest_of(b), b_to_a.offset, reach);
  CAROM_DISPATCH_MEASURED(tree_pairs, touching_pairs)(a, b, b_to_a, scale, found);
}

}  // namespace carom
#endif  // HWY_ONCE
