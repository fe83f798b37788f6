// Worlds of boxes in which most rest, and which change in many ways from frame to frame.
#pragma once

#include <algorithm>
#include <cstring>
#include <vector>

#include "carom/broadphase/find_pairs.h"
#include "tests/support/boxes.h"

namespace carom::test {

inline constexpr TestBox kEverywhere = {{-kInfinity, -kInfinity, -kInfinity},
                                        {kInfinity, kInfinity, kInfinity}};
inline constexpr TestBox kEmpty = {{kInfinity, kInfinity, kInfinity},
                                   {-kInfinity, -kInfinity, -kInfinity}};

// How often the histories took each path.
struct BoxCoverage {
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
class BoxHistory {
 public:
  BoxHistory(uint64_t seed, size_t count, BoxFamily family)
      : maker_(seed), family_(family), boxes_(make_boxes(family, count, seed)) {
    add_filters();
    parts_ = random_parts();
  }

  const Boxes& boxes() const { return boxes_; }
  PairFilter filter() const { return filters_.view(parts_); }
  const BoxCoverage& coverage() const { return coverage_; }

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
  BoxCoverage coverage_;
};

inline BoxCoverage operator+(BoxCoverage a, const BoxCoverage& b) {
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

}  // namespace carom::test
