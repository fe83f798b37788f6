// Loads the bodies of a view into lanes: positions and fourth components (`w`, a sphere's radius)
// from one source, extents relative to the position from another.
#if defined(CAROM_BOUNDS_BOUNDS_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_BOUNDS_BOUNDS_LOAD_INL_H_
#undef CAROM_BOUNDS_BOUNDS_LOAD_INL_H_
#else
#define CAROM_BOUNDS_BOUNDS_LOAD_INL_H_
#endif

#include <type_traits>

#include "bounds/bounds_sums-inl.h"
#include "bounds/extent.h"
#include "bounds/turned_extents-inl.h"
#include "shapes/body_reader.h"
#include "simd/gather-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// --- Positions: load(i, position, w) loads bodies i, i + 1, ... ---

// For boxes in world coordinates.
struct NoPositions {
  struct Position {
    Origin x, y, z;
  };

  HWY_INLINE void load(size_t, Position&, F& w) const { w = splat(0); }
};

struct ConsecutiveRecords {
  const char* base;
  size_t stride;

  HWY_INLINE const float* record(size_t i) const {
    return reinterpret_cast<const float*>(base + i * stride);
  }
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::LoadU(Quad(), record(i)); }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return record(i)[c]; }
};

// Records of x, y, z, w in float32.
struct FloatRecords {
  using Position = F3;

  const char* base;
  size_t stride;

  explicit FloatRecords(const PositionView& view)
      : base(static_cast<const char*>(view.data)), stride(view.stride) {}

  HWY_INLINE void load(size_t i, F3& position, F& w) const {
    transpose_records(ConsecutiveRecords{base + i * stride, stride}, position, w);
  }
};

// Records of x, y, z, w in float64.
struct DoubleRecords {
  using Position = Wide3;

  const char* base;
  size_t stride;

  explicit DoubleRecords(const PositionView& view)
      : base(static_cast<const char*>(view.data)), stride(view.stride) {}

  HWY_INLINE const double* record(size_t i) const {
    return reinterpret_cast<const double*>(base + i * stride);
  }

  HWY_INLINE void load(size_t i, Wide3& position, F& w) const {
    D3 low;
    D low_w;
    transpose_doubles(*this, i, low, low_w);
#if HWY_TARGET == HWY_SCALAR
    position = {{low.x}, {low.y}, {low.z}};
    w = demote(low_w);
#else
    D3 high;
    D high_w;
    transpose_doubles(*this, i + kLanes / 2, high, high_w);
    position = {{low.x, high.x}, {low.y, high.y}, {low.z, high.z}};
    w = demote(Wide{low_w, high_w});
#endif
  }
};

// AnyPositions reads any other layout body by body. T is float or double.
HWY_INLINE F load_scalars(const float* values) { return hn::Load(FloatTag(), values); }
HWY_INLINE Wide load_scalars(const double* values) { return load_wide(values); }

template <class T>
struct AnyPositions {
  using Position = std::conditional_t<std::is_same_v<T, float>, F3, Wide3>;

  const BodyReader& reader;

  HWY_INLINE void load(size_t first, Position& position, F& w) const {
    HWY_ALIGN T x[kLanes], y[kLanes], z[kLanes];
    for (size_t i = 0; i < kLanes; ++i) {
      const auto p = reader.position<T>(first + i);
      x[i] = p.x;
      y[i] = p.y;
      z[i] = p.z;
    }
    position = {load_scalars(x), load_scalars(y), load_scalars(z)};
    w = lanes_from([&](size_t i) HWY_ATTR {
      const bool is_sphere = reader.kind(first + i) == ShapeKind::sphere;
      return is_sphere ? reader.radius(first + i) : 0;
    });
  }
};

// --- Extents: load(i, w, lower, upper), relative to the positions ---

struct SphereExtents {
  HWY_INLINE void load(size_t, F radius, F3& lower, F3& upper) const {
    const F negative = hn::Neg(radius);
    lower = {negative, negative, negative};
    upper = {radius, radius, radius};
  }
};

struct BoxExtents {
  AabbColumns boxes;
  const uint32_t* slot;

  explicit BoxExtents(const Collidables& bodies) : boxes(bodies.boxes), slot(bodies.box_slot) {}

  HWY_INLINE size_t row(size_t i) const { return slot ? slot[i] : i; }

  // One corner of the boxes of bodies i, i + 1, ... in records.
  struct Corner {
    const BoxExtents& boxes;
    const float* first;
    size_t i;

    HWY_INLINE const float* numbers(size_t k) const { return first + 8 * boxes.row(i + k); }
#if HWY_TARGET != HWY_SCALAR
    HWY_INLINE hn::Vec<Quad> quad(size_t k) const { return hn::LoadU(Quad(), numbers(k)); }
#endif
    HWY_INLINE float component(size_t k, size_t c) const { return numbers(k)[c]; }
  };

  HWY_INLINE void load(size_t i, F, F3& lower, F3& upper) const {
    if (boxes.are_records) {
      F unused;
      transpose_records(Corner{*this, boxes.lower[0], i}, lower, unused);
      transpose_records(Corner{*this, boxes.upper[0], i}, upper, unused);
      return;
    }
    if (are_consecutive(i)) {
      load_rows(row(i), lower, upper);
      return;
    }
    size_t rows[kLanes];
    for (size_t k = 0; k < kLanes; ++k) rows[k] = row(i + k);
    gather_rows(rows, lower, upper);
  }

  // Whether the boxes lie in the order of their bodies, as they do if nothing was ever removed.
  HWY_INLINE bool are_consecutive(size_t i) const {
    if (boxes.stride != sizeof(float)) return false;
    if (!slot) return true;
    const hn::RebindToUnsigned<FloatTag> integers;
    const auto expected = hn::Add(hn::Set(integers, slot[i]), hn::Iota(integers, 0));
    return hn::AllTrue(integers, hn::Eq(hn::LoadU(integers, slot + i), expected));
  }

  HWY_INLINE void load_rows(size_t first, F3& lower, F3& upper) const {
    const FloatTag tag;
    lower = {hn::LoadU(tag, boxes.lower[0] + first), hn::LoadU(tag, boxes.lower[1] + first),
             hn::LoadU(tag, boxes.lower[2] + first)};
    upper = {hn::LoadU(tag, boxes.upper[0] + first), hn::LoadU(tag, boxes.upper[1] + first),
             hn::LoadU(tag, boxes.upper[2] + first)};
  }

  HWY_INLINE void gather_rows(const size_t* rows, F3& lower, F3& upper) const {
    const auto column = [&](const float* first) HWY_ATTR {
      return lanes_from([&](size_t k)
                            HWY_ATTR { return load_strided<float>(first, boxes.stride, rows[k]); });
    };
    lower = {column(boxes.lower[0]), column(boxes.lower[1]), column(boxes.lower[2])};
    upper = {column(boxes.upper[0]), column(boxes.upper[1]), column(boxes.upper[2])};
  }
};

// Reads bodies first, first + 1, ... one at a time.
inline void load_singly(const BodyReader& reader, size_t first, F3& lower, F3& upper) {
  HWY_ALIGN float corners[6][kLanes];
  for (size_t i = 0; i < kLanes; ++i) {
    const Extent extent = extent_of(reader, first + i);
    for (size_t axis = 0; axis < 3; ++axis) {
      corners[axis][i] = extent.lower[axis];
      corners[3 + axis][i] = extent.upper[axis];
    }
  }
  lower = {load_scalars(corners[0]), load_scalars(corners[1]), load_scalars(corners[2])};
  upper = {load_scalars(corners[3]), load_scalars(corners[4]), load_scalars(corners[5])};
}

// The orientations of bodies i, i + 1, ...
HWY_INLINE Quaternion load_orientations(const Collidables& bodies, size_t i) {
  Quaternion q = {splat3(0), splat(1)};
  if (bodies.orientation.data) {
    const char* first = reinterpret_cast<const char*>(bodies.orientation.data);
    const size_t stride = bodies.orientation.stride;
    transpose_records(ConsecutiveRecords{first + i * stride, stride}, q.v, q.w);
  }
  return q;
}

// Boxes alone, or capsules alone.
template <class Shape>
struct TurnedExtents {
  const BodyReader& reader;

  // Row k of the shapes of bodies i, i + 1, ...
  struct Rows {
    const ShapeRows& rows;
    size_t i, k;

    HWY_INLINE const float* numbers(size_t lane) const {
      const size_t body = i + lane;
      const size_t first = rows.first ? rows.first[body] : body * row_count(Shape::kKind);
      return rows.data + 4 * (first + k);
    }
#if HWY_TARGET != HWY_SCALAR
    HWY_INLINE hn::Vec<Quad> quad(size_t lane) const { return hn::LoadU(Quad(), numbers(lane)); }
#endif
    HWY_INLINE float component(size_t lane, size_t c) const { return numbers(lane)[c]; }
  };

  HWY_INLINE void load(size_t i, F, F3& lower, F3& upper) const {
    const Collidables& bodies = reader.bodies;
    const Shape shape([&](size_t k) HWY_ATTR { return Rows{bodies.rows, i, k}; });
    const Quaternion q = load_orientations(bodies, i);
    if (!turned_extents(shape, q, lower, upper)) load_singly(reader, i, lower, upper);
  }
};

// Bodies of any kinds, mixed.
struct MixedExtents {
  const BodyReader& reader;
  BoxExtents boxes;

  explicit MixedExtents(const BodyReader& bodies) : reader(bodies), boxes(bodies.bodies) {}

  HWY_INLINE void load(size_t first, F radius, F3& lower, F3& upper) const {
    size_t spheres = 0;
    size_t aabbs = 0;
    for (size_t i = 0; i < kLanes; ++i) {
      spheres += reader.kind(first + i) == ShapeKind::sphere;
      aabbs += reader.kind(first + i) == ShapeKind::aabb;
    }
    if (spheres == kLanes) return SphereExtents().load(first, radius, lower, upper);
    if (aabbs == kLanes) return boxes.load(first, radius, lower, upper);
    load_singly(reader, first, lower, upper);
  }
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_BOUNDS_BOUNDS_LOAD_INL_H_
