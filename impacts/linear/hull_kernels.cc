// Times of impact of two hulls (impacts/approach.h and impacts/turning_approach.h are the scalar
// forms). Lanes that are still open when most of a vector have ended leave it, and go on together
// with those of other vectors: pairs that meet take three times as many rounds as others.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "impacts/linear/hull_kernels.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <array>
#include <memory>

#include "impacts/linear/hull_lanes-inl.h"
#include "impacts/linear/turning_approach-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

constexpr size_t kFirstOfHullB = LinearRows::kPairColumns + number_count(LinearKind::hull);
constexpr size_t kRotations = kFirstOfHullB + number_count(LinearKind::hull);

// A pair before its search.
struct HullPair {
  D3 middle_a, middle_b;
  D reach_a, reach_b;
  DoubleMask is_left;  // to the scalar form
};

HWY_INLINE void set_motion(const LinearRows&, size_t, HullPair& pair, ApproachLanes& lanes) {
  put(pair.middle_b - pair.middle_a, lanes.corner[0]);
}

HWY_INLINE void set_motion(const LinearRows& rows, size_t row, HullPair& pair,
                           TurningApproachLanes& lanes) {
  RowReader in(rows, kRotations, row);
  // A point at the pivot does not rotate.
  const D3 a = zero_unless(hn::Gt(pair.reach_a, zero()), in.vector());
  const D3 b = zero_unless(hn::Gt(pair.reach_b, zero()), in.vector());
  put(a, lanes.rotation_a);
  put(b, lanes.rotation_b);
  lanes.reach_a.put(pair.reach_a);
  lanes.reach_b.put(pair.reach_b);
  put(pair.middle_a, lanes.on_a[0]);
  put(pair.middle_b, lanes.on_b[0]);
  const D most = max(dot(a, a), dot(b, b));
  const DoubleMask turns =
      hn::And(hn::Gt(most, zero()), hn::Le(most, splat_double(kMostTurning * kMostTurning)));
  pair.is_left = hn::Or(pair.is_left, hn::Not(turns));
}

template <class Lanes>
class HullTimes {
 public:
  struct Scratch {
    Lanes lanes, open;
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
      if (points <= kMostPointsOfDoubles) most = std::max(most, points);
    }
    return most;
  }

  void run_vector(size_t row) {
    DoubleMask is_open = start(row);
    LaneNumber times{};
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

  static HWY_NOINLINE void begin_and_go_on(size_t few, Lanes& lanes, DoubleMask& is_open,
                                           LaneNumber& times) {
    begin_approach(lanes);
    go_on(few, is_open, lanes, times);
  }

  // Places the hulls of a vector; returns which lanes need a search.
  HWY_INLINE DoubleMask start(size_t row) {
    RowReader in(rows_, 0, row);
    const D3 apart = in.vector(), motion = in.vector();
    LinearHull a(RowReader(rows_, LinearRows::kPairColumns, row));
    LinearHull b(RowReader(rows_, kFirstOfHullB, row));
    const D sizes = max(a.size, b.size);
    const D size = hn::IfThenElse(hn::Gt(sizes, zero()), sizes,
                                  max(largest_component(apart), largest_component(motion)));
    D up, down;
    power_of_two(size, up, down);
    a.scale(down);
    b.scale(down);
    const D3 from = apart * down, way = motion * down;
    const LinearHullRecords records_a(rows_.hull_a() + row), records_b(rows_.hull_b() + row);
    HullPair pair{rotate(a.turn, a.middle), rotate(b.turn, b.middle), place(records_a, a, lanes_.a),
                  place(records_b, b, lanes_.b),
                  hn::Not(hn::And(records_a.has_space, records_b.has_space))};
    const D reach = hn::Add(pair.reach_a, pair.reach_b);
    const D lengths = hn::Add(hn::Add(largest_component(from), largest_component(way)), reach);
    const D tolerance =
        hn::Add(splat_double(0x1p-38), hn::Mul(splat_double(4 * kSweepSlack), lengths));
    const D time = meets_ball(moving_point(from, way), hn::Add(reach, tolerance));
    put(from, lanes_.from);
    put(way, lanes_.way);
    set_motion(rows_, row, pair, lanes_);
    lanes_.tolerance.put(tolerance);
    lanes_.time.put(time);
    unsearched_.put(hn::IfThenElse(pair.is_left, splat_double(kNoClosedForm), never()));
    return hn::AndNot(pair.is_left, hn::Le(time, splat_double(1)));
  }

  void leave(size_t row, size_t lane) {
    copy_lane(lanes_, lane, open_, open_count_);
    open_row_[open_count_++] = row;
    if (open_count_ == kDoubleLanes) run_open();
  }

  void run_open() {
    if (open_count_ == 0) return;
    const size_t count = open_count_;
    open_count_ = 0;
    for (size_t lane = count; lane < kDoubleLanes; ++lane) copy_lane(open_, 0, open_, lane);
    DoubleMask is_open = hn::FirstN(DoubleTag(), count);
    LaneNumber times{};
    go_on_open(open_, is_open, times);
    for (size_t lane = 0; lane < count; ++lane) rows_.times()[open_row_[lane]] = times.lane[lane];
  }
  static HWY_NOINLINE void go_on_open(Lanes& lanes, DoubleMask& is_open, LaneNumber& times) {
    go_on(0, is_open, lanes, times);
  }

  LinearRows& rows_;
  const size_t count_;
  Lanes &lanes_, &open_;
  LaneNumber unsearched_;  // the times of lanes that need no search
  std::array<size_t, kDoubleLanes> open_row_;
  size_t open_count_ = 0;
};

template <class Lanes>
void run_hulls(LinearRows& rows, size_t count) {
  static thread_local const auto scratch =
      std::make_unique_for_overwrite<typename HullTimes<Lanes>::Scratch>();
  HullTimes<Lanes>(rows, count, *scratch).run();
}

void hull_hull(LinearRows& rows, size_t count) { run_hulls<ApproachLanes>(rows, count); }
void turning_hulls(LinearRows& rows, size_t count) { run_hulls<TurningApproachLanes>(rows, count); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(hull_hull);
HWY_EXPORT(turning_hulls);

}  // namespace

LinearKernel hull_kernel() { return CAROM_DISPATCH(hull_hull); }
LinearKernel turning_hull_kernel() { return CAROM_DISPATCH(turning_hulls); }

}  // namespace carom
#endif  // HWY_ONCE
