// Shapes of the bodies of a batch, in lanes, as kernels see them.
#if defined(CAROM_NARROWPHASE_BATCH_SHAPE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_SHAPE_LANES_INL_H_
#undef CAROM_NARROWPHASE_BATCH_SHAPE_LANES_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_SHAPE_LANES_INL_H_
#endif

#include "carom/shapes/hull.h"
#include "narrowphase/batch/load-inl.h"
#include "narrowphase/batch/shape_numbers-inl.h"
#include "shapes/geometry_row.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Shapes as kernels see them. A lane is plainly valid if is_ordered() and size() is finite. A lane
// whose size overflows may still be valid.
struct SphereLanes : SphereOf<F> {
  template <class V>
  using Of = SphereOf<V>;
  static constexpr ShapeKind kKind = ShapeKind::sphere;
  static constexpr bool kIsOriented = false;

  static bool is_dense(const BatchSide&) { return true; }

  template <Role kRole, class Bodies>
  static HWY_INLINE SphereLanes load(const BatchSide&, const Bodies&, const PositionLanes& p) {
    return {{kRole == Role::a ? p.radius_a : p.radius_b}};
  }
  HWY_INLINE Mask is_ordered() const { return hn::Ge(radius, splat(0)); }
  HWY_INLINE F size() const { return radius; }
  HWY_INLINE void clear_unless(Mask keep) { radius = hn::IfThenElseZero(keep, radius); }
};

// One corner of boxes in records (box_records()): `corner` is that of the first record.
template <Role kRole>
struct CornerSource {
  const BatchSide& side;
  const Listed& bodies;
  const float* corner;

  HWY_INLINE const float* numbers(size_t i) const {
    const size_t body = bodies.template body<kRole>(i);
    return corner + 8 * (side.box_slot ? side.box_slot[body] : body);
  }
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::LoadU(Quad(), numbers(i)); }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return numbers(i)[c]; }
};

struct AabbLanes : AabbOf<F> {
  template <class V>
  using Of = AabbOf<V>;
  static constexpr ShapeKind kKind = ShapeKind::aabb;
  static constexpr bool kIsOriented = false;

  static bool is_dense(const BatchSide& side) {
    return !side.box_slot && side.boxes.stride == sizeof(float);
  }

  template <Role kRole>
  static HWY_INLINE AabbLanes load(const BatchSide& side, const Listed& bodies,
                                   const PositionLanes&) {
    if (side.boxes.are_records) {
      AabbLanes box;
      F unused;
      transpose_records(CornerSource<kRole>{side, bodies, side.boxes.lower[0]}, box.lower, unused);
      transpose_records(CornerSource<kRole>{side, bodies, side.boxes.upper[0]}, box.upper, unused);
      return box;
    }
    size_t offsets[kLanes];  // in bytes
    for (size_t i = 0; i < kLanes; ++i) {
      const size_t body = bodies.template body<kRole>(i);
      offsets[i] = (side.box_slot ? side.box_slot[body] : body) * side.boxes.stride;
    }
    const auto column = [&](const float* first) HWY_ATTR {
      return lanes_from([&](size_t i) HWY_ATTR {
        return *reinterpret_cast<const float*>(reinterpret_cast<const char*>(first) + offsets[i]);
      });
    };
    const AabbColumns& boxes = side.boxes;
    return {{{column(boxes.lower[0]), column(boxes.lower[1]), column(boxes.lower[2])},
             {column(boxes.upper[0]), column(boxes.upper[1]), column(boxes.upper[2])}}};
  }

  template <Role>
  static HWY_INLINE AabbLanes load(const BatchSide& side, const DenseRows& rows,
                                   const PositionLanes&) {
    const FloatTag tag;
    const AabbColumns& boxes = side.boxes;
    const size_t row = rows.row;
    return {{{hn::LoadU(tag, boxes.lower[0] + row), hn::LoadU(tag, boxes.lower[1] + row),
              hn::LoadU(tag, boxes.lower[2] + row)},
             {hn::LoadU(tag, boxes.upper[0] + row), hn::LoadU(tag, boxes.upper[1] + row),
              hn::LoadU(tag, boxes.upper[2] + row)}}};
  }

  HWY_INLINE Mask is_ordered() const {
    return hn::And(hn::And(hn::Le(lower.x, upper.x), hn::Le(lower.y, upper.y)),
                   hn::Le(lower.z, upper.z));
  }
  HWY_INLINE F size() const {
    const F3 extent = upper - lower;
    return hn::Add(hn::Add(extent.x, extent.y), extent.z);
  }
  HWY_INLINE void clear_unless(Mask keep) {
    lower = zero_unless(keep, lower);
    upper = zero_unless(keep, upper);
  }
};

struct CapsuleLanes : CapsuleOf<F> {
  template <class V>
  using Of = CapsuleOf<V>;
  static constexpr ShapeKind kKind = ShapeKind::capsule;
  static constexpr bool kIsOriented = true;

  static bool is_dense(const BatchSide&) { return true; }

  template <Role kRole, class Bodies>
  static HWY_INLINE CapsuleLanes load(const BatchSide& side, const Bodies& bodies,
                                      const PositionLanes&) {
    CapsuleLanes capsule;
    F unused;
    load_row<kRole, 2>(side, bodies, 0, capsule.a, capsule.radius);
    load_row<kRole, 2>(side, bodies, 1, capsule.b, unused);
    return capsule;
  }
  HWY_INLINE Mask is_ordered() const { return hn::Ge(radius, splat(0)); }
  HWY_INLINE F size() const { return hn::Add(hn::Add(sum_of_sizes(a), sum_of_sizes(b)), radius); }
  HWY_INLINE void clear_unless(Mask keep) {
    a = zero_unless(keep, a);
    b = zero_unless(keep, b);
    radius = hn::IfThenElseZero(keep, radius);
  }
};

struct BoxLanes : BoxOf<F> {
  template <class V>
  using Of = BoxOf<V>;
  static constexpr ShapeKind kKind = ShapeKind::box;
  static constexpr bool kIsOriented = true;

  static bool is_dense(const BatchSide&) { return true; }

  template <Role kRole, class Bodies>
  static HWY_INLINE BoxLanes load(const BatchSide& side, const Bodies& bodies,
                                  const PositionLanes&) {
    BoxLanes box;
    F unused;
    load_row<kRole, 1>(side, bodies, 0, box.half, unused);
    return box;
  }
  HWY_INLINE Mask is_ordered() const { return hn::Ge(min(min(half.x, half.y), half.z), splat(0)); }
  HWY_INLINE F size() const { return sum_of_sizes(half); }
  HWY_INLINE void clear_unless(Mask keep) { half = zero_unless(keep, half); }
};

template <ShapeKind kRound>
struct RimLanes : RimOf<F, kRound> {
  template <class V>
  using Of = RimOf<V, kRound>;
  static constexpr ShapeKind kKind = kRound;
  static constexpr bool kIsOriented = true;
  using Of<F>::radius, Of<F>::half_length, Of<F>::rounding;

  static bool is_dense(const BatchSide&) { return true; }

  template <Role kRole, class Bodies>
  static HWY_INLINE RimLanes load(const BatchSide& side, const Bodies& bodies,
                                  const PositionLanes&) {
    F3 row;
    F rounding;
    load_row<kRole, 1>(side, bodies, 0, row, rounding);
    return {{row.x, row.y, rounding}};
  }
  HWY_INLINE Mask is_ordered() const {
    return hn::Ge(min(min(radius, half_length), rounding), splat(0));
  }
  HWY_INLINE F size() const { return hn::Add(hn::Add(radius, half_length), rounding); }
  HWY_INLINE void clear_unless(Mask keep) {
    radius = hn::IfThenElseZero(keep, radius);
    half_length = hn::IfThenElseZero(keep, half_length);
    rounding = hn::IfThenElseZero(keep, rounding);
  }
};
using CylinderLanes = RimLanes<ShapeKind::cylinder>;
using ConeLanes = RimLanes<ShapeKind::cone>;

struct EllipsoidLanes : EllipsoidOf<F> {
  template <class V>
  using Of = EllipsoidOf<V>;
  static constexpr ShapeKind kKind = ShapeKind::ellipsoid;
  static constexpr bool kIsOriented = true;

  static bool is_dense(const BatchSide&) { return true; }

  template <Role kRole, class Bodies>
  static HWY_INLINE EllipsoidLanes load(const BatchSide& side, const Bodies& bodies,
                                        const PositionLanes&) {
    EllipsoidLanes ellipsoid;
    load_row<kRole, 1>(side, bodies, 0, ellipsoid.semi_axes, ellipsoid.rounding);
    return ellipsoid;
  }
  HWY_INLINE Mask is_ordered() const {
    return hn::Ge(min(min(semi_axes.x, semi_axes.y), min(semi_axes.z, rounding)), splat(0));
  }
  HWY_INLINE F size() const { return hn::Add(sum_of_sizes(semi_axes), rounding); }
  HWY_INLINE void clear_unless(Mask keep) {
    semi_axes = zero_unless(keep, semi_axes);
    rounding = hn::IfThenElseZero(keep, rounding);
  }
};

struct TriangleLanes : TriangleOf<F> {
  template <class V>
  using Of = TriangleOf<V>;
  static constexpr ShapeKind kKind = ShapeKind::triangle;
  static constexpr bool kIsOriented = true;
  F thickness;
  Mask has_valid_flags;

  static bool is_dense(const BatchSide&) { return true; }

  template <Role kRole, class Bodies>
  static HWY_INLINE TriangleLanes load(const BatchSide& side, const Bodies& bodies,
                                       const PositionLanes&) {
    TriangleLanes triangle;
    F one_sided, inner_edges;
    load_row<kRole, 3>(side, bodies, 0, triangle.a, triangle.thickness);
    load_row<kRole, 3>(side, bodies, 1, triangle.b, one_sided);
    load_row<kRole, 3>(side, bodies, 2, triangle.c, inner_edges);
    const F zero = splat(0);
    triangle.is_special = hn::Or(hn::Or(hn::Ne(triangle.thickness, zero), hn::Ne(one_sided, zero)),
                                 hn::Ne(inner_edges, zero));
    triangle.has_valid_flags =
        hn::And(hn::Le(hn::Abs(one_sided), splat(FLT_MAX)),
                hn::And(hn::Ge(inner_edges, zero), hn::Le(inner_edges, splat(7))));
    return triangle;
  }
  HWY_INLINE Mask is_ordered() const {
    return hn::And(hn::Ge(thickness, splat(0)), has_valid_flags);
  }
  HWY_INLINE F size() const {
    return hn::Add(hn::Add(hn::Add(sum_of_sizes(a), sum_of_sizes(b)), sum_of_sizes(c)), thickness);
  }
  HWY_INLINE void clear_unless(Mask keep) {
    a = zero_unless(keep, a);
    b = zero_unless(keep, b);
    c = zero_unless(keep, c);
    thickness = hn::IfThenElseZero(keep, thickness);
  }
  HWY_INLINE F extent() const { return max(TriangleOf<F>::extent(), thickness); }
  HWY_INLINE void scale(F s) {
    TriangleOf<F>::scale(s);
    thickness = hn::Mul(thickness, s);
  }
};

// The normal is made a unit vector on loading.
struct HalfspaceLanes : HalfspaceOf<F> {
  template <class V>
  using Of = HalfspaceOf<V>;
  static constexpr ShapeKind kKind = ShapeKind::halfspace;
  static constexpr bool kIsOriented = true;

  static bool is_dense(const BatchSide&) { return true; }

  template <Role kRole, class Bodies>
  static HWY_INLINE HalfspaceLanes load(const BatchSide& side, const Bodies& bodies,
                                        const PositionLanes&) {
    HalfspaceLanes plane;
    F down;
    load_given<kRole>(side, bodies, plane, down);
    plane.make_unit(down);
    return plane;
  }

  // As stated, but for the scale of the normal: it is `down` times as long, so that squares neither
  // vanish nor overflow.
  template <Role kRole, class Bodies>
  static HWY_INLINE void load_given(const BatchSide& side, const Bodies& bodies,
                                    HalfspaceOf<F>& plane, F& down) {
    load_row<kRole, 1>(side, bodies, 0, plane.normal, plane.offset);
    F up;
    power_of_two(largest_component(plane.normal), up, down);
    plane.normal = plane.normal * down;
  }
  // A zero normal gives an offset or a size() that is NaN or infinite; so does an offset beyond
  // float32.
  HWY_INLINE Mask is_ordered() const { return hn::Eq(offset, offset); }
  HWY_INLINE F size() const { return hn::Add(sum_of_sizes(normal), hn::Abs(offset)); }
  HWY_INLINE void clear_unless(Mask keep) {
    normal = zero_unless(keep, normal);
    offset = hn::IfThenElseZero(keep, clamp_to_finite(offset));
  }
};

// Kernels read the points later, from `geometry`.
struct HullLanes {
  static constexpr ShapeKind kKind = ShapeKind::hull;
  static constexpr bool kIsOriented = true;
  const HullGeometry* geometry[kLanes];  // nullptr in lanes that are not valid
  F largest;                             // greatest coordinate, before scaling
  F scaling;

  static bool is_dense(const BatchSide&) { return true; }

  template <Role kRole, class Bodies>
  static HWY_INLINE HullLanes load(const BatchSide& side, const Bodies& bodies,
                                   const PositionLanes&) {
    HullLanes hull;
    const RowSource<kRole, 1, Bodies> rows{side, bodies, 0};
    for (size_t i = 0; i < kLanes; ++i) hull.geometry[i] = geometry_at<HullGeometry>(rows.row(i));
    hull.largest = lanes_from(
        [&](size_t i) HWY_ATTR { return hull.geometry[i] ? hull.geometry[i]->size() : -1.0f; });
    hull.scaling = splat(1);
    return hull;
  }
  HWY_INLINE Mask is_ordered() const { return hn::Ge(largest, splat(0)); }
  HWY_INLINE F size() const { return largest; }
  HWY_INLINE void clear_unless(Mask keep) { largest = hn::IfThenElseZero(keep, largest); }
  HWY_INLINE F extent() const { return hn::Mul(largest, scaling); }
  HWY_INLINE void scale(F s) { scaling = hn::Mul(scaling, s); }
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_SHAPE_LANES_INL_H_
