// Loads of a batch: bodies by index -> lanes.
#if defined(CAROM_NARROWPHASE_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_LOAD_INL_H_
#undef CAROM_NARROWPHASE_LOAD_INL_H_
#else
#define CAROM_NARROWPHASE_LOAD_INL_H_
#endif

#include "narrowphase/batch.h"
#include "simd/gather-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

enum class Role { a, b };

// The body of lane i on one side of kLanes pairs.
template <Role kRole>
HWY_INLINE uint32_t body_in(const Pair* pairs, size_t i) {
  return kRole == Role::a ? pairs[i].a : pairs[i].b;
}

// Positions of the pairs in the lanes: b - a, subtracted in the type of the positions so that the
// distance from the origin costs no accuracy, and each side's own position as high + low.
struct PositionLanes {
  F3 relative;
  F3 a, b;
  F3 a_low, b_low;       // float64 only: what rounding to float32 left
  F radius_a, radius_b;  // of spheres; otherwise any finite value
};

// Boxes given in world coordinates.
struct NoRecords {
  static constexpr bool kHasLow = false;
  static HWY_INLINE void load(const Batch&, const Pair*, PositionLanes& out) {
    out.relative = out.a = out.b = splat3(0);
  }
};

// The records of one side.
template <class T, Role kRole>
struct RecordSource {
  const BatchSide& side;
  const Pair* pairs;

  HWY_INLINE const T* record(size_t i) const {
    return reinterpret_cast<const T*>(static_cast<const char*>(side.records) +
                                      body_in<kRole>(pairs, i) * side.record_stride);
  }
};

template <Role kRole>
struct Source32 : RecordSource<float, kRole> {
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::LoadU(Quad(), this->record(i)); }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return this->record(i)[c]; }
};

struct Records32 {
  static constexpr bool kHasLow = false;

  static HWY_INLINE void load(const Batch& batch, const Pair* pairs, PositionLanes& out) {
    transpose_records(Source32<Role::a>{{batch.a, pairs}}, out.a, out.radius_a);
    transpose_records(Source32<Role::b>{{batch.b, pairs}}, out.b, out.radius_b);
    out.relative = out.b - out.a;
  }
};

// float64 records, rounded to float32.
template <Role kRole>
struct HighSource : RecordSource<double, kRole> {
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const {
    const DoublePair pair;
    const double* p = this->record(i);
    return demote_quad(hn::LoadU(pair, p), hn::LoadU(pair, p + 2));
  }
#endif
  HWY_INLINE float component(size_t i, size_t c) const {
    return static_cast<float>(this->record(i)[c]);
  }
};

// What that rounding left.
template <Role kRole>
struct LowSource : RecordSource<double, kRole> {
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const {
    const double* p = this->record(i);
    return demote_quad(low(p), low(p + 2));
  }
  static HWY_INLINE hn::Vec<DoublePair> low(const double* p) {
    const hn::Rebind<float, DoublePair> narrow;
    const auto v = hn::LoadU(DoublePair(), p);
    return hn::Sub(v, hn::PromoteTo(DoublePair(), hn::DemoteTo(narrow, v)));
  }
#endif
  HWY_INLINE float component(size_t i, size_t c) const {
    const double v = this->record(i)[c];
    return static_cast<float>(v - static_cast<double>(static_cast<float>(v)));
  }
};

// b - a in float64, then rounded to float32.
struct RelativeSource {
  RecordSource<double, Role::a> a;
  RecordSource<double, Role::b> b;

#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const {
    return demote_quad(difference(i, 0), difference(i, 2));
  }
  HWY_INLINE hn::Vec<DoublePair> difference(size_t i, size_t c) const {
    const DoublePair pair;
    return hn::Sub(hn::LoadU(pair, b.record(i) + c), hn::LoadU(pair, a.record(i) + c));
  }
#endif
  HWY_INLINE float component(size_t i, size_t c) const {
    return static_cast<float>(b.record(i)[c] - a.record(i)[c]);
  }
};

struct Records64 {
  static constexpr bool kHasLow = true;

  static HWY_INLINE void load(const Batch& batch, const Pair* pairs, PositionLanes& out) {
    const RecordSource<double, Role::a> a{batch.a, pairs};
    const RecordSource<double, Role::b> b{batch.b, pairs};
    F unused;
    transpose_records(HighSource<Role::a>{a}, out.a, out.radius_a);
    transpose_records(HighSource<Role::b>{b}, out.b, out.radius_b);
    transpose_records(LowSource<Role::a>{a}, out.a_low, unused);
    transpose_records(LowSource<Role::b>{b}, out.b_low, unused);
    transpose_records(RelativeSource{a, b}, out.relative, unused);
  }
};

// Shapes as kernels see them. A lane is plainly valid if is_ordered() and size() is finite; it may
// be valid without, if its size overflows.
struct SphereLanes {
  static constexpr ShapeKind kKind = ShapeKind::sphere;
  F radius;

  template <Role kRole>
  static HWY_INLINE SphereLanes load(const BatchSide&, const Pair*, const PositionLanes& p) {
    return {kRole == Role::a ? p.radius_a : p.radius_b};
  }
  HWY_INLINE Mask is_ordered() const { return hn::Ge(radius, splat(0)); }
  HWY_INLINE F size() const { return radius; }
  HWY_INLINE void clear_unless(Mask keep) { radius = hn::IfThenElseZero(keep, radius); }
};

struct BoxLanes {
  static constexpr ShapeKind kKind = ShapeKind::aabb;
  F3 lower, upper;

  template <Role kRole>
  static HWY_INLINE BoxLanes load(const BatchSide& side, const Pair* pairs, const PositionLanes&) {
    size_t offsets[kLanes];  // in bytes
    for (size_t i = 0; i < kLanes; ++i) {
      const uint32_t body = body_in<kRole>(pairs, i);
      offsets[i] = (side.box_slot ? side.box_slot[body] : body) * side.boxes.stride;
    }
    const auto column = [&](const float* first) HWY_ATTR {
      return lanes_from([&](size_t i) HWY_ATTR {
        return *reinterpret_cast<const float*>(reinterpret_cast<const char*>(first) + offsets[i]);
      });
    };
    const AabbColumns& boxes = side.boxes;
    return {{column(boxes.lower[0]), column(boxes.lower[1]), column(boxes.lower[2])},
            {column(boxes.upper[0]), column(boxes.upper[1]), column(boxes.upper[2])}};
  }

  // Rows in order, in dense columns: plain vector loads.
  static HWY_INLINE BoxLanes load_rows(const BatchSide& side, size_t row) {
    const FloatTag tag;
    const AabbColumns& boxes = side.boxes;
    return {{hn::LoadU(tag, boxes.lower[0] + row), hn::LoadU(tag, boxes.lower[1] + row),
             hn::LoadU(tag, boxes.lower[2] + row)},
            {hn::LoadU(tag, boxes.upper[0] + row), hn::LoadU(tag, boxes.upper[1] + row),
             hn::LoadU(tag, boxes.upper[2] + row)}};
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

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_LOAD_INL_H_
