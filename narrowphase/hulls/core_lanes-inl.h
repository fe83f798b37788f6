// Shapes as cores in lanes. A core is the convex hull of points, grown by a radius. Each lane holds
// one core, in world axes, relative to the position of A.
#if defined(CAROM_NARROWPHASE_HULLS_CORE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_CORE_LANES_INL_H_
#undef CAROM_NARROWPHASE_HULLS_CORE_LANES_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_CORE_LANES_INL_H_
#endif

#include <algorithm>
#include <array>

#include "base/tolerances.h"
#include "narrowphase/batch/shape_lanes-inl.h"
#include "shapes/dop_solid.h"
#include "simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// All lanes have room for the same number of points; a core with fewer repeats its last point.
class CoreLanes {
 public:
  F radius;
  F3 middle;       // any point inside; the search starts there
  Mask has_space;  // the points fit, and the triangle is a plain one

  // All lanes have `count` points.
  HWY_INLINE void begin(size_t count) { begin(count, count, splat(static_cast<float>(count))); }
  // `each`: the number of points of each lane, from `least` to `count`, or more if they do not fit.
  HWY_INLINE void begin(size_t count, size_t least, F each) {
    count_ = count;
    least_ = least;
    each_ = each;
    has_space = hn::Le(each, splat(static_cast<float>(kMostLanePoints)));
    radius = splat(0);
  }
  HWY_INLINE void set(size_t i, const F3& p) {
    const FloatTag tag;
    hn::Store(p.x, tag, points_[i][0]);
    hn::Store(p.y, tag, points_[i][1]);
    hn::Store(p.z, tag, points_[i][2]);
  }

  size_t count() const { return count_; }
  size_t least() const { return least_; }  // no lane repeats points before this index
  HWY_INLINE Mask has(size_t i) const { return hn::Lt(splat(static_cast<float>(i)), each_); }
  HWY_INLINE F3 point(size_t i) const {
    const FloatTag tag;
    return {hn::Load(tag, points_[i][0]), hn::Load(tag, points_[i][1]),
            hn::Load(tag, points_[i][2])};
  }

 private:
  size_t count_, least_;
  F each_;
  HWY_ALIGN float points_[kMostLanePoints][3][kLanes];
};

HWY_INLINE void make_core(const SphereLanes& sphere, const Quaternion&, const F3& offset,
                          CoreLanes& core) {
  core.begin(1);
  core.set(0, offset);
  core.middle = offset;
  core.radius = sphere.radius;
}

HWY_INLINE void make_core(const CapsuleLanes& capsule, const Quaternion& q, const F3& offset,
                          CoreLanes& core) {
  const Rotation turn = rotation_of(q);
  const F3 a = rotate(turn, capsule.a) + offset, b = rotate(turn, capsule.b) + offset;
  core.begin(2);
  core.set(0, a);
  core.set(1, b);
  core.middle = (a + b) * splat(0.5f);
  core.radius = capsule.radius;
}

HWY_INLINE void make_core_of_box(const F3& lower, const F3& upper, const Rotation& turn,
                                 const F3& offset, CoreLanes& core) {
  core.begin(8);
  for (size_t i = 0; i < 8; ++i) {  // bit k of i: at the upper end of axis k
    core.set(i, rotate(turn, {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y,
                              i & 4 ? upper.z : lower.z}) +
                    offset);
  }
  core.middle = rotate(turn, (lower + upper) * splat(0.5f)) + offset;
}

HWY_INLINE void make_core(const AabbLanes& box, const Quaternion&, const F3& offset,
                          CoreLanes& core) {
  const F one = splat(1), zero = splat(0);
  make_core_of_box(box.lower, box.upper, {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}},
                   offset, core);
}

HWY_INLINE void make_core(const BoxLanes& box, const Quaternion& q, const F3& offset,
                          CoreLanes& core) {
  make_core_of_box(-box.half, box.half, rotation_of(q), offset, core);
}

HWY_INLINE void make_core(const TriangleLanes& triangle, const Quaternion& q, const F3& offset,
                          CoreLanes& core) {
  const Rotation turn = rotation_of(q);
  core.begin(3);
  core.set(0, rotate(turn, triangle.a) + offset);
  core.set(1, rotate(turn, triangle.b) + offset);
  core.set(2, rotate(turn, triangle.c) + offset);
  core.middle = core.point(0);
  core.has_space = hn::Not(triangle.is_special);
}

// Lanes without a hull read this: a point, and the middle.
inline constexpr std::array<float, 8> kNoRecords{};

// Reads the records of each lane's hull: its points, then its middle.
class HullRecords {
 public:
  explicit HWY_INLINE HullRecords(const HullLanes& hull) {
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const HullGeometry* const geometry = hull.geometry[lane];
      first_[lane] = geometry ? geometry->records()[0].data() : kNoRecords.data();
      points_[lane] = geometry ? geometry->records().size() - 1 : 1;
      most_ = std::max(most_, points_[lane]);
      least_ = std::min(least_, points_[lane]);
    }
  }

  // Calls use(i, p) for i < count. p is point i of each hull, or its last point.
  template <class Use>
  HWY_INLINE void for_each_point(size_t count, const Use& use) const {
    size_t i = 0;
    for (; i < std::min(least_, count); ++i) use(i, read([i](size_t) { return i; }));
    for (; i < count; ++i) {
      use(i, read([i, this](size_t lane) { return std::min(i, points_[lane] - 1); }));
    }
  }
  // Point `places[lane]` of each hull, or its last point.
  HWY_INLINE F3 points_at(const std::array<uint8_t, kLanes>& places) const {
    return read([&](size_t lane) { return std::min<size_t>(places[lane], points_[lane] - 1); });
  }
  HWY_INLINE F3 points_at(Indices places) const {
    const I last = hn::ConvertTo(IntTag(), hn::Sub(count_lanes(), splat(1)));
    HWY_ALIGN uint32_t at[kLanes];
    hn::Store(hn::Min(places, hn::BitCast(IndexTag(), last)), IndexTag(), at);
    return read([&](size_t lane) { return at[lane]; });
  }
  HWY_INLINE F3 middle() const {
    return read([this](size_t lane) { return points_[lane]; });
  }

  // Numbers of points, without the middle.
  size_t most() const { return most_; }
  size_t least() const { return least_; }
  HWY_INLINE F count_lanes() const {
    if (least_ == most_) return splat(static_cast<float>(most_));  // the usual case
    return lanes_from([&](size_t lane) { return static_cast<float>(points_[lane]); });
  }

 private:
  // Reads record place(lane) of each lane.
  template <class Place>
  struct Source {
    const HullRecords& hulls;
    const Place& place;

    HWY_INLINE const float* record(size_t lane) const {
      return hulls.first_[lane] + 4 * place(lane);
    }
#if HWY_TARGET != HWY_SCALAR
    HWY_INLINE hn::Vec<Quad> quad(size_t lane) const { return hn::LoadU(Quad(), record(lane)); }
#endif
    HWY_INLINE float component(size_t lane, size_t c) const { return record(lane)[c]; }
  };

  template <class Place>
  HWY_INLINE F3 read(const Place& place) const {
    F3 p;
    F unused;
    transpose_records(Source<Place>{*this, place}, p, unused);
    return p;
  }

  std::array<const float*, kLanes> first_;
  std::array<size_t, kLanes> points_;
  size_t most_ = 1;
  size_t least_ = kMostLanePoints;
};

// Reads the points of each lane's hull as columns, four at a time: of k-DOPs these lie with all
// that a search for depths reads.
class HullColumns {
 public:
  explicit HWY_INLINE HullColumns(const HullLanes& hull) {
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const HullGeometry* const geometry = hull.geometry[lane];
      for (size_t axis = 0; axis < 3; ++axis) {
        column_[axis][lane] = geometry ? geometry->column(axis) : kNoRecords.data();
      }
      middle_[lane] = middle_of(geometry);
      padded_[lane] = geometry ? geometry->column_stride() : kPointsAtOnce;
      points_[lane] = geometry ? geometry->points().size() : 1;
      most_ = std::max(most_, points_[lane]);
      least_ = std::min(least_, points_[lane]);
      least_padded_ = std::min(least_padded_, padded_[lane]);
    }
  }

  // Calls use(i, p) for i < count, and up to three times more. p is point i of each hull, or any
  // point of it behind the last one.
  template <class Use>
  HWY_INLINE void for_each_point(size_t count, const Use& use) const {
    size_t i = 0;
    for (; i < std::min(least_padded_, count); i += kPointsAtOnce) {
      use_points(
          i, [i](size_t) { return i; }, use);
    }
    for (; i < count; i += kPointsAtOnce) {
      use_points(
          i, [i, this](size_t lane) { return std::min(i, padded_[lane] - kPointsAtOnce); }, use);
    }
  }
  HWY_INLINE F3 middle() const {
    F3 p;
    F unused;
    const auto first = [](size_t) { return size_t{0}; };
    transpose_records(Source<decltype(first)>{middle_, first}, p, unused);
    return p;
  }

  // Numbers of points.
  size_t most() const { return most_; }
  size_t least() const { return least_; }
  HWY_INLINE F count_lanes() const {
    return lanes_from([&](size_t lane) { return static_cast<float>(points_[lane]); });
  }

 private:
  static constexpr size_t kPointsAtOnce = 4;

  static const float* middle_of(const HullGeometry* geometry) {
    if (!geometry) return kNoRecords.data();
    const DopSolid* const solid = geometry->dop_solid();
    return (solid ? solid->middle() : geometry->records().back()).data();
  }

  // Four entries of a column of each lane.
  template <class Place>
  struct Source {
    const std::array<const float*, kLanes>& column;
    const Place& place;

    HWY_INLINE const float* entries(size_t lane) const { return column[lane] + place(lane); }
#if HWY_TARGET != HWY_SCALAR
    HWY_INLINE hn::Vec<Quad> quad(size_t lane) const { return hn::LoadU(Quad(), entries(lane)); }
#endif
    HWY_INLINE float component(size_t lane, size_t c) const { return entries(lane)[c]; }
  };

  // Calls use(i + k, p) for point place(lane) + k of each hull, k < 4.
  template <class Place, class Use>
  HWY_INLINE void use_points(size_t i, const Place& place, const Use& use) const {
    F x[kPointsAtOnce], y[kPointsAtOnce], z[kPointsAtOnce];
    read_column(0, place, x);
    read_column(1, place, y);
    read_column(2, place, z);
    use(i, F3{x[0], y[0], z[0]});
    use(i + 1, F3{x[1], y[1], z[1]});
    use(i + 2, F3{x[2], y[2], z[2]});
    use(i + 3, F3{x[3], y[3], z[3]});
  }
  template <class Place>
  HWY_INLINE void read_column(size_t axis, const Place& place, F* values) const {
    F3 first;
    transpose_records(Source<Place>{column_[axis], place}, first, values[3]);
    values[0] = first.x;
    values[1] = first.y;
    values[2] = first.z;
  }

  std::array<std::array<const float*, kLanes>, 3> column_;
  std::array<const float*, kLanes> middle_;
  std::array<size_t, kLanes> padded_, points_;
  size_t most_ = 1;
  size_t least_ = kMostLanePoints;
  size_t least_padded_ = kMostLanePoints;
};

// A rotation that also scales. The scale is a power of two, so rounding is the same whichever
// factor takes it.
HWY_INLINE Rotation placing_turn(const HullLanes& hull, const Quaternion& q) {
  Rotation turn = rotation_of(q);
  for (F3* column : {&turn.x, &turn.y, &turn.z}) *column = *column * hull.scaling;
  return turn;
}

template <class Points>
HWY_INLINE void put_points(const Points& points, const Rotation& turn, const F3& offset,
                           CoreLanes& core) {
  const size_t count = std::min(points.most(), kMostLanePoints);
  core.begin(count, points.least(), points.count_lanes());
  points.for_each_point(
      count, [&](size_t i, const F3& p) HWY_ATTR { core.set(i, rotate(turn, p) + offset); });
  core.middle = rotate(turn, points.middle()) + offset;
}

inline HWY_NOINLINE void put_points_of_dops(const HullLanes& hull, const Rotation& turn,
                                            const F3& offset, CoreLanes& core) {
  put_points(HullColumns(hull), turn, offset, core);
}

HWY_INLINE void make_core(const HullLanes& hull, const Quaternion& q, const F3& offset,
                          CoreLanes& core) {
  const Rotation turn = placing_turn(hull, q);
  // The hulls of a batch are those of k-DOPs, or none is.
  if (HWY_UNLIKELY(hull.geometry[0] && hull.geometry[0]->dop_solid())) {
    put_points_of_dops(hull, turn, offset, core);
  } else {
    put_points(HullRecords(hull), turn, offset, core);
  }
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_CORE_LANES_INL_H_
