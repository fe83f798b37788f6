// A convex shape as the hull of points, grown by a radius: the input of the searches over any two
// convex shapes.
#pragma once

#include <cstddef>
#include <vector>

#include "narrowphase/scalar/vector_of.h"

namespace carom {

using CoreVector = VectorOf<double>;

// Points are stored in columns of doubles, kCoreLanes at a time; the places after the last point
// repeat the first.
inline constexpr size_t kCoreLanes = 8;

class Core {
 public:
  double radius = 0;
  CoreVector middle{0, 0, 0};  // any point inside; the search starts there

  // The caller sets the points afterwards.
  void resize(size_t count) {
    count_ = count;
    padded_ = (count + kCoreLanes - 1) / kCoreLanes * kCoreLanes;
    if (values_.size() < 3 * padded_) values_.resize(3 * padded_);
  }
  void set(size_t i, const CoreVector& p) {
    values_[i] = p.x;
    values_[padded_ + i] = p.y;
    values_[2 * padded_ + i] = p.z;
  }
  void pad() {
    for (size_t i = count_; i < padded_; ++i) set(i, point(0));
  }

  size_t size() const { return count_; }
  size_t padded_size() const { return padded_; }
  CoreVector point(size_t i) const {
    return {values_[i], values_[padded_ + i], values_[2 * padded_ + i]};
  }
  const double* x() const { return values_.data(); }
  const double* y() const { return values_.data() + padded_; }
  const double* z() const { return values_.data() + 2 * padded_; }
  double* x() { return values_.data(); }
  double* y() { return values_.data() + padded_; }
  double* z() { return values_.data() + 2 * padded_; }

 private:
  std::vector<double> values_;  // never shrinks: cores are used again for the next pair
  size_t count_ = 0, padded_ = 0;
};

// The cores of one pair; the memory serves the next pair too.
struct CorePair {
  Core a, b;
};

inline CorePair& core_pair_of_thread() {
  thread_local CorePair pair;
  return pair;
}

// The index of the support point of the core along `way`; the first of equals.
using FurthestPoint = size_t (*)(const Core& core, const CoreVector& way);

}  // namespace carom
