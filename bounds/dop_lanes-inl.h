// k-DOPs of boxes and capsules in float32, one body a lane. Bodies that are not valid, or whose
// numbers are far from one, are left to the caller.
#if defined(CAROM_BOUNDS_DOP_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_BOUNDS_DOP_LANES_INL_H_
#undef CAROM_BOUNDS_DOP_LANES_INL_H_
#else
#define CAROM_BOUNDS_DOP_LANES_INL_H_
#endif

#include <cstring>

#include "base/tolerances.h"
#include "bounds/dop_directions.h"
#include "shapes/body_reader.h"
#include "simd/gather-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {  // the narrow phase has types of the same names

// Points to four floats of each body.
struct RowLanes {
  const float* row[kLanes];

#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::LoadU(Quad(), row[i]); }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return row[i][c]; }

  template <class Find>
  HWY_INLINE explicit RowLanes(const Find& find) {
    for (size_t i = 0; i < kLanes; ++i) row[i] = find(i);
  }
};

HWY_INLINE void load_shape_rows(const BodyReader& reader, const uint32_t* bodies, size_t k, F3& xyz,
                                F& w) {
  const float* rows = reader.bodies.rows.data;
  transpose_records(
      RowLanes([&](size_t i) { return rows + 4 * (reader.first_row(bodies[i]) + k); }), xyz, w);
}

HWY_INLINE Quaternion load_quaternions(const BodyReader& reader, const uint32_t* bodies) {
  const OrientationView& view = reader.bodies.orientation;
  if (!view.data) return {splat3(0), splat(1)};
  const auto* base = reinterpret_cast<const char*>(view.data);
  Quaternion q;
  transpose_records(RowLanes([&](size_t i) {
                      return reinterpret_cast<const float*>(base + bodies[i] * view.stride);
                    }),
                    q.v, q.w);
  return q;
}

HWY_INLINE F3 load_positions(const BodyReader& reader, const uint32_t* bodies) {
  HWY_ALIGN float x[kLanes], y[kLanes], z[kLanes];
  for (size_t i = 0; i < kLanes; ++i) {
    const auto p = reader.position<double>(bodies[i]);
    x[i] = static_cast<float>(p.x);
    y[i] = static_cast<float>(p.y);
    z[i] = static_cast<float>(p.z);
  }
  const FloatTag tag;
  return {hn::Load(tag, x), hn::Load(tag, y), hn::Load(tag, z)};
}

// The 1-norm. NaN if a coordinate is NaN.
HWY_INLINE F sum_of_sizes(const F3& v) {
  return hn::Add(hn::Add(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}

// Both are false for NaN.
HWY_INLINE Mask is_between(F v, float low, float high) {
  return hn::And(hn::Ge(v, splat(low)), hn::Le(v, splat(high)));
}
HWY_INLINE Mask is_finite_lane(F v) { return hn::Le(hn::Abs(v), splat(FLT_MAX)); }

// One slab in every lane: its direction, and the length of that direction.
struct SlabLanes {
  F x, y, z, length;

  HWY_INLINE SlabLanes(const SlabColumns& all, size_t s)
      : x(splat(static_cast<float>(all.x[s]))),
        y(splat(static_cast<float>(all.y[s]))),
        z(splat(static_cast<float>(all.z[s]))),
        length(splat(static_cast<float>(all.length[s]))) {}

  HWY_INLINE F project(const F3& v) const {
    return hn::Add(hn::Add(hn::Mul(x, v.x), hn::Mul(y, v.y)), hn::Mul(z, v.z));
  }
  HWY_INLINE F reach(const F3& v) const { return hn::Abs(project(v)); }
};

// A shape in lanes has these members:
//   Mask load(reader, bodies, q)   loads bodies with quaternions q; which of them are valid
//   F size                         1-norm of its coordinates
//   F middle(slab), F reach(slab)  middle and half length of its projection, with position zero
struct BoxLanes {
  F size;
  F3 x, y, z;  // half edges

  HWY_INLINE Mask load(const BodyReader& reader, const uint32_t* bodies, const Quaternion& q) {
    F3 half;
    F unused;
    load_shape_rows(reader, bodies, 0, half, unused);
    size = sum_of_sizes(half);
    const Rotation turn = rotation_of(q);
    x = turn.x * half.x;
    y = turn.y * half.y;
    z = turn.z * half.z;
    return hn::And(is_finite_lane(unused), hn::Ge(min(min(half.x, half.y), half.z), splat(0)));
  }

  HWY_INLINE F middle(const SlabLanes&) const { return splat(0); }
  HWY_INLINE F reach(const SlabLanes& slab) const {
    return hn::Add(hn::Add(slab.reach(x), slab.reach(y)), slab.reach(z));
  }
};

struct CapsuleLanes {
  F size, radius;
  F3 center, half;

  HWY_INLINE Mask load(const BodyReader& reader, const uint32_t* bodies, const Quaternion& q) {
    F3 a, b;
    F unused;
    load_shape_rows(reader, bodies, 0, a, radius);
    load_shape_rows(reader, bodies, 1, b, unused);
    size = hn::Add(hn::Add(sum_of_sizes(a), sum_of_sizes(b)), radius);
    const Rotation turn = rotation_of(q);
    center = rotate(turn, (a + b) * splat(0.5f));
    half = rotate(turn, (b - a) * splat(0.5f));
    return hn::And(is_finite_lane(unused), hn::Ge(radius, splat(0)));
  }

  HWY_INLINE F middle(const SlabLanes& slab) const { return slab.project(center); }
  HWY_INLINE F reach(const SlabLanes& slab) const {
    return hn::Add(slab.reach(half), hn::Mul(radius, slab.length));
  }
};

// The records of one body a lane: the first four floats of all, then the next four, ...
struct RecordLanes {
  HWY_ALIGN float plain[kLanes];  // not zero if the body's record was found
  HWY_ALIGN float fours[kMostRecordSize / 4][4 * kLanes];

  void copy(size_t i, size_t size, float* record) const {
    for (size_t k = 0; k < size; k += 4) {
      std::memcpy(record + k, fours[k / 4] + 4 * i, 4 * sizeof(float));
    }
  }
};

template <class ShapeLanes>
HWY_INLINE void find_records(const BodyReader& reader, const uint32_t* bodies,
                             const SlabColumns& directions, RecordLanes& out) {
  const FloatTag tag;
  const F3 position = load_positions(reader, bodies);
  const Quaternion q = load_quaternions(reader, bodies);
  ShapeLanes shape;
  const Mask is_shape = shape.load(reader, bodies, q);
  const F distance = sum_of_sizes(position);
  const Mask is_turn = is_between(squared_norm(q), kLeastSquaredNorm, kGreatestSquaredNorm);
  const Mask is_plain = hn::And(is_between(shape.size, kLeastPlain, kGreatestPlain),
                                hn::Le(distance, splat(kGreatestPlain)));
  const Mask plain = hn::And(hn::And(is_shape, is_turn), is_plain);
  hn::Store(hn::IfThenElseZero(plain, splat(1)), tag, out.plain);
  const F slack = hn::Add(hn::Mul(shape.size, splat(kLaneSizeRounding)),
                          hn::Mul(distance, splat(kLanePositionRounding)));
  for (size_t s = 0; s < directions.count; s += 4) {
    F lower[4], upper[4];
    for (size_t k = 0; k < 4; ++k) {
      const SlabLanes slab(directions, s + k);
      const F middle = hn::Add(slab.project(position), shape.middle(slab));
      const F reach = hn::Add(shape.reach(slab), slack);
      lower[k] = hn::Sub(middle, reach);
      upper[k] = hn::Add(middle, reach);
    }
    hn::StoreInterleaved4(lower[0], lower[1], lower[2], lower[3], tag, out.fours[s / 2]);
    hn::StoreInterleaved4(upper[0], upper[1], upper[2], upper[3], tag, out.fours[s / 2 + 1]);
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_BOUNDS_DOP_LANES_INL_H_
