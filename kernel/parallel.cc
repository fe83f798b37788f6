// The one place where oneTBB is used.
#include "kernel/parallel.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "carom/kernel/thread_arena.h"

namespace carom {

bool uses_threads(Parallelism parallelism) {
  return parallelism == Parallelism::arena && tbb::this_task_arena::max_concurrency() > 1;
}

void run_tasks(size_t count, FunctionRef<void(size_t)> task) {
  tbb::parallel_for(size_t{0}, count, [&](size_t i) { task(i); });
}

struct ThreadArena::State {
  tbb::task_arena arena;
};

ThreadArena::ThreadArena(int threads) {
  if (threads > 1) state_.reset(new State{tbb::task_arena(threads)});
}
ThreadArena::~ThreadArena() = default;

Parallelism ThreadArena::parallelism() const {
  return state_ ? Parallelism::arena : Parallelism::none;
}

void ThreadArena::run(const std::function<void()>& work) {
  if (state_) {
    state_->arena.execute(work);
  } else {
    work();
  }
}

}  // namespace carom
