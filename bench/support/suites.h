// What main() registers: one function a file of benchmarks.
#pragma once

#include <cstddef>

#include "carom/kernel/shape.h"

namespace carom::bench {

struct Options {
  size_t pairs = 100'000;       // of a stream
  size_t max_bodies = 100'000;  // of a scene
};

// A line of narrowphase/pair_list.inc.
struct KindPair {
  const char* name;
  ShapeKind a;
  ShapeKind b;
};

// narrowphase/NAME_bench.cc for every pair of kinds that has a kernel.
#define CAROM_PAIR(name, kind_a, kind_b) \
  void register_##name(const KindPair& kinds, const Options& options);
#include "narrowphase/pair_list.inc"
#undef CAROM_PAIR

void register_bounds();
void register_find_pairs(const Options& options);
void register_world(const Options& options);

}  // namespace carom::bench
