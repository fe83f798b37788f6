// FastKnobs::motion_tolerance: bodies that moved so little that their results may stay.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "carom/base/parallelism.h"
#include "world/changes/change_tracker.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

// Every body has a reference pose, and stays within half the tolerance of it: what it is tested in
// now and what it is in later, or was in before, are less than the tolerance apart. So each body of
// a pair may be tested at a time of its own.
class MotionTolerance {
 public:
  // One byte an index: whether the pairs of the body are to be tested again, because its shape
  // changed, it is another body, or a point of it may have gone further from where the reference
  // pose has it. Its pose becomes the reference then. `changes` and `radii` are those of the step.
  std::span<const uint8_t> update(const BodyStore& bodies, const ChangeTracker& changes,
                                  std::span<const float> radii, float tolerance,
                                  Parallelism parallelism);

  size_t bytes() const { return bytes_of(references_) + bytes_of(exceeded_); }

 private:
  struct Pose {
    std::array<double, 3> position;
    BodyStore::Row orientation;
    float radius;
  };
  static bool stays_within(double distance, const Pose& from, const Pose& to);

  std::vector<Pose> references_;
  std::vector<uint8_t> exceeded_;
};

}  // namespace carom
