// Proofs of the decision about a pair, in lanes of doubles: a direction along which the shapes
// are apart, or a point that lies in both, by more than rounding. Neither trusts the kernel that
// found it. narrowphase/proof/proof.h does the same one pair at a time.
#if defined(CAROM_NARROWPHASE_BATCH_CERTIFICATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_CERTIFICATE_INL_H_
#undef CAROM_NARROWPHASE_BATCH_CERTIFICATE_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_CERTIFICATE_INL_H_
#endif

#include "base/tolerances.h"
#include "narrowphase/batch/shape_lanes-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Shapes in scaled units, turned as the world is, about the position of A.
//   highest(n)  the greatest height over that position, along n
//   holds(p)    whether the point lies inside by more than rounding

class PlacedCapsule {
 public:
  HWY_INLINE PlacedCapsule(const CapsuleOf<D>& capsule, const QuaternionOf<D>& q, const D3& at)
      : radius_(capsule.radius) {
    const RotationOf<D> turn = rotation_of(q);
    ends_[0] = rotate(turn, capsule.a) + at;
    ends_[1] = rotate(turn, capsule.b) + at;
  }

  HWY_INLINE D highest(const D3& n) const {
    return hn::Add(max(dot(n, ends_[0]), dot(n, ends_[1])), radius_);
  }
  HWY_INLINE DoubleMask holds(const D3& p) const {
    const D zero = splat_double(0), one = splat_double(1);
    const D3 axis = ends_[1] - ends_[0], way = p - ends_[0];
    const D squared = dot(axis, axis);
    const D share = hn::IfThenElseZero(hn::Gt(squared, zero), hn::Div(dot(axis, way), squared));
    const D3 aside = way - axis * clamp(share, zero, one);
    const D within = hn::Sub(radius_, splat_double(kProvenGap));
    return hn::And(hn::Gt(within, zero), hn::Lt(dot(aside, aside), hn::Mul(within, within)));
  }

 private:
  D3 ends_[2];
  D radius_;
};

class PlacedBox {
 public:
  HWY_INLINE PlacedBox(const BoxOf<D>& box, const QuaternionOf<D>& q, const D3& at)
      : turn_(rotation_of(q)), middle_(at), half_(box.half) {}

  HWY_INLINE D highest(const D3& n) const {
    const D3 own = rotate_back(turn_, n);
    return hn::Add(dot(n, middle_), dot(half_, D3{hn::Abs(own.x), hn::Abs(own.y), hn::Abs(own.z)}));
  }
  HWY_INLINE DoubleMask holds(const D3& p) const {
    const D3 x = rotate_back(turn_, p - middle_);
    const D3 within = half_ - D3{hn::Abs(x.x), hn::Abs(x.y), hn::Abs(x.z)};
    return hn::Gt(min(min(within.x, within.y), within.z), splat_double(kProvenGap));
  }

 private:
  RotationOf<D> turn_;
  D3 middle_, half_;
};

class PlacedAabb {
 public:
  HWY_INLINE PlacedAabb(const AabbOf<D>& box, const QuaternionOf<D>&, const D3& at)
      : lower_(box.lower + at), upper_(box.upper + at) {}

  HWY_INLINE D highest(const D3& n) const {
    const D3 low = {hn::Mul(n.x, lower_.x), hn::Mul(n.y, lower_.y), hn::Mul(n.z, lower_.z)};
    const D3 high = {hn::Mul(n.x, upper_.x), hn::Mul(n.y, upper_.y), hn::Mul(n.z, upper_.z)};
    return hn::Add(hn::Add(max(low.x, high.x), max(low.y, high.y)), max(low.z, high.z));
  }
  HWY_INLINE DoubleMask holds(const D3& p) const {
    const D3 above = p - lower_, below = upper_ - p;
    const D3 within = {min(above.x, below.x), min(above.y, below.y), min(above.z, below.z)};
    return hn::Gt(min(min(within.x, within.y), within.z), splat_double(kProvenGap));
  }

 private:
  D3 lower_, upper_;
};

// Without thickness: it holds no point.
class PlacedTriangle {
 public:
  HWY_INLINE PlacedTriangle(const TriangleOf<D>& triangle, const QuaternionOf<D>& q, const D3& at) {
    const RotationOf<D> turn = rotation_of(q);
    corners_[0] = rotate(turn, triangle.a) + at;
    corners_[1] = rotate(turn, triangle.b) + at;
    corners_[2] = rotate(turn, triangle.c) + at;
  }

  HWY_INLINE D highest(const D3& n) const {
    return max(max(dot(n, corners_[0]), dot(n, corners_[1])), dot(n, corners_[2]));
  }

  // The point itself, up to rounding, if it lies in the triangle; some point of the triangle in any
  // case, since its weights are not negative.
  HWY_INLINE D3 point_near(const D3& p) const {
    const D3 u = corners_[1] - corners_[0], v = corners_[2] - corners_[0], way = p - corners_[0];
    const D3 n = cross(u, v);
    const D zero = splat_double(0);
    const D of_b = max(dot(cross(way, v), n), zero), of_c = max(dot(cross(u, way), n), zero);
    const D of_a = max(hn::Sub(hn::Sub(dot(n, n), of_b), of_c), zero);
    const D sum = hn::Add(hn::Add(of_a, of_b), of_c);
    return corners_[0] + (u * hn::Div(of_b, sum) + v * hn::Div(of_c, sum));
  }

  // Whether an edge of the other one passes through this one.
  HWY_INLINE DoubleMask is_pierced_by(const PlacedTriangle& other) const {
    const D3 n = cross(corners_[1] - corners_[0], corners_[2] - corners_[0]);
    const D heights[] = {dot(n, other.corners_[0] - corners_[0]),
                         dot(n, other.corners_[1] - corners_[0]),
                         dot(n, other.corners_[2] - corners_[0])};
    DoubleMask is_pierced = no_lanes_of<D>();
    for (size_t i = 0; i < 3; ++i) {
      const size_t next = (i + 1) % 3;
      const D low = min(heights[i], heights[next]), high = max(heights[i], heights[next]);
      const DoubleMask passes_plane = hn::And(hn::Lt(low, splat_double(-kProvenVolume)),
                                              hn::Gt(high, splat_double(kProvenVolume)));
      const DoubleMask is_hit = hn::And(
          passes_plane, surround(other.corners_[i], other.corners_[next] - other.corners_[i]));
      is_pierced = hn::Or(is_pierced, is_hit);
    }
    return is_pierced;
  }

 private:
  // Whether the edges go around the line.
  HWY_INLINE DoubleMask surround(const D3& start, const D3& way) const {
    const D3 r[] = {corners_[0] - start, corners_[1] - start, corners_[2] - start};
    const D sides[] = {dot(way, cross(r[0], r[1])), dot(way, cross(r[1], r[2])),
                       dot(way, cross(r[2], r[0]))};
    const D low = min(min(sides[0], sides[1]), sides[2]);
    const D high = max(max(sides[0], sides[1]), sides[2]);
    return hn::Or(hn::Gt(low, splat_double(kProvenVolume)),
                  hn::Lt(high, splat_double(-kProvenVolume)));
  }

  D3 corners_[3];
};

HWY_INLINE PlacedCapsule placed(const CapsuleOf<D>& shape, const QuaternionOf<D>& q, const D3& at) {
  return {shape, q, at};
}
HWY_INLINE PlacedBox placed(const BoxOf<D>& shape, const QuaternionOf<D>& q, const D3& at) {
  return {shape, q, at};
}
HWY_INLINE PlacedAabb placed(const AabbOf<D>& shape, const QuaternionOf<D>& q, const D3& at) {
  return {shape, q, at};
}
HWY_INLINE PlacedTriangle placed(const TriangleOf<D>& shape, const QuaternionOf<D>& q,
                                 const D3& at) {
  return {shape, q, at};
}

// Whether B is above A along a direction of unit length. Radii count in full, so the length may be
// off by less than the room for rounding.
template <class A, class B>
HWY_INLINE DoubleMask are_apart(const A& a, const B& b, const D3& n) {
  const D gap = hn::Neg(hn::Add(a.highest(n), b.highest(-n)));
  const D off = hn::Abs(hn::Sub(dot(n, n), splat_double(1)));
  return hn::And(hn::Gt(gap, splat_double(kProvenGap)), hn::Lt(off, splat_double(kUnitSquare)));
}

// Whether there is a common point near two points, on A and on B.
template <class A, class B>
HWY_INLINE DoubleMask have_common_point(const A& a, const B& b, const D3& on_a, const D3& on_b) {
  const D3 middle = (on_a + on_b) * splat_double(0.5);
  return hn::And(a.holds(middle), b.holds(middle));
}
template <class A>
HWY_INLINE DoubleMask have_common_point(const A& a, const PlacedTriangle& b, const D3&,
                                        const D3& on_b) {
  return a.holds(b.point_near(on_b));
}
HWY_INLINE DoubleMask have_common_point(const PlacedTriangle& a, const PlacedTriangle& b, const D3&,
                                        const D3&) {
  return hn::Or(a.is_pierced_by(b), b.is_pierced_by(a));
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_CERTIFICATE_INL_H_
