/// @file
/// Pairs of bodies, as the broadphase finds them and the narrow phase tests them.
#pragma once

#include <compare>
#include <cstdint>

namespace carom {

/// Two body indices. In pairs of one set of bodies a < b, and lists are sorted by (a, b).
struct Pair {
  uint32_t a;  ///< index of the first body
  uint32_t b;  ///< index of the second body

  /// Orders by (a, b).
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// The pair as one integer that orders like (a, b).
inline constexpr uint64_t pair_key(Pair pair) { return uint64_t{pair.a} << 32 | pair.b; }

}  // namespace carom
