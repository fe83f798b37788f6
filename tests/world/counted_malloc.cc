#include "tests/world/counted_malloc.h"

#if defined(CAROM_TEST_COUNTS_MALLOC)

namespace {

// Volatile, since compilers assume that malloc touches no variable of the program.
thread_local volatile size_t allocated = 0;
thread_local volatile size_t failing = 0;

bool is_given() {
  allocated = allocated + 1;
  return allocated != failing;
}

}  // namespace

namespace carom::test {

size_t allocations() { return allocated; }
void fail_allocation(size_t number) { failing = number; }

}  // namespace carom::test

// Visible, so that the standard library uses these functions, too.
#define CAROM_TEST_SEEN __attribute__((visibility("default")))

// glibc's own names for its functions, for programs that replace them.
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

CAROM_TEST_SEEN void* malloc(size_t size) noexcept {
  return is_given() ? __libc_malloc(size) : nullptr;
}
CAROM_TEST_SEEN void* calloc(size_t count, size_t size) noexcept {
  return is_given() ? __libc_calloc(count, size) : nullptr;
}
CAROM_TEST_SEEN void* realloc(void* old, size_t size) noexcept {
  return is_given() ? __libc_realloc(old, size) : nullptr;
}
CAROM_TEST_SEEN void* aligned_alloc(size_t alignment, size_t size) noexcept {
  return is_given() ? __libc_memalign(alignment, size) : nullptr;
}
}

#endif  // defined(CAROM_TEST_COUNTS_MALLOC)
