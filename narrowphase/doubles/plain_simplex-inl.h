// Simplices of B - A in lanes of doubles, and their point nearest to zero
// (narrowphase/doubles/plain_simplex.h is the scalar form and has the source).
#if defined(CAROM_NARROWPHASE_DOUBLES_PLAIN_SIMPLEX_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_DOUBLES_PLAIN_SIMPLEX_INL_H_
#undef CAROM_NARROWPHASE_DOUBLES_PLAIN_SIMPLEX_INL_H_
#else
#define CAROM_NARROWPHASE_DOUBLES_PLAIN_SIMPLEX_INL_H_
#endif

#include <array>

#include "narrowphase/doubles/plain_simplex.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// A bit for each place of a corner, in every lane.
using PlaceTag = hn::RebindToSigned<DoubleTag>;
using Places = hn::Vec<PlaceTag>;

HWY_INLINE Places places(int64_t bits) { return hn::Set(PlaceTag(), bits); }
HWY_INLINE DoubleMask has_place(Places bits, size_t i) {
  return hn::RebindMask(DoubleTag(), hn::TestBit(bits, places(int64_t{1} << i)));
}
HWY_INLINE Places select(DoubleMask mask, Places yes, Places no) {
  return hn::IfThenElse(hn::RebindMask(PlaceTag(), mask), yes, no);
}

HWY_INLINE DoubleMask are_same(const D3& p, const D3& q) {
  return hn::And(hn::Eq(p.x, q.x), hn::And(hn::Eq(p.y, q.y), hn::Eq(p.z, q.z)));
}

// Up to three points in each lane, in any places.
struct PlainSimplexLanes {
  std::array<D3, 3> corner;
  Places used;

  explicit HWY_INLINE PlainSimplexLanes(const D3& first)
      : corner{first, first, first}, used(places(0b001)) {}

  // Whether it is one of those in the first `kPlaces` places.
  template <size_t kPlaces>
  HWY_INLINE DoubleMask holds(const D3& point) const {
    DoubleMask holds = no_lanes_of<D>();
    for (size_t i = 0; i < kPlaces; ++i) {
      holds = hn::Or(holds, hn::And(has_place(used, i), are_same(corner[i], point)));
    }
    return holds;
  }
  // As scalar::PlainSimplex::replace(), in these lanes.
  HWY_INLINE void replace(DoubleMask lanes, Places kept, const D3& next) {
    const Places taken = hn::AndNot(kept, hn::Add(kept, places(1)));
    for (size_t i = 0; i < 3; ++i) {
      corner[i] = select(hn::And(lanes, has_place(taken, i)), next, corner[i]);
    }
    used = select(lanes, hn::Or(kept, taken), used);
  }
};

// The point nearest to zero among all faces, sides and the corner itself that hold the last corner.
struct PlainNearestLanes {
  D3 point;
  D squared;
  Places kept;
  DoubleMask is_around, is_unclear;
};

// The used corners are in the first `kPlaces` places.
template <size_t kPlaces = 3>
class PlainSearch {
 public:
  // `sliver`: as that of scalar::PlainNearest.
  HWY_INLINE PlainSearch(const std::array<D3, 3>& corner, Places used, const D3& last,
                         double sliver = kSliverSquared)
      : last_(last), zero_(hn::Zero(DoubleTag())), sliver_(sliver) {
    best_ = {last, dot(last, last), places(0), no_lanes_of<D>(), no_lanes_of<D>()};
    search(corner, used);
  }

  HWY_INLINE const PlainNearestLanes& nearest() const { return best_; }

 private:
  // An unused place gives a side without length: zero is then neither beside it nor over its
  // triangles.
  struct Side {
    D3 way;
    D along, squared, towards;

    HWY_INLINE DoubleMask has_zero_beside() const {
      const D zero = hn::Zero(DoubleTag());
      return hn::AndNot(hn::Gt(towards, zero), hn::Gt(min(along, hn::Sub(squared, along)), zero));
    }
  };
  struct Plane {
    D3 normal;
    D height;
  };

  HWY_INLINE void search(const std::array<D3, 3>& corner, Places used) {
    Side p = side_to(corner[0], has_place(used, 0));
    if constexpr (kPlaces == 1) return try_side(p, places(0b001));
    Side q = side_to(corner[1], has_place(used, 1));
    const Plane pq = try_triangle(p, q, 0b011);
    if constexpr (kPlaces == 2) return try_sides(p, q);
    Side r = side_to(corner[2], has_place(used, 2));
    const Plane pr = try_triangle(p, r, 0b101);
    const Plane qr = try_triangle(q, r, 0b110);
    try_sides(p, q, r);
    const DoubleMask has_four = hn::RebindMask(DoubleTag(), hn::Eq(used, places(0b111)));
    if (hn::AllFalse(DoubleTag(), has_four)) return;
    look_inside(corner, has_four, dot(pq.normal, r.way),
                {qr.height, hn::Neg(pr.height), pq.height});
  }

  HWY_INLINE Side side_to(const D3& corner, DoubleMask is_used) const {
    const D3 way = zero_unless(is_used, corner - last_);
    return {way, hn::Neg(dot(last_, way)), dot(way, way), zero_};
  }

  HWY_INLINE Plane try_triangle(Side& p, Side& q, int64_t kept) {
    const D3 normal = cross(p.way, q.way);
    const D height = dot(normal, last_), squared_normal = dot(normal, normal);
    const D3 across = cross(normal, last_);
    const D of_p = hn::Neg(dot(across, q.way)), of_q = dot(across, p.way);
    p.towards = max(p.towards, of_q);
    q.towards = max(q.towards, of_p);
    const DoubleMask is_over =
        hn::Gt(min(min(of_p, of_q), hn::Sub(squared_normal, hn::Add(of_p, of_q))), zero_);
    const D share = hn::Div(height, squared_normal);
    const DoubleMask is_sliver = hn::Not(
        hn::Gt(squared_normal, hn::Mul(splat_double(sliver_), hn::Mul(p.squared, q.squared))));
    keep(is_over, normal * share, hn::Mul(share, height), places(kept), is_sliver);
    return {normal, height};
  }

  // The first side that has zero beside it.
  template <class... Sides>
  HWY_INLINE void try_sides(const Side& p, const Side& q, const Sides&... r) {
    Side side = p;
    Places kept = places(0b001);
    const auto put = [&](const Side& other, int64_t bit) HWY_ATTR {
      const DoubleMask is_beside = other.has_zero_beside();
      side.way = select(is_beside, other.way, side.way);
      side.along = hn::IfThenElse(is_beside, other.along, side.along);
      side.squared = hn::IfThenElse(is_beside, other.squared, side.squared);
      side.towards = hn::IfThenElse(is_beside, other.towards, side.towards);
      kept = select(is_beside, places(bit), kept);
    };
    (put(r, 0b100), ...);
    put(q, 0b010);
    put(p, 0b001);
    try_side(side, kept);
  }

  HWY_INLINE void try_side(const Side& side, Places kept) {
    const D inverse = hn::Div(splat_double(1), side.squared);
    const D3 beside = last_ + side.way * hn::Mul(side.along, inverse);
    const D3 across = beside - side.way * hn::Mul(dot(beside, side.way), inverse);
    keep(side.has_zero_beside(), across, dot(across, across), kept, no_lanes_of<D>());
  }

  HWY_INLINE void look_inside(const std::array<D3, 3>& corner, DoubleMask has_four, D volume,
                              const std::array<D, 3>& of) {
    const D of_last = hn::Neg(hn::Add(volume, hn::Add(hn::Add(of[0], of[1]), of[2])));
    const D least = min(min(of[0], of[1]), min(of[2], of_last));
    const D most = max(max(of[0], of[1]), max(of[2], of_last));
    const D depth = max(least, hn::Neg(most));
    const auto far = [&](size_t i) HWY_ATTR { return dot(corner[i], corner[i]); };
    const D size = max(max(far(0), far(1)), max(far(2), dot(last_, last_)));
    best_.is_around =
        hn::And(has_four, hn::Gt(depth, hn::Mul(size, splat_double(scalar::kSurelyInside))));
    best_.is_unclear = hn::Or(best_.is_unclear, hn::And(has_four, hn::Gt(depth, zero_)));
  }

  HWY_INLINE void keep(DoubleMask is_there, const D3& point, D squared, Places kept,
                       DoubleMask is_sliver) {
    const DoubleMask is_nearer = hn::And(is_there, hn::Lt(squared, best_.squared));
    best_.squared = hn::IfThenElse(is_nearer, squared, best_.squared);
    best_.point = select(is_nearer, point, best_.point);
    best_.kept = select(is_nearer, kept, best_.kept);
    best_.is_unclear =
        hn::Or(hn::AndNot(is_nearer, best_.is_unclear), hn::And(is_nearer, is_sliver));
  }

  const D3 last_;
  const D zero_;
  const double sliver_;
  PlainNearestLanes best_;
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_DOUBLES_PLAIN_SIMPLEX_INL_H_
