/// @file
/// The broadphase: finds all pairs of bounds that overlap.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/export.h"
#include "carom/results/pair.h"
#include "carom/results/pair_predicate.h"
#include "carom/shapes/body.h"
#include "carom/shapes/views.h"

namespace carom {

/// How a search finds its pairs. All methods find the same ones.
enum class BroadphaseMethod : uint8_t {
  automatic,  ///< the search chooses for the boxes of the call
  brute,      ///< every box against every other; the reference
  sweep,      ///< sort and sweep along the axis of largest spread
  grid,       ///< boxes sorted into cells of their size; resting boxes keep their pairs
};

/// "auto", "brute", "sweep", "grid".
CAROM_EXPORT const char* name(BroadphaseMethod method);

/// Which boxes may be paired: dense columns with one entry a box, a list of pairs and a predicate.
/// What is nullptr or empty forbids nothing. The order of the rules is in docs/filters.md.
struct PairFilter {
  const uint32_t* layer = nullptr;  ///< a pair needs (layer_a & mask_b) and (layer_b & mask_a)
  const uint32_t* mask = nullptr;   ///< goes with `layer`: give both or neither
  const uint32_t* owner = nullptr;  ///< boxes with the same non-zero owner are never paired
  const Motion* motion = nullptr;   ///< two fixed boxes are never paired
  /// Boxes with the same negative group are never paired; layers do not part boxes with the same
  /// positive group.
  const int32_t* group = nullptr;
  const uint32_t* space = nullptr;      ///< boxes of different spaces are never paired
  FilterRule rule = FilterRule::both;   ///< `either`: one half of the rule of `layer` is enough
  std::span<const Pair> excluded = {};  ///< never paired; a < b, sorted by (a, b)
  const PairPredicate* predicate = nullptr;  ///< asked about the pairs that all else allows
};

/// The order in which a search gives its pairs.
enum class PairOrder : uint8_t {
  sorted,  ///< by (a, b)
  any      ///< as they were found, which saves sorting them; the same pairs, a < b in each
};

/// What a search did.
struct PairSearch {
  BroadphaseMethod method = BroadphaseMethod::automatic;  ///< the method that ran
  const char* reason = "";                                ///< why that one, in words
  size_t pairs = 0;                                       ///< how many pairs there are
  bool complete = true;  ///< false: `pairs` is above the limit, and none were written
  size_t changed = 0;    ///< boxes that differ from those of the last call, where that is known
  size_t searched = 0;   ///< boxes searched for pairs; the search kept the pairs of all others
  size_t grids = 0;      ///< grids of BroadphaseMethod::grid, one for each range of sizes
};

/// Finds pairs again and again. It keeps its memory, and the order or the pairs of resting boxes,
/// which makes the next call cheaper. The pairs depend on the arguments alone. One thread at a time
/// may use a finder.
class CAROM_EXPORT PairFinder {
 public:
  /// A finder without memory of earlier boxes.
  PairFinder();
  ~PairFinder();
  /// Moves the state.
  PairFinder(PairFinder&&) noexcept;
  /// Moves the state.
  PairFinder& operator=(PairFinder&&) noexcept;

  /// Replaces `out` by all pairs a < b whose closed boxes overlap and which the filter allows,
  /// sorted by (a, b). Boxes that are empty or hold a NaN overlap nothing. At most 2^29 boxes.
  PairSearch find(const BoundsView& bounds, const PairFilter& filter, std::vector<Pair>& out,
                  BroadphaseMethod method = BroadphaseMethod::automatic,
                  Parallelism parallelism = Parallelism::none);

  /// The same for callers who know which boxes differ from those of the last call, or what the
  /// columns of the filter say of them: `changed`, ascending. The finder need not compare the
  /// others then. Boxes that were not there in the last call may be listed or not.
  PairSearch find_changed(const BoundsView& bounds, const PairFilter& filter,
                          std::span<const uint32_t> changed, std::vector<Pair>& out,
                          BroadphaseMethod method = BroadphaseMethod::automatic,
                          Parallelism parallelism = Parallelism::none);

  /// Sets the order of pairs, PairOrder::sorted at first. Any order depends on this call and the
  /// earlier ones, not on threads or the instruction set. Where the filter excludes pairs, they are
  /// sorted in any case. A change of the order forgets the boxes of the last call.
  void set_order(PairOrder order);

  /// Forgets the boxes of the last call, but keeps the memory.
  void forget();

  /// The default limit of pairs. Boxes that all overlap make n (n - 1) / 2 pairs, more than a
  /// machine holds; a pair takes about 28 bytes while it is found.
  static constexpr size_t kMostPairs = size_t{1} << 28;
  /// Sets the limit of pairs, less than 2^32. A search that finds more counts them and gives none.
  /// Here, pairs that PairFilter::excluded and PairFilter::predicate drop count, too.
  void set_most_pairs(size_t pairs);

  /// Memory held, in bytes.
  size_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Finds pairs without state: writes the sorted pairs to `out` and returns how many there are. If
/// they do not fit, it writes none: call again with room for the number returned.
CAROM_EXPORT size_t find_pairs(const BoundsView& bounds, const PairFilter& filter,
                               std::span<Pair> out,
                               BroadphaseMethod method = BroadphaseMethod::automatic,
                               Parallelism parallelism = Parallelism::none);

}  // namespace carom
