// Loads the bodies of a batch, by index, into lanes.
#if defined(CAROM_NARROWPHASE_BATCH_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_LOAD_INL_H_
#undef CAROM_NARROWPHASE_BATCH_LOAD_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_LOAD_INL_H_
#endif

#include <type_traits>

#include "base/tolerances.h"
#include "narrowphase/batch/batch.h"
#include "simd/gather-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

enum class Role { a, b };

// The bodies of kLanes pairs: given by a list of pairs, or (DenseRows) body row + i on both sides.
struct Listed {
  const Pair* pairs;

  template <Role kRole>
  HWY_INLINE size_t body(size_t i) const {
    return kRole == Role::a ? pairs[i].a : pairs[i].b;
  }
};

// Records and columns are dense, so every address is a constant away from the first.
struct DenseRows {
  size_t row;

  template <Role>
  HWY_INLINE size_t body(size_t i) const {
    return row + i;
  }
};

// Positions of the pairs, in world axes: b - a, subtracted in the type of the positions so that the
// distance from the origin costs no accuracy, and the position of each side as high + low.
struct PositionLanes {
  F3 relative;
  F3 a, b;
  F3 a_low, b_low;       // float64 only: the remainder of rounding to float32
  F radius_a, radius_b;  // of spheres; otherwise any finite value
};

// The records of one side.
template <class T, Role kRole, class Bodies>
struct RecordSource {
  const BatchSide& side;
  const Bodies& bodies;

  HWY_INLINE const T* record(size_t i) const {
    constexpr size_t kDenseStride = 4 * sizeof(T);
    const size_t stride = std::is_same_v<Bodies, DenseRows> ? kDenseStride : side.record_stride;
    return reinterpret_cast<const T*>(static_cast<const char*>(side.records) +
                                      bodies.template body<kRole>(i) * stride);
  }
};

template <Role kRole, class Bodies>
struct Source32 : RecordSource<float, kRole, Bodies> {
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::LoadU(Quad(), this->record(i)); }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return this->record(i)[c]; }
};

// float64 records of one side, in lanes of doubles: of the first half of the rows and of the
// second.
struct RecordsOfDoubles {
  D3 xyz[2];
  D w[2];
};

#if HWY_TARGET != HWY_SCALAR

using HalfFloatTag = hn::Half<FloatTag>;

HWY_INLINE F rounded(D first, D second) {
  const HalfFloatTag half;
  return hn::Combine(FloatTag(), hn::DemoteTo(half, second), hn::DemoteTo(half, first));
}
// Yields the remainder of the rounding.
HWY_INLINE D beyond_float(D v) {
  return hn::Sub(v, hn::PromoteTo(DoubleTag(), hn::DemoteTo(HalfFloatTag(), v)));
}

#else

HWY_INLINE F rounded(D first, D) { return splat(static_cast<float>(hn::GetLane(first))); }
HWY_INLINE D beyond_float(D v) {
  return splat_double(hn::GetLane(v) - static_cast<double>(static_cast<float>(hn::GetLane(v))));
}

#endif

template <class Source>
HWY_INLINE void transpose_doubles(const Source& source, RecordsOfDoubles& out) {
  transpose_doubles(source, 0, out.xyz[0], out.w[0]);
  transpose_doubles(source, kLanes == 1 ? 0 : kDoubleLanes, out.xyz[1], out.w[1]);
}
HWY_INLINE F3 rounded(const D3& first, const D3& second) {
  return {rounded(first.x, second.x), rounded(first.y, second.y), rounded(first.z, second.z)};
}
HWY_INLINE D3 beyond_float(const D3& v) {
  return {beyond_float(v.x), beyond_float(v.y), beyond_float(v.z)};
}

// No positions: both sides are boxes in world coordinates.
struct NoRecords {
  static constexpr bool kHasDenseLoop = true;
  static constexpr bool kHasLow = false;
  static constexpr size_t kDenseStride = 0;

  template <class Bodies>
  static HWY_INLINE void load(const Batch&, const Bodies&, PositionLanes& out) {
    out.relative = out.a = out.b = splat3(0);
  }
};

struct Records32 {
  static constexpr bool kHasDenseLoop = true;
  static constexpr bool kHasLow = false;
  static constexpr size_t kDenseStride = 4 * sizeof(float);

  template <class Bodies>
  static HWY_INLINE void load(const Batch& batch, const Bodies& bodies, PositionLanes& out) {
    transpose_records(Source32<Role::a, Bodies>{{batch.a, bodies}}, out.a, out.radius_a);
    transpose_records(Source32<Role::b, Bodies>{{batch.b, bodies}}, out.b, out.radius_b);
    out.relative = out.b - out.a;
  }
};

struct Records64 {
  static constexpr bool kHasDenseLoop = true;
  static constexpr bool kHasLow = true;
  static constexpr size_t kDenseStride = 4 * sizeof(double);

  template <class Bodies>
  static HWY_INLINE void load(const Batch& batch, const Bodies& bodies, PositionLanes& out) {
    RecordsOfDoubles a, b;
    transpose_doubles(RecordSource<double, Role::a, Bodies>{batch.a, bodies}, a);
    transpose_doubles(RecordSource<double, Role::b, Bodies>{batch.b, bodies}, b);
    out.a = rounded(a.xyz[0], a.xyz[1]);
    out.b = rounded(b.xyz[0], b.xyz[1]);
    out.radius_a = rounded(a.w[0], a.w[1]);
    out.radius_b = rounded(b.w[0], b.w[1]);
    out.a_low = rounded(beyond_float(a.xyz[0]), beyond_float(a.xyz[1]));
    out.b_low = rounded(beyond_float(b.xyz[0]), beyond_float(b.xyz[1]));
    out.relative = rounded(b.xyz[0] - a.xyz[0], b.xyz[1] - a.xyz[1]);
  }
};

// Float32 or float64, as the batch says.
struct AnyRecords {
  static constexpr bool kHasDenseLoop = false;
  static constexpr bool kHasLow = true;

  template <class Bodies>
  static HWY_INLINE void load(const Batch& batch, const Bodies& bodies, PositionLanes& out) {
    if (batch.layout == PositionLayout::records64) {
      Records64::load(batch, bodies, out);
    } else {
      Records32::load(batch, bodies, out);
      out.a_low = out.b_low = splat3(-0.0f);  // adding -0 changes no number, not even +0
    }
  }
};

struct AnyRecordsOrNone {
  template <class Bodies>
  static HWY_INLINE void load(const Batch& batch, const Bodies& bodies, PositionLanes& out) {
    if (batch.layout == PositionLayout::none) {
      NoRecords::load(batch, bodies, out);
      out.a_low = out.b_low = splat3(-0.0f);
    } else {
      AnyRecords::load(batch, bodies, out);
    }
  }
};

// Row k of the parameters of each shape, which has `kRows` rows.
template <Role kRole, uint32_t kRows, class Bodies>
struct RowSource {
  const BatchSide& side;
  const Bodies& bodies;
  size_t k;

  HWY_INLINE const float* row(size_t i) const {
    const size_t body = bodies.template body<kRole>(i);
    const size_t first = side.rows.first ? side.rows.first[body] : body * kRows;
    return side.rows.data + 4 * (first + k);
  }
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::LoadU(Quad(), row(i)); }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return row(i)[c]; }
};

template <Role kRole, uint32_t kRows, class Bodies>
HWY_INLINE void load_row(const BatchSide& side, const Bodies& bodies, size_t k, F3& xyz, F& w) {
  transpose_records(RowSource<kRole, kRows, Bodies>{side, bodies, k}, xyz, w);
}

template <Role kRole, class Bodies>
struct OrientationSource {
  const BatchSide& side;
  const Bodies& bodies;

  HWY_INLINE const float* quaternion(size_t i) const {
    const size_t offset = bodies.template body<kRole>(i) * side.orientation.stride;
    return reinterpret_cast<const float*>(reinterpret_cast<const char*>(side.orientation.data) +
                                          offset);
  }
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::LoadU(Quad(), quaternion(i)); }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return quaternion(i)[c]; }
};

template <Role kRole, class Bodies>
HWY_INLINE void load_orientation(const BatchSide& side, const Bodies& bodies, Quaternion& q) {
  transpose_records(OrientationSource<kRole, Bodies>{side, bodies}, q.v, q.w);
}

HWY_INLINE Mask is_plain(const Quaternion& q) {
  const F norm = squared_norm(q);
  return hn::And(hn::Ge(norm, splat(kLeastSquaredNorm)), hn::Le(norm, splat(kGreatestSquaredNorm)));
}

// Scales only the lanes that are not plain: in others, subnormal components would lose bits.
HWY_INLINE void make_plain(Quaternion& q) {
  F up, down;
  power_of_two(max(largest_component(q.v), hn::Abs(q.w)), up, down);
  const F scale = hn::IfThenElse(is_plain(q), splat(1), down);
  q.v = q.v * scale;
  q.w = hn::Mul(q.w, scale);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_LOAD_INL_H_
