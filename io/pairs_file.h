// Reads files of pairs to test and writes their results (.npz).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "carom/base/result.h"
#include "carom/results/result_columns.h"
#include "io/region_arrays.h"
#include "io/shape_arrays.h"

namespace carom::io {

// One side (a or b) of all pairs. Optional arrays are empty if absent.
struct PairSide {
  std::vector<uint32_t> shape;
  std::vector<std::array<float, 3>> position32;    // one of these two,
  std::vector<std::array<double, 3>> position64;   // the same one for both sides
  std::vector<std::array<float, 4>> orientation;   // empty: identity
  std::vector<std::array<float, 3>> displacement;  // for time of impact
  std::vector<std::array<float, 3>> rotation;      // empty: none
};

struct PairsFile {
  uint64_t pairs = 0;
  bool float64_positions = false;
  SceneShapes shapes;
  PairSide a;
  PairSide b;
};

// Checks indices and sizes, not values: NaN is passed on.
Result<PairsFile> read_pairs(const std::string& path);
Result<void> write_pairs(const std::string& path, const PairsFile& pairs);

// Writes the columns that are there, under their names, the times of impact if `toi` is not
// nullptr, and all contacts if `regions` is not. A file of no pairs gets all arrays that
// docs/formats.md names. Unused points of a manifold are NaN in the file.
Result<void> write_pair_results(const std::string& path, uint64_t pairs,
                                const ResultColumns& columns, const float* toi = nullptr,
                                const RegionArrays* regions = nullptr);

}  // namespace carom::io
