// A progress line on the terminal for work that takes longer than about a second.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "cli/support/console.h"

namespace carom::cli {

class Progress {
 public:
  Progress(const Console& console, const std::string& what, uint64_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(uint64_t done);

 private:
  using Clock = std::chrono::steady_clock;
  void erase();

  const Console& console_;
  std::string what_;
  uint64_t total_;
  Clock::time_point next_;
  size_t shown_ = 0;  // characters on the line
};

}  // namespace carom::cli
