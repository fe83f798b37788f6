// FastKnobs::motion_tolerance: finds the bodies that moved so little that their results may stay.
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

// Every body has a reference pose, and stays within half the tolerance of it. So the pose in which
// it was tested and any pose since then differ by less than the tolerance, and the two bodies of a
// pair may be tested at different times.
class MotionTolerance {
 public:
  // One byte an index: whether the pairs of the body must be tested again. That is so if its shape
  // changed, if it is another body, or if one of its points may have left the tolerance about the
  // reference pose; its pose then becomes the reference. `changes` and `radii` are those of the
  // step.
  std::span<const uint8_t> update(const BodyStore& bodies, const ChangeTracker& changes,
                                  std::span<const float> radii, float tolerance,
                                  Parallelism parallelism);

  void give_back() { carom::give_back(references_, exceeded_); }
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
