// Pairs of bodies, the common currency of broadphase, cache and narrow phase.
#pragma once

#include <compare>
#include <cstdint>

namespace carom {

// Two indices. In lists of one set of bodies a < b, and lists are sorted by (a, b).
struct Pair {
  uint32_t a;
  uint32_t b;

  friend auto operator<=>(const Pair&, const Pair&) = default;
};

// The pair as one integer that orders like (a, b).
inline constexpr uint64_t pair_key(Pair pair) { return uint64_t{pair.a} << 32 | pair.b; }

}  // namespace carom
