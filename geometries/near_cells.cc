// Bounds the gaps of both triangles of as many cells as there are lanes.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometries/near_cells.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <cmath>

#include "base/outward.h"
#include "base/tolerances.h"
#include "geometries/cell_gaps-inl.h"
#include "geometries/cell_rows-inl.h"
#include "geometries/near_cells.h"
#include "simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// Collects triangles and their gaps.
class NearCollector {
 public:
  explicit NearCollector(FunctionRef<void(const NearPoints&)> found) : found_(found) {
    near_.count = 0;
  }

  // Those of greater gaps are not wanted any more.
  void limit(float most) { most_ = std::min(most_, most); }

  template <class Gap, class Numbers, class M>
  HWY_INLINE void add(Gap gap, Numbers numbers, M kept) {
    const hn::RebindToUnsigned<CellTag> tag;
    const auto mask = hn::RebindMask(tag, kept);
    compress_store(tag, hn::BitCast(tag, gap), mask,
                   reinterpret_cast<uint32_t*>(near_.gap.data() + near_.count));
    near_.count += compress_store(tag, numbers, mask, near_.triangle.data() + near_.count);
  }
  bool is_full() const { return near_.count + 2 * kCellLanes > BoxTree::kMostAtOnce; }
  void hand_on() {
    size_t kept = 0;
    for (size_t i = 0; i < near_.count; ++i) {
      near_.triangle[kept] = near_.triangle[i];
      near_.gap[kept] = near_.gap[i];
      kept += near_.gap[i] <= most_ ? 1 : 0;
    }
    near_.count = kept;
    if (kept > 0) found_(near_);
    near_.count = 0;
  }

 private:
  const FunctionRef<void(const NearPoints&)> found_;
  float most_ = HUGE_VALF;
  NearPoints near_;
};

// Samples are where they would be without rounding; the slack covers what that moves corners.
template <bool kIsBox>
void near_cells(const HeightFieldGeometry& field, const CellRange& window, const SeenSolid& seen,
                const GapsWanted& wanted, FunctionRef<void(const NearPoints&)> found) {
  const CellTag tag;
  const hn::RebindToUnsigned<CellTag> number_tag;
  const RoundedSolid solid(seen);
  const BoxGaps gaps(solid);
  NearCollector collector(found);
  HeightRows rows(field, window);
  const uint32_t cells = window.end_i - window.first_i;
  const float dx = field.dx(), dy = field.dy();
  const double middle_j = field.cells_y() / 2.0;
  const auto first_x =
      static_cast<float>((window.first_i - field.cells_x() / 2.0) * double{dx} - seen.middle[0]);
  const Cells width_x = splat_cells(dx), width_y = splat_cells(dy);
  const Cells per_x = splat_cells(1 / dx), per_y = splat_cells(1 / dy);
  const Cells per_diagonal = splat_cells(1 / std::sqrt(dx * dx + dy * dy));
  const Cells middle_z = splat_cells(solid.z), rest_z = splat_cells(solid.z_rest);
  const Cells greatest_height = splat_cells(field.greatest_height());
  const Cells most = splat_cells(static_cast<float>(wanted.most));
  const float moved = std::max(-field.lower().x(), -field.lower().y()) * 0x1p-23f;
  const LaneCells lanes(field, window);
  Cells nearest_face = splat_cells(HUGE_VALF);
  const auto hand_on = [&]() HWY_ATTR {
    if constexpr (!kIsBox) {
      const float nearest = hn::GetLane(hn::MinOfLanes(tag, nearest_face));
      collector.limit(-round_downwards(-(nearest + wanted.ties)));
    }
    collector.hand_on();
  };
  const float* last_row = rows.row(window.first_j);
  for (uint32_t j = window.first_j; j < window.end_j; j += lanes.rows()) {
    const uint32_t rows_left = window.end_j - j;
    // Samples of rows of cells; the last two are one row, and nothing reads the second, where lanes
    // lie in one row, or no row is left.
    const float* const first_row = last_row;
    const float* const second_row = rows.row(j + 1);
    last_row = lanes.rows() == 2 && rows_left > 1 ? rows.row(j + 2) : second_row;
    const auto y_of = [&](uint32_t row) {
      return static_cast<float>((row - middle_j) * double{dy} - seen.middle[1]);
    };
    const Cells y0 = lanes.of_rows(y_of(j), y_of(j + 1));
    const Cells y1 = hn::Add(y0, width_y);
    for (uint32_t k = 0; k < cells; k += lanes.columns()) {
      const Cells h00 = lanes.heights(first_row + k, second_row + k);
      const Cells h10 = lanes.heights(first_row + k + 1, second_row + k + 1);
      const Cells h01 = lanes.heights(second_row + k, last_row + k);
      const Cells h11 = lanes.heights(second_row + k + 1, last_row + k + 1);
      const auto is_height = [&](Cells h) HWY_ATTR {
        return hn::Le(hn::Abs(h), greatest_height);  // false for NaN
      };
      const auto are_cells = hn::And(
          hn::And(hn::And(is_height(h00), is_height(h10)), hn::And(is_height(h01), is_height(h11))),
          lanes.in_window(cells - k, rows_left));

      const Cells x0 =
          hn::Add(splat_cells(first_x),
                  hn::Mul(hn::Add(lanes.column(), splat_cells(static_cast<float>(k))), width_x));
      const Cells x1 = hn::Add(x0, width_x);
      const auto about = [&](Cells h) HWY_ATTR { return hn::Sub(hn::Sub(h, middle_z), rest_z); };
      const Cells3 p00 = {x0, y0, about(h00)}, p10 = {x1, y0, about(h10)};
      const Cells3 p01 = {x0, y1, about(h01)}, p11 = {x1, y1, about(h11)};
      // How far a point is to the left of the diagonal.
      const auto left = [&](Cells x, Cells y) HWY_ATTR {
        return hn::Mul(hn::Sub(hn::Mul(hn::Sub(y, y0), width_x), hn::Mul(hn::Sub(x, x0), width_y)),
                       per_diagonal);
      };
      const Cells reach =
          max(max(max(hn::Abs(x0), hn::Abs(x1)), max(hn::Abs(y0), hn::Abs(y1))),
              max(max(hn::Abs(p00.z), hn::Abs(p10.z)), max(hn::Abs(p01.z), hn::Abs(p11.z))));
      const Cells slack =
          hn::Add(hn::Mul(splat_cells(kPlaneSlack), hn::Add(reach, splat_cells(solid.size))),
                  splat_cells(moved));
      const TrianglePlane below(p00, hn::Mul(hn::Sub(h10, h00), per_x),
                                hn::Mul(hn::Sub(h11, h10), per_y));
      const TrianglePlane above(p00, hn::Mul(hn::Sub(h11, h01), per_x),
                                hn::Mul(hn::Sub(h01, h00), per_y));
      const Cells left_of_below = left(below.foot_x, below.foot_y);
      const Cells right_of_above = hn::Neg(left(above.foot_x, above.foot_y));
      Cells gap_below, gap_above;
      if constexpr (kIsBox) {
        // About where the triangle is nearest to the middle.
        const Cells zero = hn::Zero(tag);
        const Cells back_below = hn::Mul(max(left_of_below, zero), per_diagonal);
        const Cells back_above = hn::Mul(max(right_of_above, zero), per_diagonal);
        const Cells3 near_below =
            below.point(p00, min(hn::Add(below.foot_x, hn::Mul(back_below, width_y)), x1),
                        max(hn::Sub(below.foot_y, hn::Mul(back_below, width_x)), y0));
        const Cells3 near_above =
            above.point(p00, max(hn::Sub(above.foot_x, hn::Mul(back_above, width_y)), x0),
                        min(hn::Add(above.foot_y, hn::Mul(back_above, width_x)), y1));
        const Cells aside = max(hn::Sub(max(x0, hn::Neg(x1)), splat_cells(solid.reach[0])),
                                hn::Sub(max(y0, hn::Neg(y1)), splat_cells(solid.reach[1])));
        gap_below = max(aside, gaps.greatest(below, near_below, p00, p10, p11));
        gap_above = max(aside, gaps.greatest(above, near_above, p00, p11, p01));
      } else {
        const Cells beside_below =
            max(max(hn::Sub(y0, below.foot_y), hn::Sub(below.foot_x, x1)), left_of_below);
        const Cells beside_above =
            max(max(hn::Sub(x0, above.foot_x), hn::Sub(above.foot_y, y1)), right_of_above);
        gap_below = below.distance(beside_below);
        gap_above = above.distance(beside_above);
        const auto note_face = [&](Cells beside, Cells distance) HWY_ATTR {
          const auto is_face = hn::And(are_cells, hn::Le(beside, hn::Neg(slack)));
          nearest_face = min(nearest_face, hn::IfThenElse(is_face, hn::Add(distance, slack),
                                                          splat_cells(HUGE_VALF)));
        };
        note_face(beside_below, gap_below);
        note_face(beside_above, gap_above);
      }
      const auto add = [&](Cells gap, uint32_t first) HWY_ATTR {
        const Cells less = hn::Sub(gap, slack);
        const Cells known = hn::IfThenElse(hn::Eq(less, less), less, splat_cells(-HUGE_VALF));
        collector.add(known, hn::Add(lanes.number(), hn::Set(number_tag, first)),
                      hn::And(are_cells, hn::Le(known, most)));
      };
      const uint32_t first_triangle = 2 * (j * field.cells_x() + window.first_i + k);
      add(gap_below, first_triangle);
      add(gap_above, first_triangle + 1);
      if (collector.is_full()) hand_on();
    }
  }
  hand_on();
}

void near_cells_of_ball(const HeightFieldGeometry& field, const CellRange& window,
                        const SeenSolid& solid, const GapsWanted& wanted,
                        FunctionRef<void(const NearPoints&)> found) {
  near_cells<false>(field, window, solid, wanted, found);
}

void near_cells_of_box(const HeightFieldGeometry& field, const CellRange& window,
                       const SeenSolid& solid, const GapsWanted& wanted,
                       FunctionRef<void(const NearPoints&)> found) {
  near_cells<true>(field, window, solid, wanted, found);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(near_cells_of_ball);
HWY_EXPORT(near_cells_of_box);

void find_near_cells(const HeightFieldGeometry& field, const CellRange& window,
                     const SeenSolid& solid, const GapsWanted& wanted,
                     FunctionRef<void(const NearPoints&)> found) {
  if (solid.is_box) {
    CAROM_DISPATCH(near_cells_of_box)(field, window, solid, wanted, found);
  } else {
    CAROM_DISPATCH(near_cells_of_ball)(field, window, solid, wanted, found);
  }
}

}  // namespace carom
#endif  // HWY_ONCE
