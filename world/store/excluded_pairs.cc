#include "world/store/excluded_pairs.h"

#include <algorithm>
#include <cassert>

namespace carom {
namespace {

Pair in_order(Pair pair) {
  assert(pair.a != pair.b);
  return pair.a < pair.b ? pair : Pair{pair.b, pair.a};
}

}  // namespace

void ExcludedPairs::exclude(Pair pair) {
  pair = in_order(pair);
  if (is_used_.size() <= pair.b) is_used_.resize(pair.b + size_t{1}, 0);
  is_used_[pair.a] = is_used_[pair.b] = 1;
  changes_.push_back({pair, Kind::exclude});
}

void ExcludedPairs::include_again(Pair pair) {
  pair = in_order(pair);
  if (pair.b < is_used_.size()) changes_.push_back({pair, Kind::include});
}

void ExcludedPairs::remove_body(uint32_t index) {
  if (index >= is_used_.size() || !is_used_[index]) return;
  is_used_[index] = 0;
  changes_.push_back({{index, index}, Kind::remove});
}

bool ExcludedPairs::contains(Pair pair) const {
  pair = in_order(pair);
  for (auto change = changes_.rbegin(); change != changes_.rend(); ++change) {
    const Pair of = change->pair;
    if (change->kind != Kind::remove && of == pair) return change->kind == Kind::exclude;
    if (change->kind == Kind::remove && (of.a == pair.a || of.a == pair.b)) return false;
  }
  return std::binary_search(pairs_.begin(), pairs_.end(), pair);
}

void ExcludedPairs::update() {
  if (changes_.empty()) return;
  drop_removed();
  std::stable_sort(changes_.begin(), changes_.end(),
                   [](const Change& x, const Change& y) { return x.pair < y.pair; });
  merge();
  if (pairs_.empty()) {
    *this = {};
  } else {
    digest_.build(pairs_);
    changes_.clear();  // not before: if memory runs out, they are made again
  }
}

// Drops removed bodies: from the list, and from the changes before the removal.
void ExcludedPairs::drop_removed() {
  const auto is_removal = [](const Change& change) { return change.kind == Kind::remove; };
  if (std::none_of(changes_.begin(), changes_.end(), is_removal)) return;
  std::vector<size_t> removed_at(is_used_.size(), 0);  // number of the change; 0: not removed
  for (size_t i = 0; i < changes_.size(); ++i) {
    if (is_removal(changes_[i])) removed_at[changes_[i].pair.a] = i + 1;
  }
  std::erase_if(pairs_, [&](Pair pair) { return removed_at[pair.a] || removed_at[pair.b]; });
  size_t kept = 0;
  for (size_t i = 0; i < changes_.size(); ++i) {
    const Change change = changes_[i];
    const bool is_past = i < std::max(removed_at[change.pair.a], removed_at[change.pair.b]);
    changes_[kept] = change;
    kept += !is_past;
  }
  changes_.resize(kept);
}

// The last change of each pair counts.
void ExcludedPairs::merge() {
  std::vector<Pair> merged;
  merged.reserve(pairs_.size() + changes_.size());
  auto old = pairs_.begin();
  for (size_t i = 0; i < changes_.size(); ++i) {
    const Change change = changes_[i];
    if (i + 1 < changes_.size() && changes_[i + 1].pair == change.pair) continue;
    const auto end = std::lower_bound(old, pairs_.end(), change.pair);
    merged.insert(merged.end(), old, end);
    old = end != pairs_.end() && *end == change.pair ? end + 1 : end;
    if (change.kind == Kind::exclude) merged.push_back(change.pair);
  }
  merged.insert(merged.end(), old, pairs_.end());
  pairs_.swap(merged);
}

}  // namespace carom
