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

// A corner, its squared distance from zero, and how it is seen along the ray.
struct ShellCorner {
  F3 point;
  F squared, u, v;

  HWY_INLINE explicit ShellCorner(const F3& p)
      : point(p), squared(dot(p, p)), u(dot(p, across(0))), v(dot(p, across(1))) {}
  HWY_INLINE ShellCorner(const F3& p, F squared_p, F u_p, F v_p)
      : point(p), squared(squared_p), u(u_p), v(v_p) {}

 private:
  static HWY_INLINE F3 across(size_t i) {
    return {splat(kShellAcross[i][0]), splat(kShellAcross[i][1]), splat(kShellAcross[i][2])};
  }
};

// On which side of the edge from p to q the ray passes.
HWY_INLINE F beside(const ShellCorner& p, const ShellCorner& q) {
  return hn::Sub(hn::Mul(p.u, q.v), hn::Mul(p.v, q.u));
}

// The corners of a shell, looked up by their numbers: from registers in vectors of sixteen.
class ShellCorners {
 public:
  HWY_INLINE ShellCorners(const Shell& shell, const ShellSpace& space)
      : space_(space),
        has_high_(shell.corners >> kInOne != 0),
        low_(load(0)),
        high_(has_high_ ? load(ShellSpace::kPlaces - kInOne) : low_) {}

  HWY_INLINE ShellCorner at(const uint8_t* numbers) const {
    const IntTag tag;
    const I index = hn::PromoteTo(tag, hn::LoadU(hn::Rebind<uint8_t, IntTag>(), numbers));
    if constexpr (kLanes == kInOne) {
      const auto find = [&](F low, F high) HWY_ATTR { return look_up(low, high, index); };
      return {{find(low_.point.x, high_.point.x), find(low_.point.y, high_.point.y),
               find(low_.point.z, high_.point.z)},
              find(low_.squared, high_.squared),
              find(low_.u, high_.u),
              find(low_.v, high_.v)};
    } else {
      const FloatTag floats;
      const auto find = [&](size_t axis) HWY_ATTR {
        return hn::GatherIndex(floats, space_.corner[axis].data(), index);
      };
      return ShellCorner(F3{find(0), find(1), find(2)});
    }
  }

 private:
  static constexpr size_t kInOne = 16;  // corners in a vector of sixteen lanes

  HWY_INLINE ShellCorner load(size_t i) const {
    const FloatTag tag;
    return ShellCorner({hn::Load(tag, space_.corner[0].data() + i),
                        hn::Load(tag, space_.corner[1].data() + i),
                        hn::Load(tag, space_.corner[2].data() + i)});
  }

  HWY_INLINE F look_up(F low, F high, I index) const {
    const FloatTag tag;
    const IntTag integers;
    const auto place =
        hn::IndicesFromVec(tag, hn::And(index, hn::Set(integers, int32_t{kInOne - 1})));
    const F found = hn::TableLookupLanes(low, place);
    if (!has_high_) return found;
    const auto is_low = hn::RebindMask(tag, hn::Lt(index, hn::Set(integers, int32_t{kInOne})));
    return hn::IfThenElse(is_low, found, hn::TableLookupLanes(high, place));
  }

  const ShellSpace& space_;
  const bool has_high_;
  const ShellCorner low_, high_;  // of vectors of sixteen lanes
};

// The squared distance of the edge from p to q, or less. `across`: p x q.
HWY_INLINE F edge_squared(const ShellCorner& p, const ShellCorner& q, const F3& across,
                          F greatest) {
  const F3 e = q.point - p.point;
  const F pq = dot(p.point, q.point), sure = hn::Mul(splat(kShellSure), greatest);
  const Mask ends_first =
      hn::Or(hn::Gt(hn::Sub(pq, p.squared), sure), hn::Gt(hn::Sub(pq, q.squared), sure));
  const F share = splat(kShellShare);
  const F product = hn::Sub(hn::Mul(dot(across, across), share),
                            hn::Mul(splat(kShellEdgeRest), hn::Mul(greatest, greatest)));
  const F line = hn::IfThenElseZero(hn::Gt(product, splat(0)), hn::Div(product, dot(e, e)));
  return hn::IfThenElse(ends_first, hn::Mul(min(p.squared, q.squared), share), line);
}

// The triangles from number i on; scalar::ShellTriangle says what the members are.
struct ShellTriangles {
  ShellCorner a, b, c;
  F greatest;
  F3 normal;
  F volume, height, squared;

  HWY_INLINE ShellTriangles(const Shell& shell, const ShellCorners& corners, size_t i)
      : a(corners.at(numbers(shell, i, 0))),
        b(corners.at(numbers(shell, i, 1))),
        c(corners.at(numbers(shell, i, 2))),
        greatest(max(max(a.squared, b.squared), c.squared)),
        normal(cross(b.point - a.point, c.point - a.point)),
        volume(dot(a.point, normal)) {
    const F rest = hn::Mul(splat(kShellHeight), hn::Mul(greatest, hn::Add(greatest, splat(1))));
    height = hn::Sub(hn::Abs(volume), rest);
    squared = hn::IfThenElseZero(hn::Gt(height, splat(0)),
                                 hn::Div(hn::Mul(height, height), dot(normal, normal)));
  }

 private:
  static HWY_INLINE const uint8_t* numbers(const Shell& shell, size_t i, size_t k) {
    return shell.corner[i / Shell::kGroup][k].data() + i % Shell::kGroup;
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
    const F beside_ab = beside(t.a, t.b), beside_bc = beside(t.b, t.c);
    const F beside_ca = beside(t.c, t.a);
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
    const F3 ab = cross(t.a.point, t.b.point), bc = cross(t.b.point, t.c.point);
    const F3 ca = cross(t.c.point, t.a.point);
    const F least = hn::Mul(splat(-kShellBeside), hn::Mul(t.greatest, t.greatest));
    const Mask is_beside =
        hn::Or(hn::Lt(dot(t.normal, ab), least),
               hn::Or(hn::Lt(dot(t.normal, bc), least), hn::Lt(dot(t.normal, ca), least)));
    const F edges =
        min(min(edge_squared(t.a, t.b, ab, t.greatest), edge_squared(t.b, t.c, bc, t.greatest)),
            edge_squared(t.c, t.a, ca, t.greatest));
    squared.put(i, hn::Lt(index, count),
                hn::IfThenElse(is_beside, max(t.squared, edges), t.squared));
    index = hn::Add(index, splat(kLanes));
  }
  return squared.check(shell.triangle_count, true);
}

HWY_INLINE uint64_t places_below(size_t count) {
  return count < 64 ? (uint64_t{1} << count) - 1 : ~uint64_t{0};
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
  return found & places_below(shell.triangle_count);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_SHELL_CHECK_INL_H_
