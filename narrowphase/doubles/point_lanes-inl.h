// Points in lanes of doubles: the hull of some points in each lane. They lie in memory.
#if defined(CAROM_NARROWPHASE_DOUBLES_POINT_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_DOUBLES_POINT_LANES_INL_H_
#undef CAROM_NARROWPHASE_DOUBLES_POINT_LANES_INL_H_
#else
#define CAROM_NARROWPHASE_DOUBLES_POINT_LANES_INL_H_
#endif

#include <algorithm>
#include <array>

#include "narrowphase/doubles/core_rows.h"
#include "simd/gather-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Numbers of every lane, in memory.
struct alignas(64) LaneNumber {
  double lane[kDoubleLanes];

  HWY_INLINE D get() const { return hn::Load(DoubleTag(), lane); }
  HWY_INLINE void put(D v) { hn::Store(v, DoubleTag(), lane); }
};
using LaneVector = std::array<LaneNumber, 3>;

HWY_INLINE D3 get(const LaneVector& v) { return {v[0].get(), v[1].get(), v[2].get()}; }
HWY_INLINE void put(const D3& v, LaneVector& out) {
  out[0].put(v.x);
  out[1].put(v.y);
  out[2].put(v.z);
}

// The points of a hull in each lane. A hull with fewer points repeats its last one.
struct HullPointLanes {
  std::array<LaneVector, kMostPointsOfDoubles> point;
  size_t count;

  // The point that is furthest along `way`; of equals the first.
  HWY_INLINE D3 furthest(const D3& way) const {
    D3 best = get(point[0]);
    D most = dot(way, best);
    for (size_t i = 1; i < count; ++i) {
      const D3 p = get(point[i]);
      const D height = dot(way, p);
      const DoubleMask is_better = hn::Gt(height, most);
      most = max(height, most);
      best = select(is_better, p, best);
    }
    return best;
  }

  void copy_lane(const HullPointLanes& from, size_t lane, size_t to) {
    for (size_t i = 0; i < count; ++i) {
      const LaneVector& p = from.point[std::min(i, from.count - 1)];
      for (size_t axis = 0; axis < 3; ++axis) point[i][axis].lane[to] = p[axis].lane[lane];
    }
  }
};

// Where the points of a vector of hulls are stored: records of four floats.
struct PointRecords {
  std::array<const float*, kDoubleLanes> first;
  std::array<size_t, kDoubleLanes> points;  // at least one
  size_t most = 0;

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

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_DOUBLES_POINT_LANES_INL_H_
