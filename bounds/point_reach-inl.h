// point_reach() of one target.
#if defined(CAROM_BOUNDS_POINT_REACH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_BOUNDS_POINT_REACH_INL_H_
#undef CAROM_BOUNDS_POINT_REACH_INL_H_
#else
#define CAROM_BOUNDS_POINT_REACH_INL_H_
#endif

#include "bounds/point_reach.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Columns of hulls are padded to a multiple of 16.
static_assert(16 % kDoubleLanes == 0 && DopPolytope::kPadding % kDoubleLanes == 0);

HWY_INLINE D wide_points(const float* column) {
  return hn::PromoteTo(DoubleTag(), hn::LoadU(hn::Rebind<float, DoubleTag>(), column));
}
HWY_INLINE D wide_points(const double* column) { return hn::LoadU(DoubleTag(), column); }

inline size_t point_count(const HullGeometry& hull) { return hull.points().size(); }
inline size_t point_count(const DopPolytope& polytope) { return polytope.point_count(); }

// How far the points in each lane reach along three axes.
struct ReachOfLanes {
  D least[3], most[3];

  template <class Shape>
  HWY_INLINE ReachOfLanes(const std::array<Double3, 3>& axes, const Shape& shape) {
    visit(axes, shape, 0, [&](size_t k, D height) HWY_ATTR { least[k] = most[k] = height; });
    for (size_t i = kDoubleLanes; i < point_count(shape); i += kDoubleLanes) {
      visit(axes, shape, i, [&](size_t k, D height) HWY_ATTR {
        least[k] = min(least[k], height);
        most[k] = max(most[k], height);
      });
    }
  }

 private:
  // Calls use(k, axes[k] . point) for the points from i on.
  template <class Shape, class Use>
  static HWY_INLINE void visit(const std::array<Double3, 3>& axes, const Shape& shape, size_t i,
                               const Use& use) {
    const D x = wide_points(shape.column(0) + i);
    const D y = wide_points(shape.column(1) + i);
    const D z = wide_points(shape.column(2) + i);
    for (size_t k = 0; k < 3; ++k) {
      const auto times = [&](size_t axis, D v)
                             HWY_ATTR { return hn::Mul(splat_double(axes[k][axis]), v); };
      use(k, hn::Add(hn::Add(times(0, x), times(1, y)), times(2, z)));
    }
  }
};

// Lane i is op of all lanes of rows[i], of which there are as many as lanes.
template <class Op>
HWY_INLINE D fold_rows(const D* rows, const Op& op) {
#if HWY_TARGET == HWY_SCALAR
  (void)op;
  return rows[0];
#else
  const DoubleTag tag;
  const auto pair = [&](size_t i) HWY_ATTR {
    return op(hn::InterleaveLower(tag, rows[i], rows[i + 1]),
              hn::InterleaveUpper(tag, rows[i], rows[i + 1]));
  };
  const auto halves = [&](D a, D b) HWY_ATTR {
    return op(hn::ConcatLowerLower(tag, b, a), hn::ConcatUpperUpper(tag, b, a));
  };
  if constexpr (kDoubleLanes == 2) {
    return pair(0);
  } else if constexpr (kDoubleLanes == 4) {
    return halves(pair(0), pair(2));
  } else {  // eight
    const D a = halves(pair(0), pair(4)), b = halves(pair(2), pair(6));
    return op(hn::OddEvenBlocks(hn::SwapAdjacentBlocks(b), a),
              hn::OddEvenBlocks(b, hn::SwapAdjacentBlocks(a)));
  }
#endif
}

// Zero is positive.
template <class Shape>
HWY_INLINE Intervals reach(const std::array<Double3, 3>& axes, const Shape& shape) {
  const DoubleTag tag;
  const ReachOfLanes lanes(axes, shape);
  Intervals result;
  for (size_t k = 0; k < 3; ++k) {
    result[k] = {hn::GetLane(hn::MinOfLanes(tag, lanes.least[k])) + 0.0,
                 hn::GetLane(hn::MaxOfLanes(tag, lanes.most[k])) + 0.0};
  }
  return result;
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_BOUNDS_POINT_REACH_INL_H_
