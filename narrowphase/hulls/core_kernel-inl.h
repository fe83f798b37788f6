// The kernel for a hull and another kind, by GJK in lanes.
#if defined(CAROM_NARROWPHASE_HULLS_CORE_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_CORE_KERNEL_INL_H_
#undef CAROM_NARROWPHASE_HULLS_CORE_KERNEL_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_CORE_KERNEL_INL_H_
#endif

#include <array>

#include "base/tolerances.h"
#include "narrowphase/hulls/closest_feature-inl.h"
#include "narrowphase/hulls/features.h"
#include "narrowphase/hulls/gjk_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

HWY_INLINE Mask is_same(const F3& p, const F3& q) {
  return hn::And(hn::Eq(p.x, q.x), hn::And(hn::Eq(p.y, q.y), hn::Eq(p.z, q.z)));
}

// Index of the first point of the core for which `is_it` holds, in each lane; 0 if there is none.
template <class IsIt>
HWY_INLINE F place_of(const CoreLanes& core, const IsIt& is_it) {
  F place = splat(0);
  for (size_t i = core.count(); i-- > 0;) {
    place = hn::IfThenElse(is_it(core.point(i)), splat(static_cast<float>(i)), place);
  }
  return place;
}

// Packs the first `count` corners of each lane into its feature word.
HWY_INLINE void write_features(const CoreLanes& a, const CoreLanes& b,
                               const std::array<const CornerLanes*, kMostFeatures>& corners,
                               F count, uint64_t* features) {
  HWY_ALIGN float counts[kLanes];
  HWY_ALIGN float places[2 * kMostFeatures][kLanes];
  hn::Store(count, FloatTag(), counts);
  for (size_t k = 0; k < kMostFeatures; ++k) {
    const CornerLanes& c = *corners[k];
    const auto of_a = [&](const F3& p) HWY_ATTR { return is_same(p, c.on_a); };
    const auto of_b = [&](const F3& p) HWY_ATTR { return is_same(p - c.on_a, c.point); };
    hn::Store(place_of(a, of_a), FloatTag(), places[2 * k]);
    hn::Store(place_of(b, of_b), FloatTag(), places[2 * k + 1]);
  }
  for (size_t lane = 0; lane < kLanes; ++lane) {
    Features found{static_cast<size_t>(counts[lane])};
    for (size_t k = 0; k < found.count; ++k) {
      found.of_a[k] = static_cast<uint8_t>(places[2 * k][lane]);
      found.of_b[k] = static_cast<uint8_t>(places[2 * k + 1][lane]);
    }
    features[lane] = pack_features(found);
  }
}

// Stores the corners around zero of deep lanes, the nearest corners of sure separate lanes, and
// none elsewhere.
HWY_INLINE void write_features(const CoreLanes& a, const CoreLanes& b, const FrontCorners& ends,
                               Mask is_nearest, const GjkLanes& gjk, Mask is_around,
                               uint64_t* features) {
  const auto& corner = gjk.ends.corner;
  const CornerLanes p = select(is_around, corner[0], ends.p);
  const CornerLanes q = select(is_around, corner[1], ends.q);
  const CornerLanes r = select(is_around, corner[2], ends.r);
  const F count = hn::IfThenElseZero(is_nearest, ends.count());
  write_features(a, b, {&p, &q, &r, &gjk.last}, hn::IfThenElse(is_around, splat(4), count),
                 features);
}

// `radius` is the sum of both radii; A has `radius_a` of it. Lanes whose cores overlap are unsure,
// because other searches find their depth. Lanes in `goes_on` are not unsure: the second stage
// reports them.
template <class Report>
HWY_INLINE void report_nearest(const NearestCores& nearest, F radius, F radius_a, const F3& d,
                               Mask goes_on, Report& report) {
  const F separation = hn::Sub(nearest.distance, radius);
  const Mask is_sure =
      hn::Or(goes_on, hn::And(nearest.is_sure, hn::Gt(hn::Abs(separation), splat(kSureGap))));
  const F3 arm_a = nearest.on_a + nearest.normal * radius_a;
  const F3 arm_b = (arm_a + nearest.normal * separation) - d;
  report(hn::Le(separation, splat(0)), hn::Not(is_sure), no_lanes(), separation, nearest.normal,
         arm_a, arm_b);
}

// Whether float32 may decide at this scale. `up`: metres per unit.
HWY_INLINE Mask is_usual_scale(F up) {
  return hn::And(hn::Ge(up, splat(1 / kGreatestScale)), hn::Le(up, splat(kGreatestScale)));
}

// A test runs as a whole, or in two stages (core_stages-inl.h).
enum class Stage { whole, first, rest };

// The first stage of a vector ends once no more than this many lanes are open: 3 of 16, 1 of 8, and
// none of 4, where a second stage would cost more than it saves.
inline constexpr size_t kFewOpen = 3 * kLanes / 16;

// The test of two kinds of which one is a hull. Marks as unsure whatever is left to other tests,
// and with kDeep cores that surely overlap, whose depth is wanted. At Pass::test the separation of
// separate pairs is a lower bound, along the normal; at Pass::clearance overlaps have no depth; at
// Pass::distance there is all.
template <class ShapeA, class ShapeB, bool kDecides, Stage kStage = Stage::whole>
struct CoreKernel {
  using A = ShapeA;
  using B = ShapeB;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::left;
  static constexpr Columns kColumns = kDecides ? Columns::as_asked : Columns::contact;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& a, const B& b, Report& report) {
    CoreLanes core_a, core_b;
    make_core(a, pose.a, splat3(0), core_a);
    make_core(b, pose.b, pose.d, core_b);
    const Mask is_known =
        hn::And(hn::And(core_a.has_space, core_b.has_space), is_usual_scale(report.up));
    const F radius = hn::Add(core_a.radius, core_b.radius);
    GjkSearch search;
    const Mask goes_on = run_stage(core_a, core_b, radius, report, search);
    const GjkLanes& gjk = search.gjk;
    if constexpr (kDecides) {
      report_decision(gjk, radius, is_known, goes_on, report);
    } else {
      const FrontCorners ends(gjk.ends);
      NearestCores nearest;
      nearest_cores(core_a, core_b, ends, nearest);
      nearest.is_sure = hn::And(nearest.is_sure, hn::And(gjk.has_ended, is_known));
      const Mask is_nearest = hn::And(nearest.is_sure, report.valid);
      const Mask is_around = hn::And(gjk.is_around, hn::And(is_known, report.valid));
      if (report.batch.features) {
        write_features(core_a, core_b, ends, is_nearest, gjk, is_around,
                       report.batch.features + report.row);
      }
      if (report.batch.pass == Pass::clearance) {
        nearest.distance = hn::IfThenElse(is_around, splat(-1), nearest.distance);
        nearest.is_sure = hn::Or(nearest.is_sure, is_around);
      }
      report_nearest(nearest, radius, core_a.radius, pose.d, goes_on, report);
    }
    if (has_contacts(report.batch.detail) && report.batch.pass != Pass::clearance) {
      mark_deep(hn::And(gjk.is_around, is_known), report);
    }
  }

 private:
  static HWY_INLINE void begin(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal,
                               GjkSearch& search) {
    if constexpr (kDecides) {
      begin_search_inlined<true>(a, b, goal, search);
    } else {
      begin_search(a, b, goal, search);
    }
  }

  static HWY_INLINE void run_rounds(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal,
                                    size_t few, GjkSearch& search) {
    if constexpr (kDecides) {
      go_on_inlined<true>(a, b, goal, few, search);
    } else {
      go_on(a, b, goal, few, search);
    }
  }

  // Yields the lanes that go on later.
  template <class Report>
  static HWY_INLINE Mask run_stage(const CoreLanes& a, const CoreLanes& b, F radius,
                                   const Report& report, GjkSearch& search) {
    const SearchGoal goal = goal_at(radius, report.batch.features != nullptr);
    OpenSearches* const open = report.batch.open;
    if constexpr (kStage == Stage::rest) {
      resume(*open, report.row, search);
    } else {
      begin(a, b, goal, search);
    }
    if constexpr (kStage == Stage::first) {
      run_rounds(a, b, goal, open ? kFewOpen : 0, search);
      const Mask goes_on = hn::And(search.is_open, report.valid);
      if (!hn::AllFalse(FloatTag(), goes_on)) leave(search, goes_on, report.row, *open);
      return goes_on;
    } else {
      run_rounds(a, b, goal, 0, search);
      return no_lanes();
    }
  }

  template <class Report>
  static HWY_INLINE void report_decision(const GjkLanes& gjk, F radius, Mask is_known, Mask goes_on,
                                         Report& report) {
    const F reach = hn::Sub(radius, splat(kSureGap));
    // Cores that nearly touch may be flat; a slower test decides them.
    const Mask is_within =
        hn::And(hn::Gt(gjk.squared, splat(kNearCores * kNearCores)),
                hn::And(hn::Gt(reach, splat(0)), hn::Lt(gjk.squared, hn::Mul(reach, reach))));
    const Mask overlap = hn::Or(gjk.is_around, is_within);
    const Mask is_sure = hn::Or(goes_on, hn::And(is_known, hn::Or(overlap, gjk.is_apart)));
    const F length = hn::Sqrt(gjk.squared);
    const F gap = hn::Sub(hn::Div(gjk.gap, length), radius);
    report(overlap, hn::Not(is_sure), no_lanes(), hn::IfThenElse(gjk.is_apart, gap, splat(-1)),
           gjk.way * hn::Div(splat(1), length), splat3(0), splat3(0));
  }

  template <class Report>
  static HWY_INLINE void mark_deep(Mask is_deep, const Report& report) {
    HWY_ALIGN float flags[kLanes];
    hn::Store(hn::IfThenElseZero(hn::And(is_deep, report.valid), splat(1)), FloatTag(), flags);
    for (size_t i = 0; i < kLanes; ++i) {
      if (flags[i] != 0) report.batch.unsure[report.row + i] = kDeep;
    }
  }
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_CORE_KERNEL_INL_H_
