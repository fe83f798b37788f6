// Times at which points come within reach of segments, parallelograms, triangles and prisms, one
// pair per lane (rounded_scalar.h is the scalar form).
#if defined(CAROM_IMPACTS_LINEAR_ROUNDED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_LINEAR_ROUNDED_INL_H_
#undef CAROM_IMPACTS_LINEAR_ROUNDED_INL_H_
#else
#define CAROM_IMPACTS_LINEAR_ROUNDED_INL_H_
#endif

#include "impacts/linear/crossing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

HWY_INLINE D meets_segment(const MovingPoint& point, const D3& edge, D reach) {
  return min(meets_edge(point, edge, reach),
             min(meets_ball(point, reach), meets_ball(seen_from(point, edge), reach)));
}

HWY_INLINE D meets_parallelogram(const MovingPoint& point, const D3& u, const D3& v, D reach,
                                 D slack) {
  const Face face(u, v);
  const D edge_reach = hn::Add(reach, face.width());
  const D sides =
      min(meets_edge(point, v, edge_reach), meets_edge(seen_from(point, u), v, edge_reach));
  const D ends =
      min(meets_segment(point, u, edge_reach), meets_segment(seen_from(point, v), u, edge_reach));
  const D inside = meets_face<FaceKind::parallelogram>(point, face, reach, slack);
  return unless_slanted(face.is_slanted, min(inside, min(sides, ends)));
}

HWY_INLINE D meets_triangle(const MovingPoint& point, const Face& face, D reach, D edge_reach,
                            D slack) {
  const MovingPoint from_u = seen_from(point, face.u);
  const D sides =
      min(meets_edge(point, face.v, edge_reach), meets_edge(from_u, face.v - face.u, edge_reach));
  const D rest = min(meets_segment(point, face.u, edge_reach),
                     meets_ball(seen_from(point, face.v), edge_reach));
  return min(meets_face<FaceKind::triangle>(point, face, reach, slack), min(sides, rest));
}

HWY_INLINE DoubleMask pierces(const D3& a, const D3& edge, const Face& face) {
  const D height = dot(face.normal, a), other = hn::Add(height, dot(face.normal, edge));
  const DoubleMask crosses = hn::AndNot(face.is_thin, hn::Lt(hn::Mul(height, other), zero()));
  const D3 at = a + edge * hn::Div(height, hn::Sub(height, other));
  const D along_u = dot(cross(at, face.v), face.normal);
  const D along_v = dot(cross(face.u, at), face.normal);
  const DoubleMask is_in = hn::And(hn::And(hn::Ge(along_u, zero()), hn::Ge(along_v, zero())),
                                   hn::Le(hn::Add(along_u, along_v), face.squared));
  return hn::And(crosses, is_in);
}

HWY_INLINE D meets_prism(const MovingPoint& point, const Face& face, const D3& depth, D reach,
                         D slack) {
  const Face side_u(face.u, depth), side_v(face.v, depth), side_w(face.v - face.u, depth);
  const D width = max(max(face.width(), side_u.width()), max(side_v.width(), side_w.width()));
  const D edge_reach = hn::Add(reach, width);
  const MovingPoint from_u = seen_from(point, face.u);
  const auto side = [&](const MovingPoint& from, const Face& of) HWY_ATTR -> D {
    return meets_face<FaceKind::parallelogram>(from, of, reach, slack);
  };
  const D faces = min(side(point, side_u), min(side(point, side_v), side(from_u, side_w)));
  const D edges = min(meets_edge(point, depth, edge_reach),
                      min(meets_edge(from_u, depth, edge_reach),
                          meets_edge(seen_from(point, face.v), depth, edge_reach)));
  const D front = meets_triangle(point, face, reach, edge_reach, slack);
  const D back = meets_triangle(seen_from(point, depth), face, reach, edge_reach, slack);
  const D first = min(min(faces, edges), min(front, back));
  const DoubleMask is_slanted = hn::Or(hn::Or(face.is_slanted, side_u.is_slanted),
                                       hn::Or(side_v.is_slanted, side_w.is_slanted));
  const D time = hn::IfThenZeroElse(pierces(point.from, -depth, face), first);
  return unless_slanted(is_slanted, time);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_LINEAR_ROUNDED_INL_H_
