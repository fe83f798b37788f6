#include "carom/broadphase/find_pairs.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "base/float_environment.h"
#include "broadphase/grid/cell_search.h"
#include "broadphase/resting/resting_boxes.h"
#include "broadphase/sort/pair_selection.h"
#include "broadphase/sort/sort_pairs.h"
#include "broadphase/space_order.h"
#include "broadphase/sweep/box_columns.h"
#include "broadphase/sweep/scan.h"
#include "broadphase/sweep/sweep_order.h"

namespace carom {
namespace {

constexpr size_t kRowsPerBlock = 256;
constexpr size_t kSpacesPerBlock = 16;

// Up to this many boxes, testing all pairs is as fast as sorting.
constexpr size_t kBruteForceLimit = 128;
// Up to this many boxes, a sweep along one axis is as fast as cells.
constexpr size_t kSweepLimit = 350;
// Up to this many, two threads are no faster than one.
constexpr size_t kSerialLimit = 4096;
// With more boxes than this in the cell of a box, a sweep may be faster again.
constexpr double kMostCrowded = 512;

// Turns hits into candidate pairs of bodies, if the filter allows them.
class PairSink final : public HitSink {
 public:
  PairSink(const BoxColumns& columns, const PairFilter& filter, PairList& out)
      : columns_(columns), filter_(filter), filters_(!lets_all_meet(filter)), out_(out) {}

  void add(size_t box_row, const uint32_t* rows, size_t count) override {
    const uint32_t body = columns_.body[box_row];
    Pair* pairs = out_.reserve(count);
    for (size_t i = 0; i < count; ++i) {
      const uint32_t other = columns_.body[rows[i]];
      pairs[i] = {std::min(body, other), std::max(body, other)};
    }
    if (filters_) {
      out_.commit(count, filter_);
    } else {
      out_.commit(count);
    }
  }

 private:
  const BoxColumns& columns_;
  const PairFilter& filter_;
  const bool filters_;
  PairList& out_;
};

struct Choice {
  BroadphaseMethod method;
  const char* reason;
};

Choice choose(BroadphaseMethod wanted, size_t boxes) {
  if (wanted != BroadphaseMethod::automatic) return {wanted, "asked for"};
  if (boxes <= kBruteForceLimit) return {BroadphaseMethod::brute, "at most 128 boxes"};
  if (boxes <= kSweepLimit) return {BroadphaseMethod::sweep, "at most 350 boxes"};
  return {BroadphaseMethod::grid, "more than 350 boxes"};
}

}  // namespace

const char* name(BroadphaseMethod method) {
  static constexpr std::array<const char*, 4> kNames = {"auto", "brute", "sweep", "grid"};
  return kNames[static_cast<size_t>(method)];
}

struct PairFinder::State {
  size_t most_pairs = kMostPairs;
  PairOrder wanted = PairOrder::sorted;
  PairOrder order_of_pairs = PairOrder::sorted;  // of the present search
  FoundPairs found;
  PairSorter sorter;
  PairSelection selection;
  Scratch scratch;
  SpaceOrder spaces;
  // Used by brute force, also within spaces, and the sweep.
  SweepOrder order;
  BoxColumns columns;
  // Used by the grid.
  BoxSample sample;
  RestingBoxes resting;
  bool is_resting_current = false;  // whether `resting` knows the boxes of the last call
  CellRows cells;

  PairSearch find(const BoundsView& bounds, const PairFilter& filter,
                  const std::span<const uint32_t>* listed, std::vector<Pair>& out,
                  BroadphaseMethod method, Parallelism parallelism);

  void find_by_rows(const BoundsView& bounds, const PairFilter& filter, bool sweep,
                    Parallelism parallelism, std::vector<Pair>& out, PairSearch& search) {
    const size_t axis = sweep ? axis_of_largest_spread(bounds) : 0;
    if (sweep) {
      order.update(bounds, axis, parallelism, columns.body);
    } else {
      order_for_brute_force(bounds);
    }
    columns.fill(bounds, axis, parallelism);
    found.start(most_pairs);
    found.add(block_count(columns.count, kRowsPerBlock));
    for_each_block(columns.count, kRowsPerBlock, parallelism,
                   [&](size_t block, size_t begin, size_t end) {
                     PairSink sink(columns, filter, found[block]);
                     if (sweep) {
                       sweep_rows(columns, begin, end, sink);
                     } else {
                       test_rows(columns, begin, end, columns.count, sink);
                     }
                   });
    sort_found(bounds, parallelism, out, search);
  }

  // Tests all boxes of a space against one another. Returns false if a space holds too many.
  bool find_in_spaces(const BoundsView& bounds, const PairFilter& filter, Parallelism parallelism,
                      std::vector<Pair>& out, PairSearch& search) {
    if (!spaces.update(bounds, filter.space, kSweepLimit)) return false;
    order.forget();
    columns.body.assign(spaces.boxes().begin(), spaces.boxes().end());
    columns.fill(bounds, 0, parallelism);
    found.start(most_pairs);
    found.add(block_count(spaces.spaces(), kSpacesPerBlock));
    for_each_block(spaces.spaces(), kSpacesPerBlock, parallelism,
                   [&](size_t block, size_t begin, size_t end) {
                     // The filter drops pairs with boxes of the next space.
                     PairSink sink(columns, filter, found[block]);
                     for (size_t i = begin; i < end; ++i) {
                       const size_t last = spaces.first(i + 1);
                       test_rows(columns, spaces.first(i), last, last, sink);
                     }
                   });
    sort_found(bounds, parallelism, out, search);
    search.method = BroadphaseMethod::brute;
    search.reason = "few boxes in each space";
    return true;
  }

  void order_for_brute_force(const BoundsView& bounds) {
    order.forget();
    columns.body.clear();
    for (size_t i = 0; i < bounds.count; ++i) {
      if (takes_part(bounds, i)) columns.body.push_back(static_cast<uint32_t>(i));
    }
  }

  void sort_found(const BoundsView& bounds, Parallelism parallelism, std::vector<Pair>& out,
                  PairSearch& search) {
    search.pairs = found.count();
    search.searched = bounds.count;
    search.complete = search.pairs <= most_pairs;
    if (!search.complete) return;
    if (order_of_pairs == PairOrder::any) {
      found.list(parallelism, out);
    } else {
      sorter.sort(found.lists(), bounds.count, parallelism, out, scratch);
    }
  }

  // Keeps the boxes that rest in `resting` as soon as most boxes do.
  void find_by_cells(const BoundsView& bounds, const PairFilter& filter,
                     const std::span<const uint32_t>* listed, bool must, Parallelism parallelism,
                     std::vector<Pair>& out, PairSearch& search) {
    using Outcome = RestingBoxes::Outcome;
    // RestingBoxes gives up where a quarter of the boxes move. This is less.
    constexpr double kRestless = 0.2;
    const double most_crowded = must ? std::numeric_limits<double>::infinity() : kMostCrowded;
    const RestingBoxes::Workspace work = {cells,      found,        sorter,        scratch,
                                          most_pairs, most_crowded, order_of_pairs};
    Outcome outcome = Outcome::restless;
    if (!resting.is_empty()) {
      outcome = resting.update(bounds, filter, listed, parallelism, work, out);
      sample.forget();
    } else if (sample.changed_share(bounds) <= kRestless) {
      outcome = resting.settle(bounds, filter, parallelism, work, out);
    }
    if (outcome == Outcome::restless) {
      cells.build(BoxSource(bounds), parallelism, scratch);
      if (cells.crowding() > most_crowded) outcome = Outcome::crowded;
    }
    if (outcome == Outcome::crowded) {
      search.method = BroadphaseMethod::sweep;
      search.reason = "boxes crowd in few places far apart";
      return find_by_rows(bounds, filter, true, parallelism, out, search);
    }
    if (outcome == Outcome::restless) {
      found.start(most_pairs);
      find_pairs_within(cells, filter, parallelism, found);
      sort_found(bounds, parallelism, out, search);
      search.changed = bounds.count;
      search.grids = cells.grids().count;
      if (!must) search.reason = "more than 350 boxes, most of them moving";
      return;
    }
    is_resting_current = true;
    search.complete = outcome == Outcome::found;
    search.pairs = resting.pairs();
    search.changed = resting.changed();
    search.searched = resting.searched();
    search.grids = resting.grids();
    if (!must) search.reason = "more than 350 boxes, most of them at rest";
  }

  void set_order_of_pairs(const PairFilter& filter) {
    const PairOrder next = filter.excluded.empty() ? wanted : PairOrder::sorted;
    if (std::exchange(order_of_pairs, next) != next) resting.forget();
  }

  void forget() {
    order.forget();
    sample.forget();
    resting.forget();
  }
};

PairFinder::PairFinder() : state_(std::make_unique<State>()) {}
PairFinder::~PairFinder() = default;
PairFinder::PairFinder(PairFinder&&) noexcept = default;
PairFinder& PairFinder::operator=(PairFinder&&) noexcept = default;

PairSearch PairFinder::find(const BoundsView& bounds, const PairFilter& filter,
                            std::vector<Pair>& out, BroadphaseMethod method,
                            Parallelism parallelism) {
  return state_->find(bounds, filter, nullptr, out, method, parallelism);
}

PairSearch PairFinder::find_changed(const BoundsView& bounds, const PairFilter& filter,
                                    std::span<const uint32_t> changed, std::vector<Pair>& out,
                                    BroadphaseMethod method, Parallelism parallelism) {
  return state_->find(bounds, filter, &changed, out, method, parallelism);
}

// `listed`: the boxes that may differ from those of the last call; nullptr: any.
PairSearch PairFinder::State::find(const BoundsView& bounds, const PairFilter& filter,
                                   const std::span<const uint32_t>* listed, std::vector<Pair>& out,
                                   BroadphaseMethod method, Parallelism parallelism) {
  const FloatEnvironment environment;
  set_order_of_pairs(filter);
  if (!std::exchange(is_resting_current, false)) listed = nullptr;
  if (bounds.count <= kSerialLimit) parallelism = Parallelism::none;
  const Choice choice = choose(method, bounds.count);
  PairSearch search{.method = choice.method, .reason = choice.reason};
  const bool may_split =
      method == BroadphaseMethod::automatic && filter.space && bounds.count > kBruteForceLimit;
  const bool is_found = may_split && find_in_spaces(bounds, filter, parallelism, out, search);
  if (!is_found && choice.method == BroadphaseMethod::grid) {
    const bool must = method == BroadphaseMethod::grid;
    find_by_cells(bounds, filter, listed, must, parallelism, out, search);
  } else if (!is_found) {
    const bool sweep = choice.method == BroadphaseMethod::sweep;
    find_by_rows(bounds, filter, sweep, parallelism, out, search);
  }
  found.settle();
  if (!search.complete) {
    out.clear();
    return search;
  }
  selection.run(filter.excluded, nullptr, filter.predicate, parallelism, out);
  search.pairs = out.size();
  return search;
}

void PairFinder::forget() { state_->forget(); }

void PairFinder::set_order(PairOrder order) { state_->wanted = order; }

void PairFinder::set_most_pairs(size_t pairs) {
  constexpr size_t kMostOffsets = 0xffffffffu;  // the range of the sort's counters
  state_->most_pairs = std::min(pairs, kMostOffsets);
}

size_t PairFinder::bytes() const {
  const State& s = *state_;
  return s.found.bytes() + s.sorter.bytes() + s.scratch.bytes() + s.selection.bytes() +
         s.spaces.bytes() + s.order.bytes() + s.columns.bytes() + s.resting.bytes() +
         s.cells.bytes();
}

size_t find_pairs(const BoundsView& bounds, const PairFilter& filter, std::span<Pair> out,
                  BroadphaseMethod method, Parallelism parallelism) {
  PairFinder finder;
  finder.set_most_pairs(std::max(out.size(), PairFinder::kMostPairs));
  std::vector<Pair> pairs;
  const PairSearch search = finder.find(bounds, filter, pairs, method, parallelism);
  if (search.pairs <= out.size()) std::copy(pairs.begin(), pairs.end(), out.begin());
  return search.pairs;
}

}  // namespace carom
