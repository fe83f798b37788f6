// Tests the planes of as many pairs of triangles as there are lanes.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometries/near_triangles.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <bit>

#include "geometries/near_triangles.h"
#include "simd/gather-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// A normal whose square is less may have lost digits: it keeps nothing apart.
constexpr float kLeastSquare = 0x1p-100f;
constexpr float kNoGap = -0x1p100f;

// The corners number k of the triangles `kItem` of some pairs.
template <uint32_t ItemPair::*kItem>
struct CornerSource {
  const TriangleArrays& mesh;
  const ItemPair* pairs;
  size_t k;

  HWY_INLINE const float* corner(size_t i) const {
    return mesh.vertices + size_t{3} * mesh.triangles[pairs[i].*kItem][k];
  }
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::LoadU(Quad(), corner(i)); }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return corner(i)[c]; }
};

template <uint32_t ItemPair::*kItem>
HWY_INLINE void load_corners(const TriangleArrays& mesh, const ItemPair* pairs, F3* corners) {
  F next;  // the number that follows in memory
  for (size_t k = 0; k < 3; ++k) {
    transpose_records(CornerSource<kItem>{mesh, pairs, k}, corners[k], next);
  }
}

// The values of dot(n, x) that a triangle has.
struct Range {
  F low, high;

  HWY_INLINE Range(const F3& n, const F3* corners) {
    const F x = dot(n, corners[0]), y = dot(n, corners[1]), z = dot(n, corners[2]);
    low = min(min(x, y), z);
    high = max(max(x, y), z);
  }
};

// The gap of two triangles along the normal of the first. Both are projected on it, so that it need
// not be exact.
HWY_INLINE F gap_along_normal(const F3* a, const F3* b) {
  const F3 n = cross(a[1] - a[0], a[2] - a[0]);
  const Range range_a(n, a), range_b(n, b);
  const F gap = max(hn::Sub(range_b.low, range_a.high), hn::Sub(range_a.low, range_b.high));
  const F squared = dot(n, n);
  return hn::IfThenElse(hn::Ge(squared, splat(kLeastSquare)), hn::Div(gap, hn::Sqrt(squared)),
                        splat(kNoGap));
}

class PlaneTest {
 public:
  PlaneTest(const TriangleArrays& a, const TriangleArrays& b, const FrameChange& b_to_a,
            const PairScale& scale)
      : a_(a), b_(b), down_(static_cast<float>(scale.down)) {
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 3; ++k) turn_[k][i] = static_cast<float>(b_to_a.turn[i][k]);
      offset_[i] = scale.offset(b_to_a.offset[i]);
    }
  }

  // The greater one of the gaps along the two normals.
  HWY_INLINE F gap(const ItemPair* pairs) const {
    F3 a[3], b[3];
    load_corners<&ItemPair::a>(a_, pairs, a);
    load_corners<&ItemPair::b>(b_, pairs, b);
    const Rotation turn = {column(0), column(1), column(2)};
    const F3 offset = {splat(offset_[0]), splat(offset_[1]), splat(offset_[2])};
    for (size_t k = 0; k < 3; ++k) {
      a[k] = a[k] * splat(down_);
      b[k] = rotate(turn, b[k] * splat(down_)) + offset;
    }
    for (size_t k = 3; k-- > 0;) {  // small numbers have small errors
      b[k] = b[k] - a[0];
      a[k] = a[k] - a[0];
    }
    return max(gap_along_normal(a, b), gap_along_normal(b, a));
  }

 private:
  HWY_INLINE F3 column(size_t k) const {
    return {splat(turn_[k][0]), splat(turn_[k][1]), splat(turn_[k][2])};
  }

  const TriangleArrays a_, b_;
  float turn_[3][3];  // columns
  float offset_[3];
  const float down_;
};

size_t keep_near(const TriangleArrays& a, const TriangleArrays& b, const FrameChange& b_to_a,
                 const PairScale& scale, float reach, std::span<ItemPair> pairs, float* gaps) {
  const PlaneTest test(a, b, b_to_a, scale);
  size_t kept = 0;
  for (size_t first = 0; first < pairs.size(); first += kLanes) {
    const size_t count = std::min(pairs.size() - first, kLanes);
    ItemPair some[kLanes];
    std::copy_n(pairs.begin() + first, count, some);
    std::fill(some + count, some + kLanes, some[0]);
    const F gap = test.gap(some);
    // What is not a number is near.
    const Mask apart = hn::Gt(gap, splat(reach));
    uint64_t near = bits_of(FloatTag(), hn::Not(apart)) & ((uint64_t{1} << count) - 1);
    float gap_of[kLanes];
    hn::StoreU(gap, FloatTag(), gap_of);
    for (; near != 0; near &= near - 1) {
      const auto i = static_cast<size_t>(std::countr_zero(near));
      gaps[kept] = gap_of[i];
      pairs[kept++] = some[i];
    }
  }
  return kept;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/measured_kernels.h"

namespace carom {

HWY_EXPORT(keep_near);

size_t keep_near(const TriangleArrays& a, const TriangleArrays& b, const FrameChange& b_to_a,
                 const PairScale& scale, float reach, std::span<ItemPair> pairs, float* gaps) {
  return CAROM_DISPATCH_MEASURED(near_triangles, keep_near)(a, b, b_to_a, scale, reach, pairs,
                                                            gaps);
}

}  // namespace carom
#endif  // HWY_ONCE
