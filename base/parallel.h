// Loops over fixed blocks. The blocks depend on the count alone, never on the number of threads, so
// results that are put together block by block do not depend on it either.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/float_environment.h"
#include "carom/base/function_ref.h"
#include "carom/base/parallelism.h"

namespace carom {

// True if the caller's scheduler, its Jobs or its arena, may be used and has more than one thread.
bool uses_threads(Parallelism parallelism);

// Runs task(i) for i in [0, count) on the caller's scheduler, in no particular order. A task that
// runs on Jobs finds no threads: it does not start tasks of its own.
void run_tasks(size_t count, FunctionRef<void(size_t)> task);

// Nanoseconds that the calling thread has spent in run_tasks() so far, in calls that were no part
// of another: the time that it shared with other threads.
uint64_t shared_nanoseconds();

// The threads for a loop over items that take a few nanoseconds each: none for few of them, because
// waking a thread takes 10 to 20 microseconds. In larger worlds threads stay awake from loop to
// loop.
inline constexpr size_t kFewItems = 8192;
inline Parallelism unless_few(Parallelism parallelism, size_t items) {
  return items < kFewItems ? Parallelism::none : parallelism;
}

inline size_t block_count(size_t count, size_t block_size) {
  return (count + block_size - 1) / block_size;
}

// Runs body(block, begin, end) for every block of [0, count), each in Carom's floating-point mode.
template <class Body>
void for_each_block(size_t count, size_t block_size, Parallelism parallelism, const Body& body) {
  const size_t blocks = block_count(count, block_size);
  const auto run = [&](size_t block) {
    const FloatEnvironment environment;
    const size_t begin = block * block_size;
    body(block, begin, std::min(begin + block_size, count));
  };
  if (blocks > 1 && uses_threads(parallelism)) {
    run_tasks(blocks, run);
  } else {
    for (size_t block = 0; block < blocks; ++block) run(block);
  }
}

}  // namespace carom
