// Gaps of cores in lanes of doubles, a vector of rows at a time.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/doubles/core_rows.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <memory>

#include "narrowphase/batch/to_floats-inl.h"
#include "narrowphase/doubles/round_gjk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// The points of a core that face along a direction.
struct FacingPoints {
  D count;
  D3 first, last;
};

HWY_INLINE FacingPoints facing_points(const HullPointLanes& points, D count, const D3& way) {
  D most = dot(way, get(points.point[0]));
  for (size_t i = 1; i < points.count; ++i) most = max(most, dot(way, get(points.point[i])));
  const D least = hn::Sub(most, splat_double(kInPlane)), one = splat_double(1);
  FacingPoints facing{hn::Zero(DoubleTag()), get(points.point[0]), get(points.point[0])};
  for (size_t i = 0; i < points.count; ++i) {
    const D3 p = get(points.point[i]);
    const DoubleMask faces =
        hn::And(hn::Ge(dot(way, p), least), hn::Lt(splat_double(static_cast<double>(i)), count));
    facing.first = select(hn::And(faces, hn::Lt(facing.count, one)), p, facing.first);
    facing.last = select(faces, p, facing.last);
    facing.count = hn::Add(facing.count, hn::IfThenElseZero(faces, one));
  }
  return facing;
}

// As scalar::find_crossing().
HWY_INLINE DoubleMask find_crossing(const FacingPoints& a, const FacingPoints& b, const D3& n,
                                    D3& point) {
  const D3 u = a.last - a.first, v = b.last - b.first, between = b.first - a.first;
  const D slope = dot(n, cross(u, v));
  const D t = hn::Div(dot(n, cross(between, v)), slope);
  const D s = hn::Div(dot(n, cross(between, u)), slope);
  point = a.first + u * t;
  const D low = splat_double(scalar::kWellInside), high = splat_double(1 - scalar::kWellInside);
  const DoubleMask is_inside =
      hn::And(hn::And(hn::Gt(t, low), hn::Lt(t, high)), hn::And(hn::Gt(s, low), hn::Lt(s, high)));
  const D least = hn::Mul(splat_double(kParallelEdges), hn::Mul(dot(u, u), dot(v, v)));
  return hn::And(is_inside, hn::Gt(hn::Mul(slope, slope), least));
}

// The contact location on A as the first round of scalar::meeting_point() finds it. Lanes for
// which it finds none count as not found.
HWY_INLINE D3 meeting_point(const CorePairLanes& cores, CoreGapLanes& gap) {
  const D one = splat_double(1), two = splat_double(2);
  const FacingPoints a = facing_points(cores.a, cores.count_a.get(), gap.normal);
  const DoubleMask is_a =
      hn::Or(hn::Eq(cores.count_a.get(), one), hn::And(gap.is_at_corners, hn::Eq(a.count, one)));
  if (hn::AllFalse(DoubleTag(), hn::AndNot(is_a, gap.is_found))) return a.first;
  const FacingPoints b = facing_points(cores.b, cores.count_b.get(), -gap.normal);
  D3 point;
  const DoubleMask crosses = hn::And(hn::And(hn::Eq(a.count, two), hn::Eq(b.count, two)),
                                     find_crossing(a, b, gap.normal, point));
  const DoubleMask is_b = hn::And(gap.is_at_corners, hn::Eq(b.count, one));
  point = select(is_b, b.first - gap.normal * gap.size, point);
  point = select(is_a, a.first, point);
  gap.is_found = hn::And(gap.is_found, hn::Or(crosses, hn::Or(is_a, is_b)));
  return point;
}

// A vector of rows.
class CoreVectorOfRows {
 public:
  CoreVectorOfRows(CoreRows& rows, size_t row, CorePairLanes& cores)
      : rows_(rows), row_(row), cores_(cores) {}

  HWY_INLINE void run() {
    offset_ = vector(CoreRows::kOffset);
    const RotationOf<D> turn_a = rotation(CoreRows::kTurnA), turn_b = rotation(CoreRows::kTurnB);
    place(rows_.a, turn_a, splat_zero(), cores_.a, cores_.count_a);
    place(rows_.b, turn_b, offset_, cores_.b, cores_.count_b);
    const D3 middle_a = rotate(turn_a, vector(CoreRows::kMiddleA)) + splat_zero();
    const D3 middle_b = rotate(turn_b, vector(CoreRows::kMiddleB)) + offset_;
    const D3 between = middle_b - middle_a;
    if (rows_.a.is_round || rows_.b.is_round) {
      run_round({round_core(cores_.a, rows_.a.is_round, CoreRows::kRoundnessA, turn_a),
                 round_core(cores_.b, rows_.b.is_round, CoreRows::kRoundnessB, turn_b),
                 hn::Add(number(CoreRows::kRadiusA), number(CoreRows::kRadiusB))},
                between);
    } else {
      run_points(between);
    }
  }

 private:
  HWY_INLINE void run_points(const D3& between) {
    CoreGapLanes gap;
    find_plain_gap(cores_, between, rows_.decides_only, gap);
    D3 on_a = gap.normal;
    if (!rows_.decides_only) on_a = meeting_point(cores_, gap);
    put_gap(gap.size, gap.normal, on_a, gap.is_found, gap.is_proven);
  }

  HWY_INLINE void run_round(const RoundPairLanes& cores, const D3& between) {
    const RoundGapLanes gap =
        find_plain_round_gap(cores, between, {rows_.decides_separate, rows_.decides_only});
    put_gap(gap.size, gap.normal, gap.of_a, gap.is_found, gap.is_proven);
  }

  // `on_a`: where A without its radius is nearest to B.
  HWY_INLINE void put_gap(D size, const D3& n, const D3& on_a, DoubleMask is_found,
                          DoubleMask is_proven) {
    const D radius_a = number(CoreRows::kRadiusA), up = number(CoreRows::kUp);
    const D separation = hn::Sub(size, hn::Add(radius_a, number(CoreRows::kRadiusB)));
    if (!rows_.decides_only) {
      const D3 arm_a = on_a + n * radius_a;
      put(1, n);
      put(4, arm_a * up);
      put(7, ((arm_a + n * separation) - offset_) * up);
    }
    put(0, rounded_separation(hn::Mul(separation, up)));
    const uint64_t found = bits_of(DoubleTag(), is_found);
    const uint64_t proven = bits_of(
        DoubleTag(), hn::And(is_proven, hn::Gt(hn::Abs(separation), splat_double(kProvenGap))));
    for (size_t lane = 0; lane < kDoubleLanes; ++lane) {
      rows_.is_found[row_ + lane] = found >> lane & 1;
      rows_.is_unsure[row_ + lane] = !(proven >> lane & 1);
    }
  }

  static HWY_INLINE D3 splat_zero() {
    const D zero = hn::Zero(DoubleTag());
    return {zero, zero, zero};
  }
  HWY_INLINE D number(size_t column) const {
    return hn::Load(DoubleTag(), rows_.column[column].data() + row_);
  }
  HWY_INLINE D3 vector(size_t column) const {
    return {number(column), number(column + 1), number(column + 2)};
  }
  HWY_INLINE RotationOf<D> rotation(size_t column) const {
    RotationOf<D> turn = rotation_of(QuaternionOf<D>{vector(column), number(column + 3)});
    for (D3* axis : {&turn.x, &turn.y, &turn.z}) *axis = *axis * number(CoreRows::kDown);
    return turn;
  }
  HWY_INLINE void put(size_t answer, D v) {
    store_as_floats(v, rows_.answer[answer].data() + row_);
  }
  HWY_INLINE void put(size_t answer, const D3& v) {
    put(answer, v.x), put(answer + 1, v.y), put(answer + 2, v.z);
  }

  HWY_INLINE void place(const CoreRows::Side& side, const RotationOf<D>& turn, const D3& offset,
                        HullPointLanes& points, LaneNumber& count) {
    PointRecords records;
    for (size_t lane = 0; lane < kDoubleLanes; ++lane) {
      records.first[lane] = side.points[row_ + lane];
      records.points[lane] = side.count[row_ + lane];
      records.most = std::max(records.most, records.points[lane]);
      count.lane[lane] = static_cast<double>(side.count[row_ + lane]);
    }
    points.count = records.most;
    for (size_t i = 0; i < records.most; ++i) {
      carom::HWY_NAMESPACE::put(rotate(turn, records.point(i)) + offset, points.point[i]);
    }
  }

  // `column`: the first of the roundness.
  HWY_INLINE RoundCoreLanes round_core(const HullPointLanes& points, bool is_round, size_t column,
                                       const RotationOf<D>& turn) const {
    if (!is_round) return {&points, false, {}, {}};
    const D zero = hn::Zero(DoubleTag());
    const D3 lengths = vector(column);
    return {&points,
            true,
            {rotate(turn, {lengths.x, zero, zero}), rotate(turn, {zero, lengths.y, zero}),
             rotate(turn, {zero, zero, lengths.z})},
            {number(column + 3), number(column + 4)}};
  }

  CoreRows& rows_;
  const size_t row_;
  CorePairLanes& cores_;
  D3 offset_;
};

// Places up to a whole vector repeat the last row.
void fill_vector(CoreRows& rows, size_t end) {
  const size_t last = rows.count - 1;
  for (size_t row = rows.count; row < end; ++row) {
    for (auto& column : rows.column) column[row] = column[last];
    for (CoreRows::Side* side : {&rows.a, &rows.b}) {
      side->points[row] = side->points[last];
      side->count[row] = side->count[last];
    }
  }
}

void find_gaps(CoreRows& rows) {
  static thread_local const auto cores = std::make_unique_for_overwrite<CorePairLanes>();
  fill_vector(rows, (rows.count + kDoubleLanes - 1) / kDoubleLanes * kDoubleLanes);
  for (size_t row = 0; row < rows.count; row += kDoubleLanes) {
    CoreVectorOfRows(rows, row, *cores).run();
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(find_gaps);

}  // namespace

FindCoreGaps find_core_gaps() { return &CAROM_DISPATCH(find_gaps); }

}  // namespace carom
#endif  // HWY_ONCE
