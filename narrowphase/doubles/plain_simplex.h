// The point of a simplex that is nearest to zero, by the plain way: the first side or face at the
// last corner that has zero over it. It says where rounding could decide, and nearest_way() or
// another careful search has to. It takes a third of the time of NearestPoint, and runs in lanes as
// well (plain_simplex-inl.h).
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 9.5.2 (which parts of a simplex
// can be nearest).
#pragma once

#include <array>

#include "narrowphase/doubles/core.h"
#include "narrowphase/doubles/sliver_cross.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

// Up to three corners of B - A, in any places.
struct PlainSimplex {
  std::array<CoreVector, 3> corner{};
  unsigned used = 0;  // a bit for each place

  // Keeps these places, and puts the corner in the first that is free.
  void replace(unsigned kept, const CoreVector& next) {
    const unsigned taken = (kept + 1) & ~kept;
    for (size_t i = 0; i < 3; ++i) {
      if (taken >> i & 1) corner[i] = next;
    }
    used = kept | taken;
  }

  bool holds(const CoreVector& point) const {
    for (size_t i = 0; i < 3; ++i) {
      const CoreVector& p = corner[i];
      if ((used >> i & 1) && p.x == point.x && p.y == point.y && p.z == point.z) return true;
    }
    return false;
  }
};

// Zero is surely inside a tetrahedron if the volumes that it spans with the corners all exceed this
// share of the squared distance of the furthest corner.
inline constexpr double kSurelyInside = 0x1p-36;

class PlainNearest {
 public:
  CoreVector point;
  double squared;
  unsigned kept = 0;        // places of the corners that span the point beside the last one
  bool is_around = false;   // zero is surely inside the tetrahedron
  bool is_unclear = false;  // rounding decides

  // `sliver`: the squared sine between the sides of a triangle below which rounding decides.
  PlainNearest(const PlainSimplex& simplex, const CoreVector& last, double sliver = kSliverSquared)
      : point(last), squared(dot(last, last)), last_(last), sliver_(sliver) {
    std::array<Side, 3> side;
    for (size_t i = 0; i < 3; ++i) side[i] = side_to(simplex, i);
    const Plane pq = try_triangle(side[0], side[1], 0b011);
    const Plane pr = try_triangle(side[0], side[2], 0b101);
    const Plane qr = try_triangle(side[1], side[2], 0b110);
    try_sides(side);
    if (simplex.used == 0b111) {
      look_inside(simplex, dot(pq.normal, side[2].way), {qr.height, -pr.height, pq.height});
    }
  }

 private:
  // From the last corner to another one.
  struct Side {
    CoreVector way{};
    double along = 0;  // projection of zero on the side, times its length
    double squared = 0;
    bool is_used = false;
    double towards = 0;  // positive if zero is on the inner side of it in some triangle

    bool has_zero_beside() const { return min(along, squared - along) > 0 && !(towards > 0); }
  };
  struct Plane {
    CoreVector normal;
    double height = 0;  // of the plane over zero, times the normal's length
  };

  Side side_to(const PlainSimplex& simplex, size_t i) const {
    if (!(simplex.used >> i & 1)) return {};
    const CoreVector way = simplex.corner[i] - last_;
    return {way, -dot(last_, way), dot(way, way), true};
  }

  Plane try_triangle(Side& p, Side& q, unsigned places) {
    if (!p.is_used || !q.is_used) return {};
    const CoreVector normal = cross(p.way, q.way);
    const double height = dot(normal, last_), squared_normal = dot(normal, normal);
    const CoreVector across = cross(normal, last_);
    const double of_p = -dot(across, q.way), of_q = dot(across, p.way);
    p.towards = max(p.towards, of_q);
    q.towards = max(q.towards, of_p);
    const bool is_over = min(min(of_p, of_q), squared_normal - (of_p + of_q)) > 0;
    const double share = height / squared_normal;
    const bool is_sliver = !(squared_normal > sliver_ * (p.squared * q.squared));
    if (is_over) keep(normal * share, share * height, places, is_sliver);
    return {normal, height};
  }

  void try_sides(const std::array<Side, 3>& sides) {
    for (size_t i = 0; i < 3; ++i) {
      const Side& side = sides[i];
      if (!side.is_used || !side.has_zero_beside()) continue;
      const double inverse = 1 / side.squared;
      const CoreVector beside = last_ + side.way * (side.along * inverse);
      // The part along the side is rounding: for a short vector it is most of the error.
      const CoreVector across = beside - side.way * (dot(beside, side.way) * inverse);
      return keep(across, dot(across, across), 1u << i, false);
    }
  }

  // `of[i]`: volume of zero with all corners but the i-th. `volume`: of the tetrahedron. Six times
  // the volume, signed.
  void look_inside(const PlainSimplex& simplex, double volume, const std::array<double, 3>& of) {
    const double of_last = -(volume + ((of[0] + of[1]) + of[2]));
    const double least = min(min(of[0], of[1]), min(of[2], of_last));
    const double most = max(max(of[0], of[1]), max(of[2], of_last));
    const double depth = max(least, -most);
    const auto far = [&](size_t i) { return dot(simplex.corner[i], simplex.corner[i]); };
    const double size = max(max(far(0), far(1)), max(far(2), dot(last_, last_)));
    is_around = depth > size * kSurelyInside;
    is_unclear = is_unclear || depth > 0;
  }

  void keep(const CoreVector& nearer, double its_squared, unsigned places, bool is_sliver) {
    if (!(its_squared < squared)) return;
    squared = its_squared;
    point = nearer;
    kept = places;
    is_unclear = is_sliver;
  }

  CoreVector last_;
  double sliver_;
};

}  // namespace carom::scalar
