// Counts what the calling thread allocates, and lets an allocation fail: malloc is replaced for the
// whole program, which covers everything built on it.
#pragma once

#include <cstddef>
#include <cstdlib>  // tells which C library it is

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CAROM_TEST_OTHER_MALLOC
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define CAROM_TEST_OTHER_MALLOC
#endif

// If another malloc is already in place (sanitizers), tests that need this one are left out.
#if !defined(CAROM_TEST_OTHER_MALLOC)
#define CAROM_TEST_COUNTS_MALLOC

namespace carom::test {

// How many there have been.
size_t allocations();

// Lets the allocation with this number fail; 0: none.
void fail_allocation(size_t number);

}  // namespace carom::test

#endif  // !defined(CAROM_TEST_OTHER_MALLOC)
