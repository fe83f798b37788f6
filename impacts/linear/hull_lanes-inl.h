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
#include "simd/gather-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The records of the hulls of a vector.
struct HullRecords {
  std::array<const float*, kDoubleLanes> first;
  std::array<size_t, kDoubleLanes> points;
  size_t most = 0;
  DoubleMask has_space;  // lanes of which the points fit

  HWY_INLINE explicit HullRecords(const HullGeometry* const* hulls) {
    static constexpr std::array<float, 4> kNothing{};
    HWY_ALIGN double counts[kDoubleLanes];
    for (size_t lane = 0; lane < kDoubleLanes; ++lane) {
      const HullGeometry* const hull = hulls[lane];
      const size_t count = hull ? hull->records().size() : kMostApproachPoints + 1;
      const bool fits = count <= kMostApproachPoints;
      first[lane] = fits ? hull->records()[0].data() : kNothing.data();
      points[lane] = fits ? count : 1;
      counts[lane] = static_cast<double>(count);
      most = std::max(most, points[lane]);
    }
    has_space = hn::Le(hn::Load(DoubleTag(), counts),
                       splat_double(static_cast<double>(kMostApproachPoints)));
  }

  // Point i of each hull, or its last one.
  template <class Tag = DoubleTag>  // so that branches for other widths are not compiled
  HWY_INLINE D3 point(size_t i) const {
    const auto record = [&](size_t lane)
                            HWY_ATTR { return first[lane] + 4 * std::min(i, points[lane] - 1); };
#if HWY_TARGET != HWY_SCALAR
    if constexpr (hn::MaxLanes(Tag()) >= 4) {
      const hn::Rebind<float, Tag> floats;
      const auto row = [&](size_t k) HWY_ATTR {
        return interleaved_row(floats, Source<decltype(record)>{record}, k);
      };
      const auto r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
      const auto xy02 = hn::InterleaveLower(floats, r0, r2);
      const auto xy13 = hn::InterleaveLower(floats, r1, r3);
      const auto zw02 = hn::InterleaveUpper(floats, r0, r2);
      const auto zw13 = hn::InterleaveUpper(floats, r1, r3);
      const Tag tag;
      return {hn::PromoteTo(tag, hn::InterleaveLower(floats, xy02, xy13)),
              hn::PromoteTo(tag, hn::InterleaveUpper(floats, xy02, xy13)),
              hn::PromoteTo(tag, hn::InterleaveLower(floats, zw02, zw13))};
    }
#endif
    LaneVector p;
    for (size_t lane = 0; lane < kDoubleLanes; ++lane) {
      for (size_t axis = 0; axis < 3; ++axis) p[axis].lane[lane] = record(lane)[axis];
    }
    return get(p);
  }

 private:
#if HWY_TARGET != HWY_SCALAR
  template <class Record>
  struct Source {
    const Record& record;
    HWY_INLINE hn::Vec<Quad> quad(size_t lane) const { return hn::LoadU(Quad(), record(lane)); }
  };
#endif
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
HWY_INLINE D place(const HullRecords& records, const LinearHull& hull, HullPointLanes& points) {
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
