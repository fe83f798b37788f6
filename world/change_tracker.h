// Which bodies changed since the last step: by comparing their data with a copy of it, since poses
// may be written straight into the arrays.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "carom/kernel/parallelism.h"
#include "world/body_store.h"

namespace carom {

class ChangeTracker {
 public:
  // Compares with the last call and remembers the bodies as they are now.
  void update(BodyStore& bodies, Parallelism parallelism);

  // Pose, shape or properties of the body at this index differ, or it is another body.
  bool changed(uint32_t index) const { return changed_[index]; }

  // Nothing differs at all, bodies that came and went included.
  bool all_unchanged() const { return all_unchanged_; }

  size_t bytes() const;

 private:
  template <class T>
  void compare_records(const std::vector<T>& now, std::vector<T>& last, Parallelism parallelism);
  void compare_boxes(BodyStore& bodies);

  std::vector<uint8_t> changed_;
  bool all_unchanged_ = false;
  std::vector<float> last_records32_;
  std::vector<double> last_records64_;
  std::array<std::vector<float>, 6> last_boxes_;
  std::vector<uint8_t> box_changed_;
};

}  // namespace carom
