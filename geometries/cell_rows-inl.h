// Rows of samples of a height field, and where the lanes of a vector of cells lie in them.
#if defined(CAROM_GEOMETRIES_CELL_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_GEOMETRIES_CELL_ROWS_INL_H_
#undef CAROM_GEOMETRIES_CELL_ROWS_INL_H_
#else
#define CAROM_GEOMETRIES_CELL_ROWS_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstring>

#include "geometries/cell_gaps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// Rows of heights as float32, of which whole vectors can be read from any cell: where they are, or
// copied.
class HeightRows {
 public:
  HeightRows(const HeightFieldGeometry& field, const CellRange& window)
      : field_(field), first_(window.first_i), count_(window.end_i - window.first_i + 1) {
    const auto address = reinterpret_cast<uintptr_t>(field.row(0));
    const auto next = reinterpret_cast<uintptr_t>(field.row(1));
    const bool are_aligned = (address | next) % alignof(float) == 0;
    const bool has_room = window.end_i + kCellLanes < field.nx();
    are_in_place_ = field.type() == HeightType::float32 && are_aligned && has_room;
  }

  // From the first sample of the window. It may lie in the place of the row three before.
  const float* row(uint32_t j) {
    const std::byte* const samples = field_.row(j);
    if (are_in_place_) return reinterpret_cast<const float*>(samples) + first_;
    float* const copy = copies_[j % kKept].data();
    std::fill_n(copy + count_, NearPoints::kRoom, 0.0f);
    if (field_.type() == HeightType::float32) {
      std::memcpy(copy, samples + sizeof(float) * first_, sizeof(float) * count_);
      return copy;
    }
    for (size_t k = 0; k < count_; ++k) {
      int16_t steps;
      std::memcpy(&steps, samples + sizeof steps * (first_ + k), sizeof steps);
      copy[k] = field_.height_of(steps);
    }
    return copy;
  }

 private:
  static constexpr size_t kKept = 3;

  const HeightFieldGeometry& field_;
  const size_t first_, count_;
  bool are_in_place_;
  std::array<std::array<float, kMostCellsOfWindow + 1 + NearPoints::kRoom>, kKept> copies_;
};

// Where the lanes of a vector of cells are: in one row, or half of them in the next one, since most
// windows are narrow.
class LaneCells {
 public:
  HWY_INLINE LaneCells(const HeightFieldGeometry& field, const CellRange& window)
      : rows_(are_in_two_rows(window) ? 2 : 1) {
    const CellTag tag;
    const Numbers number_tag;
    const Cells lane = hn::Iota(tag, 0.0f);
    const Cells half = splat_cells(static_cast<float>(kCellLanes) / 2);
    is_second_ =
        hn::And(hn::Ge(lane, half), hn::Gt(splat_cells(static_cast<float>(rows_)), splat_cells(1)));
    column_ = hn::Sub(lane, hn::IfThenElseZero(is_second_, half));
    const auto to_second =
        hn::Set(number_tag, static_cast<uint32_t>(field.cells_x() - kCellLanes / 2));
    const auto cell =
        hn::Add(hn::Iota(number_tag, 0u),
                hn::IfThenElseZero(hn::RebindMask(number_tag, is_second_), to_second));
    number_ = hn::Add(cell, cell);
  }

  uint32_t rows() const { return rows_; }
  uint32_t columns() const { return static_cast<uint32_t>(kCellLanes) / rows_; }
  HWY_INLINE Cells column() const { return column_; }
  HWY_INLINE Cells of_rows(float first, float second) const {
    return hn::IfThenElse(is_second_, splat_cells(second), splat_cells(first));
  }
  // The number of the lower triangle, from that of the first cell.
  HWY_INLINE auto number() const { return number_; }

  // The heights of some cells from a sample in each of the rows on.
  HWY_INLINE Cells heights(const float* first, [[maybe_unused]] const float* second) const {
#if HWY_TARGET != HWY_SCALAR
    const hn::Half<CellTag> half;
    if (rows_ == 2) return hn::Combine(CellTag(), hn::LoadU(half, second), hn::LoadU(half, first));
#endif
    return hn::LoadU(CellTag(), first);
  }

  // Those of the window, where `columns` and `rows` are left.
  HWY_INLINE hn::Mask<CellTag> in_window(uint32_t columns_left, uint32_t rows_left) const {
    const auto in_columns = hn::Lt(column_, splat_cells(static_cast<float>(columns_left)));
    return rows_left > 1 ? in_columns : hn::AndNot(is_second_, in_columns);
  }

 private:
  using Numbers = hn::RebindToUnsigned<CellTag>;

  static bool are_in_two_rows(const CellRange& window) {
    return kCellLanes == NearPoints::kRoom && window.end_i - window.first_i <= kCellLanes / 2;
  }

  const uint32_t rows_;
  hn::Mask<CellTag> is_second_;
  Cells column_;
  hn::Vec<Numbers> number_;
};

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_GEOMETRIES_CELL_ROWS_INL_H_
