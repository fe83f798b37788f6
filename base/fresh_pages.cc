#include "base/fresh_pages.h"

#include <cstdint>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace carom {
namespace {

// Advises on pages of this size. Where the system refuses, it is memory as any other.
[[maybe_unused]] void advise(uintptr_t begin, uintptr_t end, int advice) {
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, advice);
}

[[maybe_unused]] uintptr_t down_to(uintptr_t address, size_t page) { return address / page * page; }
[[maybe_unused]] uintptr_t up_to(uintptr_t address, size_t page) {
  return down_to(address + page - 1, page);
}

}  // namespace

void prepare_pages([[maybe_unused]] void* memory, [[maybe_unused]] size_t bytes) {
  [[maybe_unused]] const auto begin = reinterpret_cast<uintptr_t>(memory);
  [[maybe_unused]] const uintptr_t end = begin + bytes;
#ifdef MADV_HUGEPAGE
  constexpr size_t kHugePage = 2 << 20;
  advise(up_to(begin, kHugePage), down_to(end, kHugePage), MADV_HUGEPAGE);
#endif
#ifdef MADV_POPULATE_WRITE
  constexpr size_t kPage = 4096, kMostAtOnce = 16 << 20;
  // Also the pages that it begins and ends in: touching does not change what others keep there.
  if (bytes >= kPage && bytes <= kMostAtOnce) {
    advise(down_to(begin, kPage), up_to(end, kPage), MADV_POPULATE_WRITE);
  }
#endif
}

}  // namespace carom
