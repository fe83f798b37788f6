#include "broadphase/resting/resting_boxes.h"

#include <algorithm>
#include <iterator>

#include "broadphase/grid/cell_search.h"
#include "broadphase/sort/merge_pairs.h"

namespace carom {

RestingBoxes::Outcome RestingBoxes::settle(const BoundsView& bounds, const PairFilter& filter,
                                           Parallelism parallelism, Workspace work,
                                           std::vector<Pair>& out) {
  memory_.forget();
  memory_.update(bounds, filter, parallelism, changed_);
  is_moving_.assign(bounds.count, 0);
  moving_.clear();
  resting_.reserve(bounds.count);  // now, so that settling again allocates nothing
  const Outcome outcome = settle_rest(bounds, filter, parallelism, work);
  if (outcome == Outcome::found) merge_pairs(pairs_, {}, parallelism, out);
  return outcome;
}

// Sorts all boxes that do not move into cells, and finds the pairs among them.
RestingBoxes::Outcome RestingBoxes::settle_rest(const BoundsView& bounds, const PairFilter& filter,
                                                Parallelism parallelism, Workspace work) {
  idle_ = 0;
  searched_ = bounds.count;
  if (moving_.empty()) {
    rows_.build(BoxSource(bounds), parallelism, work.scratch);
  } else {
    resting_.clear();
    for (uint32_t i = 0; i < bounds.count; ++i) {
      if (!is_moving_[i]) resting_.push_back(i);
    }
    rows_.build(BoxSource(bounds, resting_.data(), resting_.size()), parallelism, work.scratch);
  }
  if (rows_.crowding() > work.most_crowded) {
    forget();
    return Outcome::crowded;
  }
  row_of_.assign(bounds.count, kNoRow);
  for (size_t row = 0; row < rows_.count(); ++row) {
    row_of_[rows_.body[row]] = static_cast<uint32_t>(row);
  }
  work.found.start(work.most_pairs);
  find_pairs_within(rows_, filter, parallelism, work.found);
  pair_count_ = work.found.count();
  if (pair_count_ > work.most_pairs) {
    forget();
    return Outcome::too_many;
  }
  list_found(bounds.count, parallelism, work, pairs_);
  holds_any_ = true;
  return Outcome::found;
}

RestingBoxes::Outcome RestingBoxes::update(const BoundsView& bounds, const PairFilter& filter,
                                           const std::span<const uint32_t>* listed,
                                           Parallelism parallelism, Workspace work,
                                           std::vector<Pair>& out) {
  // Searching for a moving box costs about as much as searching for four boxes from scratch.
  constexpr size_t kCostOfMoving = 4;
  const size_t count_before = memory_.count();
  if (listed) {
    memory_.update_listed(bounds, filter, *listed, changed_);
  } else {
    memory_.update(bounds, filter, parallelism, changed_);
  }
  const size_t moving_before = moving_.size();
  wake(count_before);
  if (kCostOfMoving * moving_.size() > bounds.count) {
    forget();
    return Outcome::restless;
  }
  if (moving_.size() != moving_before || bounds.count < count_before) drop_pairs_of_moving();

  // Boxes that came to rest are still searched for. They join the resting ones as soon as these
  // searches have cost about as much as settling.
  searched_ = moving_.size();
  idle_ += moving_.size() - std::min(moving_.size(), changed_.size());
  if (kCostOfMoving * idle_ > memory_.count()) {
    for (const uint32_t body : moving_) is_moving_[body] = 0;
    for (const uint32_t body : changed_) is_moving_[body] = 1;
    moving_ = changed_;
    const Outcome outcome = settle_rest(bounds, filter, parallelism, work);
    if (outcome != Outcome::found) return outcome;
  }
  return find_pairs_of_moving(bounds, filter, parallelism, work, out);
}

// Takes the boxes that have changed or vanished out of the resting ones.
void RestingBoxes::wake(size_t count_before) {
  const size_t count = memory_.count();
  const auto leave_row = [&](uint32_t body) {
    if (row_of_[body] != kNoRow) rows_.clear_row(row_of_[body]);
    row_of_[body] = kNoRow;
  };
  for (size_t gone = count; gone < count_before; ++gone) leave_row(static_cast<uint32_t>(gone));
  while (!moving_.empty() && moving_.back() >= count) moving_.pop_back();
  row_of_.resize(count, kNoRow);
  is_moving_.resize(count, 0);

  resting_.clear();  // here: the changed boxes that were at rest until now
  for (const uint32_t body : changed_) {
    if (is_moving_[body]) continue;
    is_moving_[body] = 1;
    leave_row(body);
    resting_.push_back(body);
  }
  if (resting_.empty()) return;
  merged_.clear();
  std::merge(moving_.begin(), moving_.end(), resting_.begin(), resting_.end(),
             std::back_inserter(merged_));
  moving_.swap(merged_);
}

void RestingBoxes::drop_pairs_of_moving() {
  const size_t count = memory_.count();
  std::erase_if(pairs_, [&](const Pair& pair) {
    return pair.b >= count || is_moving_[pair.a] || is_moving_[pair.b];
  });
}

RestingBoxes::Outcome RestingBoxes::find_pairs_of_moving(const BoundsView& bounds,
                                                         const PairFilter& filter,
                                                         Parallelism parallelism, Workspace work,
                                                         std::vector<Pair>& out) {
  moving_pairs_.clear();
  pair_count_ = pairs_.size();
  if (!moving_.empty()) {
    work.moving.build(BoxSource(bounds, moving_.data(), moving_.size()), parallelism, work.scratch);
    work.found.start(work.most_pairs - std::min(work.most_pairs, pairs_.size()));
    find_pairs_within(work.moving, filter, parallelism, work.found);
    find_pairs_between(work.moving, rows_, filter, parallelism, work.found);
    pair_count_ += work.found.count();
  }
  if (pair_count_ > work.most_pairs) {
    forget();
    return Outcome::too_many;
  }
  if (!moving_.empty()) {
    list_found(bounds.count, parallelism, work, moving_pairs_);
  }
  if (work.order == PairOrder::sorted) {
    merge_pairs(pairs_, moving_pairs_, parallelism, out);
  } else {
    merge_pairs(pairs_, {}, parallelism, out);
    out.insert(out.end(), moving_pairs_.begin(), moving_pairs_.end());
  }
  return Outcome::found;
}

void RestingBoxes::list_found(size_t bodies, Parallelism parallelism, Workspace work,
                              std::vector<Pair>& out) {
  if (work.order == PairOrder::any) {
    work.found.list(parallelism, out);
  } else {
    work.sorter.sort(work.found.lists(), bodies, parallelism, out, work.scratch);
  }
}

void RestingBoxes::forget() {
  holds_any_ = false;
  memory_.forget();
}

size_t RestingBoxes::bytes() const {
  size_t sum = memory_.bytes() + rows_.bytes() + is_moving_.capacity() +
               (pairs_.capacity() + moving_pairs_.capacity()) * sizeof(Pair);
  for (const std::vector<uint32_t>* column : {&row_of_, &moving_, &changed_, &resting_, &merged_}) {
    sum += column->capacity() * sizeof(uint32_t);
  }
  return sum;
}

}  // namespace carom
