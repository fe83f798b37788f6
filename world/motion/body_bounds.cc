#include "world/motion/body_bounds.h"

#include <algorithm>
#include <limits>

#include "base/grown.h"
#include "base/parallel.h"
#include "bounds/some_bounds.h"
#include "world/motion/present_bounds.h"
#include "world/store/columns.h"
#include "world/store/row_blocks.h"

namespace carom {

void BodyBounds::resize(size_t rows) {
  for (LargeVector<float>& column : columns_) column.resize(rows);
}

BoundsColumns BodyBounds::columns_to_write() {
  return {{columns_[0].data(), columns_[1].data(), columns_[2].data()},
          {columns_[3].data(), columns_[4].data(), columns_[5].data()}};
}

void BodyBounds::clear_box(size_t index) {
  for (size_t axis = 0; axis < 3; ++axis) {
    columns_[axis][index] = std::numeric_limits<float>::infinity();
    columns_[3 + axis][index] = -std::numeric_limits<float>::infinity();
  }
}

BoundsView BodyBounds::view() const {
  return {{columns_[0].data(), columns_[1].data(), columns_[2].data()},
          {columns_[3].data(), columns_[4].data(), columns_[5].data()},
          columns_[0].size()};
}

void BodyBounds::update_all(BodyStore& bodies, Parallelism parallelism,
                            HalfspaceStage& halfspaces) {
  resize(bodies.rows());
  const size_t invalid = compute_bounds(bodies.view(), columns_to_write(), parallelism);
  // Rows without a body still hold old values.
  for (const uint32_t index : bodies.free_indices()) clear_box(index);
  quarantined_.clear();
  for (uint32_t i = 0; invalid > 0 && i < bodies.rows(); ++i) {
    if (bodies.is_alive(i) && !has_box(view(), i)) quarantined_.push_back(bodies.id_of(i));
  }
  halfspaces.set_aside(bodies, columns_);
}

void BodyBounds::update(const BodyStore& bodies, std::span<const uint32_t> changed,
                        HalfspaceStage& halfspaces) {
  resize(bodies.rows());
  const Collidables view_of_bodies = bodies.view();
  compute_some_bounds(view_of_bodies, changed, columns_to_write());
  // These may have been set aside.
  compute_some_bounds(view_of_bodies, bodies.halfspaces(), columns_to_write());
  std::erase_if(quarantined_, [&](BodyId id) {
    return id.index >= bodies.rows() ||
           std::binary_search(changed.begin(), changed.end(), id.index);
  });
  const auto known = static_cast<ptrdiff_t>(quarantined_.size());
  for (const uint32_t index : changed) {
    if (!bodies.is_alive(index)) {
      clear_box(index);
    } else if (!has_box(view(), index)) {
      quarantined_.push_back(bodies.id_of(index));
    }
  }
  std::inplace_merge(quarantined_.begin(), quarantined_.begin() + known, quarantined_.end(),
                     [](BodyId a, BodyId b) { return a.index < b.index; });
  halfspaces.set_aside(bodies, columns_);
}

void BodyBounds::grow(std::span<const uint32_t> bodies, std::span<const float> metres,
                      Parallelism parallelism) {
  for_each_block(bodies.size(), kRowsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t axis = 0; axis < 3; ++axis) {
      float* const lower = columns_[axis].data();
      float* const upper = columns_[3 + axis].data();
      for (size_t k = begin; k < end; ++k) {
        const uint32_t i = bodies[k];
        if (!(lower[i] <= upper[i]) || metres[k] == 0) continue;
        lower[i] = below(lower[i], metres[k]);
        upper[i] = above(upper[i], metres[k]);
      }
    }
  });
}

void BodyBounds::give_back() {
  for (LargeVector<float>& column : columns_) carom::give_back(column);
  carom::give_back(quarantined_);
}

size_t BodyBounds::bytes() const {
  size_t sum = 0;
  for (const LargeVector<float>& column : columns_) sum += bytes_of(column);
  return sum;
}

}  // namespace carom
