// GJK in lanes, in float32 and scaled units: each lane has a simplex of its own (gjk_ref.h says
// what is found, and when it is sure).
#if defined(CAROM_NARROWPHASE_GJK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_GJK_INL_H_
#undef CAROM_NARROWPHASE_GJK_INL_H_
#else
#define CAROM_NARROWPHASE_GJK_INL_H_
#endif

#include <array>

#include "kernel/tolerances.h"
#include "narrowphase/core_batch.h"
#include "narrowphase/core_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The point of each lane that is furthest along `way`; of equals the first.
HWY_INLINE F3 furthest_point(const CoreLanes& core, const F3& way) {
  F3 best = core.point(0);
  F most = dot(way, best);
  for (size_t i = 1; i < core.count(); ++i) {
    const F3 p = core.point(i);
    const F height = dot(way, p);
    const Mask is_better = hn::Gt(height, most);
    most = max(most, height);
    best = select(is_better, p, best);
  }
  return best;
}

// Heights along a way: of the furthest point, and how many reach as far up to a slack.
struct FurthestHeights {
  F most, second, third;

  HWY_INLINE Mask is_one() const { return hn::Gt(hn::Sub(most, second), splat(kFacingSlack)); }
  HWY_INLINE Mask is_two() const { return hn::Gt(hn::Sub(most, third), splat(kFacingSlack)); }
};

HWY_INLINE FurthestHeights furthest_heights(const CoreLanes& core, const F3& way) {
  const F none = splat(-FLT_MAX);
  FurthestHeights found{dot(way, core.point(0)), none, none};
  for (size_t i = 1; i < core.count(); ++i) {
    const Mask exists = hn::Lt(splat(static_cast<float>(i)), core.count_lanes);
    const F height = hn::IfThenElse(exists, dot(way, core.point(i)), none);
    const F below_most = min(found.most, height);
    const F below_second = min(found.second, below_most);
    found.most = max(found.most, height);
    found.second = max(found.second, below_most);
    found.third = max(found.third, below_second);
  }
  return found;
}

// A corner of B - A, and the point of A that it belongs to.
struct CornerLanes {
  F3 point, on_a;
};

HWY_INLINE CornerLanes select(Mask mask, const CornerLanes& yes, const CornerLanes& no) {
  return {select(mask, yes.point, no.point), select(mask, yes.on_a, no.on_a)};
}

HWY_INLINE CornerLanes difference_corner(const CoreLanes& a, const CoreLanes& b, const F3& way) {
  const F3 on_a = furthest_point(a, way);
  return {furthest_point(b, -way) - on_a, on_a};
}

// Up to three corners, in any of the places; which of them there are differs from lane to lane.
struct SimplexLanes {
  std::array<CornerLanes, 3> corner;
  std::array<Mask, 3> is_used;
};

// Of a simplex and one more corner: the point nearest to zero, if the new corner is among those
// that span it, and which others do.
struct NearestLanes {
  F3 point;
  F squared;
  std::array<Mask, 3> is_kept;
  Mask is_around;       // zero lies inside of all four
  Mask is_sure_around;  // and deep enough to be sure
};

class NearestSearch {
 public:
  HWY_INLINE NearestSearch(const SimplexLanes& simplex, const F3& last) {
    const Mask none = no_lanes();
    best_ = {last, dot(last, last), {none, none, none}, none, none};
    const F3 &p = simplex.corner[0].point, &q = simplex.corner[1].point,
             &r = simplex.corner[2].point;
    const auto& used = simplex.is_used;
    const F3 to_p = p - last, to_q = q - last, to_r = r - last;
    const F3 pq = cross(p, q), pr = cross(p, r), qr = cross(q, r);
    const F3 p_last = cross(p, last), q_last = cross(q, last), r_last = cross(r, last);
    try_segment(last, to_p, used[0], 0);
    try_segment(last, to_q, used[1], 1);
    try_segment(last, to_r, used[2], 2);
    try_triangle(last, to_p, to_q, pq, p_last, q_last, hn::And(used[0], used[1]), 0, 1);
    try_triangle(last, to_p, to_r, pr, p_last, r_last, hn::And(used[0], used[2]), 0, 2);
    try_triangle(last, to_q, to_r, qr, q_last, r_last, hn::And(used[1], used[2]), 1, 2);
    const Mask has_four = hn::And(hn::And(used[0], used[1]), used[2]);
    if (hn::AllFalse(FloatTag(), has_four)) return;
    try_tetrahedron(p, q, r, last, pq, q_last, r_last, has_four);
  }

  HWY_INLINE const NearestLanes& nearest() const { return best_; }

 private:
  HWY_INLINE void keep(Mask is_inside, const F3& point, size_t one, size_t other) {
    const F squared = dot(point, point);
    const Mask is_nearer = hn::And(is_inside, hn::Lt(squared, best_.squared));
    best_.squared = hn::IfThenElse(is_nearer, squared, best_.squared);
    best_.point = select(is_nearer, point, best_.point);
    for (size_t i = 0; i < 3; ++i) {
      best_.is_kept[i] = i == one || i == other ? hn::Or(best_.is_kept[i], is_nearer)
                                                : hn::AndNot(is_nearer, best_.is_kept[i]);
    }
  }

  HWY_INLINE void try_segment(const F3& last, const F3& side, Mask exists, size_t other) {
    const F along = hn::Neg(dot(last, side)), length = dot(side, side);
    const Mask is_inside = hn::And(exists, hn::And(hn::Gt(along, splat(0)), hn::Lt(along, length)));
    keep(is_inside, last + side * hn::Div(along, length), other, other);
  }

  // u, v: the sides from the last corner; pq, p_last, q_last: products of the corners themselves.
  HWY_INLINE void try_triangle(const F3& last, const F3& u, const F3& v, const F3& pq,
                               const F3& p_last, const F3& q_last, Mask exists, size_t one,
                               size_t other) {
    const F zero = splat(0);
    const F3 n = cross(u, v);
    const Mask is_over = hn::And(hn::Gt(dot(n, pq), zero), hn::And(hn::Gt(dot(n, q_last), zero),
                                                                   hn::Lt(dot(n, p_last), zero)));
    keep(hn::And(exists, is_over), n * hn::Div(dot(n, last), dot(n, n)), one, other);
  }

  // Zero is inside if its coordinates in the four corners have one sign.
  HWY_INLINE void try_tetrahedron(const F3& p, const F3& q, const F3& r, const F3& last,
                                  const F3& pq, const F3& q_last, const F3& r_last, Mask exists) {
    const F of_p = dot(q, r_last), of_q = hn::Neg(dot(p, r_last)), of_r = dot(p, q_last),
            of_last = hn::Neg(dot(r, pq));
    const F least = min(min(of_p, of_q), min(of_r, of_last));
    const F most = max(max(of_p, of_q), max(of_r, of_last));
    const F depth = max(least, hn::Neg(most));
    const F size = max(max(dot(p, p), dot(q, q)), max(dot(r, r), dot(last, last)));
    best_.is_around = hn::And(exists, hn::Gt(depth, splat(0)));
    best_.is_sure_around =
        hn::And(best_.is_around, hn::Gt(depth, hn::Mul(size, splat(kSureVolume))));
  }

  NearestLanes best_;
};

struct GjkLanes {
  F3 way;             // from A to B
  F squared;          // of its length
  SimplexLanes ends;  // the corners that span it
  Mask is_apart;      // surely, by more than the radius; found by whoever asks for no more
  F gap;              // there: of the projections on the way, times its length
  Mask is_around;     // zero is surely inside of B - A
  Mask has_ended;     // at the shortest way
};

// `radius`: of both together. `kDecides`: no more is wanted than who is apart.
template <bool kDecides>
HWY_INLINE GjkLanes run_gjk(const CoreLanes& a, const CoreLanes& b, F radius) {
  const FloatTag tag;
  const Mask none = no_lanes(), all = hn::Not(none);
  const CornerLanes first = difference_corner(a, b, b.middle - a.middle);
  GjkLanes gjk;
  gjk.way = first.point;
  gjk.squared = dot(gjk.way, gjk.way);
  gjk.ends.corner = {first, first, first};
  gjk.ends.is_used = {all, none, none};
  gjk.is_apart = gjk.is_around = gjk.has_ended = none;
  gjk.gap = splat(0);
  const F sure = hn::Add(radius, splat(kSureGap));
  const F sure_squared = hn::Mul(sure, sure);
  Mask is_open = all;
  for (size_t round = 0; round < kMostLaneRounds; ++round) {
    is_open = hn::And(is_open, hn::Gt(gjk.squared, splat(kNearCores * kNearCores)));
    if (hn::AllFalse(tag, is_open)) break;
    const CornerLanes next = difference_corner(a, b, gjk.way);
    const F gap = dot(gjk.way, next.point);
    if constexpr (kDecides) {
      const Mask is_beyond = hn::And(hn::Gt(gap, splat(0)),
                                     hn::Gt(hn::Mul(gap, gap), hn::Mul(sure_squared, gjk.squared)));
      gjk.is_apart = hn::Or(gjk.is_apart, hn::And(is_open, is_beyond));
      gjk.gap = hn::IfThenElse(is_open, gap, gjk.gap);
      is_open = hn::AndNot(is_beyond, is_open);
    }
    const Mask is_shortest =
        hn::Le(hn::Sub(gjk.squared, gap), hn::Mul(gjk.squared, splat(kLeastProgress)));
    const NearestSearch search(gjk.ends, next.point);
    const NearestLanes& nearest = search.nearest();
    const Mask is_nearer = hn::Lt(nearest.squared, gjk.squared);
    gjk.is_around = hn::Or(gjk.is_around, hn::And(is_open, nearest.is_sure_around));
    is_open = hn::AndNot(nearest.is_around, is_open);
    gjk.has_ended =
        hn::Or(gjk.has_ended, hn::And(is_open, hn::Or(is_shortest, hn::Not(is_nearer))));
    is_open = hn::AndNot(gjk.has_ended, is_open);
    gjk.way = select(is_open, nearest.point, gjk.way);
    gjk.squared = hn::IfThenElse(is_open, nearest.squared, gjk.squared);
    // The new corner takes the first place that is free.
    Mask has_no_place = is_open;
    for (size_t i = 0; i < 3; ++i) {
      const Mask is_kept = nearest.is_kept[i];
      const Mask takes = hn::AndNot(is_kept, has_no_place);
      gjk.ends.corner[i] = select(takes, next, gjk.ends.corner[i]);
      gjk.ends.is_used[i] = hn::Or(hn::AndNot(is_open, gjk.ends.is_used[i]),
                                   hn::Or(takes, hn::And(is_open, is_kept)));
      has_no_place = hn::And(has_no_place, is_kept);
    }
  }
  return gjk;
}

// Where the cores are nearest to each other.
struct NearestCores {
  F distance;
  F3 normal;  // unit, from A to B
  F3 on_a;
  Mask is_sure;
};

HWY_INLINE NearestCores nearest_cores(const CoreLanes& a, const CoreLanes& b, const GjkLanes& gjk) {
  const auto& used = gjk.ends.is_used;
  const auto& corner = gjk.ends.corner;
  const Mask has_three = hn::And(hn::And(used[0], used[1]), used[2]);
  const Mask has_two = hn::AndNot(
      has_three, hn::Or(hn::And(used[0], used[1]), hn::And(hn::Or(used[0], used[1]), used[2])));
  // Those in use, to the front.
  const CornerLanes p = select(used[0], corner[0], select(used[1], corner[1], corner[2]));
  const CornerLanes q = select(hn::And(used[0], used[1]), corner[1], corner[2]);
  const CornerLanes& r = corner[2];
  const F3 u = q.point - p.point, v = r.point - p.point;

  // One corner.
  F3 way = p.point;
  F3 on_a = p.on_a;
  // Two: across the side between them.
  const F uu = dot(u, u);
  const F along = hn::Div(hn::Neg(dot(p.point, u)), uu);
  const F3 on_side = p.point + u * along;
  way = select(has_two, on_side - u * hn::Div(dot(on_side, u), uu), way);
  on_a = select(has_two, p.on_a + (q.on_a - p.on_a) * along, on_a);
  // Three: across their plane.
  const F3 n = cross(u, v);
  const F nn = dot(n, n);
  const F height = hn::Div(dot(n, p.point), nn);
  const F3 foot = n * height, along_plane = foot - p.point;
  const F of_q = hn::Div(dot(n, cross(along_plane, v)), nn);
  const F of_r = hn::Div(dot(n, cross(u, along_plane)), nn);
  way = select(has_three, foot, way);
  on_a = select(has_three, (p.on_a + (q.on_a - p.on_a) * of_q) + (r.on_a - p.on_a) * of_r, on_a);

  const F distance = hn::Sqrt(dot(way, way));
  const F3 normal = way * hn::Div(splat(1), distance);
  const FurthestHeights of_a = furthest_heights(a, normal), of_b = furthest_heights(b, -normal);
  const F gap = hn::Neg(hn::Add(of_a.most, of_b.most));
  const Mask is_shortest = hn::Le(hn::Abs(hn::Sub(distance, gap)), splat(kSameGapInFloat));
  // One point faces the other core, or two edges cross: there is no other place where they meet.
  const Mask crosses = hn::And(hn::Gt(nn, hn::Mul(splat(kSmallCrossing), hn::Mul(uu, dot(v, v)))),
                               hn::And(has_three, hn::And(of_a.is_two(), of_b.is_two())));
  const Mask is_unique = hn::Or(hn::Or(of_a.is_one(), of_b.is_one()), crosses);
  on_a = select(of_a.is_one(), p.on_a, on_a);
  on_a = select(of_b.is_one(), (p.point + p.on_a) - normal * distance, on_a);
  // Rounding tilts the plane of a needle: its corners are not equally far then.
  const auto is_level = [&](const F3& side) HWY_ATTR {
    return hn::Le(hn::Abs(dot(normal, side)), splat(kSameGapInFloat));
  };
  const Mask is_tilted = hn::AndNot(hn::And(is_level(u), is_level(v)), has_three);
  const Mask is_sure = hn::And(hn::And(gjk.has_ended, hn::Gt(distance, splat(kNearCores))),
                               hn::And(is_shortest, hn::AndNot(is_tilted, is_unique)));
  return {distance, normal, on_a, is_sure};
}

// The test of two kinds of which one is a hull. Marks as unsure whatever is left to other tests,
// and with kDeep cores that surely overlap, whose depth is wanted. `kMeasures`: separate pairs,
// too; otherwise their separation is a lower bound, along the normal.
template <class ShapeA, class ShapeB, bool kMeasures>
struct CoreKernel {
  using A = ShapeA;
  using B = ShapeB;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::left;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& a, const B& b, Report& report) {
    constexpr bool kDecides = !(kMeasures && Report::kHasContact);
    CoreLanes core_a, core_b;
    make_core(a, pose.a, splat3(0), core_a);
    make_core(b, pose.b, pose.d, core_b);
    const Mask is_known = hn::And(hn::And(core_a.has_space, core_b.has_space),
                                  hn::And(hn::Ge(report.up, splat(1 / kGreatestScale)),
                                          hn::Le(report.up, splat(kGreatestScale))));
    const F radius = hn::Add(core_a.radius, core_b.radius);
    const GjkLanes gjk = run_gjk<kDecides>(core_a, core_b, radius);
    if constexpr (kDecides) {
      report_decision(gjk, radius, is_known, report);
    } else {
      report_nearest(nearest_cores(core_a, core_b, gjk), radius, core_a, pose, is_known, report);
    }
    if constexpr (Report::kHasContact) mark_deep(hn::And(gjk.is_around, is_known), report);
  }

 private:
  template <class Report>
  static HWY_INLINE void report_decision(const GjkLanes& gjk, F radius, Mask is_known,
                                         Report& report) {
    const F reach = hn::Sub(radius, splat(kSureGap));
    // Cores that all but touch may be flat, which is for others to say.
    const Mask is_within =
        hn::And(hn::Gt(gjk.squared, splat(kNearCores * kNearCores)),
                hn::And(hn::Gt(reach, splat(0)), hn::Lt(gjk.squared, hn::Mul(reach, reach))));
    const Mask overlap = hn::Or(gjk.is_around, is_within);
    const Mask is_sure = hn::And(is_known, hn::Or(overlap, gjk.is_apart));
    const F length = hn::Sqrt(gjk.squared);
    const F gap = hn::Sub(hn::Div(gjk.gap, length), radius);
    report(overlap, hn::Not(is_sure), no_lanes(), hn::IfThenElse(gjk.is_apart, gap, splat(-1)),
           gjk.way * hn::Div(splat(1), length), splat3(0), splat3(0));
  }

  // Whose cores overlap is unsure: depths are found elsewhere.
  template <class Report>
  static HWY_INLINE void report_nearest(const NearestCores& nearest, F radius,
                                        const CoreLanes& core_a, const PoseLanes& pose,
                                        Mask is_known, Report& report) {
    const F separation = hn::Sub(nearest.distance, radius);
    const Mask is_sure =
        hn::And(hn::And(is_known, nearest.is_sure), hn::Gt(hn::Abs(separation), splat(kSureGap)));
    const F3 arm_a = nearest.on_a + nearest.normal * core_a.radius;
    const F3 arm_b = (arm_a + nearest.normal * separation) - pose.d;
    report(hn::Le(separation, splat(0)), hn::Not(is_sure), no_lanes(), separation, nearest.normal,
           arm_a, arm_b);
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

#endif  // CAROM_NARROWPHASE_GJK_INL_H_
