// Runs a test on every instruction set of this machine.
#pragma once

#include <gtest/gtest.h>

#include "carom/simd/isa.h"

namespace carom::test {

class ForcedIsa {
 public:
  explicit ForcedIsa(Isa isa) : forced_(force_isa(isa) && active_isa() == isa) {}
  ~ForcedIsa() { unforce_isa(); }
  ForcedIsa(const ForcedIsa&) = delete;
  ForcedIsa& operator=(const ForcedIsa&) = delete;

  bool succeeded() const { return forced_; }

 private:
  bool forced_;
};

template <class Test>
void for_each_isa(const Test& test) {
  ASSERT_FALSE(usable_isas().empty());
  for (const Isa isa : usable_isas()) {
    SCOPED_TRACE(name(isa));
    const ForcedIsa forced(isa);
    ASSERT_TRUE(forced.succeeded());
    test();
  }
}

}  // namespace carom::test
