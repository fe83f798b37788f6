// Pairs to test, A[i] against B[i], and columns for their results.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "carom/base/result.h"
#include "carom/results/pair.h"
#include "carom/results/result_arrays.h"
#include "carom/results/sweep.h"
#include "cli/pairs/body_columns.h"
#include "io/pairs_file.h"

namespace carom::cli {

// The movement of the bodies of one side. An empty array means zero for all.
struct Motions {
  std::vector<std::array<float, 3>> displacement;
  std::vector<std::array<float, 3>> rotation;

  void push(const Sweep& sweep);
  SweepView view() const;
  Sweep sweep(size_t index) const;
};

struct PairSet {
  BodyColumns a;
  BodyColumns b;
  Motions motions_a{};
  Motions motions_b{};

  size_t size() const { return a.size(); }
  // Whether a side has displacements; a time of impact needs them.
  bool has_motions() const {
    return !motions_a.displacement.empty() || !motions_b.displacement.empty();
  }
  // Whether some body is a mesh or a compound.
  bool has_composites() const { return a.has_composites() || b.has_composites(); }
};

// Reads a file of pairs. An orientation that is not a rotation (NaN, infinite or zero) makes its
// body invalid, whatever the kind. Kernels ignore orientations of spheres and aabbs, so this gives
// such a body a NaN position. With a tolerance (metres), models within half of it stand for hulls,
// meshes and compounds that many pairs share.
Result<PairSet> read_pair_set(const std::string& path, float tolerance = 0);

// The list of pairs (row i of A, row i of B): in order, or with neighbours far apart, so that they
// fall into other lanes and other batches.
std::vector<Pair> rows_in_order(size_t count);
std::vector<Pair> rows_spread_out(size_t count);

// Memory for the results of pairs at a detail; has sub-shapes if a body can have them.
ResultArrays results_of(const PairSet& pairs, Detail detail);

}  // namespace carom::cli
