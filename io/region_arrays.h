// All contacts of the pairs of a file, as its arrays hold them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "carom/base/result.h"
#include "io/files/npz.h"

namespace carom::io {

// Contacts first[i] to first[i + 1] - 1 are those of pair i. Points are in world coordinates; those
// that are unused are NaN.
struct RegionArrays {
  static constexpr uint32_t kNoParts = 0xffffffffu;

  std::vector<uint64_t> first = {0};
  std::vector<std::array<float, 3>> normal;
  std::vector<float> separation;
  std::vector<std::array<uint32_t, 2>> part;  // kNoParts for a shape that has none
  std::vector<uint8_t> point_count;
  std::vector<std::array<float, 12>> point;
  std::vector<std::array<float, 4>> point_separation;
};

Result<void> write_regions(NpzWriter& writer, const RegionArrays& regions);

}  // namespace carom::io
