// Loads of a batch: bodies by index -> lanes.
#if defined(CAROM_NARROWPHASE_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_LOAD_INL_H_
#undef CAROM_NARROWPHASE_LOAD_INL_H_
#else
#define CAROM_NARROWPHASE_LOAD_INL_H_
#endif

#include <type_traits>

#include "narrowphase/batch.h"
#include "simd/gather-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

enum class Role { a, b };

// Where the bodies of kLanes pairs are: by a list of pairs, or row after row.
struct Listed {
  const Pair* pairs;

  template <Role kRole>
  HWY_INLINE size_t body(size_t i) const {
    return kRole == Role::a ? pairs[i].a : pairs[i].b;
  }
};

// Records and columns are dense: every address is a constant away from the first.
struct DenseRows {
  size_t row;

  template <Role>
  HWY_INLINE size_t body(size_t i) const {
    return row + i;
  }
};

// Positions of the pairs in the lanes: b - a, subtracted in the type of the positions so that the
// distance from the origin costs no accuracy, and each side's own position as high + low.
struct PositionLanes {
  F3 relative;
  F3 a, b;
  F3 a_low, b_low;       // float64 only: what rounding to float32 left
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

// float64 records, rounded to float32.
template <Role kRole, class Bodies>
struct HighSource : RecordSource<double, kRole, Bodies> {
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
template <Role kRole, class Bodies>
struct LowSource : RecordSource<double, kRole, Bodies> {
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
template <class Bodies>
struct RelativeSource {
  RecordSource<double, Role::a, Bodies> a;
  RecordSource<double, Role::b, Bodies> b;

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

// Boxes given in world coordinates.
struct NoRecords {
  static constexpr bool kHasLow = false;
  static constexpr size_t kDenseStride = 0;

  template <class Bodies>
  static HWY_INLINE void load(const Batch&, const Bodies&, PositionLanes& out) {
    out.relative = out.a = out.b = splat3(0);
  }
};

struct Records32 {
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
  static constexpr bool kHasLow = true;
  static constexpr size_t kDenseStride = 4 * sizeof(double);

  template <class Bodies>
  static HWY_INLINE void load(const Batch& batch, const Bodies& bodies, PositionLanes& out) {
    const RecordSource<double, Role::a, Bodies> a{batch.a, bodies};
    const RecordSource<double, Role::b, Bodies> b{batch.b, bodies};
    F unused;
    transpose_records(HighSource<Role::a, Bodies>{a}, out.a, out.radius_a);
    transpose_records(HighSource<Role::b, Bodies>{b}, out.b, out.radius_b);
    transpose_records(LowSource<Role::a, Bodies>{a}, out.a_low, unused);
    transpose_records(LowSource<Role::b, Bodies>{b}, out.b_low, unused);
    transpose_records(RelativeSource<Bodies>{a, b}, out.relative, unused);
  }
};

// Shapes as kernels see them. A lane is plainly valid if is_ordered() and size() is finite; it may
// be valid without, if its size overflows.
struct SphereLanes {
  static constexpr ShapeKind kKind = ShapeKind::sphere;
  F radius;

  static bool is_dense(const BatchSide&) { return true; }

  template <Role kRole, class Bodies>
  static HWY_INLINE SphereLanes load(const BatchSide&, const Bodies&, const PositionLanes& p) {
    return {kRole == Role::a ? p.radius_a : p.radius_b};
  }
  HWY_INLINE Mask is_ordered() const { return hn::Ge(radius, splat(0)); }
  HWY_INLINE F size() const { return radius; }
  HWY_INLINE void clear_unless(Mask keep) { radius = hn::IfThenElseZero(keep, radius); }
};

struct BoxLanes {
  static constexpr ShapeKind kKind = ShapeKind::aabb;
  F3 lower, upper;

  static bool is_dense(const BatchSide& side) {
    return !side.box_slot && side.boxes.stride == sizeof(float);
  }

  template <Role kRole>
  static HWY_INLINE BoxLanes load(const BatchSide& side, const Listed& bodies,
                                  const PositionLanes&) {
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
    return {{column(boxes.lower[0]), column(boxes.lower[1]), column(boxes.lower[2])},
            {column(boxes.upper[0]), column(boxes.upper[1]), column(boxes.upper[2])}};
  }

  template <Role>
  static HWY_INLINE BoxLanes load(const BatchSide& side, const DenseRows& rows,
                                  const PositionLanes&) {
    const FloatTag tag;
    const AabbColumns& boxes = side.boxes;
    const size_t row = rows.row;
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
