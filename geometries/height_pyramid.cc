#include "geometries/height_pyramid.h"

#include <algorithm>
#include <array>
#include <limits>

namespace carom {
namespace {

void include(float height, HeightRange& range) {
  range.low = std::min(range.low, height);
  range.high = std::max(range.high, height);
}

void include(const HeightRange& other, HeightRange& range) {
  range.low = std::min(range.low, other.low);
  range.high = std::max(range.high, other.high);
}

uint32_t blocks_of(uint32_t count, uint32_t side) { return (count + side - 1) / side; }

// Cell by cell, for blocks with holes.
HeightRange range_of_cells(const HeightFieldGeometry& field, uint32_t first_i, uint32_t end_i,
                           uint32_t first_j, uint32_t end_j) {
  HeightRange range;
  for (uint32_t j = first_j; j < end_j; ++j) {
    for (uint32_t i = first_i; i < end_i; ++i) {
      if (field.is_hole(i, j)) continue;
      for (const uint32_t k : {i, i + 1}) {
        include(field.height(k, j), range);
        include(field.height(k, j + 1), range);
      }
    }
  }
  return range;
}

// The lowest and highest sample of each column of some rows; comparisons alone, which compilers put
// into lanes.
template <class Sample>
class ColumnRanges {
 public:
  static constexpr uint32_t kColumns = 512;

  // Reads `columns` samples of each of `rows` rows from (i, j) on.
  void read(const HeightFieldGeometry& field, uint32_t i, uint32_t j, uint32_t columns,
            uint32_t rows) {
    std::fill_n(low_.begin(), columns, std::numeric_limits<Sample>::max());
    std::fill_n(high_.begin(), columns, std::numeric_limits<Sample>::lowest());
    std::fill_n(is_number_.begin(), columns, uint8_t{1});
    for (uint32_t k = 0; k < rows; ++k) {
      std::memcpy(row_.data(), field.row(j + k) + sizeof(Sample) * i, sizeof(Sample) * columns);
      for (uint32_t c = 0; c < columns; ++c) {
        const Sample x = row_[c];
        low_[c] = x < low_[c] ? x : low_[c];
        high_[c] = x > high_[c] ? x : high_[c];
      }
      for (uint32_t c = 0; c < columns; ++c) is_number_[c] &= uint8_t(is_number(row_[c]));
    }
  }

  // Finds the least and the greatest sample of some columns; false if one of them is no number.
  bool find(uint32_t first, uint32_t count, Sample& low, Sample& high) const {
    low = low_[first];
    high = high_[first];
    bool are_numbers = true;
    for (uint32_t c = first; c < first + count; ++c) {
      low = std::min(low, low_[c]);
      high = std::max(high, high_[c]);
      are_numbers &= is_number_[c] != 0;
    }
    return are_numbers;
  }

 private:
  static bool is_number(float sample) { return sample == sample; }
  static bool is_number(int16_t sample) { return sample != kHoleSample; }

  std::array<Sample, kColumns> low_, high_, row_;
  std::array<uint8_t, kColumns> is_number_;
};

float height_of(const HeightFieldGeometry& /*field*/, float sample) { return sample; }
float height_of(const HeightFieldGeometry& field, int16_t sample) {
  return field.height_of(sample);
}

template <class Sample>
void take_blocks_of(const HeightFieldGeometry& field, uint32_t j, uint32_t first_i, uint32_t end_i,
                    HeightPyramid::Level& level) {
  constexpr uint32_t kSide = HeightPyramid::kCells;
  constexpr uint32_t kAtOnce = (ColumnRanges<Sample>::kColumns - 1) / kSide;
  const uint32_t first_row = j * kSide, end_row = std::min(first_row + kSide, field.cells_y());
  ColumnRanges<Sample> columns;
  for (uint32_t first = first_i; first < end_i; first += kAtOnce) {
    const uint32_t end = std::min(first + kAtOnce, end_i);
    const uint32_t first_cell = first * kSide, end_cell = std::min(end * kSide, field.cells_x());
    columns.read(field, first_cell, first_row, end_cell - first_cell + 1, end_row - first_row + 1);
    for (uint32_t i = first; i < end; ++i) {
      const uint32_t begin = i * kSide, cells = std::min(kSide, field.cells_x() - begin);
      Sample low, high;
      const bool are_numbers = columns.find(begin - first_cell, cells + 1, low, high);
      const HeightRange range = {height_of(field, low), height_of(field, high)};
      level.at(i, j) = are_numbers && field.is_height(range.low) && field.is_height(range.high)
                           ? range
                           : range_of_cells(field, begin, begin + cells, first_row, end_row);
    }
  }
}

}  // namespace

HeightPyramid::HeightPyramid(uint32_t cells_x, uint32_t cells_y) {
  uint32_t nx = blocks_of(cells_x, kCells), ny = blocks_of(cells_y, kCells), side = kCells;
  for (;;) {
    levels_.push_back({nx, ny, side, std::vector<HeightRange>(size_t{nx} * ny)});
    if (nx == 1 && ny == 1) return;
    nx = blocks_of(nx, kBlocks);
    ny = blocks_of(ny, kBlocks);
    side *= kBlocks;
  }
}

size_t HeightPyramid::bytes() const {
  size_t bytes = sizeof *this + levels_.capacity() * sizeof(Level);
  for (const Level& level : levels_) bytes += level.ranges.capacity() * sizeof(HeightRange);
  return bytes;
}

void HeightPyramid::take_blocks(const HeightFieldGeometry& field, uint32_t j, uint32_t first_i,
                                uint32_t end_i) {
  field.type() == HeightType::float32
      ? take_blocks_of<float>(field, j, first_i, end_i, levels_[0])
      : take_blocks_of<int16_t>(field, j, first_i, end_i, levels_[0]);
}

void HeightPyramid::take_upper(uint32_t first_i, uint32_t end_i, uint32_t first_j, uint32_t end_j) {
  for (size_t k = 1; k < levels_.size(); ++k) {
    const Level& below = levels_[k - 1];
    Level& level = levels_[k];
    first_i /= kBlocks;
    first_j /= kBlocks;
    end_i = blocks_of(end_i, kBlocks);
    end_j = blocks_of(end_j, kBlocks);
    for (uint32_t j = first_j; j < end_j; ++j) {
      for (uint32_t i = first_i; i < end_i; ++i) {
        HeightRange range;
        for (uint32_t y = j * kBlocks; y < std::min((j + 1) * kBlocks, below.ny); ++y) {
          for (uint32_t x = i * kBlocks; x < std::min((i + 1) * kBlocks, below.nx); ++x) {
            include(below.at(x, y), range);
          }
        }
        level.at(i, j) = range;
      }
    }
  }
}

}  // namespace carom
