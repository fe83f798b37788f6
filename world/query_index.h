// The search index over the bodies of the last step, which the first query after the step builds.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "queries/body_index.h"

namespace carom {

class QueryIndex {
 public:
  const BodyIndex& of_step(uint64_t step, const Collidables& bodies, const BoundsView& bounds,
                           std::span<const WorldHalfspace> halfspaces, Parallelism parallelism) {
    if (!index_ || step_ != step) index_ = index_bodies(bodies, bounds, halfspaces, parallelism);
    step_ = step;
    return *index_;
  }

  size_t bytes() const { return index_ ? index_->bytes() : 0; }

 private:
  std::optional<BodyIndex> index_;
  uint64_t step_ = 0;
};

}  // namespace carom
