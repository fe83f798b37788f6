#include "world/pairs/pair_history.h"

#include <utility>

#include "world/store/columns.h"

namespace carom {

void PairHistory::clear() {
  pairs.clear();
  overlaps.clear();
  contact.clear();
  direction.clear();
  clear_contacts();
}

void PairHistory::clear_contacts() {
  contacts.clear();
  manifolds.clear();
  identities.clear();
}

void PairHistory::give_back() {
  carom::give_back(pairs, overlaps, contact, direction, contacts, manifolds, identities);
}

size_t PairHistory::bytes() const {
  return bytes_of(pairs) + bytes_of(overlaps) + bytes_of(contact) + bytes_of(direction) +
         bytes_of(contacts) + bytes_of(manifolds) + bytes_of(identities);
}

MergeRange matching_range(const std::vector<Pair>& last, const std::vector<Pair>& now, size_t begin,
                          size_t end) {
  const auto place = [&](size_t i) -> size_t {
    return std::lower_bound(last.begin(), last.end(), now[i]) - last.begin();
  };
  return {begin == 0 ? 0 : place(begin), end == now.size() ? last.size() : place(end)};
}

void CarryPlan::test_all(size_t pairs) {
  tests_all_ = true;
  tested_ = pairs;
  dropped_ = 0;
}

void CarryPlan::match(const PairHistory& last, const std::vector<Pair>& now,
                      std::span<const uint8_t> changed, Parallelism parallelism) {
  row_.resize(now.size());
  last_.resize(now.size());
  block_first_.assign(block_count(now.size(), kPairsPerMergeBlock), 0);
  for_each_block(now.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   const MergeRange range = matching_range(last.pairs, now, begin, end);
                   size_t candidate = range.begin;
                   for (size_t i = begin; i < end; ++i) {
                     const Pair pair = now[i];
                     while (candidate < range.end && last.pairs[candidate] < pair) ++candidate;
                     const bool known = candidate < range.end && last.pairs[candidate] == pair;
                     const bool carried = known && !changed[pair.a] && !changed[pair.b];
                     row_[i] = carried ? kCarried : 0;
                     last_[i] = static_cast<uint32_t>(candidate);
                     block_first_[block] += !carried;
                   }
                 });
  tested_ = dropped_ = 0;
  for (size_t& first : block_first_) tested_ += std::exchange(first, tested_);
  tests_all_ = tested_ == now.size();
  if (tests_all_) return;
  to_test_.resize(tested_);
  for_each_block(now.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   size_t row = block_first_[block];
                   for (size_t i = begin; i < end; ++i) {
                     if (row_[i] == kCarried) continue;
                     to_test_[row] = now[i];
                     row_[i] = static_cast<uint32_t>(row++);
                   }
                 });
}

void CarryPlan::drop(const std::vector<uint8_t>& overlap, const std::vector<Pair>& now,
                     Parallelism parallelism) {
  block_first_.assign(block_count(now.size(), kPairsPerMergeBlock), 0);
  row_.resize(now.size());
  for_each_block(now.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   size_t count = 0;
                   for (size_t i = begin; i < end; ++i) {
                     const uint32_t row = test_row(i);
                     count += row != kCarried && overlap[row];
                   }
                   block_first_[block] = count;
                 });
  size_t left = 0;
  for (size_t& first : block_first_) left += std::exchange(first, left);
  left_.resize(left);
  for_each_block(now.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   size_t next = block_first_[block];
                   Pair dropped;
                   for (size_t i = begin; i < end; ++i) {
                     const uint32_t row = test_row(i);
                     if (row == kCarried) continue;
                     // Without a branch: which pairs are dropped cannot be predicted.
                     const bool stays = overlap[row] != 0;
                     row_[i] = static_cast<uint32_t>(stays ? next : left);
                     *(stays ? left_.data() + next : &dropped) = now[i];
                     next += stays;
                   }
                 });
  to_test_.swap(left_);
  tests_all_ = false;
  dropped_ = tested_ - left;
  tested_ = left;
}

size_t CarryPlan::bytes() const {
  return bytes_of(row_) + bytes_of(last_) + bytes_of(to_test_) + bytes_of(left_) +
         bytes_of(block_first_);
}

}  // namespace carom
