#include "bench/support/narrowphase.h"

namespace carom::bench {

void register_sphere_aabb(const KindPair& kinds, const Options& options) {
  register_streams(kinds, options);
}

}  // namespace carom::bench
