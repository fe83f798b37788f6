// The functions that main() calls: one for each file of benchmarks.
#pragma once

#include <cstddef>

namespace carom::bench {

struct Options {
  size_t pairs = 100'000;       // of a stream
  size_t max_bodies = 100'000;  // of a scene
};

void register_clock();
void register_memory();
void register_bounds();
void register_dop_bounds();
void register_loads();
void register_find_pairs(const Options& options);
void register_narrowphase(const Options& options);
void register_impacts(const Options& options);
void register_world(const Options& options);
void register_moving(const Options& options);
void register_spaces(const Options& options);
void register_casts(const Options& options);

}  // namespace carom::bench
