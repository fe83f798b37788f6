#include "world/pairs/watched_pairs.h"

#include <array>

#include "base/parallel.h"
#include "bounds/travel.h"
#include "world/pairs/due_pairs.h"
#include "world/store/columns.h"

namespace carom {
namespace {

constexpr uint32_t kSteps = 16;  // that a list lasts if bodies go on as they have

// Fills `found` with the numbers that find(begin, end, numbers) writes for the blocks of `count`
// pairs; it returns how many.
template <class Find>
void find_in_blocks(size_t count, Parallelism parallelism, BlockLists<uint32_t>& of_block,
                    std::vector<uint32_t>& found, const Find& find) {
  of_block.reset(block_count(count, kPairsPerMergeBlock));
  for_each_block(count, kPairsPerMergeBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   std::array<uint32_t, kPairsPerMergeBlock + kDuePadding> numbers;
                   const size_t its = find(begin, end, numbers.data());
                   of_block[block].assign(numbers.begin(), numbers.begin() + its);
                 });
  of_block.concatenate(found, parallelism);
}

}  // namespace

void WatchedPairs::find_due(const PairHistory& last, std::span<const uint32_t> odometers,
                            uint32_t gained, Parallelism parallelism, std::vector<uint32_t>& due) {
  if (is_known_ && gained <= left_) {
    left_ -= gained;
  } else {
    list(last, odometers, gained, parallelism);
  }
  const uint32_t *const until = last.holds_until.data(), *const travelled = odometers.data();
  if (is_short_) {
    find_in_blocks(pairs_.size(), parallelism, of_block_, due,
                   [&](size_t begin, size_t end, uint32_t* numbers) {
                     return find_due_of_list(pairs_.data(), number_.data(), until, travelled, begin,
                                             end, numbers);
                   });
  } else {
    find_in_blocks(last.pairs.size(), parallelism, of_block_, due,
                   [&](size_t begin, size_t end, uint32_t* numbers) {
                     return find_due_pairs(last.pairs.data(), until, travelled, 0, begin, end,
                                           numbers);
                   });
  }
}

void WatchedPairs::list(const PairHistory& last, std::span<const uint32_t> odometers,
                        uint32_t gained, Parallelism parallelism) {
  constexpr uint32_t kMost = kJump / 8;  // limits and odometers are compared by their difference
  is_short_ = false;
  is_known_ = gained <= kMost / kSteps;
  if (!is_known_) return;
  left_ = kSteps * gained;
  find_in_blocks(last.pairs.size(), parallelism, of_block_, number_,
                 [&](size_t begin, size_t end, uint32_t* numbers) {
                   // Both bodies of a pair may gain as much.
                   return find_due_pairs(last.pairs.data(), last.holds_until.data(),
                                         odometers.data(), 2 * left_, begin, end, numbers);
                 });
  is_short_ = 4 * number_.size() <= 3 * last.pairs.size();
  if (!is_short_) return;
  pairs_.resize(number_.size());
  for (size_t k = 0; k < number_.size(); ++k) pairs_[k] = last.pairs[number_[k]];
}

void WatchedPairs::give_back() {
  give_back_scratch(number_, pairs_, of_block_);
  is_known_ = false;
}

size_t WatchedPairs::bytes() const {
  return bytes_of(number_) + bytes_of(pairs_) + of_block_.bytes();
}

}  // namespace carom
