// Linear times of impact of two hulls (impacts/approach.h is the scalar form). Lanes that are still
// open when most of a vector have ended leave it, and go on together with those of other vectors:
// pairs that meet take three times as many rounds as others.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "impacts/linear/hull_kernels.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <array>
#include <memory>

#include "carom/shapes/hull.h"
#include "impacts/linear/approach-inl.h"
#include "impacts/linear/linear_load-inl.h"
#include "simd/gather-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// The records of the hulls of a vector.
struct HullPoints {
  std::array<const float*, kDoubleLanes> first;
  std::array<size_t, kDoubleLanes> points;
  size_t most = 0;
  DoubleMask has_space;  // lanes of which the points fit

  HWY_INLINE explicit HullPoints(const HullGeometry* const* hulls) {
    static constexpr std::array<float, 4> kNothing{};
    HWY_ALIGN double counts[kDoubleLanes];
    for (size_t lane = 0; lane < kDoubleLanes; ++lane) {
      const HullGeometry* const hull = hulls[lane];
      const size_t count = hull ? hull->records().size() - 1 : kMostApproachPoints + 1;
      const bool fits = count <= kMostApproachPoints;
      first[lane] = fits ? hull->records()[0].data() : kNothing.data();
      points[lane] = fits ? count : 1;
      counts[lane] = static_cast<double>(count);
      most = std::max(most, points[lane]);
    }
    has_space = hn::Le(hn::Load(DoubleTag(), counts),
                       splat_double(static_cast<double>(kMostApproachPoints)));
  }

  // Point i of each hull, or its last one.
  template <class Tag = DoubleTag>  // so that branches for other widths are not compiled
  HWY_INLINE D3 point(size_t i) const {
    const auto record = [&](size_t lane)
                            HWY_ATTR { return first[lane] + 4 * std::min(i, points[lane] - 1); };
#if HWY_TARGET != HWY_SCALAR
    if constexpr (hn::MaxLanes(Tag()) >= 4) {
      const hn::Rebind<float, Tag> floats;
      const auto row = [&](size_t k) HWY_ATTR {
        return interleaved_row(floats, Source<decltype(record)>{record}, k);
      };
      const auto r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
      const auto xy02 = hn::InterleaveLower(floats, r0, r2);
      const auto xy13 = hn::InterleaveLower(floats, r1, r3);
      const auto zw02 = hn::InterleaveUpper(floats, r0, r2);
      const auto zw13 = hn::InterleaveUpper(floats, r1, r3);
      const Tag tag;
      return {hn::PromoteTo(tag, hn::InterleaveLower(floats, xy02, xy13)),
              hn::PromoteTo(tag, hn::InterleaveUpper(floats, xy02, xy13)),
              hn::PromoteTo(tag, hn::InterleaveLower(floats, zw02, zw13))};
    }
#endif
    LaneVector p;
    for (size_t lane = 0; lane < kDoubleLanes; ++lane) {
      for (size_t axis = 0; axis < 3; ++axis) p[axis].lane[lane] = record(lane)[axis];
    }
    return get(p);
  }

 private:
#if HWY_TARGET != HWY_SCALAR
  template <class Record>
  struct Source {
    const Record& record;
    HWY_INLINE hn::Vec<Quad> quad(size_t lane) const { return hn::LoadU(Quad(), record(lane)); }
  };
#endif
};

// A hull as it is in a row.
struct LinearHull {
  D3 middle;
  D size;
  RotationOf<D> turn;

  explicit HWY_INLINE LinearHull(RowReader in)
      : middle(in.vector()), size(in.number()), turn(in.rotation()) {}

  // In units in which the scale is one. Powers of two round nothing.
  HWY_INLINE void scale(D down) {
    for (D3* column : {&turn.x, &turn.y, &turn.z}) *column = *column * down;
  }
};

// Places the points; returns how far the furthest is from the hull's position.
HWY_INLINE D place(const HullPoints& records, const LinearHull& hull, PointLanes& points) {
  D greatest = zero();
  points.count = records.most;
  for (size_t i = 0; i < records.most; ++i) {
    const D3 p = rotate(hull.turn, records.point(i));
    greatest = max(greatest, dot(p, p));
    put(p, points.point[i]);
  }
  return hn::Mul(hn::Sqrt(greatest), splat_double(scalar::kSpeedUpwards));
}

class HullTimes {
 public:
  struct Scratch {
    ApproachLanes lanes, open;
  };

  HullTimes(LinearRows& rows, size_t count, Scratch& scratch)
      : rows_(rows), count_(count), lanes_(scratch.lanes), open_(scratch.open) {}

  void run() {
    open_.a.count = most_points(rows_.hull_a());
    open_.b.count = most_points(rows_.hull_b());
    for (size_t row = 0; row < count_; row += kDoubleLanes) run_vector(row);
    run_open();
  }

 private:
  // When no more lanes than these are open they leave.
  static constexpr size_t kFew = kDoubleLanes > 2 ? kDoubleLanes / 2 : 0;

  size_t most_points(const HullGeometry* const* hulls) const {
    size_t most = 1;
    for (size_t row = 0; row < count_; ++row) {
      const size_t points = hulls[row] ? hulls[row]->points().size() : 1;
      if (points <= kMostApproachPoints) most = std::max(most, points);
    }
    return most;
  }

  void run_vector(size_t row) {
    DoubleMask is_open = start(row);
    LaneNumber times{};
    times.put(lanes_.time.get());
    const DoubleMask is_searched = is_open;
    begin_and_go_on(kFew, lanes_, is_open, times);
    const D time = hn::IfThenElse(is_searched, times.get(), unsearched_.get());
    hn::Store(time, DoubleTag(), rows_.times() + row);
    if (hn::AllFalse(DoubleTag(), is_open)) return;
    const uint64_t bits = bits_of(DoubleTag(), is_open);
    for (size_t lane = 0; lane < kDoubleLanes; ++lane) {
      if (bits >> lane & 1) leave(row + lane, lane);
    }
  }

  static HWY_NOINLINE void begin_and_go_on(size_t few, ApproachLanes& lanes, DoubleMask& is_open,
                                           LaneNumber& times) {
    begin_approach(lanes);
    go_on(few, is_open, lanes, times);
  }

  // Places the hulls of a vector; returns which lanes need a search.
  HWY_INLINE DoubleMask start(size_t row) {
    constexpr size_t kFirstOfB = LinearRows::kPairColumns + number_count(LinearKind::hull);
    RowReader in(rows_, 0, row);
    const D3 apart = in.vector(), motion = in.vector();
    LinearHull a(RowReader(rows_, LinearRows::kPairColumns, row));
    LinearHull b(RowReader(rows_, kFirstOfB, row));
    const D sizes = max(a.size, b.size);
    const D size = hn::IfThenElse(hn::Gt(sizes, zero()), sizes,
                                  max(largest_component(apart), largest_component(motion)));
    D up, down;
    power_of_two(size, up, down);
    a.scale(down);
    b.scale(down);
    const D3 from = apart * down, way = motion * down;
    const HullPoints records_a(rows_.hull_a() + row), records_b(rows_.hull_b() + row);
    const D reach = hn::Add(place(records_a, a, lanes_.a), place(records_b, b, lanes_.b));
    const D lengths = hn::Add(hn::Add(largest_component(from), largest_component(way)), reach);
    const D tolerance =
        hn::Add(splat_double(0x1p-38), hn::Mul(splat_double(4 * kSweepSlack), lengths));
    const D time = meets_ball(moving_point(from, way), hn::Add(reach, tolerance));
    put(from, lanes_.from);
    put(way, lanes_.way);
    put(rotate(b.turn, b.middle) - rotate(a.turn, a.middle), lanes_.corner[0]);
    lanes_.tolerance.put(tolerance);
    lanes_.time.put(time);
    const DoubleMask has_space = hn::And(records_a.has_space, records_b.has_space);
    unsearched_.put(hn::IfThenElse(has_space, never(), splat_double(kNoClosedForm)));
    return hn::And(has_space, hn::Le(time, splat_double(1)));
  }

  void leave(size_t row, size_t lane) {
    open_.copy_lane(lanes_, lane, open_count_);
    open_row_[open_count_++] = row;
    if (open_count_ == kDoubleLanes) run_open();
  }

  void run_open() {
    if (open_count_ == 0) return;
    const size_t count = open_count_;
    open_count_ = 0;
    for (size_t lane = count; lane < kDoubleLanes; ++lane) open_.copy_lane(open_, 0, lane);
    DoubleMask is_open = hn::FirstN(DoubleTag(), count);
    LaneNumber times{};
    go_on_open(open_, is_open, times);
    for (size_t lane = 0; lane < count; ++lane) rows_.times()[open_row_[lane]] = times.lane[lane];
  }
  static HWY_NOINLINE void go_on_open(ApproachLanes& lanes, DoubleMask& is_open,
                                      LaneNumber& times) {
    go_on(0, is_open, lanes, times);
  }

  LinearRows& rows_;
  const size_t count_;
  ApproachLanes &lanes_, &open_;
  LaneNumber unsearched_;  // the times of lanes that need no search
  std::array<size_t, kDoubleLanes> open_row_;
  size_t open_count_ = 0;
};

void hull_hull(LinearRows& rows, size_t count) {
  static thread_local const auto scratch = std::make_unique_for_overwrite<HullTimes::Scratch>();
  HullTimes(rows, count, *scratch).run();
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(hull_hull);

}  // namespace

LinearKernel hull_kernel() { return CAROM_DISPATCH(hull_hull); }

}  // namespace carom
#endif  // HWY_ONCE
