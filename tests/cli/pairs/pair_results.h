// Reads the results of pairs that `carom pairs` wrote.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/files/npz.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {

// Members that the file lacks stay empty.
struct PairResultsFile {
  std::vector<uint8_t> overlap, status, manifold_count;
  std::vector<float> separation, toi;
  std::vector<std::array<float, 3>> normal, point_a, point_b;
  std::vector<float> manifold_point;  // 12 numbers a pair
  std::vector<std::array<float, 4>> manifold_separation;
  std::vector<uint32_t> sub_a, sub_b;
};

PairResultsFile read_pair_results(const std::string& path, size_t pairs);

}  // namespace carom::cli
