// Working memory that stages use one after the other: nothing in it outlives a stage.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "base/raw_vector.h"

namespace carom {

class Scratch {
 public:
  // Frees what the last stage took, and makes room for `bytes` bytes in `arrays` arrays. New memory
  // has room for an eighth more: what a stage needs changes a little from one time to the next.
  void start(size_t bytes, size_t arrays) {
    const size_t lines = bytes / sizeof(Line) + arrays;
    if (lines_.size() < lines) {
      lines_.clear();  // the contents need not be copied
      lines_.resize(lines + lines / 8);
    }
    used_ = 0;
  }

  // An array of `count` elements with undefined contents, at the start of a cache line.
  template <class T>
  std::span<T> take(size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(Line));
    const std::span<T> taken(reinterpret_cast<T*>(lines_.data() + used_), count);
    used_ += (count * sizeof(T) + sizeof(Line) - 1) / sizeof(Line);
    return taken;
  }

  size_t bytes() const { return lines_.capacity() * sizeof(Line); }

 private:
  struct alignas(64) Line {
    std::byte bytes[64];
  };

  RawVector<Line> lines_;
  size_t used_ = 0;
};

}  // namespace carom
