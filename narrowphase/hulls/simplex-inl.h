// Simplices of B - A in lanes, and their point nearest to zero.
#if defined(CAROM_NARROWPHASE_HULLS_SIMPLEX_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_SIMPLEX_INL_H_
#undef CAROM_NARROWPHASE_HULLS_SIMPLEX_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_SIMPLEX_INL_H_
#endif

#include <array>

#include "base/tolerances.h"
#include "narrowphase/batch/shape_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// A corner of B - A, and the point of A that it belongs to.
struct CornerLanes {
  F3 point, on_a;
};

HWY_INLINE CornerLanes select(Mask mask, const CornerLanes& yes, const CornerLanes& no) {
  return {select(mask, yes.point, no.point), select(mask, yes.on_a, no.on_a)};
}

// Whether bit `i` is set. Each bit stands for a corner.
HWY_INLINE Mask has_bit(I bits, size_t i) {
  return hn::RebindMask(FloatTag(), hn::TestBit(bits, hn::Set(IntTag(), 1 << i)));
}

HWY_INLINE I select(Mask mask, I yes, I no) {
  return hn::IfThenElse(hn::RebindMask(IntTag(), mask), yes, no);
}

// Up to three corners, in any places. `used` has a bit per place, because the used places differ
// from lane to lane and a mask for each costs more than the arithmetic.
struct SimplexLanes {
  std::array<CornerLanes, 3> corner;
  I used;
};

// Whether zero is inside the tetrahedron of four corners: its barycentric coordinates have one
// sign.
struct ZeroInside {
  Mask is_inside;
  Mask is_sure;  // and deeper than float32 rounding

  // `of[i]`: volume of zero with all corners but the i-th. `volume`: of the whole tetrahedron, from
  // the sides at its last corner. Six times the volume, signed.
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

// The point nearest to zero among all faces, sides and the corner itself that hold the new corner,
// and the old corners that span it too.
struct NearestLanes {
  F3 point;
  F squared;
  I kept;               // a bit per place
  Mask is_around;       // zero lies inside the tetrahedron
  Mask is_sure_around;  // and deeper than float32 rounding
};

// kPlaces: how many places of the simplex may be used. The first rounds use fewer, which saves most
// of their work.
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
  // From the last corner to another one. An unused place gives a side without length: zero is then
  // neither beside it nor over its triangles.
  struct Side {
    F3 way;
    F along;  // projection of zero on the side, times its length
    F squared;
    F towards;  // positive if zero is on the inner side of it in some triangle

    HWY_INLINE Mask has_zero_beside() const {
      return hn::AndNot(hn::Gt(towards, splat(0)),
                        hn::Gt(min(along, hn::Sub(squared, along)), splat(0)));
    }
  };

  struct Plane {
    F3 normal;
    F height;  // of the plane over zero, times the normal's length
  };

  HWY_INLINE Side side_to(const SimplexLanes& simplex, size_t i) const {
    const F3 way = zero_unless(has_bit(simplex.used, i), simplex.corner[i].point - last_);
    return {way, hn::Neg(dot(last_, way)), dot(way, way), splat(0)};
  }

  // Tries the triangle of two sides. Lagrange's identity needs only dot products of the sides.
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

  // Tries the first side that has zero beside it.
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

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_SIMPLEX_INL_H_
