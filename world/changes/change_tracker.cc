#include "world/changes/change_tracker.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "shapes/body_reader.h"
#include "world/store/columns.h"
#include "world/store/row_blocks.h"

namespace carom {
namespace {

// The bits that differ between two records of four numbers. Comparing bits makes NaN equal itself.
template <class T>
uint64_t difference(const T* a, const T* b) {
  constexpr size_t kWords = 4 * sizeof(T) / sizeof(uint64_t);
  uint64_t words_a[kWords], words_b[kWords];
  std::memcpy(words_a, a, sizeof(words_a));
  std::memcpy(words_b, b, sizeof(words_b));
  uint64_t bits = 0;
  for (size_t i = 0; i < kWords; ++i) bits |= words_a[i] ^ words_b[i];
  return bits;
}

uint32_t count_set(const uint8_t* flags, size_t count) {
  return std::accumulate(flags, flags + count, uint32_t{0});
}

// Calls use(i) for each flag that is set.
template <class Use>
void for_each_set(const uint8_t* flags, size_t count, const Use& use) {
  for (size_t i = 0; i < count; ++i) {
    const void* const at = std::memchr(flags + i, 1, count - i);
    if (!at) return;
    i = static_cast<size_t>(static_cast<const uint8_t*>(at) - flags);
    use(i);
  }
}

// Copies the records of four numbers that changed, and no others if they are few.
template <class T>
void copy_changed(const T* now, const uint8_t* changed, size_t count, size_t changes, T* last) {
  constexpr size_t kFewest = 8;  // fewer than one record in so many are few
  if (kFewest * changes < count) {
    for_each_set(changed, count, [&](size_t i) { std::copy_n(now + 4 * i, 4, last + 4 * i); });
  } else {
    std::memcpy(last, now, 4 * count * sizeof(T));
  }
}

// Sets the flags of rows that differ, copies these, and returns how many flags are set.
uint32_t compare_rows_of(const BodyStore::Row* now, BodyStore::Row* last, size_t count,
                         uint8_t* changed) {
  for (size_t i = 0; i < count; ++i) changed[i] |= difference(now[i].data(), last[i].data()) != 0;
  const uint32_t changes = count_set(changed, count);
  copy_changed(now->data(), changed, count, changes, last->data());
  return changes;
}

}  // namespace

void ChangeTracker::SlotChanges::resize(size_t slots) {
  changed.resize(slots);
  block_changed.resize(block_count(slots, kRowsPerBlock));
}

bool ChangeTracker::SlotChanges::at(size_t slot) const {
  return knows_last && block_changed[slot / kRowsPerBlock] && changed[slot];
}

void ChangeTracker::update(BodyStore& bodies, Parallelism parallelism) {
  update_shapes(bodies, parallelism);
  update_bodies(bodies, parallelism);
}

void ChangeTracker::update_shapes(const BodyStore& bodies, Parallelism parallelism) {
  any_reshaped_ = compare_boxes(bodies, unless_few(parallelism, bodies.boxes().size()));
  any_reshaped_ |= compare_rows(bodies, unless_few(parallelism, bodies.shape_rows().size()));
}

void ChangeTracker::update_bodies(BodyStore& bodies, Parallelism parallelism) {
  const size_t rows = bodies.rows();
  parallelism = unless_few(parallelism, rows);
  const bool same_rows = changed_.size() == rows;
  if (all_keep_moving(bodies)) {
    has_old_poses_ = true;
    all_unchanged_ = false;
    return;  // all flags are set
  }
  changed_.resize(rows);
  block_changes_.resize(block_count(rows, kRowsPerBlock));
  const bool knows_poses = knows_last_ && !std::exchange(has_old_poses_, false);
  const size_t listed = bodies.moved_indices().size() + bodies.touched_indices().size();
  const bool compares_all = bodies.shares_poses() || !knows_poses || 4 * listed > rows;
  const bool moved =
      compares_all ? compare_poses(bodies, parallelism) : compare_listed_poses(bodies);
  if (any_reshaped_) mark_changed_shapes(bodies, parallelism);
  if (knows_poses) {
    for (const uint32_t index : bodies.touched_indices()) {
      if (index < changed_.size()) mark(index);
    }
  } else {
    mark_all();
  }
  all_unchanged_ = knows_poses && same_rows && !moved && !any_reshaped_ && !bodies.any_touched();
  knows_last_ = true;
  changed_count_ = std::accumulate(block_changes_.begin(), block_changes_.end(), size_t{0});
  if (are_few()) list_few();
}

// Whether all bodies have changed in the last update, and nearly all have moved since.
bool ChangeTracker::all_keep_moving(const BodyStore& bodies) {
  const size_t rows = bodies.rows();
  const bool all_changed = knows_last_ && changed_count_ == rows && changed_.size() == rows;
  if (all_changed && rows >= kFewItems && bodies.shares_poses()) return sample_.all_moved(bodies);
  sample_.forget();
  return false;
}

// Each of the two sets the flags of bodies whose poses differ and clears all others, copies what
// differs, and says whether anything does. New rows are listed as touched, so the contents of their
// copies do not matter.
bool ChangeTracker::compare_poses(const BodyStore& bodies, Parallelism parallelism) {
  bool moved = compare_records(bodies.records32(), last_records32_, parallelism);
  moved |= compare_records(bodies.records64(), last_records64_, parallelism);
  moved |= compare_orientations(bodies, parallelism);
  return moved;
}

bool ChangeTracker::compare_listed_poses(const BodyStore& bodies) {
  clear_flags();
  last_records32_.resize(bodies.records32().size());
  last_records64_.resize(bodies.records64().size());
  last_orientations_.resize(bodies.orientations().size(), BodyStore::kIdentity);
  bool moved = false;
  const auto differs = [](const auto& now, auto& last, size_t index) {
    if (now.empty() || difference(&now[4 * index], &last[4 * index]) == 0) return false;
    std::copy_n(&now[4 * index], 4, &last[4 * index]);
    return true;
  };
  for (const auto* list : {&bodies.moved_indices(), &bodies.touched_indices()}) {
    for (const uint32_t index : *list) {
      if (index >= changed_.size()) continue;
      bool is_other = differs(bodies.records32(), last_records32_, index);
      is_other |= differs(bodies.records64(), last_records64_, index);
      if (!last_orientations_.empty()) {
        const BodyStore::Row& now = bodies.orientations()[index];
        is_other |= difference(now.data(), last_orientations_[index].data()) != 0;
        last_orientations_[index] = now;
      }
      if (is_other) mark(index);
      moved |= is_other;
    }
  }
  return moved;
}

// Clears the flags of the last step.
void ChangeTracker::clear_flags() {
  for (size_t block = 0; block < block_changes_.size(); ++block) {
    if (std::exchange(block_changes_[block], 0) == 0) continue;
    const size_t first = block * kRowsPerBlock;
    std::memset(&changed_[first], 0, std::min(kRowsPerBlock, changed_.size() - first));
  }
}

// Overwrites the flags of the last step.
template <class T>
bool ChangeTracker::compare_records(const LargeVector<T>& now, LargeVector<T>& last,
                                    Parallelism parallelism) {
  last.resize(now.size());
  std::atomic<bool> any{false};
  for_each_block(now.size() / 4, kRowsPerBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   const size_t count = end - begin;
                   const size_t size = 4 * count * sizeof(T);
                   const T* records = now.data() + 4 * begin;
                   T* copies = last.data() + 4 * begin;
                   uint8_t* flags = changed_.data() + begin;
                   uint32_t& changes = block_changes_[block];
                   if (std::memcmp(records, copies, size) == 0) {
                     if (changes > 0) std::memset(flags, 0, count);
                     changes = 0;
                     return;
                   }
                   for (size_t i = 0; i < count; ++i) {
                     flags[i] = difference(records + 4 * i, copies + 4 * i) != 0;
                   }
                   changes = count_set(flags, count);
                   copy_changed(records, flags, count, changes, copies);
                   any = true;
                 });
  return any;
}

bool ChangeTracker::compare_orientations(const BodyStore& bodies, Parallelism parallelism) {
  const LargeVector<BodyStore::Row>& now = bodies.orientations();
  // A body that had no orientation had the identity.
  last_orientations_.resize(now.size(), BodyStore::kIdentity);
  std::atomic<bool> any{false};
  for_each_block(
      now.size(), kRowsPerBlock, parallelism, [&](size_t block, size_t begin, size_t end) {
        const size_t count = end - begin;
        BodyStore::Row* last = &last_orientations_[begin];
        if (std::memcmp(&now[begin], last, count * sizeof(*last)) == 0) return;
        block_changes_[block] = compare_rows_of(&now[begin], last, count, &changed_[begin]);
        any = true;
      });
  return any;
}

bool ChangeTracker::compare_boxes(const BodyStore& bodies, Parallelism parallelism) {
  if (!bodies.shares_boxes()) return false;
  const LargeVector<BodyStore::BoxRecord>& boxes = bodies.boxes();
  const size_t slots = boxes.size();
  last_boxes_.resize(slots);
  box_changes_.resize(slots);
  // The caller has had the array for some time when they are compared for the first time.
  const bool knows_last = std::exchange(box_changes_.knows_last, true);
  std::atomic<bool> any{false};
  for_each_block(slots, kRowsPerBlock, parallelism, [&](size_t block, size_t begin, size_t end) {
    const BodyStore::BoxRecord* now = &boxes[begin];
    BodyStore::BoxRecord* last = &last_boxes_[begin];
    const size_t size = (end - begin) * sizeof(*last);
    const bool differs = !knows_last || std::memcmp(now, last, size) != 0;
    box_changes_.block_changed[block] = differs;
    if (!differs) return;
    for (size_t i = begin; i < end; ++i) {
      box_changes_.changed[i] =
          !knows_last || difference(boxes[i].lower.data(), last_boxes_[i].lower.data()) != 0 ||
          difference(boxes[i].upper.data(), last_boxes_[i].upper.data()) != 0;
    }
    std::memcpy(last, now, size);
    any = true;
  });
  return any;
}

bool ChangeTracker::compare_rows(const BodyStore& bodies, Parallelism parallelism) {
  if (!bodies.shares_shape_rows()) return false;
  const std::span<const BodyStore::Row> now = bodies.shape_rows();
  last_rows_.resize(now.size());
  row_changes_.resize(now.size());
  const bool knows_last = std::exchange(row_changes_.knows_last, true);
  std::atomic<bool> any{false};
  for_each_block(now.size(), kRowsPerBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   const size_t count = end - begin;
                   BodyStore::Row* last = &last_rows_[begin];
                   const bool differs =
                       !knows_last || std::memcmp(&now[begin], last, count * sizeof(*last)) != 0;
                   row_changes_.block_changed[block] = differs;
                   if (!differs) return;
                   std::memset(&row_changes_.changed[begin], !knows_last, count);
                   compare_rows_of(&now[begin], last, count, &row_changes_.changed[begin]);
                   any = true;
                 });
  return any;
}

bool ChangeTracker::reshaped(const Collidables& view, size_t index) const {
  if (!any_reshaped_) return false;
  const ShapeKind kind = view.kind ? view.kind[index] : view.uniform_kind;
  const BodyReader reader{view};
  if (kind == ShapeKind::aabb) return box_changes_.at(reader.box(index));
  for (uint32_t k = 0; k < row_count(kind); ++k) {
    if (row_changes_.at(reader.first_row(index) + k)) return true;
  }
  return false;
}

void ChangeTracker::mark_changed_shapes(const BodyStore& bodies, Parallelism parallelism) {
  const Collidables view = bodies.view();
  for_each_block(changed_.size(), kRowsPerBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   for (size_t i = begin; i < end; ++i) changed_[i] |= reshaped(view, i);
                   block_changes_[block] = count_set(&changed_[begin], end - begin);
                 });
}

void ChangeTracker::mark(size_t index) {
  block_changes_[index / kRowsPerBlock] += !changed_[index];
  changed_[index] = 1;
}

void ChangeTracker::list_few() {
  few_.clear();
  for (size_t block = 0; block < block_changes_.size(); ++block) {
    if (block_changes_[block] == 0) continue;
    const size_t first = block * kRowsPerBlock;
    const size_t count = std::min(kRowsPerBlock, changed_.size() - first);
    for_each_set(changed_.data() + first, count,
                 [&](size_t i) { few_.push_back(static_cast<uint32_t>(first + i)); });
  }
}

void ChangeTracker::mark_all() {
  std::fill(changed_.begin(), changed_.end(), uint8_t{1});
  for (size_t block = 0; block < block_changes_.size(); ++block) {
    const size_t first = block * kRowsPerBlock;
    block_changes_[block] = static_cast<uint32_t>(std::min(kRowsPerBlock, changed_.size() - first));
  }
}

void ChangeTracker::give_back() {
  carom::give_back(changed_, block_changes_, few_, last_records32_, last_records64_,
                   last_orientations_, last_boxes_, last_rows_);
  for (SlotChanges* changes : {&box_changes_, &row_changes_}) changes->give_back();
}

size_t ChangeTracker::bytes() const {
  size_t sum = bytes_of(changed_) + bytes_of(block_changes_) + bytes_of(few_) +
               bytes_of(last_records32_) + bytes_of(last_records64_) +
               bytes_of(last_orientations_) + bytes_of(last_rows_) + bytes_of(last_boxes_) +
               box_changes_.bytes() + row_changes_.bytes();
  return sum;
}

}  // namespace carom
