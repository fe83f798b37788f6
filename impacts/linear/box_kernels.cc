// Linear times of impact of boxes: against spheres and capsules piece by piece, against boxes and
// triangles by separating axes (linear.h is the scalar form).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "impacts/linear/box_kernels.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "impacts/linear/axes-inl.h"
#include "impacts/linear/box-inl.h"
#include "impacts/linear/linear_load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct SphereBox {
  using A = LinearSphere;
  using B = LinearBox;
  static constexpr LinearKind kKindA = LinearKind::sphere;

  static HWY_INLINE D time(const LinearPair& pair, const A& a, const B& b) {
    const MovingPoint point =
        moving_point(rotate_back(b.turn, -pair.from), rotate_back(b.turn, -pair.way));
    return meets_box(point, b.half, hn::Add(a.radius, pair.slack));
  }
};

struct CapsuleBox {
  using A = LinearCapsule;
  using B = LinearBox;
  static constexpr LinearKind kKindA = LinearKind::capsule;

  static HWY_INLINE D time(const LinearPair& pair, const A& a, const B& b) {
    const MovingPoint point =
        moving_point(rotate_back(b.turn, a.start - pair.from), rotate_back(b.turn, -pair.way));
    return meets_box(point, rotate_back(b.turn, a.edge), b.half, hn::Add(a.radius, pair.slack),
                     pair.slack);
  }
};

struct BoxBox {
  using A = LinearBox;
  using B = LinearBox;
  static constexpr LinearKind kKindA = LinearKind::box;

  static HWY_INLINE D time(const LinearPair& pair, const A& a, const B& b) {
    const RotationOf<D> seen{rotate_back(a.turn, b.turn.x), rotate_back(a.turn, b.turn.y),
                             rotate_back(a.turn, b.turn.z)};
    return boxes_meet({rotate_back(a.turn, pair.from), rotate_back(a.turn, pair.way), a.half,
                       b.half, seen, pair.slack});
  }
};

struct BoxTriangle {
  using A = LinearBox;
  using B = LinearTriangle;
  static constexpr LinearKind kKindA = LinearKind::box;

  static HWY_INLINE D time(const LinearPair& pair, const A& a, const B& b) {
    const auto seen = [&](const D3& corner)
                          HWY_ATTR -> D3 { return rotate_back(a.turn, pair.from + corner); };
    return box_meets_triangle({seen(b.corner[0]), seen(b.corner[1]), seen(b.corner[2]),
                               rotate_back(a.turn, pair.way), a.half, pair.slack});
  }
};

void sphere_box(LinearRows& rows, size_t count) { run_rows<SphereBox>(rows, count); }
void capsule_box(LinearRows& rows, size_t count) { run_rows<CapsuleBox>(rows, count); }
void box_box(LinearRows& rows, size_t count) { run_rows<BoxBox>(rows, count); }
void box_triangle(LinearRows& rows, size_t count) { run_rows<BoxTriangle>(rows, count); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(sphere_box);
HWY_EXPORT(capsule_box);
HWY_EXPORT(box_box);
HWY_EXPORT(box_triangle);

}  // namespace

LinearKernel box_kernel(LinearKind a, LinearKind b) {
  using enum LinearKind;
  if (a == sphere && b == box) return CAROM_DISPATCH(sphere_box);
  if (a == capsule && b == box) return CAROM_DISPATCH(capsule_box);
  if (a == box && b == box) return CAROM_DISPATCH(box_box);
  if (a == box && b == triangle) return CAROM_DISPATCH(box_triangle);
  return nullptr;
}

}  // namespace carom
#endif  // HWY_ONCE
