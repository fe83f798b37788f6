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

// The bodies of kLanes pairs.
struct LaneIndices {
  uint32_t a[kLanes];
  uint32_t b[kLanes];
};

// Positions of the pairs in the lanes: b - a, subtracted in the type of the positions so that the
// distance from the origin costs no accuracy, and each side's own position as high + low.
struct PositionLanes {
  F3 relative;
  F3 a, b;
  F3 a_low, b_low;  // float64 only: what rounding to float32 left
  F radius_a, radius_b;
};

HWY_INLINE F3 xyz(const F4& v) { return {v.x, v.y, v.z}; }

// Boxes given in world coordinates.
struct NoRecords {
  static constexpr bool kHasLow = false;
  static HWY_INLINE PositionLanes load(const Batch&, const LaneIndices&) {
    const F zero = splat(0);
    return {splat3(0), splat3(0), splat3(0), splat3(0), splat3(0), zero, zero};
  }
};

// Body indices[i] of one side.
template <class T>
struct RecordSource {
  const BatchSide& side;
  const uint32_t* indices;

  HWY_INLINE const T* record(size_t i) const {
    return reinterpret_cast<const T*>(static_cast<const char*>(side.records) +
                                      indices[i] * side.record_stride);
  }
};

struct Source32 : RecordSource<float> {
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::LoadU(Quad(), record(i)); }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return record(i)[c]; }
};

struct Records32 {
  static constexpr bool kHasLow = false;

  static HWY_INLINE PositionLanes load(const Batch& batch, const LaneIndices& indices) {
    const F4 a = transpose_records(Source32{{batch.a, indices.a}});
    const F4 b = transpose_records(Source32{{batch.b, indices.b}});
    return {xyz(b) - xyz(a), xyz(a), xyz(b), splat3(0), splat3(0), a.w, b.w};
  }
};

// float64 records, rounded to float32.
struct HighSource : RecordSource<double> {
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const {
    const DoublePair pair;
    return demote_quad(hn::LoadU(pair, record(i)), hn::LoadU(pair, record(i) + 2));
  }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return static_cast<float>(record(i)[c]); }
};

// What that rounding left.
struct LowSource : RecordSource<double> {
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const {
    return demote_quad(low(record(i)), low(record(i) + 2));
  }
  static HWY_INLINE hn::Vec<DoublePair> low(const double* p) {
    const hn::Rebind<float, DoublePair> narrow;
    const auto v = hn::LoadU(DoublePair(), p);
    return hn::Sub(v, hn::PromoteTo(DoublePair(), hn::DemoteTo(narrow, v)));
  }
#endif
  HWY_INLINE float component(size_t i, size_t c) const {
    const double v = record(i)[c];
    return static_cast<float>(v - static_cast<double>(static_cast<float>(v)));
  }
};

// b - a in float64, then rounded to float32.
struct RelativeSource {
  RecordSource<double> a, b;

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

  static HWY_INLINE PositionLanes load(const Batch& batch, const LaneIndices& indices) {
    const RecordSource<double> source_a{batch.a, indices.a};
    const RecordSource<double> source_b{batch.b, indices.b};
    const F4 a = transpose_records(HighSource{source_a});
    const F4 b = transpose_records(HighSource{source_b});
    const F4 a_low = transpose_records(LowSource{source_a});
    const F4 b_low = transpose_records(LowSource{source_b});
    const F4 relative = transpose_records(RelativeSource{source_a, source_b});
    return {xyz(relative), xyz(a), xyz(b), xyz(a_low), xyz(b_low), a.w, b.w};
  }
};

// Shapes as kernels see them. `is_plainly_valid` may miss a valid lane, never an invalid one.
struct SphereLanes {
  static constexpr ShapeKind kKind = ShapeKind::sphere;
  F radius;

  static HWY_INLINE SphereLanes load(const BatchSide&, const uint32_t*, F radius) {
    return {radius};
  }
  HWY_INLINE Mask is_plainly_valid() const {
    return hn::And(hn::Ge(radius, splat(0)), hn::Le(radius, splat(FLT_MAX)));
  }
  HWY_INLINE void clear_unless(Mask keep) { radius = hn::IfThenElseZero(keep, radius); }
};

struct BoxLanes {
  static constexpr ShapeKind kKind = ShapeKind::aabb;
  F3 lower, upper;

  static HWY_INLINE F load_column(const float* column, size_t stride, const uint32_t* slots) {
    const char* base = reinterpret_cast<const char*>(column);
    return lanes_from([&](size_t i) HWY_ATTR {
      return *reinterpret_cast<const float*>(base + slots[i] * stride);
    });
  }

  static HWY_INLINE BoxLanes load(const BatchSide& side, const uint32_t* indices, F) {
    uint32_t slots[kLanes];
    for (size_t i = 0; i < kLanes; ++i) {
      slots[i] = side.box_slot ? side.box_slot[indices[i]] : indices[i];
    }
    const AabbColumns& boxes = side.boxes;
    return {{load_column(boxes.lower[0], boxes.stride, slots),
             load_column(boxes.lower[1], boxes.stride, slots),
             load_column(boxes.lower[2], boxes.stride, slots)},
            {load_column(boxes.upper[0], boxes.stride, slots),
             load_column(boxes.upper[1], boxes.stride, slots),
             load_column(boxes.upper[2], boxes.stride, slots)}};
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

  HWY_INLINE Mask is_plainly_valid() const {
    const F3 extent = upper - lower;  // NaN if any corner is, infinite if one is
    const Mask ordered = hn::And(hn::And(hn::Ge(extent.x, splat(0)), hn::Ge(extent.y, splat(0))),
                                 hn::Ge(extent.z, splat(0)));
    const F sum = hn::Add(hn::Add(extent.x, extent.y), extent.z);
    return hn::And(ordered, hn::Le(sum, splat(FLT_MAX)));
  }
  HWY_INLINE void clear_unless(Mask keep) {
    lower = zero_unless(keep, lower);
    upper = zero_unless(keep, upper);
  }
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_LOAD_INL_H_
