// Memory that ends at an inaccessible page: reading or writing past the end crashes.
#pragma once

#include <cstddef>
#include <cstring>
#include <utility>

namespace carom::test {

class GuardedBytes {
 public:
  explicit GuardedBytes(size_t size, int fill = 0xa5);
  GuardedBytes(GuardedBytes&& other) noexcept;
  GuardedBytes& operator=(GuardedBytes&&) = delete;
  ~GuardedBytes();

  size_t size() const { return size_; }
  char* data() { return data_; }
  const char* data() const { return data_; }

 private:
  size_t size_;
  size_t mapped_;
  char* base_;
  char* data_;
};

// `count` elements, `stride` bytes apart; the last one ends where the memory ends.
class GuardedArray {
 public:
  GuardedArray(size_t count, size_t element, size_t stride);

  template <class T>
  void set(size_t i, T value, size_t offset = 0) {
    std::memcpy(bytes_.data() + i * stride_ + offset, &value, sizeof value);
  }
  template <class T>
  T get(size_t i, size_t offset = 0) const {
    T value;
    std::memcpy(&value, bytes_.data() + i * stride_ + offset, sizeof value);
    return value;
  }

  void copy(size_t i, void* to) const { std::memcpy(to, bytes_.data() + i * stride_, element_); }

  size_t stride() const { return stride_; }
  template <class T>
  T* as() {
    return reinterpret_cast<T*>(bytes_.data());
  }
  template <class T>
  const T* as() const {
    return reinterpret_cast<const T*>(bytes_.data());
  }

 private:
  size_t element_;
  size_t stride_;
  GuardedBytes bytes_;
};

}  // namespace carom::test
