// World bounds in lanes: loads positions and extents from any layout, and adds them.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bounds/bounds.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <array>
#include <limits>

#include "bounds/bounds_columns.h"
#include "bounds/bounds_load-inl.h"
#include "bounds/point_extents-inl.h"
#include "carom/bounds/bounds.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Zero if the position is finite, else NaN.
template <class V>
HWY_INLINE V finite_test(V x, V y, V z) {
  const V zero = hn::Zero(hn::DFromV<V>());
  return hn::Add(hn::Add(hn::Mul(x, zero), hn::Mul(y, zero)), hn::Mul(z, zero));
}
HWY_INLINE F finite_test(const Wide& x, const Wide& y, const Wide& z) {
#if HWY_TARGET == HWY_SCALAR
  return demote(finite_test(x.all, y.all, z.all));
#else
  return demote(Wide{finite_test(x.low, y.low, z.low), finite_test(x.high, y.high, z.high)});
#endif
}

template <class Position>
HWY_INLINE Mask is_valid(const Position& p) {
  return hn::Eq(finite_test(p.x, p.y, p.z), splat(0));
}
HWY_INLINE Mask is_valid(const NoPositions::Position&) { return hn::Not(no_lanes()); }

// Whether both are finite and in order; false for NaN.
HWY_INLINE Mask is_valid_axis(F lower, F upper) {
  return hn::And(hn::And(hn::Ge(lower, splat(-FLT_MAX)), hn::Le(lower, upper)),
                 hn::Le(upper, splat(FLT_MAX)));
}

HWY_INLINE Mask is_valid_extent(const F3& lower, const F3& upper) {
  return hn::And(hn::And(is_valid_axis(lower.x, upper.x), is_valid_axis(lower.y, upper.y)),
                 is_valid_axis(lower.z, upper.z));
}

// Writes the bounds of bodies [begin, end), a multiple of the lanes, and returns how many are
// valid.
template <class Positions, class Extents>
size_t bounds_of(const Positions& positions, const Extents& extents, const BoundsColumns& out,
                 size_t begin, size_t end) {
  const FloatTag tag;
  size_t count = 0;
  for (size_t i = begin; i < end; i += kLanes) {
    typename Positions::Position position;
    F w;
    F3 lower, upper;
    positions.load(i, position, w);
    extents.load(i, w, lower, upper);
    const Mask valid = hn::And(is_valid(position), is_valid_extent(lower, upper));
    count += hn::CountTrue(tag, valid);
    const auto write = [&](size_t axis, const auto& p, F low, F high) HWY_ATTR {
      const F down = hn::IfThenElse(valid, sum_downwards(p, low), splat(kInfinity));
      const F up = hn::IfThenElse(valid, sum_upwards(p, high), splat(-kInfinity));
      hn::StoreU(down, tag, out.lower[axis] + i);
      hn::StoreU(up, tag, out.upper[axis] + i);
    };
    write(0, position.x, lower.x, upper.x);
    write(1, position.y, lower.y, upper.y);
    write(2, position.z, lower.z, upper.z);
  }
  return count;
}

template <class Positions>
size_t bounds_at(const Positions& positions, const BodyReader& reader, const BoundsColumns& out,
                 size_t begin, size_t end) {
  const Collidables& bodies = reader.bodies;
  if (bodies.kind) return bounds_of(positions, MixedExtents(reader), out, begin, end);
  if (bodies.uniform_kind == ShapeKind::sphere) {
    return bounds_of(positions, SphereExtents(), out, begin, end);
  }
  if (bodies.uniform_kind == ShapeKind::aabb) {
    return bounds_of(positions, BoxExtents(bodies), out, begin, end);
  }
  if (bodies.uniform_kind == ShapeKind::box) {
    return bounds_of(positions, TurnedExtents<BoxReach>{reader}, out, begin, end);
  }
  if (bodies.uniform_kind == ShapeKind::capsule) {
    return bounds_of(positions, TurnedExtents<CapsuleReach>{reader}, out, begin, end);
  }
  if (bodies.uniform_kind == ShapeKind::hull) {
    return bounds_of(positions, PointExtents<HullCorners>{reader}, out, begin, end);
  }
  if (bodies.uniform_kind == ShapeKind::dop) {
    return bounds_of(positions, PointExtents<DopCorners>{reader}, out, begin, end);
  }
  return bounds_of(positions, MixedExtents(reader), out, begin, end);
}

size_t lane_bounds(const Collidables& bodies, const BoundsColumns& out, size_t begin, size_t end) {
  const BodyReader reader{bodies};
  const bool are_boxes = !bodies.kind && bodies.uniform_kind == ShapeKind::aabb;
  if (!bodies.position.data && are_boxes) {
    return bounds_of(NoPositions(), BoxExtents(bodies), out, begin, end);
  }
  if (bodies.position.data && bodies.position.radius_layout == RadiusLayout::fourth) {
    return reader.is_float64() ? bounds_at(DoubleRecords(bodies.position), reader, out, begin, end)
                               : bounds_at(FloatRecords(bodies.position), reader, out, begin, end);
  }
  const MixedExtents extents(reader);
  return reader.is_float64() ? bounds_of(AnyPositions<double>{reader}, extents, out, begin, end)
                             : bounds_of(AnyPositions<float>{reader}, extents, out, begin, end);
}

size_t lane_count() { return kLanes; }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <atomic>

#include "base/outward.h"
#include "base/parallel.h"
#include "bounds/extent.h"
#include "bounds/some_bounds.h"
#include "shapes/quick_kinds.h"
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(lane_bounds);
HWY_EXPORT(lane_count);

// Computes the bodies that are left of a block after the whole vectors, one at a time.
size_t single_bounds(const Collidables& bodies, const BoundsColumns& out, size_t begin,
                     size_t end) {
  const BodyReader reader{bodies};
  const float infinity = std::numeric_limits<float>::infinity();
  size_t valid = 0;
  for (size_t i = begin; i < end; ++i) {
    const bool is_valid = reader.is_valid(i);
    const Position<double> p = reader.position<double>(i);
    const Extent extent = extent_of(reader, i);
    const std::array<double, 3> position = {p.x, p.y, p.z};
    for (size_t axis = 0; axis < 3; ++axis) {
      const double lower = extent.lower[axis];
      const double upper = extent.upper[axis];
      out.lower[axis][i] = is_valid ? sum_downwards(position[axis], lower) : infinity;
      out.upper[axis][i] = is_valid ? sum_upwards(position[axis], upper) : -infinity;
    }
    valid += is_valid;
  }
  return valid;
}

bool has_halfspaces(const Collidables& bodies) {
  if (!bodies.kind) return bodies.uniform_kind == ShapeKind::halfspace;
  return std::find(bodies.kind, bodies.kind + bodies.count, ShapeKind::halfspace) !=
         bodies.kind + bodies.count;
}

// Gives body i all of space as its bounds if it is a valid half-space.
void open_if_halfspace(const BodyReader& reader, size_t i, const BoundsColumns& out) {
  const float infinity = std::numeric_limits<float>::infinity();
  if (reader.kind(i) != ShapeKind::halfspace || out.lower[0][i] > out.upper[0][i]) return;
  for (size_t axis = 0; axis < 3; ++axis) {
    out.lower[axis][i] = -infinity;
    out.upper[axis][i] = infinity;
  }
}

}  // namespace

size_t compute_bounds(const Collidables& bodies, const BoundsColumns& out,
                      Parallelism parallelism) {
  if (have_quick_kind(bodies)) parallelism = unless_few(parallelism, bodies.count);
  const size_t lanes = CAROM_DISPATCH(lane_count)();
  const bool are_open = has_halfspaces(bodies);
  std::atomic<size_t> valid{0};
  for_each_block(bodies.count, kBodiesPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    const size_t whole = end - (end - begin) % lanes;
    valid += CAROM_DISPATCH(lane_bounds)(bodies, out, begin, whole) +
             single_bounds(bodies, out, whole, end);
    for (size_t i = begin; are_open && i < end; ++i) open_if_halfspace(BodyReader{bodies}, i, out);
  });
  return bodies.count - valid;
}

void compute_some_bounds(const Collidables& bodies, std::span<const uint32_t> indices,
                         const BoundsColumns& out) {
  for (const uint32_t i : indices) {
    single_bounds(bodies, out, i, i + 1);
    open_if_halfspace(BodyReader{bodies}, i, out);
  }
}

}  // namespace carom
#endif  // HWY_ONCE
