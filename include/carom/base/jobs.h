/// @file
/// The hook through which an engine's own scheduler runs Carom, in place of oneTBB.
#pragma once

#include <cstddef>

#include "carom/base/function_ref.h"
#include "carom/export.h"

namespace carom {

/// A scheduler of the caller: runs tasks and waits for them. Results do not depend on it: not on
/// the number of threads, and not on the order of the tasks.
class CAROM_EXPORT Jobs {
 public:
  virtual ~Jobs();

  /// How many threads may run tasks at the same time, the caller of run() included. With one,
  /// Carom does its work without run().
  virtual int threads() const = 0;

  /// Calls task(i) once for every i in [0, count), in any order, on any threads, at the same time
  /// or not, and returns when all calls have returned. Everything that was written before run() is
  /// visible to the tasks, and everything that they write is visible after it, as with
  /// std::thread and join(). Tasks are unequal in length (some 10 microseconds to a few
  /// milliseconds), so threads should take the next one when they are done with theirs. They do not
  /// wait, neither for other tasks nor for locks, and never call run() themselves. They throw
  /// nothing but std::bad_alloc; an implementation either hands that on to the caller of run() or
  /// ends the program.
  virtual void run(size_t count, FunctionRef<void(size_t)> task) = 0;
};

/// While it lives, Carom's calls with Parallelism::arena that this thread makes run on `jobs` in
/// place of oneTBB. Scopes may be nested: the last one counts, and inside ThreadArena::run() the
/// arena does. It must be destroyed by the thread that made it, in reverse order. It costs nothing:
/// make one around every call, or one for the life of a thread.
class CAROM_EXPORT JobsScope {
 public:
  /// `jobs` must outlive the scope.
  explicit JobsScope(Jobs& jobs);
  ~JobsScope();
  JobsScope(const JobsScope&) = delete;
  JobsScope& operator=(const JobsScope&) = delete;

 private:
  Jobs* outer_;
};

}  // namespace carom
