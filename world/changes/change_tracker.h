// Which bodies changed since the last step: by comparing their data with a copy of it, since poses
// may be written straight into the arrays.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "carom/base/parallelism.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

class ChangeTracker {
 public:
  // Compares with the last call and remembers the bodies as they are now. In two halves, for
  // callers that write to the records what depends on shapes: first boxes and rows of shapes, then
  // all the rest.
  void update(BodyStore& bodies, Parallelism parallelism);
  void update_shapes(const BodyStore& bodies, Parallelism parallelism);
  void update_bodies(BodyStore& bodies, Parallelism parallelism);

  // For callers that leave out steps: the next update finds everything changed.
  void forget() { knows_last_ = false; }

  // Pose, shape or properties of the body at this index differ, or it is another body.
  bool changed(uint32_t index) const { return changed_[index]; }
  std::span<const uint8_t> changed() const { return changed_; }  // one byte an index

  // The box or the rows of the body at this index differ, as the last update_shapes() has it. What
  // is known without comparing, BodyStore::touched(), is not in it, nor are radii of spheres.
  bool reshaped(const Collidables& view, size_t index) const;

  // How many indices there are of which that is true; bodies that went may be among them.
  size_t changed_count() const { return changed_count_; }

  // There was a last step, and nothing differs at all, bodies that came and went included.
  bool all_unchanged() const { return all_unchanged_; }

  size_t bytes() const;

 private:
  // What changed in arrays that are not indexed by body: boxes, rows of shapes.
  struct SlotChanges {
    std::vector<uint8_t> changed;  // one a slot; of use where block_changed is set
    std::vector<uint8_t> block_changed;

    void resize(size_t slots);
    bool at(size_t slot) const;
    size_t bytes() const { return bytes_of(changed) + bytes_of(block_changed); }
  };

  template <class T>
  bool compare_records(const std::vector<T>& now, std::vector<T>& last, Parallelism parallelism);
  bool compare_orientations(const BodyStore& bodies, Parallelism parallelism);
  bool compare_boxes(const BodyStore& bodies, Parallelism parallelism);
  bool compare_rows(const BodyStore& bodies, Parallelism parallelism);
  void mark_changed_shapes(const BodyStore& bodies, Parallelism parallelism);
  void mark_touched(const BodyStore& bodies);
  void mark_all();

  // One byte a row, and how many are set in each block of rows: a block without any is all zero and
  // need not be written.
  std::vector<uint8_t> changed_;
  std::vector<uint32_t> block_changes_;
  size_t changed_count_ = 0;
  bool all_unchanged_ = false;
  bool any_reshaped_ = false;
  bool knows_last_ = false;
  std::vector<float> last_records32_;
  std::vector<double> last_records64_;
  std::vector<BodyStore::Row> last_orientations_;
  std::array<std::vector<float>, 6> last_boxes_;
  SlotChanges box_changes_;
  std::vector<BodyStore::Row> last_rows_;
  SlotChanges row_changes_;
};

}  // namespace carom
