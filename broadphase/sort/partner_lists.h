// The last step of sorting pairs: sorts the partners of every body.
#pragma once

#include <cstddef>
#include <cstdint>

#include "carom/results/pair.h"

namespace carom {

// The partners b of consecutive bodies a, one body after the other; each body's partners in any
// order.
struct PartnerLists {
  // This many partners after the last one can be read.
  static constexpr size_t kPadding = 32;

  const uint32_t* partners;
  // the place of the first partner of body first_body + i; one more entry at the end
  const uint32_t* first;
  size_t bodies;
  uint32_t first_body;
};

// Writes all pairs, sorted by (a, b).
void write_sorted(const PartnerLists& lists, Pair* out);

}  // namespace carom
