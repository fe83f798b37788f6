#include "base/fresh_pages.h"

#include <cstdint>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace carom {
namespace {

// Advises on the whole pages of this size that the memory covers. Where the system refuses, it is
// memory as any other.
[[maybe_unused]] void advise(void* memory, size_t bytes, size_t page, int advice) {
  const auto address = reinterpret_cast<uintptr_t>(memory);
  const uintptr_t begin = (address + page - 1) / page * page;
  const uintptr_t end = (address + bytes) / page * page;
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, advice);
}

}  // namespace

void prepare_pages([[maybe_unused]] void* memory, [[maybe_unused]] size_t bytes) {
#ifdef MADV_HUGEPAGE
  advise(memory, bytes, 2 << 20, MADV_HUGEPAGE);
#endif
#ifdef MADV_POPULATE_WRITE
  constexpr size_t kMostAtOnce = 16 << 20;
  if (bytes <= kMostAtOnce) advise(memory, bytes, 4096, MADV_POPULATE_WRITE);
#endif
}

}  // namespace carom
