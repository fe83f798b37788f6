// Schedulers as callers have them.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include "carom/base/jobs.h"

namespace carom::test {

// New threads in every run, which take one task after the other.
class ThreadJobs : public Jobs {
 public:
  explicit ThreadJobs(int threads) : threads_(threads) {}

  int threads() const override { return threads_; }
  void run(size_t count, FunctionRef<void(size_t)> task) override {
    runs_ += 1;
    std::atomic<size_t> next = 0;
    const auto work = [&] {
      for (size_t i = next++; i < count; i = next++) task(i);
    };
    std::vector<std::thread> others;
    for (int i = 1; i < threads_; ++i) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
  }

  size_t runs() const { return runs_; }

 private:
  int threads_;
  std::atomic<size_t> runs_ = 0;
};

// One thread that takes the last task first, and counts.
class BackwardJobs : public Jobs {
 public:
  // The calling thread alone would be called a scheduler without threads.
  int threads() const override { return 2; }
  void run(size_t count, FunctionRef<void(size_t)> task) override {
    runs_ += 1;
    tasks_ += count;
    most_inside_ = ++inside_ > most_inside_ ? inside_ : most_inside_;
    for (size_t i = count; i > 0; --i) task(i - 1);
    --inside_;
  }

  size_t runs() const { return runs_; }
  size_t tasks() const { return tasks_; }
  int most_inside() const { return most_inside_; }  // 2: a task called run()

 private:
  size_t runs_ = 0, tasks_ = 0;
  int inside_ = 0, most_inside_ = 0;
};

}  // namespace carom::test
