/// @file
/// A fixed number of threads for callers that do not use oneTBB themselves.
#pragma once

#include <functional>
#include <memory>

#include "carom/base/parallelism.h"
#include "carom/export.h"

namespace carom {

/// Limits the threads of Carom's calls: work that runs inside uses at most `threads` threads, the
/// calling one included. With one thread (or less) no scheduler is started.
class CAROM_EXPORT ThreadArena {
 public:
  /// An arena of `threads` threads.
  explicit ThreadArena(int threads);
  ~ThreadArena();
  ThreadArena(const ThreadArena&) = delete;
  ThreadArena& operator=(const ThreadArena&) = delete;

  /// The value to pass to Carom's calls inside run().
  Parallelism parallelism() const;

  /// Calls work() inside the arena and returns when it is done.
  void run(const std::function<void()>& work);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carom
