// Reads files of pairs to test and writes their results (.npz).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "carom/base/result.h"
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

// Results of P pairs; arrays that are empty are not written.
struct PairResults {
  uint64_t pairs = 0;
  std::vector<uint8_t> overlap;
  std::vector<float> separation;
  std::vector<std::array<float, 3>> normal;
  std::vector<std::array<float, 3>> point_a;
  std::vector<std::array<float, 3>> point_b;
  std::vector<uint8_t> manifold_count;
  std::vector<std::array<float, 12>> manifold_point;  // written as (P, 4, 3)
  std::vector<std::array<float, 4>> manifold_separation;
  std::vector<float> toi;
  std::vector<uint8_t> status;
  std::vector<uint32_t> sub_a;  // for pairs with meshes or compounds
  std::vector<uint32_t> sub_b;
};

Result<void> write_pair_results(const std::string& path, const PairResults& results);

}  // namespace carom::io
