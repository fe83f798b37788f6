// How far apart the separate pairs of a step are, as far as it matters for holding on to that
// result.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "carom/results/result_arrays.h"
#include "carom/shapes/views.h"
#include "world/changes/drift.h"
#include "world/results/result_buffer.h"
#include "world/store/columns.h"

namespace carom {

class GapStage {
 public:
  // Measures the separate pairs of a range of results: a lower bound of each gap, up to as far as
  // the two bodies come in some steps if they go on as they have. `pairs`: those of the rows.
  // Results themselves stay as they are. Nothing is asked of two meshes, whose distance costs more
  // than many decisions.
  void measure(std::span<const Pair> pairs, const PairRange& range, const ResultBuffer& results,
               const Collidables& bodies, const ContactDistances& distances, const Drift& drift,
               Parallelism parallelism);

  // The gap of a row of that range, metres; 0 if the pair has a contact, or nothing is known.
  float gap(size_t row) const { return gap_[row - first_row_]; }

  void give_back() { give_back_scratch(gap_, pairs_, rows_, reach_); }
  size_t bytes() const {
    return bytes_of(gap_) + bytes_of(pairs_) + bytes_of(rows_) + bytes_of(reach_) +
           columns_.bytes();
  }

 private:
  size_t first_row_ = 0;
  std::vector<float> gap_;
  std::vector<Pair> pairs_;  // that are measured, with their rows and how far it matters
  std::vector<uint32_t> rows_;
  std::vector<float> reach_;
  ResultArrays columns_;
};

}  // namespace carom
