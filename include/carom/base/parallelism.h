/// @file
/// Whether a call may use more threads than the calling one. Results do not depend on it.
#pragma once

#include <cstdint>

namespace carom {

/// The threads that a call may use.
enum class Parallelism : uint8_t {
  none,   ///< the calling thread alone; the call touches no scheduler
  arena,  ///< the oneTBB arena of the calling thread, with its concurrency; inside a JobsScope
          ///< (carom/base/jobs.h) the caller's own scheduler
};

}  // namespace carom
