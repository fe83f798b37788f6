// How far the bodies of a heap move in a frame.
#pragma once

#include <vector>

#include "bench/world/settle/heap.h"

namespace carom::bench {

class MotionShares {
 public:
  explicit MotionShares(const Heap& heap);

  // Keeps the poses that the next motions count from.
  void start();
  // Prints, after a step, which share of the moving bodies moved by more than some distances since
  // start(): the way of the position, and the angle times turning_radius().
  void print(int frame) const;

 private:
  std::vector<float> sorted_motions() const;

  const Heap& heap_;
  std::vector<float> turn_radius_;
  std::vector<Pose> poses_;
};

}  // namespace carom::bench
