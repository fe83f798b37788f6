// k-DOPs between broadphase and narrow phase: which pairs of overlapping bounds need no test.
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
  // Brings the k-DOPs up to date: of the bodies whose byte in `changed` is not zero, those that are
  // new included, or of all if there are no such bytes.
  void update(const Collidables& bodies, DopKind kind, std::span<const uint8_t> changed,
              Parallelism parallelism);

  // One byte a pair: 1 if it is to be tested, 0 if the k-DOPs are apart.
  const std::vector<uint8_t>& test(std::span<const Pair> pairs, Parallelism parallelism);

  void give_back_beyond(size_t pairs);
  size_t record_bytes() const;
  size_t pair_bytes() const;

 private:
  DopKind kind_ = DopKind::k14;
  std::vector<float> records_;
  std::vector<uint8_t> overlap_;
};

}  // namespace carom
