#include "tests/support/guarded.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <mutex>
#include <vector>

#if defined(__SANITIZE_ADDRESS__)
#define CAROM_UNMAPS_AT_ONCE
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CAROM_UNMAPS_AT_ONCE
#endif
#endif

namespace carom::test {
namespace {

// How many mappings of a size are kept. With AddressSanitizer none, so that it sees reads of memory
// that was given back.
#ifdef CAROM_UNMAPS_AT_ONCE
constexpr size_t kMostKept = 0;
#else
constexpr size_t kMostKept = 64;
#endif

// Maps memory, and keeps what is given back: mapping took half the time of some tests.
class GuardedPages {
 public:
  // `used` bytes, a multiple of a page, and an inaccessible page behind them.
  char* take(size_t used, size_t page) {
    const std::lock_guard lock(mutex_);
    std::vector<char*>& kept = kept_[used + page];
    if (!kept.empty()) {
      char* base = kept.back();
      kept.pop_back();
      return base;
    }
    void* base =
        mmap(nullptr, used + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (base == MAP_FAILED) std::abort();
    if (mprotect(static_cast<char*>(base) + used, page, PROT_NONE) != 0) std::abort();
    return static_cast<char*>(base);
  }

  void give_back(char* base, size_t mapped) {
    const std::lock_guard lock(mutex_);
    std::vector<char*>& kept = kept_[mapped];
    if (kept.size() < kMostKept) {
      kept.push_back(base);
    } else {
      munmap(base, mapped);
    }
  }

  static GuardedPages& all() {
    static auto* pages = new GuardedPages;  // outlives every array
    return *pages;
  }

 private:
  std::mutex mutex_;
  std::map<size_t, std::vector<char*>> kept_;
};

}  // namespace

GuardedBytes::GuardedBytes(size_t size, int fill) : size_(size) {
  const size_t page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
  const size_t used = (size + page - 1) / page * page;
  mapped_ = used + page;
  base_ = GuardedPages::all().take(used, page);
  data_ = base_ + used - size;
  std::memset(data_, fill, size);
}

GuardedBytes::GuardedBytes(GuardedBytes&& other) noexcept
    : size_(other.size_),
      mapped_(other.mapped_),
      base_(std::exchange(other.base_, nullptr)),
      data_(other.data_) {}

GuardedBytes::~GuardedBytes() {
  if (base_) GuardedPages::all().give_back(base_, mapped_);
}

GuardedArray::GuardedArray(size_t count, size_t element, size_t stride)
    : element_(element), stride_(stride), bytes_(count == 0 ? 0 : (count - 1) * stride + element) {}

}  // namespace carom::test
