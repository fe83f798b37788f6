#include "broadphase/sort/merge_pairs.h"

#include <algorithm>

#include "base/huge_pages.h"

namespace carom {
namespace {

constexpr size_t kPairsPerTask = 1 << 15;

}  // namespace

// Task i merges a block of `a` with the pairs of `b` up to the first pair of the next block. Their
// places in `out` follow from their places in `a` and `b`.
void merge_pairs(const std::vector<Pair>& a, const std::vector<Pair>& b, Parallelism parallelism,
                 std::vector<Pair>& out) {
  resize_for_overwriting(out, a.size() + b.size());
  if (a.empty() || b.empty()) {
    const std::vector<Pair>& all = a.empty() ? b : a;
    for_each_block(all.size(), kPairsPerTask, parallelism, [&](size_t, size_t begin, size_t end) {
      std::copy(all.begin() + begin, all.begin() + end, out.begin() + begin);
    });
    return;
  }
  const auto place_in_b = [&](size_t i) {
    if (i == 0) return b.begin();
    return i == a.size() ? b.end() : std::lower_bound(b.begin(), b.end(), a[i]);
  };
  for_each_block(a.size(), kPairsPerTask, parallelism, [&](size_t, size_t begin, size_t end) {
    const auto b_begin = place_in_b(begin);
    std::merge(a.begin() + begin, a.begin() + end, b_begin, place_in_b(end),
               out.begin() + begin + (b_begin - b.begin()));
  });
}

}  // namespace carom
