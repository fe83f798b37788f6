#include "broadphase/sort/merge_pairs.h"

#include <algorithm>
#include <bit>
#include <cstring>
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

// Merges two lists from both ends. A step waits for the comparison of the last one at its end, and
// the ends do not wait for each other. No branch depends on the pairs.
class MergeFromBothEnds {
 public:
  MergeFromBothEnds(std::span<const Pair> a, std::span<const Pair> b, Pair* out)
      : a_(a.data()),
        b_(b.data()),
        out_(out),
        a_end_(a_ + a.size()),
        b_end_(b_ + b.size()),
        out_end_(out + a.size() + b.size()) {}

  void run() {
    constexpr size_t kWorthWhile = 8;
    for (size_t steps = sure_steps(); steps >= kWorthWhile; steps = sure_steps()) {
      for (; steps > 0; --steps) step();
    }
    std::merge(a_, a_end_, b_, b_end_, out_);
  }

 private:
  // So many steps reach the end of neither list.
  size_t sure_steps() const { return static_cast<size_t>(std::min(a_end_ - a_, b_end_ - b_)) / 2; }

  void step() {
    const uint64_t first_a = key(*a_), first_b = key(*b_);
    const bool b_is_first = first_b < first_a;
    write(b_is_first ? first_b : first_a, out_++);
    b_ += b_is_first;
    a_ += !b_is_first;
    const uint64_t last_a = key(a_end_[-1]), last_b = key(b_end_[-1]);
    const bool b_is_last = last_b > last_a;
    write(b_is_last ? last_b : last_a, --out_end_);
    b_end_ -= b_is_last;
    a_end_ -= !b_is_last;
  }

  // pair_key() as one load, which g++ does not make of it.
  static uint64_t key(const Pair& pair) {
    static_assert(std::endian::native == std::endian::little);
    uint64_t bits;
    std::memcpy(&bits, &pair, sizeof(bits));
    return std::rotl(bits, 32);
  }
  static void write(uint64_t key, Pair* to) {
    const uint64_t bits = std::rotl(key, 32);
    std::memcpy(to, &bits, sizeof(bits));
  }

  const Pair *a_, *b_;
  Pair* out_;
  const Pair *a_end_, *b_end_;
  Pair* out_end_;
};

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
      MergeFromBothEnds(first, second, place).run();
    }
  });
}

}  // namespace carom
