// A list of bounded length that needs no heap.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <initializer_list>

namespace carom {

// Holds at most kMost elements. A copy copies only the elements in use.
template <class T, size_t kMost>
class FewOf {
 public:
  static constexpr size_t kCapacity = kMost;

  FewOf() {}  // NOLINT(modernize-use-equals-default): that would fill the array with zeros
  FewOf(std::initializer_list<T> values) {
    for (const T& value : values) push_back(value);
  }
  FewOf(const FewOf& other) { *this = other; }
  FewOf& operator=(const FewOf& other) {
    size_ = other.size_;
    std::copy_n(other.begin(), size_, begin());
    return *this;
  }

  void push_back(const T& value) {
    assert(size_ < kMost);
    values_[size_++] = value;
  }
  void clear() { size_ = 0; }

  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool is_full() const { return size_ == kMost; }
  const T& operator[](size_t i) const { return values_[i]; }
  T& operator[](size_t i) { return values_[i]; }
  const T* begin() const { return values_.data(); }
  const T* end() const { return values_.data() + size_; }
  T* begin() { return values_.data(); }
  T* end() { return values_.data() + size_; }

 private:
  std::array<T, kMost> values_;
  size_t size_ = 0;
};

}  // namespace carom
