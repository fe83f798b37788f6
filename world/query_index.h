// The search index over the bodies of the last step. The first query after the step brings it up to
// date; others that come meanwhile wait.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>

#include "queries/body_index.h"

namespace carom {

class QueryIndex {
 public:
  // Threads must not take other queries of this world on while they wait for those that help them
  // here, since these would wait for them: a query passes Parallelism::none.
  const BodyIndex& of_step(uint64_t step, const Collidables& bodies, const BoundsView& bounds,
                           const Motion* motion, std::span<const WorldHalfspace> halfspaces,
                           Parallelism parallelism) {
    if (step_.load(std::memory_order_acquire) == step) return index_;
    const std::lock_guard lock(mutex_);
    if (step_.load(std::memory_order_relaxed) != step) {
      update(bodies, bounds, motion, halfspaces, parallelism);
      step_.store(step, std::memory_order_release);
    }
    return index_;
  }

  // The next query builds the index anew.
  void give_back() {
    const std::lock_guard lock(mutex_);
    index_ = {};
    step_.store(kNever, std::memory_order_release);
  }

  size_t bytes() const {
    const std::lock_guard lock(mutex_);
    return index_.bytes();
  }

 private:
  static constexpr uint64_t kNever = ~uint64_t{0};

  // An index that is half made is of no use: the next query begins anew.
  void update(const Collidables& bodies, const BoundsView& bounds, const Motion* motion,
              std::span<const WorldHalfspace> halfspaces, Parallelism parallelism) {
    try {
      index_.update(bodies, bounds, motion, halfspaces, parallelism);
    } catch (...) {
      index_ = {};
      throw;
    }
  }

  mutable std::mutex mutex_;
  BodyIndex index_;
  std::atomic<uint64_t> step_{kNever};
};

}  // namespace carom
