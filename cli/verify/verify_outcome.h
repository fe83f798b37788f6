// The outcome of a verification: engines, counts and the first difference.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "carom/base/thread_arena.h"
#include "carom/simd/isa.h"

namespace carom::cli {

// An instruction set and a number of threads; every check runs on every engine.
struct Engine {
  Isa isa;
  int threads;
  ThreadArena* arena;
};

class Engines {
 public:
  // All usable instruction sets, 1 to `threads` threads.
  explicit Engines(int threads);
  const std::vector<Engine>& list() const { return engines_; }

 private:
  std::vector<std::unique_ptr<ThreadArena>> arenas_;
  std::vector<Engine> engines_;
};

// One line of the table.
struct VerifyRow {
  Engine engine;
  uint64_t frames = 0;
  uint64_t pairs = 0;
  uint64_t overlaps = 0;
  bool differs = false;
};

struct Difference {
  std::string where;  // one line
  std::string text;   // the pair, its inputs and both results
};

struct VerifyOutcome {
  std::string source;
  std::string compared;
  std::vector<VerifyRow> rows;
  std::optional<Difference> difference;  // the first
};

}  // namespace carom::cli
