// Hulls of linear rows, and their points in lanes of doubles.
#if defined(CAROM_IMPACTS_LINEAR_HULL_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_LINEAR_HULL_LANES_INL_H_
#undef CAROM_IMPACTS_LINEAR_HULL_LANES_INL_H_
#else
#define CAROM_IMPACTS_LINEAR_HULL_LANES_INL_H_
#endif

#include <algorithm>
#include <array>

#include "carom/shapes/hull.h"
#include "impacts/linear/approach-inl.h"
#include "impacts/linear/linear_load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The records of the hulls of a vector.
struct LinearHullRecords : PointRecords {
  DoubleMask has_space;  // lanes of which the points fit

  HWY_INLINE explicit LinearHullRecords(const HullGeometry* const* hulls) {
    static constexpr std::array<float, 4> kNothing{};
    HWY_ALIGN double counts[kDoubleLanes];
    for (size_t lane = 0; lane < kDoubleLanes; ++lane) {
      const HullGeometry* const hull = hulls[lane];
      const size_t count = hull ? hull->records().size() - 1 : kMostPointsOfDoubles + 1;
      const bool fits = count <= kMostPointsOfDoubles;
      first[lane] = fits ? hull->records()[0].data() : kNothing.data();
      points[lane] = fits ? count : 1;
      counts[lane] = static_cast<double>(count);
      most = std::max(most, points[lane]);
    }
    has_space = hn::Le(hn::Load(DoubleTag(), counts),
                       splat_double(static_cast<double>(kMostPointsOfDoubles)));
  }
};

// A hull as it is in a row.
struct LinearHull {
  D3 middle;
  D size;
  RotationOf<D> turn;

  explicit HWY_INLINE LinearHull(RowReader in)
      : middle(in.vector()), size(in.number()), turn(in.rotation()) {}

  // In units in which the scale is one. Powers of two round nothing.
  HWY_INLINE void scale(D down) {
    for (D3* column : {&turn.x, &turn.y, &turn.z}) *column = *column * down;
  }
};

// Places the points; returns how far the furthest is from the hull's position.
HWY_INLINE D place(const LinearHullRecords& records, const LinearHull& hull,
                   HullPointLanes& points) {
  D greatest = zero();
  points.count = records.most;
  for (size_t i = 0; i < records.most; ++i) {
    const D3 p = rotate(hull.turn, records.point(i));
    greatest = max(greatest, dot(p, p));
    put(p, points.point[i]);
  }
  return hn::Mul(hn::Sqrt(greatest), splat_double(scalar::kSpeedUpwards));
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_LINEAR_HULL_LANES_INL_H_
