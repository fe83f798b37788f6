#include "broadphase/sort/merge_pairs.h"

#include <algorithm>
#include <span>

#include "base/fresh_pages.h"

namespace carom {
namespace {

constexpr size_t kPairsPerTask = 1 << 15;

// The first pair of [begin, end) that is not less than `pair`. It is near `begin`.
const Pair* gallop(const Pair* begin, const Pair* end, Pair pair) {
  size_t step = 8;
  while (step < static_cast<size_t>(end - begin) && begin[step] < pair) {
    begin += step;
    step *= 2;
  }
  return std::lower_bound(begin, std::min(begin + step, end), pair);
}

// Merges two lists of which the second is short: most pairs of the first are copied by runs.
void merge_few(std::span<const Pair> a, std::span<const Pair> few, Pair* out) {
  const Pair* at = a.data();
  const Pair* const end = at + a.size();
  for (const Pair pair : few) {
    const Pair* const next = gallop(at, end, pair);
    out = std::copy(at, next, out);
    *out++ = pair;
    at = next;
  }
  std::copy(at, end, out);
}

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
  constexpr size_t kFew = 8;
  for_each_block(a.size(), kPairsPerTask, parallelism, [&](size_t, size_t begin, size_t end) {
    const std::span<const Pair> first(a.begin() + begin, a.begin() + end);
    const std::span<const Pair> second(place_in_b(begin), place_in_b(end));
    Pair* const place = out.data() + begin + (second.data() - b.data());
    if (kFew * second.size() < first.size()) {
      merge_few(first, second, place);
    } else {
      std::merge(first.begin(), first.end(), second.begin(), second.end(), place);
    }
  });
}

}  // namespace carom
