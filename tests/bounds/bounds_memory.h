// Six columns of bounds in guarded memory: reading past the end of a column crashes.
#pragma once

#include <cstring>
#include <vector>

#include "carom/bounds/bounds.h"
#include "carom/reference/reference.h"
#include "tests/support/guarded.h"

namespace carom::test {

class BoundsMemory {
 public:
  explicit BoundsMemory(size_t count);
  BoundsColumns out();
  reference::Box box(size_t i) const;

 private:
  std::vector<GuardedArray> columns_;
};

bool same_bits(const reference::Box& x, const reference::Box& y);

}  // namespace carom::test
