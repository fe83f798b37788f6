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
#include "narrowphase/features.h"

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

// Along a way: how high the furthest point is, and how many are as high as `height` up to a slack.
struct FacingCount {
  F most, count;

  HWY_INLINE Mask is_one() const { return hn::Lt(count, splat(1.5f)); }
  HWY_INLINE Mask is_two() const { return hn::Lt(count, splat(2.5f)); }
};

HWY_INLINE FacingCount count_facing(const CoreLanes& core, const F3& way, F height) {
  const F limit = hn::Sub(height, splat(kFacingSlack)), one = splat(1);
  FacingCount facing{splat(-FLT_MAX), splat(0)};
  for (size_t i = 0; i < core.count(); ++i) {
    const F h = dot(way, core.point(i));
    Mask is_facing = hn::Ge(h, limit);
    if (i >= core.least()) is_facing = hn::And(is_facing, core.has(i));
    facing.most = max(facing.most, h);
    facing.count = hn::Add(facing.count, hn::IfThenElseZero(is_facing, one));
  }
  return facing;
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

// Whether bit `i` is set: of which corners are meant.
HWY_INLINE Mask has_bit(I bits, size_t i) {
  return hn::RebindMask(FloatTag(), hn::TestBit(bits, hn::Set(IntTag(), 1 << i)));
}

HWY_INLINE I select(Mask mask, I yes, I no) {
  return hn::IfThenElse(hn::RebindMask(IntTag(), mask), yes, no);
}

// Up to three corners, in any of the places; which of them there are differs from lane to lane, a
// bit a place (a mask each costs more than the arithmetic).
struct SimplexLanes {
  std::array<CornerLanes, 3> corner;
  I used;
};

// Whether zero is inside of four corners: if its coordinates in them have one sign.
struct ZeroInside {
  Mask is_inside;
  Mask is_sure;  // and deep enough to be sure

  // `of`: of zero with all corners but the first, the second, the third; `volume`: of the sides
  // from the last one.
  HWY_INLINE ZeroInside(const std::array<F, 3>& of, F volume, const std::array<F3, 4>& corner) {
    const F of_last = hn::Neg(hn::Add(volume, hn::Add(hn::Add(of[0], of[1]), of[2])));
    const F least = min(min(of[0], of[1]), min(of[2], of_last));
    const F most = max(max(of[0], of[1]), max(of[2], of_last));
    const F depth = max(least, hn::Neg(most));
    const auto squared = [&](size_t i) HWY_ATTR { return dot(corner[i], corner[i]); };
    const F size = max(max(squared(0), squared(1)), max(squared(2), squared(3)));
    is_inside = hn::Gt(depth, splat(0));
    is_sure = hn::And(is_inside, hn::Gt(depth, hn::Mul(size, splat(kSureVolume))));
  }
};

// Of a simplex and one more corner: the point nearest to zero, if the new corner is among those
// that span it, and which others do.
struct NearestLanes {
  F3 point;
  F squared;
  I kept;               // a bit a place
  Mask is_around;       // zero lies inside of all four
  Mask is_sure_around;  // and deep enough to be sure
};

// kPlaces: of those of the simplex, how many may be used. The first rounds save most of the work.
template <size_t kPlaces>
class NearestSearch {
 public:
  HWY_INLINE NearestSearch(const SimplexLanes& simplex, const F3& last) : last_(last) {
    best_ = {last, dot(last, last), hn::Zero(IntTag()), no_lanes(), no_lanes()};
    Side p = side_to(simplex, 0);
    if constexpr (kPlaces == 1) {
      try_side(p, hn::Set(IntTag(), 0b001));
    } else {
      Side q = side_to(simplex, 1);
      const Plane pq = try_triangle(p, q, 0b011);
      if constexpr (kPlaces == 2) {
        try_sides(p, q);
      } else {
        Side r = side_to(simplex, 2);
        const F volume = dot(pq.normal, r.way);
        const F height_pr = try_triangle(p, r, 0b101).height;
        const F height_qr = try_triangle(q, r, 0b110).height;
        try_sides(p, q, r);
        const Mask has_four =
            hn::RebindMask(FloatTag(), hn::Eq(simplex.used, hn::Set(IntTag(), 0b111)));
        if (!hn::AllFalse(FloatTag(), has_four)) {
          const auto& corner = simplex.corner;
          const ZeroInside zero({height_qr, hn::Neg(height_pr), pq.height}, volume,
                                {corner[0].point, corner[1].point, corner[2].point, last});
          best_.is_around = hn::And(has_four, zero.is_inside);
          best_.is_sure_around = hn::And(has_four, zero.is_sure);
        }
      }
    }
  }

  HWY_INLINE const NearestLanes& nearest() const { return best_; }

 private:
  // From the last corner to another. Without length where there is none: zero is then neither
  // beside it nor over its triangles.
  struct Side {
    F3 way;
    F along;  // how far zero is along it, times its length
    F squared;
    F towards;  // positive if zero is on its triangles' side of it

    HWY_INLINE Mask has_zero_beside() const {
      return hn::AndNot(hn::Gt(towards, splat(0)),
                        hn::Gt(min(along, hn::Sub(squared, along)), splat(0)));
    }
  };

  // Of a triangle.
  struct Plane {
    F3 normal;
    F height;  // of its corners, from zero
  };

  HWY_INLINE Side side_to(const SimplexLanes& simplex, size_t i) const {
    const F3 way = zero_unless(has_bit(simplex.used, i), simplex.corner[i].point - last_);
    return {way, hn::Neg(dot(last_, way)), dot(way, way), splat(0)};
  }

  // The triangle of two sides; by Lagrange's identity: no more products than dot products of those.
  HWY_INLINE Plane try_triangle(Side& p, Side& q, int32_t kept) {
    const F pq = dot(p.way, q.way);
    const F of_p = hn::Sub(hn::Mul(q.squared, p.along), hn::Mul(q.along, pq));
    const F of_q = hn::Sub(hn::Mul(p.squared, q.along), hn::Mul(p.along, pq));
    p.towards = max(p.towards, of_q);
    q.towards = max(q.towards, of_p);
    const F3 normal = cross(p.way, q.way);
    const F height = dot(normal, last_);
    const F squared_normal = dot(normal, normal);
    const F of_last = hn::Sub(squared_normal, hn::Add(of_p, of_q));
    const F share = hn::Div(height, squared_normal);
    keep(hn::Gt(min(min(of_p, of_q), of_last), splat(0)), normal * share, hn::Mul(share, height),
         hn::Set(IntTag(), kept));
    return {normal, height};
  }

  // The first of them that zero is beside.
  template <class... More>
  HWY_INLINE void try_sides(const Side& p, const Side& q, const More&... r) {
    Side side = p;
    I kept = hn::Set(IntTag(), 0b001);
    const auto put = [&](const Side& other, int32_t bit) HWY_ATTR {
      const Mask is_beside = other.has_zero_beside();
      side.way = select(is_beside, other.way, side.way);
      side.along = hn::IfThenElse(is_beside, other.along, side.along);
      side.squared = hn::IfThenElse(is_beside, other.squared, side.squared);
      side.towards = hn::IfThenElse(is_beside, other.towards, side.towards);
      kept = select(is_beside, hn::Set(IntTag(), bit), kept);
    };
    (put(r, 0b100), ...);
    put(q, 0b010);
    put(p, 0b001);
    try_side(side, kept);
  }

  HWY_INLINE void try_side(const Side& side, I kept) {
    const F3 point = last_ + side.way * hn::Div(side.along, side.squared);
    keep(side.has_zero_beside(), point, dot(point, point), kept);
  }

  HWY_INLINE void keep(Mask is_there, const F3& point, F squared, I kept) {
    const Mask is_nearer = hn::And(is_there, hn::Lt(squared, best_.squared));
    best_.squared = hn::IfThenElse(is_nearer, squared, best_.squared);
    best_.point = select(is_nearer, point, best_.point);
    best_.kept = select(is_nearer, kept, best_.kept);
  }

  const F3 last_;
  NearestLanes best_;
};

struct GjkLanes {
  F3 way;             // from A to B
  F squared;          // of its length
  SimplexLanes ends;  // the corners that span it
  CornerLanes last;   // with three of those: around zero, if that is asked for
  Mask is_apart;      // surely, by more than the radius; found by whoever asks for no more
  F gap;              // there: of the projections on the way, times its length
  Mask is_around;     // zero is surely inside of B - A
  Mask has_ended;     // at the shortest way
};

// The new corner takes the first place that is free.
HWY_INLINE void replace_corners(Mask is_open, I kept, const CornerLanes& next,
                                SimplexLanes& simplex) {
  const I above = hn::Add(kept, hn::Set(IntTag(), 1));
  const I taken = hn::IfThenElseZero(hn::RebindMask(IntTag(), is_open), hn::AndNot(kept, above));
  for (size_t i = 0; i < 3; ++i) {
    simplex.corner[i] = select(has_bit(taken, i), next, simplex.corner[i]);
  }
  simplex.used = select(is_open, hn::Or(kept, taken), simplex.used);
}

// Of searches that only decide.
struct Decision {
  F sure_squared;   // of a gap that surely parts
  bool keeps_last;  // of the corners around zero
};

// One more corner.
template <bool kDecides, size_t kPlaces>
HWY_INLINE void run_round(const CoreLanes& a, const CoreLanes& b, const Decision& decision,
                          GjkLanes& gjk, Mask& is_open) {
  const CornerLanes next = difference_corner(a, b, gjk.way);
  const F gap = dot(gjk.way, next.point);
  if constexpr (kDecides) {
    const Mask is_beyond =
        hn::And(hn::Gt(gap, splat(0)),
                hn::Gt(hn::Mul(gap, gap), hn::Mul(decision.sure_squared, gjk.squared)));
    gjk.is_apart = hn::Or(gjk.is_apart, hn::And(is_open, is_beyond));
    gjk.gap = hn::IfThenElse(is_open, gap, gjk.gap);
    is_open = hn::AndNot(is_beyond, is_open);
  }
  const Mask is_shortest =
      hn::Le(hn::Sub(gjk.squared, gap), hn::Mul(gjk.squared, splat(kLeastProgress)));
  const NearestSearch<kPlaces> search(gjk.ends, next.point);
  const NearestLanes& nearest = search.nearest();
  const Mask is_nearer = hn::Lt(nearest.squared, gjk.squared);
  const Mask is_sure_around = hn::And(is_open, nearest.is_sure_around);
  gjk.is_around = hn::Or(gjk.is_around, is_sure_around);
  if constexpr (kDecides && kPlaces == 3) {
    if (decision.keeps_last) gjk.last = select(is_sure_around, next, gjk.last);
  }
  is_open = hn::AndNot(nearest.is_around, is_open);
  gjk.has_ended = hn::Or(gjk.has_ended, hn::And(is_open, hn::Or(is_shortest, hn::Not(is_nearer))));
  is_open = hn::AndNot(gjk.has_ended, is_open);
  gjk.way = select(is_open, nearest.point, gjk.way);
  gjk.squared = hn::IfThenElse(is_open, nearest.squared, gjk.squared);
  replace_corners(is_open, nearest.kept, next, gjk.ends);
  is_open = hn::And(is_open, hn::Gt(gjk.squared, splat(kNearCores * kNearCores)));
}

// `radius`: of both together. `kDecides`: no more is wanted than who is apart, and with
// `keeps_last` the corners around zero.
template <bool kDecides>
HWY_INLINE GjkLanes run_gjk(const CoreLanes& a, const CoreLanes& b, F radius, bool keeps_last) {
  const Mask none = no_lanes();
  const CornerLanes first = difference_corner(a, b, b.middle - a.middle);
  GjkLanes gjk;
  gjk.way = first.point;
  gjk.squared = dot(gjk.way, gjk.way);
  gjk.ends.corner = {first, first, first};
  gjk.last = first;
  gjk.ends.used = hn::Set(IntTag(), 0b001);
  gjk.is_apart = gjk.is_around = gjk.has_ended = none;
  gjk.gap = splat(0);
  const F sure = hn::Add(radius, splat(kSureGap));
  const Decision decision{hn::Mul(sure, sure), keeps_last};
  Mask is_open = hn::Gt(gjk.squared, splat(kNearCores * kNearCores));
  run_round<kDecides, 1>(a, b, decision, gjk, is_open);
  run_round<kDecides, 2>(a, b, decision, gjk, is_open);
  for (size_t round = 2; round < kMostLaneRounds; ++round) {
    if (hn::AllFalse(FloatTag(), is_open)) break;
    run_round<kDecides, 3>(a, b, decision, gjk, is_open);
  }
  return gjk;
}

// The corners of a simplex that are in use, to the front; behind them anything.
struct FrontCorners {
  CornerLanes p, q, r;
  Mask has_two, has_three;

  explicit HWY_INLINE FrontCorners(const SimplexLanes& simplex) {
    const std::array<Mask, 3> used = {has_bit(simplex.used, 0), has_bit(simplex.used, 1),
                                      has_bit(simplex.used, 2)};
    const auto& corner = simplex.corner;
    has_three = hn::And(hn::And(used[0], used[1]), used[2]);
    has_two = hn::AndNot(
        has_three, hn::Or(hn::And(used[0], used[1]), hn::And(hn::Or(used[0], used[1]), used[2])));
    p = select(used[0], corner[0], select(used[1], corner[1], corner[2]));
    q = select(hn::And(used[0], used[1]), corner[1], corner[2]);
    r = corner[2];
  }
};

HWY_INLINE Mask is_same(const F3& p, const F3& q) {
  return hn::And(hn::Eq(p.x, q.x), hn::And(hn::Eq(p.y, q.y), hn::Eq(p.z, q.z)));
}

// Which point of the core it is, as `is_it` says; of several the first.
template <class IsIt>
HWY_INLINE F place_of(const CoreLanes& core, const IsIt& is_it) {
  F place = splat(0);
  for (size_t i = core.count(); i-- > 0;) {
    place = hn::IfThenElse(is_it(core.point(i)), splat(static_cast<float>(i)), place);
  }
  return place;
}

// Where the cores are nearest to each other.
struct NearestCores {
  F distance;
  F3 normal;  // unit, from A to B
  F3 on_a;
  Mask is_sure;
};

// One to three corners, as far as they differ in the front places, and the way to their difference.
class SpannedWay {
 public:
  // p, and q where there are two, and r where there are three.
  HWY_INLINE SpannedWay(const CornerLanes& p, const CornerLanes& q, const CornerLanes& r,
                        Mask has_two, Mask has_three)
      : p_(p), has_three_(has_three), u_(q.point - p.point), v_(r.point - p.point) {
    // One corner.
    way_ = p.point;
    on_a_ = p.on_a;
    // Two: across the side between them.
    const F uu = dot(u_, u_);
    const F along = hn::Div(hn::Neg(dot(p.point, u_)), uu);
    const F3 on_side = p.point + u_ * along;
    way_ = select(has_two, on_side - u_ * hn::Div(dot(on_side, u_), uu), way_);
    on_a_ = select(has_two, p.on_a + (q.on_a - p.on_a) * along, on_a_);
    // Three: across their plane.
    const F3 n = cross(u_, v_);
    const F nn = dot(n, n);
    const F3 foot = n * hn::Div(dot(n, p.point), nn), along_plane = foot - p.point;
    const F of_q = hn::Div(dot(n, cross(along_plane, v_)), nn);
    const F of_r = hn::Div(dot(n, cross(u_, along_plane)), nn);
    way_ = select(has_three, foot, way_);
    on_a_ =
        select(has_three, (p.on_a + (q.on_a - p.on_a) * of_q) + (r.on_a - p.on_a) * of_r, on_a_);

    is_wide_ =
        hn::And(has_three, hn::Gt(nn, hn::Mul(splat(kSmallCrossing), hn::Mul(uu, dot(v_, v_)))));
    const F zero = splat(0), one = splat(1);
    const Mask is_in_side = hn::And(hn::Gt(along, zero), hn::Lt(along, one));
    const Mask is_in_triangle =
        hn::And(hn::Gt(min(of_q, of_r), zero), hn::Lt(hn::Add(of_q, of_r), one));
    ends_inside_ =
        hn::And(hn::Or(hn::Not(has_two), is_in_side), hn::Or(hn::Not(has_three), is_in_triangle));
    distance_ = hn::Sqrt(dot(way_, way_));
    normal_ = way_ * hn::Div(one, distance_);
  }

  HWY_INLINE F distance() const { return distance_; }
  HWY_INLINE const F3& normal() const { return normal_; }       // unit, from A to B
  HWY_INLINE Mask ends_inside() const { return ends_inside_; }  // of the span of the corners
  // Of a corner's points, along the normal of either.
  HWY_INLINE F height_of_a() const { return dot(normal_, p_.on_a); }
  HWY_INLINE F height_of_b() const { return hn::Neg(dot(normal_, on_b())); }

  // Where the cores are nearest to each other, if they are nowhere nearer; of_a along the normal,
  // of_b against it.
  HWY_INLINE NearestCores confirmed_by(const FacingCount& of_a, const FacingCount& of_b) const {
    const F gap = hn::Neg(hn::Add(of_a.most, of_b.most));
    const Mask is_shortest = hn::Le(hn::Abs(hn::Sub(distance_, gap)), splat(kSameGapInFloat));
    // One point faces the other core, or two edges cross: there is no other place to meet.
    const Mask crosses = hn::And(is_wide_, hn::And(of_a.is_two(), of_b.is_two()));
    const Mask is_unique = hn::Or(hn::Or(of_a.is_one(), of_b.is_one()), crosses);
    F3 on_a = select(of_a.is_one(), p_.on_a, on_a_);
    on_a = select(of_b.is_one(), on_b() - normal_ * distance_, on_a);
    // Rounding tilts the plane of a needle: its corners are not equally far then.
    const Mask is_tilted = hn::AndNot(hn::And(is_level(u_), is_level(v_)), has_three_);
    const Mask is_sure = hn::And(hn::Gt(distance_, splat(kNearCores)),
                                 hn::And(is_shortest, hn::AndNot(is_tilted, is_unique)));
    return {distance_, normal_, on_a, is_sure};
  }

 private:
  HWY_INLINE F3 on_b() const { return p_.point + p_.on_a; }
  HWY_INLINE Mask is_level(const F3& side) const {
    return hn::Le(hn::Abs(dot(normal_, side)), splat(kSameGapInFloat));
  }

  const CornerLanes p_;
  const Mask has_three_;
  const F3 u_, v_;
  F3 way_, on_a_, normal_;
  F distance_;
  Mask is_wide_, ends_inside_;
};

HWY_INLINE NearestCores nearest_cores(const CoreLanes& a, const CoreLanes& b,
                                      const FrontCorners& ends) {
  const SpannedWay way(ends.p, ends.q, ends.r, ends.has_two, ends.has_three);
  return way.confirmed_by(count_facing(a, way.normal(), way.height_of_a()),
                          count_facing(b, -way.normal(), way.height_of_b()));
}

// Writes `count` of the corners, a lane each, as features.
template <size_t kCorners>
HWY_INLINE void write_features(const CoreLanes& a, const CoreLanes& b,
                               const std::array<const CornerLanes*, kCorners>& corners, F count,
                               uint64_t* features) {
  HWY_ALIGN float counts[kLanes];
  HWY_ALIGN float places[2 * kCorners][kLanes];
  hn::Store(count, FloatTag(), counts);
  for (size_t k = 0; k < kCorners; ++k) {
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

// Those that are nearest, where that is sure.
HWY_INLINE void write_features(const CoreLanes& a, const CoreLanes& b, const FrontCorners& ends,
                               Mask is_sure, uint64_t* features) {
  const F count =
      hn::IfThenElse(ends.has_three, splat(3), hn::IfThenElse(ends.has_two, splat(2), splat(1)));
  write_features<3>(a, b, {&ends.p, &ends.q, &ends.r}, hn::IfThenElseZero(is_sure, count),
                    features);
}

// Those around zero, where that is sure.
HWY_INLINE void write_features(const CoreLanes& a, const CoreLanes& b, const GjkLanes& gjk,
                               Mask is_sure, uint64_t* features) {
  const auto& corner = gjk.ends.corner;
  write_features<4>(a, b, {&corner[0], &corner[1], &corner[2], &gjk.last},
                    hn::IfThenElseZero(is_sure, splat(4)), features);
}

// `radius`: of both, of which A has `radius_a`. Whose cores overlap is unsure: depths are found
// elsewhere.
template <class Report>
HWY_INLINE void report_nearest(const NearestCores& nearest, F radius, F radius_a, const F3& d,
                               Report& report) {
  const F separation = hn::Sub(nearest.distance, radius);
  const Mask is_sure = hn::And(nearest.is_sure, hn::Gt(hn::Abs(separation), splat(kSureGap)));
  const F3 arm_a = nearest.on_a + nearest.normal * radius_a;
  const F3 arm_b = (arm_a + nearest.normal * separation) - d;
  report(hn::Le(separation, splat(0)), hn::Not(is_sure), no_lanes(), separation, nearest.normal,
         arm_a, arm_b);
}

// Scales at which float32 may decide. `up`: metres a unit.
HWY_INLINE Mask is_usual_scale(F up) {
  return hn::And(hn::Ge(up, splat(1 / kGreatestScale)), hn::Le(up, splat(kGreatestScale)));
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
    const Mask is_known =
        hn::And(hn::And(core_a.has_space, core_b.has_space), is_usual_scale(report.up));
    const F radius = hn::Add(core_a.radius, core_b.radius);
    uint64_t* const features = report.batch.features ? report.batch.features + report.row : nullptr;
    const GjkLanes gjk = run_gjk<kDecides>(core_a, core_b, radius, features != nullptr);
    if constexpr (kDecides) {
      report_decision(gjk, radius, is_known, report);
      if (features) {
        const Mask is_sure = hn::And(gjk.is_around, hn::And(is_known, report.valid));
        write_features(core_a, core_b, gjk, is_sure, features);
      }
    } else {
      const FrontCorners ends(gjk.ends);
      NearestCores nearest = nearest_cores(core_a, core_b, ends);
      nearest.is_sure = hn::And(nearest.is_sure, hn::And(gjk.has_ended, is_known));
      report_nearest(nearest, radius, core_a.radius, pose.d, report);
      if (features) {
        write_features(core_a, core_b, ends, hn::And(nearest.is_sure, report.valid), features);
      }
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
