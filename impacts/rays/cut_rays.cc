// Puts rays into the frame of a mesh and cuts them to its bounds, in lanes of doubles: C. Ericson,
// Real-Time Collision Detection, 2005, section 5.3.3.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "impacts/rays/cut_rays.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <bit>
#include <cfloat>
#include <cmath>

#include "impacts/rays/ray_in_mesh.h"
#include "impacts/rays/ray_lanes-inl.h"
#include "impacts/slack.h"
#include "trees/box_path.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using FloatsOfDoubles = hn::Rebind<float, DoubleTag>;

// A vector of rays after the cut; take() copies one of them.
struct CutRays {
  using Doubles = std::array<double, kDoubleLanes>;
  using Floats = std::array<float, kDoubleLanes>;

  alignas(64) std::array<Doubles, 3> start, way, inverse;
  alignas(64) Doubles travel, lengths, first, last;
  alignas(64) std::array<Floats, 3> lower, upper;

  void take(size_t lane, RayInMesh& ray) const {
    for (size_t axis = 0; axis < 3; ++axis) {
      ray.start[axis] = start[axis][lane];
      ray.way[axis] = way[axis][lane];
      ray.lower[axis] = lower[axis][lane];
      ray.upper[axis] = upper[axis][lane];
      ray.inverse[axis] = static_cast<float>(inverse[axis][lane]);
    }
    ray.travel = travel[lane];
    ray.lengths = lengths[lane];
    ray.first = first[lane];
    ray.last = last[lane];
  }
};

HWY_INLINE void put(D v, CutRays::Doubles& out) { hn::Store(v, DoubleTag(), out.data()); }
// On the scalar target infinite numbers become the largest ones.
HWY_INLINE void put(D v, CutRays::Floats& out) {
  hn::Store(hn::DemoteTo(FloatsOfDoubles(), v), FloatsOfDoubles(), out.data());
}

HWY_INLINE D load(const RayColumns::Column& column, size_t row) {
  return hn::LoadU(DoubleTag(), column.data() + row);
}

class Cutter {
 public:
  Cutter(const RayTarget& target, const Turn& turn) : target_(target), turn_(turn) {}

  // Cuts the rays from row `begin` on. Returns those that may touch the bounds, as bits.
  HWY_INLINE uint32_t cut(const RayColumns& rays, size_t begin, CutRays& out) const {
    const DoubleTag tag;
    const D3 start = in_mesh(rays.from, begin), way = in_mesh(rays.way, begin);
    const D travel = largest_component(way);
    const D lengths =
        hn::Add(hn::Add(largest_component(start), travel), splat_double(target_.greatest));
    const D slack = hn::Add(hn::Mul(splat_double(kPathSlack), lengths), splat_double(FLT_TRUE_MIN));
    const D one = splat_double(1);
    const D3 inverse = {hn::Div(one, way.x), hn::Div(one, way.y), hn::Div(one, way.z)};
    D first = hn::Zero(tag), last = hn::LoadU(tag, rays.limit.data() + begin);
    cut_axis(0, start.x, way.x, inverse.x, slack, first, last);
    cut_axis(1, start.y, way.y, inverse.y, slack, first, last);
    cut_axis(2, start.z, way.z, inverse.z, slack, first, last);
    put(travel, out.travel);
    put(lengths, out.lengths);
    put(first, out.first);
    put(last, out.last);

    const D3 at_first = start + way * first, on_path = way * hn::Sub(last, first);
    const D length = hn::Add(largest_component(at_first), largest_component(on_path));
    // The slack of float32 holds the rounding of what is put, too.
    const D margin = hn::Add(slack, hn::Mul(splat_double(kFloatSlack), length));
    put_axis(0, start.x, way.x, inverse.x, at_first.x, on_path.x, margin, out);
    put_axis(1, start.y, way.y, inverse.y, at_first.y, on_path.y, margin, out);
    put_axis(2, start.z, way.z, inverse.z, at_first.z, on_path.z, margin, out);
    return static_cast<uint32_t>(bits_of(tag, hn::Le(first, last)));
  }

 private:
  // Leaves the times at which points are between the ends of the bounds on an axis. One that stands
  // still there is between them all the time, or never.
  HWY_INLINE void cut_axis(size_t axis, D start, D way, D inverse, D slack, D& first,
                           D& last) const {
    const D zero = hn::Zero(DoubleTag());
    const D to_lower = hn::Sub(hn::Sub(splat_double(target_.lower[axis]), slack), start);
    const D to_upper = hn::Sub(hn::Add(splat_double(target_.upper[axis]), slack), start);
    const D at_lower = hn::Mul(to_lower, inverse), at_upper = hn::Mul(to_upper, inverse);
    const DoubleMask stands = hn::Eq(way, zero);
    const DoubleMask is_outside = hn::Or(hn::Gt(to_lower, zero), hn::Lt(to_upper, zero));
    const D still = hn::IfThenElse(is_outside, splat_double(-1), last);
    first = hn::IfThenElse(stands, first, max(min(at_lower, at_upper), first));
    last = hn::IfThenElse(stands, still, min(max(at_lower, at_upper), last));
  }

  static HWY_INLINE void put_axis(size_t axis, D start, D way, D inverse, D at_first, D on_path,
                                  D margin, CutRays& out) {
    const D zero = hn::Zero(DoubleTag());
    const DoubleMask moves = hn::Ge(hn::Abs(way), splat_double(BoxPath::kLeastDisplacement));
    const D along = hn::IfThenElse(moves, zero, on_path);
    put(start, out.start[axis]);
    put(way, out.way[axis]);
    put(hn::Sub(hn::Add(at_first, min(along, zero)), margin), out.lower[axis]);
    put(hn::Add(hn::Add(at_first, max(along, zero)), margin), out.upper[axis]);
    put(hn::IfThenElse(moves, inverse, splat_double(HUGE_VAL)), out.inverse[axis]);
  }

  // Minus a vector from the point to the mesh, in the mesh's frame.
  HWY_INLINE D3 in_mesh(const std::array<RayColumns::Column, 3>& columns, size_t row) const {
    const D3 v = {load(columns[0], row), load(columns[1], row), load(columns[2], row)};
    return rotate({splat3(turn_[0]), splat3(turn_[1]), splat3(turn_[2])}, -v);
  }

  const RayTarget& target_;
  const Turn& turn_;
};

size_t cut_rays_at_mesh(const RayTarget& target, const Turn& turn, const RayColumns& rays,
                        size_t begin, size_t end, RaySearch* searches) {
  const Cutter cutter(target, turn);
  size_t count = 0;
  for (size_t i = begin; i < end; i += kDoubleLanes) {
    CutRays cut;
    const uint32_t is_there = end - i < kDoubleLanes ? (1u << (end - i)) - 1 : ~0u;
    for (uint32_t bits = cutter.cut(rays, i, cut) & is_there; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(bits));
      RaySearch& search = searches[count++];
      search.row = i + lane;
      search.limit = rays.limit[i + lane];
      search.ray.mesh = target.mesh;
      search.ray.one_sided = target.one_sided;
      cut.take(lane, search.ray);
    }
  }
  return count;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(cut_rays_at_mesh);

}  // namespace

size_t cut_rays(const RayTarget& target, const Turn& turn, const RayColumns& rays, size_t begin,
                size_t end, RaySearch* searches) {
  return CAROM_DISPATCH(cut_rays_at_mesh)(target, turn, rays, begin, end, searches);
}

}  // namespace carom
#endif  // HWY_ONCE
