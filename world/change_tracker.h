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

  // For callers that leave out steps: the next update finds everything changed.
  void forget() { knows_last_ = false; }

  // Pose, shape or properties of the body at this index differ, or it is another body.
  bool changed(uint32_t index) const { return changed_[index]; }

  // How many indices there are of which that is true; bodies that went may be among them.
  size_t changed_count() const { return changed_count_; }

  // There was a last step, and nothing differs at all, bodies that came and went included.
  bool all_unchanged() const { return all_unchanged_; }

  size_t bytes() const;

 private:
  bool compare_boxes(const BodyStore& bodies, Parallelism parallelism);
  template <class T>
  bool compare_records(const std::vector<T>& now, std::vector<T>& last, Parallelism parallelism);
  void mark_changed_boxes(const BodyStore& bodies, Parallelism parallelism);
  void mark_touched(const BodyStore& bodies);
  void mark_all();

  // One byte a row, and how many are set in each block of rows: a block without any is all zero and
  // need not be written.
  std::vector<uint8_t> changed_;
  std::vector<uint32_t> block_changes_;
  size_t changed_count_ = 0;
  bool all_unchanged_ = false;
  bool knows_last_ = false;
  std::vector<float> last_records32_;
  std::vector<double> last_records64_;
  std::array<std::vector<float>, 6> last_boxes_;
  std::vector<uint8_t> box_changed_;  // one a slot; of use where box_block_changed_ is set
  std::vector<uint8_t> box_block_changed_;
};

}  // namespace carom
