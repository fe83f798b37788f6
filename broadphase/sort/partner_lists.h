// The last step of sorting pairs: the partners of every body.
#pragma once

#include <cstddef>
#include <cstdint>

#include "carom/results/pair.h"

namespace carom {

// The partners b of neighbouring bodies a, one body behind the other, each body's in any order.
struct PartnerLists {
  // Partners that can be read behind the last one.
  static constexpr size_t kPadding = 32;

  const uint32_t* partners;
  const uint32_t* first;  // where those of body first_body + i begin; one more entry behind
  size_t bodies;
  uint32_t first_body;
};

// Writes all pairs in the order of (a, b).
void write_sorted(const PartnerLists& lists, Pair* out);

}  // namespace carom
