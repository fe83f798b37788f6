// Whether a call may use more than the calling thread. Results do not depend on it.
#pragma once

#include <cstdint>

namespace carom {

enum class Parallelism : uint8_t {
  none,   // the calling thread alone; no scheduler is touched
  arena,  // the oneTBB arena of the caller, with its concurrency
};

}  // namespace carom
