// How near the triangles of a shell come to zero, a triangle a lane (shell_check_scalar.h is the
// scalar form, and says why the answers are certain).
#if defined(CAROM_NARROWPHASE_HULLS_SHELL_CHECK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_SHELL_CHECK_INL_H_
#undef CAROM_NARROWPHASE_HULLS_SHELL_CHECK_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_SHELL_CHECK_INL_H_
#endif

#include <bit>

#include "base/tolerances.h"
#include "narrowphase/hulls/shell.h"
#include "simd/first_of_most-inl.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The corners of a shell, looked up by their numbers: from registers in vectors of sixteen.
class ShellCorners {
 public:
  HWY_INLINE ShellCorners(const Shell& shell, const ShellSpace& space)
      : space_(space), has_high_(shell.corners >> kInOne != 0) {
    if constexpr (kLanes == kInOne) {
      const FloatTag tag;
      for (size_t axis = 0; axis < 3; ++axis) {
        low_[axis] = hn::Load(tag, space.corner[axis].data());
        high_[axis] = hn::Load(tag, space.corner[axis].data() + kInOne);
      }
    }
  }

  HWY_INLINE F3 at(const uint8_t* numbers) const {
    const IntTag tag;
    const I index = hn::PromoteTo(tag, hn::LoadU(hn::Rebind<uint8_t, IntTag>(), numbers));
    return {look_up(0, index), look_up(1, index), look_up(2, index)};
  }

 private:
  static constexpr size_t kInOne = 16;  // corners in a vector of sixteen lanes

  HWY_INLINE F look_up(size_t axis, I index) const {
    const FloatTag tag;
    if constexpr (kLanes == kInOne) {
      const IntTag integers;
      const auto place =
          hn::IndicesFromVec(tag, hn::And(index, hn::Set(integers, int32_t{kInOne - 1})));
      const F low = hn::TableLookupLanes(low_[axis], place);
      if (!has_high_) return low;
      const auto is_low = hn::RebindMask(tag, hn::Lt(index, hn::Set(integers, int32_t{kInOne})));
      return hn::IfThenElse(is_low, low, hn::TableLookupLanes(high_[axis], place));
    } else {
      return hn::GatherIndex(tag, space_.corner[axis].data(), index);
    }
  }

  const ShellSpace& space_;
  const bool has_high_;
  F low_[3], high_[3];
};

// The squared distance of the edge from p to q, or less. `across`: p x q.
HWY_INLINE F edge_squared(const F3& p, const F3& q, const F3& across, F pp, F qq, F greatest) {
  const F3 e = q - p;
  const F pq = dot(p, q), sure = hn::Mul(splat(kShellSure), greatest);
  const Mask ends_first = hn::Or(hn::Gt(hn::Sub(pq, pp), sure), hn::Gt(hn::Sub(pq, qq), sure));
  const F share = splat(kShellShare);
  const F product = hn::Sub(hn::Mul(dot(across, across), share),
                            hn::Mul(splat(kShellEdgeRest), hn::Mul(greatest, greatest)));
  const F line = hn::IfThenElseZero(hn::Gt(product, splat(0)), hn::Div(product, dot(e, e)));
  return hn::IfThenElse(ends_first, hn::Mul(min(pp, qq), share), line);
}

// The triangles from number i on; scalar::ShellTriangle says what the members are.
struct ShellTriangles {
  F3 a, b, c, ab, bc, ca;
  F aa, bb, cc, greatest;
  F3 normal;
  F volume, height, squared;

  HWY_INLINE ShellTriangles(const Shell& shell, const ShellCorners& corners, size_t i) {
    const auto& group = shell.corner[i / Shell::kGroup];
    const size_t k = i % Shell::kGroup;
    a = corners.at(group[0].data() + k);
    b = corners.at(group[1].data() + k);
    c = corners.at(group[2].data() + k);
    ab = cross(a, b);
    bc = cross(b, c);
    ca = cross(c, a);
    aa = dot(a, a);
    bb = dot(b, b);
    cc = dot(c, c);
    greatest = max(max(aa, bb), cc);
    normal = (ab + bc) + ca;
    volume = dot(a, bc);
    const F rest = hn::Mul(splat(kShellSure), hn::Mul(greatest, hn::Add(greatest, splat(1))));
    height = hn::Sub(hn::Abs(volume), rest);
    squared = hn::IfThenElseZero(hn::Gt(height, splat(0)),
                                 hn::Div(hn::Mul(height, height), dot(normal, normal)));
  }
};

// The least of some numbers, and the first place of it.
struct LeastOfTriangles {
  HWY_ALIGN float number[Shell::kMostTriangles];
  F least;

  HWY_INLINE LeastOfTriangles() : least(splat(FLT_MAX)) {}
  HWY_INLINE void put(size_t i, Mask exists, F value) {
    const F kept = hn::IfThenElse(exists, value, splat(FLT_MAX));
    hn::Store(kept, FloatTag(), number + i);
    least = min(least, kept);
  }
  HWY_INLINE ShellCheck check(size_t count, bool is_around) const {
    const FloatTag tag;
    const F all = hn::MinOfLanes(tag, least);
    uint64_t places = 0;
    for (size_t i = 0; i < count; i += kLanes) {
      places |= bits_of(tag, hn::Eq(hn::Load(tag, number + i), all)) << i;
    }
    const auto first = static_cast<size_t>(std::countr_zero(places));
    return {hn::GetLane(all), first < count ? first : 0, is_around};
  }
};

HWY_INLINE ShellCheck check_planes(const Shell& shell, ShellSpace& space) {
  const FloatTag tag;
  const ShellCorners corners(shell, space);
  const F count = splat(static_cast<float>(shell.triangle_count)), zero = splat(0);
  F index = lane_indices();
  LeastOfTriangles squared;
  const F3 ray = {splat(kShellRay[0]), splat(kShellRay[1]), splat(kShellRay[2])};
  Mask unsure = no_lanes();
  uint64_t leaves = 0, enters = 0;
  for (size_t i = 0; i < shell.triangle_count; i += kLanes) {
    const ShellTriangles t(shell, corners, i);
    hn::Store(t.normal.x, tag, space.normal[0].data() + i);
    hn::Store(t.normal.y, tag, space.normal[1].data() + i);
    hn::Store(t.normal.z, tag, space.normal[2].data() + i);
    hn::Store(t.volume, tag, space.volume.data() + i);
    const Mask exists = hn::Lt(index, count);
    squared.put(i, exists, t.squared);
    index = hn::Add(index, splat(kLanes));
    // The ray from zero.
    const F sure = hn::Mul(splat(kShellSure), t.greatest), not_sure = hn::Neg(sure);
    const F beside_ab = dot(t.ab, ray), beside_bc = dot(t.bc, ray), beside_ca = dot(t.ca, ray);
    const F most = max(max(beside_ab, beside_bc), beside_ca);
    const F least = min(min(beside_ab, beside_bc), beside_ca);
    const Mask is_missed = hn::And(hn::Gt(most, sure), hn::Lt(least, not_sure));
    const Mask from_behind = hn::Gt(least, sure), from_before = hn::Lt(most, not_sure);
    const Mask is_hit = hn::And(hn::Or(from_behind, from_before), hn::Gt(t.height, zero));
    unsure = hn::Or(unsure, hn::AndNot(hn::Or(is_missed, is_hit), exists));
    const Mask counts = hn::And(is_hit, exists);
    leaves += hn::CountTrue(tag, hn::And(counts, hn::And(from_behind, hn::Gt(t.volume, zero))));
    enters += hn::CountTrue(tag, hn::And(counts, hn::And(from_before, hn::Lt(t.volume, zero))));
  }
  return squared.check(shell.triangle_count, hn::AllFalse(tag, unsure) && leaves == enters + 1);
}

HWY_INLINE ShellCheck check_edges(const Shell& shell, const ShellSpace& space) {
  const ShellCorners corners(shell, space);
  const F count = splat(static_cast<float>(shell.triangle_count));
  F index = lane_indices();
  LeastOfTriangles squared;
  for (size_t i = 0; i < shell.triangle_count; i += kLanes) {
    const ShellTriangles t(shell, corners, i);
    const F beside = hn::Mul(splat(-kShellBeside), hn::Mul(t.greatest, t.greatest));
    const Mask is_beside =
        hn::Or(hn::Lt(dot(t.normal, t.ab), beside),
               hn::Or(hn::Lt(dot(t.normal, t.bc), beside), hn::Lt(dot(t.normal, t.ca), beside)));
    const F edges = min(min(edge_squared(t.a, t.b, t.ab, t.aa, t.bb, t.greatest),
                            edge_squared(t.b, t.c, t.bc, t.bb, t.cc, t.greatest)),
                        edge_squared(t.c, t.a, t.ca, t.cc, t.aa, t.greatest));
    squared.put(i, hn::Lt(index, count),
                hn::IfThenElse(is_beside, max(t.squared, edges), t.squared));
    index = hn::Add(index, splat(kLanes));
  }
  return squared.check(shell.triangle_count, true);
}

// A bit for each triangle that the point is in front of.
HWY_INLINE uint64_t in_front(const Shell& shell, const ShellSpace& space,
                             const Eigen::Vector3f& point) {
  const FloatTag tag;
  const F3 p = {splat(point.x()), splat(point.y()), splat(point.z())};
  uint64_t found = 0;
  for (size_t i = 0; i < shell.triangle_count; i += kLanes) {
    const F3 n = {hn::Load(tag, space.normal[0].data() + i),
                  hn::Load(tag, space.normal[1].data() + i),
                  hn::Load(tag, space.normal[2].data() + i)};
    found |= bits_of(tag, hn::Gt(dot(n, p), hn::Add(hn::Load(tag, space.volume.data() + i),
                                                    splat(kShellInFront))))
             << i;
  }
  return found & ((uint64_t{1} << shell.triangle_count) - 1);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_SHELL_CHECK_INL_H_
