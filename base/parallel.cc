// The one place where oneTBB is used.
#include "base/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <chrono>
#include <mutex>
#include <utility>

#include "carom/base/jobs.h"
#include "carom/base/thread_arena.h"

// ThreadSanitizer does not see oneTBB's synchronisation; these calls tell it.
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

// The scheduler of the calling thread; nullptr: oneTBB.
thread_local Jobs* thread_jobs = nullptr;

thread_local uint64_t shared_ns = 0;
thread_local bool is_sharing = false;

// The time of a call of run_tasks().
class SharedTime {
 public:
  SharedTime() : is_outermost_(!std::exchange(is_sharing, true)) {}
  ~SharedTime() {
    if (!is_outermost_) return;
    const auto time = std::chrono::steady_clock::now() - start_;
    shared_ns += static_cast<uint64_t>(std::chrono::nanoseconds(time).count());
    is_sharing = false;
  }
  SharedTime(const SharedTime&) = delete;
  SharedTime& operator=(const SharedTime&) = delete;

 private:
  const bool is_outermost_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Runs what is inside of a task.
class OneThread : public Jobs {
 public:
  int threads() const override { return 1; }
  void run(size_t count, FunctionRef<void(size_t)> task) override {
    for (size_t i = 0; i < count; ++i) task(i);
  }
};

void run_on_jobs(Jobs& jobs, size_t count, FunctionRef<void(size_t)> task) {
  OneThread alone;
  jobs.run(count, [&](size_t i) {
    const JobsScope scope(alone);
    task(i);
  });
}

void run_on_arena(size_t count, FunctionRef<void(size_t)> task) {
  char started, finished;
  happens_before(&started);
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    happens_after(&started);
    task(i);
    happens_before(&finished);
  });
  happens_after(&finished);
}

}  // namespace

bool uses_threads(Parallelism parallelism) {
  if (parallelism != Parallelism::arena) return false;
  if (thread_jobs) return thread_jobs->threads() > 1;
  return tbb::this_task_arena::max_concurrency() > 1;
}

uint64_t shared_nanoseconds() { return shared_ns; }

void run_tasks(size_t count, FunctionRef<void(size_t)> task) {
  const SharedTime time;
  if (thread_jobs) {
    run_on_jobs(*thread_jobs, count, task);
  } else {
    run_on_arena(count, task);
  }
}

Jobs::~Jobs() = default;

JobsScope::JobsScope(Jobs& jobs) : outer_(thread_jobs) { thread_jobs = &jobs; }
JobsScope::~JobsScope() { thread_jobs = outer_; }

namespace {

// oneTBB uses as many threads as there are cores. global_control raises that limit, but of several
// controls the least counts. So the process has one control: the greatest number of threads that
// any arena asked for beyond the cores.
void allow_threads(int threads) {
  static std::mutex mutex;
  static int allowed = tbb::info::default_concurrency();
  // never deleted at exit: arenas may outlive every scope
  static tbb::global_control* limit = nullptr;
  const std::lock_guard lock(mutex);
  if (threads <= allowed) return;
  delete limit;
  allowed = threads;
  limit = new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                  static_cast<size_t>(allowed));
}

}  // namespace

struct ThreadArena::State {
  tbb::task_arena arena;
};

ThreadArena::ThreadArena(int threads) {
  if (threads <= 1) return;
  allow_threads(threads);
  state_.reset(new State{tbb::task_arena(threads)});
}
ThreadArena::~ThreadArena() = default;

Parallelism ThreadArena::parallelism() const {
  return state_ ? Parallelism::arena : Parallelism::none;
}

void ThreadArena::run(const std::function<void()>& work) {
  if (state_) {
    state_->arena.execute([&] {
      // Inside, the arena counts, whatever the thread's Jobs are.
      Jobs* const outer = std::exchange(thread_jobs, nullptr);
      work();
      thread_jobs = outer;
    });
  } else {
    work();
  }
}

}  // namespace carom
