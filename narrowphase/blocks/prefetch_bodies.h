// Fetches the bodies of a block into the cache before kernels read them.
#pragma once

#include "carom/shapes/shape.h"
#include "narrowphase/blocks/pair_block.h"

namespace carom {

// Where pairs lie anywhere among many bodies, nearly every body is a miss of the cache. Kernels
// wait for a few of them at a time; here all of a block are on their way at once. The lines go to
// the second level, which a block fits into.
class BodyPrefetch {
 public:
  explicit BodyPrefetch(const PairBlock& block) : block_(block) {}

  void run() const {
    if (!block_.pairs) return;
    fetch_all(block_.a, [](Pair pair) { return pair.a; });
    fetch_all(block_.b, [](Pair pair) { return pair.b; });
    // GCC takes a function that does nothing but prefetch for one without effects, and drops it.
    asm volatile("" : : : "memory");
  }

 private:
  // So much lies in the cache anyway.
  static constexpr size_t kCachedBytes = 1 << 20;

  static void fetch(const void* address) { __builtin_prefetch(address, 0, 2); }

  template <class T>
  static void fetch(const T* base, size_t index, size_t stride = sizeof(T)) {
    if (base) fetch(reinterpret_cast<const char*>(base) + index * stride);
  }

  template <class IndexOf>
  void fetch_all(const Collidables& bodies, const IndexOf& index_of) const {
    const bool has_boxes = bodies.kind || bodies.uniform_kind == ShapeKind::aabb;
    const bool has_rows = bodies.kind || row_count(bodies.uniform_kind) > 0;
    const size_t bytes_each = bodies.position.stride + (has_boxes ? sizeof(Aabb) : 0) +
                              (has_rows ? bodies.orientation.stride + 4 * sizeof(float) : 0);
    if (bodies.count * bytes_each < kCachedBytes) return;
    for (size_t i = 0; i < block_.count; ++i) {
      const size_t body = index_of(block_.pairs[i]);
      fetch(static_cast<const char*>(bodies.position.data), body, bodies.position.stride);
      if (has_boxes) fetch(bodies.box_slot, body);
      if (!has_rows) continue;
      fetch(bodies.orientation.data, body, bodies.orientation.stride);
      fetch(bodies.rows.first, body);
    }
    if (!has_boxes && !has_rows) return;
    for (size_t i = 0; i < block_.count; ++i) {
      const size_t body = index_of(block_.pairs[i]);
      const ShapeKind kind = bodies.kind ? bodies.kind[body] : bodies.uniform_kind;
      if (kind == ShapeKind::aabb) {
        fetch(bodies.boxes.lower[0], bodies.box_slot ? bodies.box_slot[body] : body,
              bodies.boxes.stride);
      } else if (row_count(kind) > 0) {
        const size_t row = bodies.rows.first ? bodies.rows.first[body] : body * row_count(kind);
        fetch(bodies.rows.data, row, 4 * sizeof(float));
      }
    }
  }

  const PairBlock& block_;
};

}  // namespace carom
