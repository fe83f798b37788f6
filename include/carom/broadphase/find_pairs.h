// Bounds -> pairs whose closed boxes overlap.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/export.h"
#include "carom/results/pair.h"
#include "carom/shapes/body.h"
#include "carom/shapes/views.h"

namespace carom {

enum class BroadphaseMethod : uint8_t {
  automatic,
  brute,  // every box against every other; the reference
  sweep,  // sort and sweep along the axis of largest spread
  grid,   // boxes sorted into cells of their size; what rests is kept from call to call
};

// "auto", "brute", "sweep", "grid".
CAROM_EXPORT const char* name(BroadphaseMethod method);

// Who may meet whom; one entry a box, nullptr: everybody. Decided inside the search, so that
// filtered pairs cost no output.
struct PairFilter {
  const uint32_t* layer = nullptr;  // with mask: (layer_a & mask_b) and (layer_b & mask_a)
  const uint32_t* mask = nullptr;   // both or neither
  const uint32_t* owner = nullptr;  // the same non-zero owner: never
  const Motion* motion = nullptr;   // two fixed boxes: never
};

// What a search did.
struct PairSearch {
  BroadphaseMethod method = BroadphaseMethod::automatic;  // that ran
  const char* reason = "";                                // why, in words
  size_t pairs = 0;                                       // that there are
  bool complete = true;  // false: more than the limit, and none were written
  size_t changed = 0;    // boxes that differ from those of the last call, where that is known
  size_t searched = 0;   // boxes whose pairs were searched for; those of all others were kept
  size_t grids = 0;      // of the grid method: one for each range of sizes that needs its own
};

// Finds pairs again and again: keeps its memory, and the order or the pairs of boxes that rest,
// which makes the next call cheaper. The pairs depend on the arguments alone.
class CAROM_EXPORT PairFinder {
 public:
  PairFinder();
  ~PairFinder();
  PairFinder(PairFinder&&) noexcept;
  PairFinder& operator=(PairFinder&&) noexcept;

  // Replaces `out` by all pairs a < b whose boxes overlap and which the filter lets through,
  // sorted. Boxes that are empty or hold a NaN meet nothing. At most 2^29 boxes.
  PairSearch find(const BoundsView& bounds, const PairFilter& filter, std::vector<Pair>& out,
                  BroadphaseMethod method = BroadphaseMethod::automatic,
                  Parallelism parallelism = Parallelism::none);

  // Forgets the boxes of the last call, not the memory.
  void forget();

  // A search that finds more pairs counts them, and gives none: boxes that all overlap make
  // n (n - 1) / 2 pairs, more than a machine holds. A pair takes about 28 bytes while it is found.
  // Less than 2^32.
  static constexpr size_t kMostPairs = size_t{1} << 28;
  void set_most_pairs(size_t pairs);

  // Memory held, in bytes.
  size_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Without state: writes the sorted pairs to `out` and returns how many there are. If they do not
// fit, nothing is written: call again with room for the number returned.
CAROM_EXPORT size_t find_pairs(const BoundsView& bounds, const PairFilter& filter,
                               std::span<Pair> out,
                               BroadphaseMethod method = BroadphaseMethod::automatic,
                               Parallelism parallelism = Parallelism::none);

}  // namespace carom
