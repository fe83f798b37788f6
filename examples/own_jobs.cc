// A scheduler of the program's own runs Carom's steps: here a few threads that wait for work and
// take one task after the other. An engine hands Carom's tasks to the job system that it has.
#include <carom/carom.h>

#include <atomic>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <thread>
#include <vector>

namespace {

class OwnJobs : public carom::Jobs {
 public:
  explicit OwnJobs(int threads) {
    for (int i = 1; i < threads; ++i) workers_.emplace_back([this] { wait_for_work(); });
  }
  ~OwnJobs() override {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

  int threads() const override { return static_cast<int>(workers_.size()) + 1; }

  void run(size_t count, carom::FunctionRef<void(size_t)> task) override {
    {
      const std::lock_guard lock(mutex_);
      task_ = &task;
      count_ = count;
      next_ = 0;
      busy_ = workers_.size();
      ++round_;
    }
    wake_.notify_all();
    work();
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
  }

 private:
  void work() {
    for (size_t i = next_++; i < count_; i = next_++) (*task_)(i);
  }

  void wait_for_work() {
    for (size_t seen = 0;;) {
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return stop_ || round_ != seen; });
        if (stop_) return;
        seen = round_;
      }
      work();
      const std::lock_guard lock(mutex_);
      if (--busy_ == 0) done_.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, done_;
  std::vector<std::thread> workers_;
  const carom::FunctionRef<void(size_t)>* task_ = nullptr;
  size_t count_ = 0, busy_ = 0, round_ = 0;
  std::atomic<size_t> next_ = 0;
  bool stop_ = false;
};

// The contacts of 20,000 balls in a box.
std::vector<carom::Contact> find_contacts() {
  carom::World world;
  for (int i = 0; i < 20000; ++i) {
    world.add(
        {.shape = carom::Sphere{0.6f},
         .position = {1.1 * (i % 25), 1.1 * (i / 25 % 25), 1.1 * (i / 625) + 0.01 * (i % 7)}});
  }
  world.step();
  return {world.contacts().begin(), world.contacts().end()};
}

}  // namespace

int main() {
  const std::vector<carom::Contact> expected = find_contacts();  // with oneTBB

  OwnJobs jobs(3);
  const carom::JobsScope scope(jobs);  // from here on this thread's calls use `jobs`
  const std::vector<carom::Contact> contacts = find_contacts();

  const size_t bytes = contacts.size() * sizeof(carom::Contact);
  const bool same = contacts.size() == expected.size() &&
                    std::memcmp(contacts.data(), expected.data(), bytes) == 0;
  std::printf("%zu contacts on %d threads of our own, %s\n", contacts.size(), jobs.threads(),
              same ? "the same bits as with oneTBB" : "other bits");
  return same && contacts.size() > 20000 ? 0 : 1;
}
