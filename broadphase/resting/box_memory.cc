#include "broadphase/resting/box_memory.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "broadphase/resting/compare_boxes.h"

namespace carom {
namespace {

constexpr size_t kBoxesPerTask = 8192;

// Marks where a column of the filter and its copy differ. Returns whether they did.
template <class T>
bool compare_column(const T* now, const std::vector<T>& last, size_t begin, size_t count,
                    BoxFlags& differs) {
  static_assert(std::has_unique_object_representations_v<T>);
  if (!now || std::memcmp(now + begin, last.data() + begin, count * sizeof(T)) == 0) return false;
  for (size_t i = 0; i < count; ++i) differs[i] |= now[begin + i] != last[begin + i];
  return true;
}

// An absent column has an empty copy. Returns false if the column has appeared or vanished.
template <class T>
bool resize_column(const T* now, size_t count, size_t known, std::vector<T>& copy) {
  const bool same = known == 0 || copy.empty() == (now == nullptr);
  copy.resize(now ? count : 0);
  return same;
}

}  // namespace

// Calls visit(column, its copy) for all columns of a filter.
template <class Visit>
void BoxMemory::for_each_column(const PairFilter& filter, FilterCopy& copy, const Visit& visit) {
  visit(filter.layer, copy.layer);
  visit(filter.mask, copy.mask);
  visit(filter.owner, copy.owner);
  visit(filter.motion, copy.motion);
  visit(filter.group, copy.group);
  visit(filter.space, copy.space);
}

void BoxMemory::update(const BoundsView& bounds, const PairFilter& filter, Parallelism parallelism,
                       std::vector<uint32_t>& changed) {
  resize(bounds, filter);
  const BoxSource source(bounds);
  lists_.reset(block_count(count_, kBoxesPerTask));
  for_each_block(count_, kBoxesPerTask, parallelism, [&](size_t task, size_t begin, size_t end) {
    for (size_t i = begin; i < end; i += BoxBlock::kBoxes) {
      update_block(source, filter, i, std::min(end, i + BoxBlock::kBoxes), lists_[task]);
    }
  });
  lists_.concatenate(changed, parallelism);
}

void BoxMemory::update_listed(const BoundsView& bounds, const PairFilter& filter,
                              std::span<const uint32_t> listed, std::vector<uint32_t>& changed) {
  resize(bounds, filter);
  changed.clear();
  for (const uint32_t body : listed) {
    if (body >= known_) break;
    changed.push_back(body);
    copy(bounds, filter, body);
  }
  for (size_t body = known_; body < count_; ++body) {
    changed.push_back(static_cast<uint32_t>(body));
    copy(bounds, filter, body);
  }
}

void BoxMemory::copy(const BoundsView& bounds, const PairFilter& filter, size_t body) {
  for (size_t axis = 0; axis < 3; ++axis) {
    columns_[axis][body] = value_at(bounds, bounds.lower[axis], body);
    columns_[3 + axis][body] = value_at(bounds, bounds.upper[axis], body);
  }
  for_each_column(filter, filter_, [body](const auto* now, auto& last) {
    if (now) last[body] = now[body];
  });
}

void BoxMemory::resize(const BoundsView& bounds, const PairFilter& filter) {
  known_ = std::min(count_, bounds.count);
  count_ = bounds.count;
  for (std::vector<float>& column : columns_) column.resize(count_ + BoxBlock::kPadding);
  bool same_columns = true;
  for_each_column(filter, filter_, [&](const auto* now, auto& last) {
    same_columns &= resize_column(now, count_, known_, last);
  });
  const bool same_rule = std::exchange(filter_.rule, filter.rule) == filter.rule;
  if (!same_columns || !same_rule) known_ = 0;
}

void BoxMemory::update_block(const BoxSource& source, const PairFilter& filter, size_t begin,
                             size_t end, std::vector<uint32_t>& changed) {
  BlockBuffer buffer;
  const BoxBlock block = buffer.load(source, begin, end);
  std::array<const float*, 6> last;
  for (size_t column = 0; column < 6; ++column) last[column] = columns_[column].data() + begin;
  BoxFlags differs;
  bool any = compare_boxes(block, last, differs);
  for_each_column(filter, filter_, [&](const auto* now, const auto& copy) {
    any |= compare_column(now, copy, begin, block.count, differs);
  });
  const size_t known = std::clamp(known_, begin, end) - begin;
  if (!any && known == block.count) return;
  std::array<uint32_t, BoxBlock::kBoxes> list;
  size_t listed = 0;
  for (size_t i = 0; i < block.count; ++i) {
    list[listed] = static_cast<uint32_t>(begin + i);
    listed += differs[i] != 0 || i >= known;
  }
  changed.insert(changed.end(), list.begin(), list.begin() + listed);
  for (size_t axis = 0; axis < 3; ++axis) {
    std::copy_n(block.lower[axis], block.count, columns_[axis].data() + begin);
    std::copy_n(block.upper[axis], block.count, columns_[3 + axis].data() + begin);
  }
  for_each_column(filter, filter_, [&](const auto* now, auto& copy) {
    if (now) std::copy_n(now + begin, block.count, copy.data() + begin);
  });
}

size_t BoxMemory::bytes() const {
  size_t sum = lists_.bytes() + filter_.motion.capacity() * sizeof(Motion) +
               filter_.group.capacity() * sizeof(int32_t);
  for (const std::vector<float>& column : columns_) sum += column.capacity() * sizeof(float);
  for (const std::vector<uint32_t>* column :
       {&filter_.layer, &filter_.mask, &filter_.owner, &filter_.space}) {
    sum += column->capacity() * sizeof(uint32_t);
  }
  return sum;
}

double BoxSample::changed_share(const BoundsView& bounds) {
  const size_t step = std::max<size_t>(1, bounds.count / kBoxes);
  const size_t samples = std::min(kBoxes, bounds.count / step);
  const bool comparable = count_ == bounds.count && samples > 0;
  count_ = bounds.count;
  size_t changed = 0;
  for (size_t i = 0; i < samples; ++i) {
    // Each sample lies at a different place of its stretch, since bodies at regular indices may be
    // of one kind.
    const size_t box = i * step + i * 2654435761u % step;
    std::array<float, 6> now;
    for (size_t axis = 0; axis < 3; ++axis) {
      now[axis] = value_at(bounds, bounds.lower[axis], box);
      now[3 + axis] = value_at(bounds, bounds.upper[axis], box);
    }
    changed += std::memcmp(now.data(), boxes_[i].data(), sizeof(now)) != 0;
    boxes_[i] = now;
  }
  return comparable ? static_cast<double>(changed) / static_cast<double>(samples) : 1;
}

}  // namespace carom
