#include "cli/verify/verify_outcome.h"

namespace carom::cli {

Engines::Engines(int threads) {
  for (int count = 1; count <= threads; ++count) {
    arenas_.push_back(std::make_unique<ThreadArena>(count));
  }
  for (Isa isa : usable_isas()) {
    for (int count = 1; count <= threads; ++count) {
      engines_.push_back({isa, count, arenas_[static_cast<size_t>(count - 1)].get()});
    }
  }
}

}  // namespace carom::cli
