// Blocks, lists of blocks, arenas, and the floating-point mode that all of them run in.
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "base/block_lists.h"
#include "base/float_environment.h"
#include "carom/base/thread_arena.h"
#include "tests/support/float_modes.h"

namespace carom::test {
namespace {

struct Block {
  size_t block, begin, end;
  auto operator<=>(const Block&) const = default;
};

std::set<Block> blocks_of(size_t count, size_t block_size, Parallelism parallelism) {
  std::mutex mutex;
  std::set<Block> blocks;
  for_each_block(count, block_size, parallelism, [&](size_t block, size_t begin, size_t end) {
    const std::lock_guard lock(mutex);
    EXPECT_TRUE(blocks.insert({block, begin, end}).second) << "twice";
  });
  return blocks;
}

TEST(ForEachBlock, CoversEveryIndexOnce) {
  for (const size_t block_size : {1, 7, 64}) {
    for (const size_t count : {0, 1, 6, 7, 8, 63, 64, 65, 200}) {
      const std::set<Block> blocks = blocks_of(count, block_size, Parallelism::none);
      EXPECT_EQ(blocks.size(), block_count(count, block_size));
      size_t next = 0;
      for (const Block& block : blocks) {
        EXPECT_EQ(block.block, next / block_size);
        EXPECT_EQ(block.begin, next);
        EXPECT_GT(block.end, block.begin);
        EXPECT_LE(block.end - block.begin, block_size);
        next = block.end;
      }
      EXPECT_EQ(next, count);
    }
  }
}

TEST(ForEachBlock, HasTheSameBlocksOnAnyNumberOfThreads) {
  const std::set<Block> expected = blocks_of(1000, 7, Parallelism::none);
  for (const int threads : {1, 2, 4}) {
    ThreadArena arena(threads);
    arena.run([&] { EXPECT_EQ(blocks_of(1000, 7, Parallelism::arena), expected); });
  }
}

TEST(UnlessFew, LeavesShortLoopsToOneThread) {
  EXPECT_EQ(unless_few(Parallelism::arena, kFewItems), Parallelism::arena);
  EXPECT_EQ(unless_few(Parallelism::arena, kFewItems - 1), Parallelism::none);
  EXPECT_EQ(unless_few(Parallelism::none, kFewItems), Parallelism::none);
}

TEST(ForEachBlock, WithoutThreadsRunsOnTheCallerInOrder) {
  ThreadArena arena(4);
  arena.run([] {
    size_t next = 0;
    const std::thread::id caller = std::this_thread::get_id();
    for_each_block(100, 3, Parallelism::none, [&](size_t block, size_t, size_t) {
      EXPECT_EQ(block, next++);
      EXPECT_EQ(std::this_thread::get_id(), caller);
    });
  });
}

TEST(ThreadArena, OfOneThreadIsTheCaller) {
  for (const int threads : {1, 0, -1}) {
    ThreadArena arena(threads);
    EXPECT_EQ(arena.parallelism(), Parallelism::none);
    std::thread::id worker;
    arena.run([&] { worker = std::this_thread::get_id(); });
    EXPECT_EQ(worker, std::this_thread::get_id());
    EXPECT_FALSE(uses_threads(arena.parallelism()));
  }
}

TEST(ThreadArena, SaysWhetherThereAreThreads) {
  ThreadArena arena(3);
  EXPECT_EQ(arena.parallelism(), Parallelism::arena);
  bool ran = false;
  arena.run([&] {
    EXPECT_TRUE(uses_threads(Parallelism::arena));
    EXPECT_FALSE(uses_threads(Parallelism::none));
    ran = true;
  });
  EXPECT_TRUE(ran);
}

TEST(ThreadArena, UsesNoMoreThreadsThanAllowed) {
  ThreadArena arena(2);
  std::mutex mutex;
  std::set<std::thread::id> threads;
  arena.run([&] {
    for_each_block(5000, 1, arena.parallelism(), [&](size_t, size_t, size_t) {
      const std::lock_guard lock(mutex);
      threads.insert(std::this_thread::get_id());
    });
  });
  EXPECT_GE(threads.size(), 1u);
  EXPECT_LE(threads.size(), 2u);
}

TEST(FunctionRef, CallsWhatItRefersTo) {
  int calls = 0;
  const auto add = [&](int x) { return calls += x; };
  const FunctionRef<int(int)> reference(add);
  EXPECT_EQ(reference(2), 2);
  EXPECT_EQ(reference(3), 5);
}

// --- Block lists ---

TEST(BlockLists, AreConcatenatedInBlockOrder) {
  for (const int threads : {1, 4}) {
    ThreadArena arena(threads);
    arena.run([&] {
      BlockLists<size_t> lists;
      lists.reset(block_count(1000, 7));
      for_each_block(1000, 7, arena.parallelism(), [&](size_t block, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
          if (block % 3 != 0) lists[block].push_back(i);
        }
      });
      std::vector<size_t> expected;
      for (size_t i = 0; i < 1000; ++i) {
        if (i / 7 % 3 != 0) expected.push_back(i);
      }
      std::vector<size_t> out = {1, 2, 3};
      lists.concatenate(out, arena.parallelism());
      EXPECT_EQ(out, expected);
      EXPECT_EQ(lists.place(), expected.size());
    });
  }
}

TEST(BlockLists, StartEmptyAndKeepTheirMemory) {
  BlockLists<int> lists;
  EXPECT_EQ(lists.blocks(), 0u);
  EXPECT_EQ(lists.place(), 0u);
  lists.reset(3);
  for (size_t i = 0; i < 3; ++i) lists[i].assign(100, 1);
  const size_t bytes = lists.bytes();
  EXPECT_GE(bytes, 3 * 100 * sizeof(int));
  lists.reset(2);
  EXPECT_EQ(lists.blocks(), 2u);
  EXPECT_EQ(lists.place(), 0u);
  EXPECT_EQ(lists.bytes(), bytes);
  std::vector<int> out = {1};
  lists.concatenate(out, Parallelism::none);
  EXPECT_TRUE(out.empty());
  lists.reset(0);
  lists.concatenate(out, Parallelism::none);
  EXPECT_TRUE(out.empty());
}

// --- The floating-point mode ---

// How arithmetic behaves in the current mode. Volatile, since compilers compute with the default
// mode.
struct Behaviour {
  bool flushes_results, flushes_inputs, rounds_up, rounds_down;
  bool operator==(const Behaviour&) const = default;
};

Behaviour behaviour() {
  const volatile float smallest = std::numeric_limits<float>::denorm_min();
  const volatile float least_normal = std::numeric_limits<float>::min();
  const volatile float one = 1, tiny = 1e-20f, half = 0.5f, huge = 0x1p100f;
  const volatile float halved = least_normal * half;
  const volatile float grown = smallest * huge;
  const volatile float above = one + tiny;
  const volatile float below = one - tiny;
  return {halved == 0, grown == 0, above > one, below < one};
}

constexpr Behaviour kPlain{};

TEST(FloatEnvironment, IsPlainInsideAndTheCallersAgainOutside) {
  for (const FloatMode& mode : float_modes()) {
    SCOPED_TRACE(mode.name);
    Behaviour before, inside, after;
    {
      const ScopedFloatMode scoped(mode);
      before = behaviour();
      {
        const FloatEnvironment environment;
        inside = behaviour();
        { const FloatEnvironment nested; }
        inside.rounds_up |= behaviour().rounds_up;
      }
      after = behaviour();
    }
    EXPECT_EQ(inside, kPlain);
    EXPECT_EQ(after, before);
#if defined(__SSE2__)
    EXPECT_EQ(before == kPlain, mode.mxcsr == 0);
#endif
  }
  EXPECT_EQ(behaviour(), kPlain);
}

TEST(FloatEnvironment, HoldsInBlocksOnEveryThread) {
  for (const int threads : {1, 4}) {
    ThreadArena arena(threads);
    for (const FloatMode& mode : float_modes()) {
      SCOPED_TRACE(mode.name);
      std::atomic<int> wrong{0};
      Behaviour before, after;
      arena.run([&] {
        const ScopedFloatMode scoped(mode);
        before = behaviour();
        for_each_block(2000, 1, arena.parallelism(),
                       [&](size_t, size_t, size_t) { wrong += behaviour() != kPlain; });
        after = behaviour();
      });
      EXPECT_EQ(wrong, 0);
      EXPECT_EQ(after, before);
    }
  }
}

// A loop on threads counts as shared, with what it starts itself; one on this thread alone does
// not.
TEST(SharedNanoseconds, AreThoseOfLoopsOnThreads) {
  using std::chrono::milliseconds;
  using std::chrono::steady_clock;
  const auto wait = [](size_t, size_t, size_t) { std::this_thread::sleep_for(milliseconds(2)); };
  ThreadArena arena(2);
  arena.run([&] {
    const uint64_t before = shared_nanoseconds();
    for_each_block(4, 1, Parallelism::none, wait);
    EXPECT_EQ(shared_nanoseconds(), before);
    const auto start = steady_clock::now();
    for_each_block(4, 1, Parallelism::arena,
                   [&](size_t, size_t, size_t) { for_each_block(2, 1, Parallelism::arena, wait); });
    const std::chrono::nanoseconds all = steady_clock::now() - start;
    const uint64_t shared = shared_nanoseconds() - before;
    EXPECT_GE(shared, uint64_t{2'000'000});
    EXPECT_LE(shared, static_cast<uint64_t>(all.count()));
  });
}

}  // namespace
}  // namespace carom::test
