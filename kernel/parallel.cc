// The one place where oneTBB is used.
#include "kernel/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <optional>

#include "carom/kernel/thread_arena.h"

// oneTBB's synchronisation is invisible to ThreadSanitizer; here it is stated.
#if defined(CAROM_THREAD_SANITIZER)
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace carom {
namespace {

void happens_before(void* event) {
#if defined(CAROM_THREAD_SANITIZER)
  __tsan_release(event);
#else
  (void)event;
#endif
}

void happens_after(void* event) {
#if defined(CAROM_THREAD_SANITIZER)
  __tsan_acquire(event);
#else
  (void)event;
#endif
}

}  // namespace

bool uses_threads(Parallelism parallelism) {
  return parallelism == Parallelism::arena && tbb::this_task_arena::max_concurrency() > 1;
}

void run_tasks(size_t count, FunctionRef<void(size_t)> task) {
  char started, finished;
  happens_before(&started);
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    happens_after(&started);
    task(i);
    happens_before(&finished);
  });
  happens_after(&finished);
}

struct ThreadArena::State {
  explicit State(int threads) : arena(threads) {
    // oneTBB has as many threads as cores unless told otherwise; tests ask for more.
    if (threads > tbb::info::default_concurrency()) {
      limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
    }
  }

  std::optional<tbb::global_control> limit;
  tbb::task_arena arena;
};

ThreadArena::ThreadArena(int threads) {
  if (threads > 1) state_ = std::make_unique<State>(threads);
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
