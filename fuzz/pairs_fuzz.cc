// Reads any bytes as a file of pairs. An accepted file must have arrays that fit each other.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "fuzz/memory_file.h"
#include "io/pairs_file.h"

namespace {

void check_side(const carom::io::PairSide& side, const carom::io::PairsFile& pairs) {
  const bool fits =
      side.shape.size() == pairs.pairs &&
      (pairs.float64_positions ? side.position64.size() : side.position32.size()) == pairs.pairs &&
      (side.orientation.empty() || side.orientation.size() == pairs.pairs) &&
      (side.displacement.empty() || side.displacement.size() == pairs.pairs);
  if (!fits) std::abort();
  for (const uint32_t shape : side.shape) {
    if (shape >= pairs.shapes.kind.size()) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const carom::fuzz::MemoryFile file(data, size);
  const auto pairs = carom::io::read_pairs(file.path());
  if (!pairs) return 0;
  check_side(pairs->a, *pairs);
  check_side(pairs->b, *pairs);
  return 0;
}
