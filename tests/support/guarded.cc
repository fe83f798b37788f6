#include "tests/support/guarded.h"

namespace carom::test {

GuardedBytes::GuardedBytes(size_t size, int fill) : size_(size) {
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

GuardedBytes::GuardedBytes(GuardedBytes&& other) noexcept
    : size_(other.size_),
      mapped_(other.mapped_),
      base_(std::exchange(other.base_, nullptr)),
      data_(other.data_) {}

GuardedBytes::~GuardedBytes() {
  if (base_) munmap(base_, mapped_);
}

GuardedArray::GuardedArray(size_t count, size_t element, size_t stride)
    : element_(element), stride_(stride), bytes_(count == 0 ? 0 : (count - 1) * stride + element) {}

}  // namespace carom::test
