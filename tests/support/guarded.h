// Memory that ends at an inaccessible page: reading or writing past the end crashes.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace carom::test {

class GuardedBytes {
 public:
  explicit GuardedBytes(size_t size, int fill = 0xa5) : size_(size) {
    const size_t page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
    const size_t used = (size + page - 1) / page * page;
    mapped_ = used + page;
    void* base = mmap(nullptr, mapped_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (base == MAP_FAILED) std::abort();
    base_ = static_cast<char*>(base);
    data_ = base_ + used - size;
    if (mprotect(base_ + used, page, PROT_NONE) != 0) std::abort();
    std::memset(data_, fill, size);
  }
  GuardedBytes(GuardedBytes&& other) noexcept
      : size_(other.size_),
        mapped_(other.mapped_),
        base_(std::exchange(other.base_, nullptr)),
        data_(other.data_) {}
  GuardedBytes& operator=(GuardedBytes&&) = delete;
  ~GuardedBytes() {
    if (base_) munmap(base_, mapped_);
  }

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
  GuardedArray(size_t count, size_t element, size_t stride)
      : element_(element),
        stride_(stride),
        bytes_(count == 0 ? 0 : (count - 1) * stride + element) {}

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
