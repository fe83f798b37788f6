// Finds the bodies that changed since the last step, by comparing them with a copy: those that the
// store lists (all, if they are many), or all once a caller has asked for the arrays of poses.
// Boxes and rows of shapes are compared from the time on when a caller has asked for these. Where a
// caller writes poses into the arrays and everything in a large world moves, it takes all as
// changed and makes no copy.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/raw_vector.h"
#include "carom/base/parallelism.h"
#include "world/changes/pose_sample.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

class ChangeTracker {
 public:
  // Compares the bodies with the last call, and remembers them as they are now. While everything
  // moves, a few bodies that rest may count as changed, and all do in the first call after. The
  // two halves are for callers that in between write values to the records that depend on shapes:
  // the first compares boxes and rows of shapes, the second all the rest.
  void update(BodyStore& bodies, Parallelism parallelism);
  void update_shapes(const BodyStore& bodies, Parallelism parallelism);
  void update_bodies(BodyStore& bodies, Parallelism parallelism);

  // Makes the next update find everything changed; for callers that skip steps.
  void forget() { knows_last_ = false; }

  // Whether pose, shape or properties of the body at this index differ, or it is another body.
  bool changed(uint32_t index) const { return changed_[index]; }
  std::span<const uint8_t> changed() const { return changed_; }  // one byte an index

  // Whether the box or the rows of the body at this index differed in the last update_shapes(). It
  // does not cover BodyStore::touched() or the radii of spheres.
  bool reshaped(const Collidables& view, size_t index) const;
  bool any_reshaped() const { return any_reshaped_; }

  // The number of indices that changed; removed bodies may be among them.
  size_t changed_count() const { return changed_count_; }
  // Whether they are so few that stages do better to visit these alone: those of few(), ascending.
  bool are_few() const { return kFewest * changed_count_ < changed_.size(); }
  std::span<const uint32_t> few() const { return few_; }

  // True if there was a last step and nothing differs from it, not even by added or removed bodies.
  bool all_unchanged() const { return all_unchanged_; }

  void give_back();
  size_t bytes() const;

 private:
  // Changes in arrays that are not indexed by body: boxes, rows of shapes.
  struct SlotChanges {
    std::vector<uint8_t> changed;  // one a slot; valid where block_changed is set
    std::vector<uint8_t> block_changed;

    bool knows_last = false;

    void resize(size_t slots);
    bool at(size_t slot) const;
    void give_back() { carom::give_back(changed, block_changed); }
    size_t bytes() const { return bytes_of(changed) + bytes_of(block_changed); }
  };

  bool all_keep_moving(const BodyStore& bodies);
  bool compare_poses(const BodyStore& bodies, Parallelism parallelism);
  bool compare_listed_poses(const BodyStore& bodies);
  void clear_flags();
  template <class T>
  bool compare_records(const LargeVector<T>& now, LargeVector<T>& last, Parallelism parallelism);
  bool compare_orientations(const BodyStore& bodies, Parallelism parallelism);
  bool compare_boxes(const BodyStore& bodies, Parallelism parallelism);
  bool compare_rows(const BodyStore& bodies, Parallelism parallelism);
  void mark_changed_shapes(const BodyStore& bodies, Parallelism parallelism);
  void mark(size_t index);
  void mark_all();
  void list_few();

  static constexpr size_t kFewest = 16;  // fewer than one body in so many are few

  // One byte a row, and the number of set bytes in each block of rows. A block without any is all
  // zero and need not be written again.
  std::vector<uint8_t> changed_;
  std::vector<uint32_t> block_changes_;
  std::vector<uint32_t> few_;
  size_t changed_count_ = 0;
  bool all_unchanged_ = false;
  bool any_reshaped_ = false;
  bool knows_last_ = false;
  bool has_old_poses_ = false;  // whether the copies are older than the last update
  PoseSample sample_;
  LargeVector<float> last_records32_;
  LargeVector<double> last_records64_;
  LargeVector<BodyStore::Row> last_orientations_;
  LargeVector<BodyStore::BoxRecord> last_boxes_;
  SlotChanges box_changes_;
  LargeVector<BodyStore::Row> last_rows_;
  SlotChanges row_changes_;
};

}  // namespace carom
