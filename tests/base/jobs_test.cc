// Schedulers of the caller: who runs which tasks.
#include "carom/base/jobs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "base/parallel.h"
#include "base/radix_sort.h"
#include "carom/base/thread_arena.h"
#include "tests/support/own_jobs.h"

namespace carom::test {
namespace {

// Which threads run the blocks of a loop of 100 blocks; checks that all of them run once.
std::set<std::thread::id> threads_of_a_loop(Parallelism parallelism) {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  std::multiset<size_t> blocks;
  for_each_block(700, 7, parallelism, [&](size_t block, size_t, size_t) {
    const std::lock_guard lock(mutex);
    threads.insert(std::this_thread::get_id());
    blocks.insert(block);
  });
  std::multiset<size_t> expected;
  for (size_t i = 0; i < 100; ++i) expected.insert(i);
  EXPECT_EQ(blocks, expected);
  return threads;
}

TEST(Jobs, RunTheTasksOfTheirScope) {
  BackwardJobs jobs;
  const std::set<std::thread::id> caller = {std::this_thread::get_id()};
  {
    const JobsScope scope(jobs);
    EXPECT_TRUE(uses_threads(Parallelism::arena));
    EXPECT_FALSE(uses_threads(Parallelism::none));
    EXPECT_EQ(threads_of_a_loop(Parallelism::arena), caller);
    EXPECT_EQ(jobs.runs(), 1u);
    EXPECT_EQ(jobs.tasks(), 100u);
    threads_of_a_loop(Parallelism::none);
  }
  threads_of_a_loop(Parallelism::arena);
  EXPECT_EQ(jobs.runs(), 1u);
}

TEST(Jobs, OfSeveralThreads) {
  for (const int threads : {2, 3, 8}) {
    ThreadJobs jobs(threads);
    const JobsScope scope(jobs);
    const std::set<std::thread::id> used = threads_of_a_loop(Parallelism::arena);
    EXPECT_GE(used.size(), 1u);
    EXPECT_LE(used.size(), static_cast<size_t>(threads));
    EXPECT_EQ(jobs.runs(), 1u);
  }
}

TEST(Jobs, OfOneThreadAreNotAsked) {
  ThreadJobs jobs(1);
  const JobsScope scope(jobs);
  EXPECT_FALSE(uses_threads(Parallelism::arena));
  threads_of_a_loop(Parallelism::arena);
  EXPECT_EQ(jobs.runs(), 0u);
}

TEST(Jobs, OfTheInnermostScopeCount) {
  BackwardJobs outer, inner;
  const JobsScope outer_scope(outer);
  {
    const JobsScope inner_scope(inner);
    threads_of_a_loop(Parallelism::arena);
  }
  EXPECT_EQ(outer.runs(), 0u);
  EXPECT_EQ(inner.runs(), 1u);
  threads_of_a_loop(Parallelism::arena);
  EXPECT_EQ(outer.runs(), 1u);

  ThreadArena arena(3);
  arena.run([&] {
    EXPECT_TRUE(uses_threads(Parallelism::arena));
    threads_of_a_loop(Parallelism::arena);
    EXPECT_EQ(outer.runs(), 1u);
    const JobsScope in_arena(inner);
    threads_of_a_loop(Parallelism::arena);
    EXPECT_EQ(inner.runs(), 2u);
  });
  threads_of_a_loop(Parallelism::arena);
  EXPECT_EQ(outer.runs(), 2u);
}

TEST(Jobs, BelongToTheThreadOfTheScope) {
  BackwardJobs jobs;
  const JobsScope scope(jobs);
  std::thread([] { threads_of_a_loop(Parallelism::arena); }).join();
  EXPECT_EQ(jobs.runs(), 0u);
}

TEST(Jobs, AreNotAskedByTheirOwnTasks) {
  BackwardJobs backward;
  ThreadJobs threads(4);
  for (Jobs* const jobs : std::vector<Jobs*>{&backward, &threads}) {
    const JobsScope scope(*jobs);
    std::atomic<size_t> inner_blocks = 0;
    for_each_block(64, 1, Parallelism::arena, [&](size_t, size_t, size_t) {
      EXPECT_FALSE(uses_threads(Parallelism::arena));
      for_each_block(10, 1, Parallelism::arena, [&](size_t, size_t, size_t) { ++inner_blocks; });
    });
    EXPECT_EQ(inner_blocks, 640u);
    EXPECT_TRUE(uses_threads(Parallelism::arena));
  }
  EXPECT_EQ(backward.runs(), 1u);
  EXPECT_EQ(backward.most_inside(), 1);
  EXPECT_EQ(threads.runs(), 1u);
}

TEST(Jobs, Sort) {
  std::vector<uint64_t> items(100000);
  for (size_t i = 0; i < items.size(); ++i) items[i] = (i * 0x9e3779b97f4a7c15u) >> 32 << 32 | i;
  std::vector<uint64_t> expected = items, scratch;
  std::vector<uint32_t> histograms;
  radix_sort_by_key(expected, scratch, histograms, Parallelism::none);
  BackwardJobs backward;
  ThreadJobs threads(3);
  for (Jobs* const jobs : std::vector<Jobs*>{&backward, &threads}) {
    const JobsScope scope(*jobs);
    std::vector<uint64_t> sorted = items;
    radix_sort_by_key(sorted, scratch, histograms, Parallelism::arena);
    EXPECT_TRUE(sorted == expected);
  }
  EXPECT_GT(backward.runs(), 0u);
  EXPECT_GT(threads.runs(), 0u);
}

}  // namespace
}  // namespace carom::test
