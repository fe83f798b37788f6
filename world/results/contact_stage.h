// Results of pair tests, new and carried -> the step's overlaps and contacts, sorted.
#pragma once

#include <cstdint>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/results/contact.h"
#include "carom/results/result_arrays.h"
#include "world/motion/present_bounds.h"
#include "world/pairs/pair_history.h"
#include "world/store/body_store.h"

namespace carom {

// The columns to which the narrow phase writes.
class ResultBuffer {
 public:
  // Makes room for `pairs` results in the columns that the detail fills; with columns for
  // sub-shapes if `sub_shapes`. An extra row after them does not overlap; it serves pairs that need
  // no test.
  const ResultColumns& prepare(size_t pairs, Detail detail, bool sub_shapes);

  // Bounds are exact, tests round. So pairs with separate bounds do not overlap, even if the
  // rounded result of the test says that they touch.
  void reject_apart(const std::vector<Pair>& pairs, const PresentBounds& bounds,
                    Parallelism parallelism);

  uint8_t overlap(size_t row) const { return columns().overlap[row]; }
  Contact contact(size_t row, Pair pair) const;
  const ManifoldPoints& manifold(size_t row) const {
    // A row is a line of the cache, and rows of separate pairs are skipped: the processor does not
    // fetch these lines ahead.
    __builtin_prefetch(columns().manifold + row + kRowsAhead);
    return columns().manifold[row];
  }

  void give_back_beyond(size_t pairs) { arrays_.give_back_beyond(pairs); }
  size_t bytes() const { return arrays_.bytes(); }

 private:
  static constexpr size_t kRowsAhead = 12;

  const ResultColumns& columns() const { return arrays_.columns(); }

  size_t pairs_ = 0;
  ResultArrays arrays_;
};

// Fills overlaps, contact indices, contacts and manifolds of `now`.
class ContactStage {
 public:
  void run(const CarryPlan& plan, const PairHistory& last, const ResultBuffer& results,
           const BodyStore& bodies, Detail detail, Parallelism parallelism, PairHistory& now);

  size_t overlaps() const { return overlaps_; }
  size_t undecided() const { return undecided_; }
  size_t bytes() const { return block_first_.capacity() * sizeof(size_t); }

 private:
  void find_overlaps(const CarryPlan& plan, const PairHistory& last, const ResultBuffer& results,
                     const BodyStore& bodies, Parallelism parallelism, PairHistory& now);

  size_t overlaps_ = 0;
  size_t undecided_ = 0;
  // number of contacts of each block, later the place of its first one
  std::vector<size_t> block_first_;
};

// Sets the normal velocity of every contact.
void set_normal_velocities(std::span<const Eigen::Vector3f> velocities, Parallelism parallelism,
                           std::vector<Contact>& contacts);

}  // namespace carom
