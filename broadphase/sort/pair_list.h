// Lists of pairs that a search fills in any order, and the limit on how many it keeps.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/fresh_pages.h"
#include "base/parallel.h"
#include "base/raw_vector.h"
#include "carom/broadphase/find_pairs.h"

namespace carom {

inline bool layers_allow(const PairFilter& f, uint32_t a, uint32_t b) {
  const bool b_lets_a = (f.layer[a] & f.mask[b]) != 0;
  const bool a_lets_b = (f.layer[b] & f.mask[a]) != 0;
  return f.rule == FilterRule::both ? b_lets_a && a_lets_b : b_lets_a || a_lets_b;
}

// Whether the columns of the filter allow the pair of two bodies. PairSelection does the rest.
inline bool may_meet(const PairFilter& f, uint32_t a, uint32_t b) {
  if (f.motion && f.motion[a] == Motion::fixed && f.motion[b] == Motion::fixed) return false;
  if (f.owner && f.owner[a] != 0 && f.owner[a] == f.owner[b]) return false;
  if (f.space && f.space[a] != f.space[b]) return false;
  if (f.group && f.group[a] != 0 && f.group[a] == f.group[b]) return f.group[a] > 0;
  return !f.layer || layers_allow(f, a, b);
}

// Whether the columns forbid nothing.
inline bool lets_all_meet(const PairFilter& f) {
  return !f.motion && !f.layer && !f.owner && !f.group && !f.space;
}

// The number of pairs that a search may keep. Once it is spent, lists only count.
class PairBudget {
 public:
  void start(size_t most) {
    most_ = most;
    kept_ = 0;
  }
  void add(size_t pairs) { kept_ += pairs; }
  bool is_spent() const { return kept_ > most_; }
  size_t most() const { return most_; }

 private:
  size_t most_ = 0;
  std::atomic<size_t> kept_{0};
};

// Each list has a cache line of its own, so that two threads that append to neighbouring lists
// never share one.
class alignas(64) PairList {
 public:
  // Empties the list, which draws on this budget from now on.
  void start(PairBudget& budget) {
    budget_ = &budget;
    used_ = 0;
    accounted_ = 0;
    dropped_ = 0;
  }

  // Ends a search, and with it the pairs. A list that grew gets room to spare now: from one search
  // to the next a few pairs come and go.
  void settle() {
    if (!std::exchange(has_grown_, false)) return;
    const size_t usual = used_ + used_ / 4 + 2 * most_at_once_;
    if (pairs_.size() < usual) {
      pairs_.clear();  // the contents need not be copied
      pairs_.resize(usual);
    }
  }

  // Makes room for `pairs` pairs after the last one. The caller writes them there and then calls
  // commit().
  Pair* reserve(size_t pairs) {
    if (used_ + pairs > pairs_.size()) grow(pairs);
    return pairs_.data() + used_;
  }

  // Makes room for at least `least` pairs after the last one, and returns all that there is.
  std::span<Pair> room(size_t least) {
    Pair* const first = reserve(least);
    return {first, pairs_.size() - used_};
  }

  void commit(size_t pairs) {
    if (is_counting_only()) {
      dropped_ += pairs;
    } else {
      used_ += pairs;
    }
  }

  // Adds those of the pairs written there that the filter allows.
  void commit(size_t pairs, const PairFilter& filter) {
    Pair* written = pairs_.data() + used_;
    size_t kept = 0;
    for (size_t i = 0; i < pairs; ++i) {
      const Pair pair = written[i];
      written[kept] = pair;
      kept += may_meet(filter, pair.a, pair.b);
    }
    commit(kept);
  }

  std::span<const Pair> pairs() const { return {pairs_.data(), used_}; }
  size_t count() const { return used_ + dropped_; }
  size_t bytes() const { return pairs_.capacity() * sizeof(Pair); }

 private:
  bool is_counting_only() const { return accounted_ == kSpent; }

  void grow(size_t pairs) {
    if (!is_counting_only()) {
      budget_->add(used_ - accounted_);
      accounted_ = budget_->is_spent() ? kSpent : used_;
    }
    const size_t larger = is_counting_only() ? 0 : pairs_.size() / 2;
    pairs_.resize(std::max(pairs_.size(), used_ + pairs + larger));
    has_grown_ = true;
    most_at_once_ = std::max(most_at_once_, pairs);
  }

  static constexpr size_t kSpent = ~size_t{0};

  RawVector<Pair> pairs_;
  PairBudget* budget_ = nullptr;
  size_t used_ = 0;
  size_t accounted_ = 0;  // pairs of this list that the budget has counted
  size_t dropped_ = 0;
  size_t most_at_once_ = 0;  // of the calls of reserve() for which it grew
  bool has_grown_ = false;   // in this search
};

// The lists of a search, one a task. They keep their memory between searches.
class FoundPairs {
 public:
  // After a search that found too many they give it back: lists that begin with room ask the budget
  // late, and each such search would keep more than the last one.
  void start(size_t most_pairs) {
    if (count() > budget_.most()) lists_ = {};
    budget_.start(most_pairs);
    used_ = 0;
  }

  // Adds `lists` empty lists, and returns the index of the first.
  size_t add(size_t lists) {
    const size_t first = used_;
    used_ += lists;
    if (lists_.size() < used_) lists_.resize(used_);
    for (size_t i = first; i < used_; ++i) lists_[i].start(budget_);
    return first;
  }

  // Ends a search: the lists are ready for one that finds a little more.
  void settle() {
    if (count() > budget_.most()) return;
    for (size_t i = 0; i < used_; ++i) lists_[i].settle();
  }

  PairList& operator[](size_t i) { return lists_[i]; }
  std::span<const PairList> lists() const { return {lists_.data(), used_}; }

  // The number of pairs found. All of them are kept unless they are more than `most_pairs`.
  size_t count() const {
    size_t sum = 0;
    for (const PairList& list : lists()) sum += list.count();
    return sum;
  }

  // Replaces `out` by all pairs, one list behind the other.
  void list(Parallelism parallelism, std::vector<Pair>& out) {
    size_t count = 0;
    first_.clear();
    for (const PairList& list : lists()) {
      first_.push_back(count);
      count += list.pairs().size();
    }
    resize_for_overwriting(out, count);
    for_each_block(used_, 1, parallelism, [&](size_t i, size_t, size_t) {
      const std::span<const Pair> pairs = lists_[i].pairs();
      std::copy(pairs.begin(), pairs.end(), out.begin() + static_cast<ptrdiff_t>(first_[i]));
    });
  }

  size_t bytes() const {
    size_t sum = lists_.capacity() * sizeof(PairList) + first_.capacity() * sizeof(size_t);
    for (const PairList& list : lists_) sum += list.bytes();
    return sum;
  }

 private:
  PairBudget budget_;
  std::vector<PairList> lists_;
  size_t used_ = 0;
  std::vector<size_t> first_;  // where each list goes to, during list()
};

}  // namespace carom
