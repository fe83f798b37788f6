#include "bench/support/narrowphase.h"

namespace carom::bench {
namespace {

// Boxes in world coordinates, few enough for inputs and results to stay in L2: what the kernel
// itself can do.
void register_in_l2(const KindPair& kinds) {
  constexpr size_t kPairs = 4096;
  for (const int hit_percent : {10, 50, 90}) {
    register_stream(kinds,
                    {.kind_a = kinds.a,
                     .kind_b = kinds.b,
                     .storage = Storage::world,
                     .hit_percent = hit_percent,
                     .count = kPairs},
                    Detail::overlap, "l2");
  }
}

}  // namespace

void register_aabb_aabb(const KindPair& kinds, const Options& options) {
  register_streams(kinds, options);
  register_in_l2(kinds);
}

}  // namespace carom::bench
