#include "world/pairs/pair_changes.h"

#include "world/pairs/pair_history.h"
#include "world/store/columns.h"

namespace carom {

void PairChanges::run(const std::vector<Pair>& last, const std::vector<Pair>& now,
                      const BodyStore& bodies, Parallelism parallelism) {
  const auto is_other_body = [&](uint32_t index) {
    return (bodies.touched(index) & BodyStore::kReplaced) != 0;
  };
  for (BlockLists<Pair>* lists : {&added_lists_, &removed_lists_}) {
    lists->reset(merge_block_count(now.size()));
  }
  parallelism = unless_few(parallelism, now.size());
  for_each_merge_block(now.size(), parallelism, [&](size_t block, size_t begin, size_t end) {
    std::vector<Pair>& added_here = added_lists_[block];
    std::vector<Pair>& removed_here = removed_lists_[block];
    merge_block(
        last, now, begin, end, [&](size_t i) { removed_here.push_back(last[i]); },
        [&](size_t i, size_t before) {
          const Pair pair = now[i];
          const bool known = before != kNotThere;
          if (known && !is_other_body(pair.a) && !is_other_body(pair.b)) return;
          added_here.push_back(pair);
          if (known) removed_here.push_back(pair);
        });
  });
  added_lists_.concatenate(added, parallelism);
  removed_lists_.concatenate(removed, parallelism);
}

void PairChanges::clear() {
  added.clear();
  removed.clear();
}

void PairChanges::give_back() {
  carom::give_back(added, removed);
  give_back_scratch(added_lists_, removed_lists_);
}

size_t PairChanges::bytes() const {
  return bytes_of(added) + bytes_of(removed) + added_lists_.bytes() + removed_lists_.bytes();
}

}  // namespace carom
