// Gaps between a ball or a box and triangles of cells, a cell a lane.
#if defined(CAROM_GEOMETRIES_CELL_GAPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_GEOMETRIES_CELL_GAPS_INL_H_
#undef CAROM_GEOMETRIES_CELL_GAPS_INL_H_
#else
#define CAROM_GEOMETRIES_CELL_GAPS_INL_H_
#endif

#include <array>
#include <cfloat>
#include <cmath>

#include "geometries/near_cells.h"
#include "simd/lanes-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// A body lies over few cells of a row.
using CellTag = hn::CappedTag<float, NearPoints::kRoom>;
using Cells = hn::Vec<CellTag>;
using Cells3 = Lanes3<Cells>;
inline constexpr size_t kCellLanes = hn::MaxLanes(CellTag());

HWY_INLINE Cells splat_cells(float value) { return hn::Set(CellTag(), value); }

HWY_INLINE Cells least_of_3(Cells a, Cells b, Cells c) { return min(min(a, b), c); }
HWY_INLINE Cells most_of_3(Cells a, Cells b, Cells c) { return max(max(a, b), c); }

// A solid in float32, about its own middle.
struct RoundedSolid {
  float z, z_rest;  // of the middle, in two parts
  std::array<std::array<float, 3>, 3> axis;
  std::array<float, 3> half;
  std::array<float, 3> reach;  // of the box along the axes of the field
  float size;

  explicit RoundedSolid(const SeenSolid& solid)
      : z(static_cast<float>(solid.middle[2])), z_rest(static_cast<float>(solid.middle[2] - z)) {
    size = 0;
    for (size_t k = 0; k < 3; ++k) {
      half[k] = static_cast<float>(solid.half[k]);
      size += half[k];
      double along = 0;
      for (size_t i = 0; i < 3; ++i) {
        axis[k][i] = static_cast<float>(solid.axis[k][i]);
        along += std::fabs(solid.axis[i][k]) * solid.half[i];
      }
      reach[k] = static_cast<float>(along);
    }
  }
};

// The plane of a triangle, and the foot of the solid's middle on it.
struct TrianglePlane {
  Cells slope_x, slope_y;
  Cells squared;  // of the length of the normal (-slope_x, -slope_y, 1)
  Cells height;   // of the middle over the plane, along z
  Cells foot_x, foot_y;

  HWY_INLINE TrianglePlane(const Cells3& corner, Cells rises_x, Cells rises_y)
      : slope_x(rises_x), slope_y(rises_y) {
    squared =
        hn::Add(hn::Add(hn::Mul(slope_x, slope_x), hn::Mul(slope_y, slope_y)), splat_cells(1));
    height = hn::Sub(hn::Add(hn::Mul(slope_x, corner.x), hn::Mul(slope_y, corner.y)), corner.z);
    const Cells along = hn::Div(height, squared);
    foot_x = hn::Mul(along, slope_x);
    foot_y = hn::Mul(along, slope_y);
  }

  // `beside`: how far the foot, seen from above, is beside the triangle; it is no nearer in the
  // plane.
  HWY_INLINE Cells distance(Cells beside) const {
    const Cells aside = max(beside, hn::Zero(CellTag()));
    const Cells over = hn::Mul(height, hn::Div(height, squared));
    return hn::Sqrt(hn::Add(over, hn::Mul(aside, aside)));
  }

  HWY_INLINE Cells3 point(const Cells3& corner, Cells x, Cells y) const {
    const Cells rise =
        hn::Add(hn::Mul(slope_x, hn::Sub(x, corner.x)), hn::Mul(slope_y, hn::Sub(y, corner.y)));
    return {x, y, hn::Add(corner.z, rise)};
  }
};

// The gaps between a box and triangles along some ways.
class BoxGaps {
 public:
  explicit BoxGaps(const RoundedSolid& solid) : solid_(solid) {}

  // The greatest one along the normal of a triangle, the way from its point that is nearest to the
  // middle, the sides of the box and the z axis of the field.
  HWY_INLINE Cells greatest(const TrianglePlane& plane, const Cells3& nearest, const Cells3& a,
                            const Cells3& b, const Cells3& c) const {
    return max(max(along_normal(plane), along_sides(a, b, c)), along_way(-nearest, a, b, c));
  }

 private:
  HWY_INLINE Cells along_normal(const TrianglePlane& plane) const {
    Cells support = hn::Zero(CellTag());
    for (size_t k = 0; k < 3; ++k) {
      const auto& e = solid_.axis[k];
      const Cells across =
          hn::Sub(splat_cells(e[2]), hn::Add(hn::Mul(plane.slope_x, splat_cells(e[0])),
                                             hn::Mul(plane.slope_y, splat_cells(e[1]))));
      support = hn::Add(support, hn::Mul(hn::Abs(across), splat_cells(solid_.half[k])));
    }
    return hn::Div(hn::Sub(hn::Abs(plane.height), support), hn::Sqrt(plane.squared));
  }

  // Along any way that is not zero.
  HWY_INLINE Cells along_way(const Cells3& way, const Cells3& a, const Cells3& b,
                             const Cells3& c) const {
    Cells support = hn::Zero(CellTag());
    for (size_t k = 0; k < 3; ++k) {
      const auto& e = solid_.axis[k];
      const Cells3 axis = {splat_cells(e[0]), splat_cells(e[1]), splat_cells(e[2])};
      support = hn::Add(support, hn::Mul(hn::Abs(dot(way, axis)), splat_cells(solid_.half[k])));
    }
    const Cells own = most_of_3(dot(way, a), dot(way, b), dot(way, c));
    const Cells squared = dot(way, way);
    const Cells gap = hn::Div(hn::Neg(hn::Add(own, support)), hn::Sqrt(squared));
    return hn::IfThenElse(hn::Gt(squared, splat_cells(FLT_MIN)), gap, splat_cells(-HUGE_VALF));
  }

  HWY_INLINE Cells along_sides(const Cells3& a, const Cells3& b, const Cells3& c) const {
    const Cells low = least_of_3(a.z, b.z, c.z), high = most_of_3(a.z, b.z, c.z);
    Cells gap = hn::Sub(max(low, hn::Neg(high)), splat_cells(solid_.reach[2]));
    for (size_t k = 0; k < 3; ++k) {
      const auto& e = solid_.axis[k];
      const Cells3 way = {splat_cells(e[0]), splat_cells(e[1]), splat_cells(e[2])};
      const Cells at_a = dot(way, a), at_b = dot(way, b), at_c = dot(way, c);
      const Cells beyond = max(least_of_3(at_a, at_b, at_c), hn::Neg(most_of_3(at_a, at_b, at_c)));
      gap = max(gap, hn::Sub(beyond, splat_cells(solid_.half[k])));
    }
    return gap;
  }

  const RoundedSolid& solid_;
};

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_GEOMETRIES_CELL_GAPS_INL_H_
