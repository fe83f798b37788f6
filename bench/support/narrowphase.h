// Benchmarks of narrow-phase kernels: NAME/DETAIL/STORAGE/hitPERCENT/ACCESS/RUNNER.
#pragma once

#include "bench/support/pair_stream.h"
#include "bench/support/suites.h"

namespace carom::bench {

// The benchmarks that every pair of kinds has: both details, both types of positions, three hit
// rates, rows and lists of pairs.
void register_streams(const KindPair& kinds, const Options& options);

// The same stream on every runner. `access` stands in the name.
void register_stream(const KindPair& kinds, const StreamSpec& spec, Detail detail,
                     const char* access);

}  // namespace carom::bench
