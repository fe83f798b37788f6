#include "world/change_tracker.h"

#include <algorithm>
#include <atomic>
#include <cstring>

#include "kernel/parallel.h"

namespace carom {
namespace {

constexpr size_t kRowsPerBlock = 8192;

// Bits that differ between two records of four numbers; by bits, so that NaN equals itself.
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

}  // namespace

void ChangeTracker::update(BodyStore& bodies, Parallelism parallelism) {
  const size_t rows = bodies.rows();
  all_unchanged_ = !bodies.any_touched() && changed_.size() == rows;
  changed_.resize(rows);
  compare_records(bodies.records32(), last_records32_, parallelism);
  compare_records(bodies.records64(), last_records64_, parallelism);
  if (!bodies.boxes()[0].empty()) compare_boxes(bodies);
  if (bodies.any_touched()) {
    for (size_t i = 0; i < rows; ++i) {
      if (bodies.touched(static_cast<uint32_t>(i))) changed_[i] = 1;
    }
  }
}

template <class T>
void ChangeTracker::compare_records(const std::vector<T>& now, std::vector<T>& last,
                                    Parallelism parallelism) {
  if (now.empty()) return;
  last.resize(now.size());  // new rows are touched, whatever their copy holds
  std::atomic<bool> any{false};
  for_each_block(
      changed_.size(), kRowsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
        uint64_t differences = 0;
        for (size_t i = begin; i < end; ++i) {
          const uint64_t bits = difference(&now[4 * i], &last[4 * i]);
          changed_[i] = bits != 0;
          differences |= bits;
        }
        if (differences == 0) return;
        std::copy(now.begin() + 4 * begin, now.begin() + 4 * end, last.begin() + 4 * begin);
        any = true;
      });
  if (any) all_unchanged_ = false;
}

void ChangeTracker::compare_boxes(BodyStore& bodies) {
  const size_t slots = bodies.boxes()[0].size();
  box_changed_.assign(slots, 0);
  for (size_t column = 0; column < 6; ++column) {
    const std::vector<float>& now = bodies.boxes()[column];
    std::vector<float>& last = last_boxes_[column];
    last.resize(slots);
    if (std::memcmp(now.data(), last.data(), slots * sizeof(float)) == 0) continue;
    for (size_t i = 0; i < slots; ++i) {
      box_changed_[i] |= std::memcmp(&now[i], &last[i], sizeof(float)) != 0;
    }
    last = now;
    all_unchanged_ = false;
  }
  const Collidables view = bodies.view();
  for (size_t i = 0; i < changed_.size(); ++i) {
    const ShapeKind kind = view.kind ? view.kind[i] : view.uniform_kind;
    if (kind == ShapeKind::aabb) changed_[i] |= box_changed_[view.box_slot[i]];
  }
}

size_t ChangeTracker::bytes() const {
  size_t sum = changed_.capacity() + box_changed_.capacity() +
               last_records32_.capacity() * sizeof(float) +
               last_records64_.capacity() * sizeof(double);
  for (const std::vector<float>& column : last_boxes_) sum += column.capacity() * sizeof(float);
  return sum;
}

}  // namespace carom
