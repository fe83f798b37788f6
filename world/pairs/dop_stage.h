// k-DOPs between broadphase and narrow phase: finds pairs with overlapping bounds that need no
// test.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/bounds/dop_bounds.h"
#include "carom/results/pair.h"
#include "carom/shapes/views.h"

namespace carom {

class DopStage {
 public:
  // Updates the k-DOPs of the bodies whose byte in `changed` is not zero, which includes new ones.
  // If `changed` is empty, updates all.
  void update(const Collidables& bodies, DopKind kind, std::span<const uint8_t> changed,
              Parallelism parallelism);

  // One byte a pair: 1 if it must be tested, 0 if its k-DOPs are separate.
  const std::vector<uint8_t>& test(std::span<const Pair> pairs, Parallelism parallelism);

  void give_back();
  size_t record_bytes() const;
  size_t pair_bytes() const;

 private:
  DopKind kind_ = DopKind::k14;
  std::vector<float> records_;
  std::vector<uint8_t> overlap_;
};

}  // namespace carom
