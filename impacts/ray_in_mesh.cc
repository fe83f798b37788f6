// Walks the tree of a mesh along a ray, eight boxes at once, and tests triangles in double
// precision: C. Ericson, Real-Time Collision Detection, 2005, sections 5.3.3 and 5.3.6, with bounds
// on the rounding of each number.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "impacts/ray_in_mesh.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <bit>
#include <utility>

#include "impacts/ray_in_mesh.h"
#include "impacts/ray_window.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using Step = RayScratch::Step;
using ChildTag = hn::CappedTag<float, BoxTree::kChildren>;
using Children = hn::Vec<ChildTag>;
inline constexpr size_t kChildLanes = hn::MaxLanes(ChildTag());

HWY_INLINE Children child_splat(float value) { return hn::Set(ChildTag(), value); }

// A bound on the rounding of times: a difference, a reciprocal and a product.
inline constexpr float kTimeRounding = 0x1p-20f;
// A bound on what products lose by underflow.
inline constexpr float kTinyTime = 0x1p-100f;

// A time after ray.first, rounded upwards.
HWY_INLINE float limit_on_path(const RayInMesh& ray, double limit) {
  return static_cast<float>((limit - ray.first) * (1 + 2.0 * kTimeRounding) + kTinyTime);
}

class RayWalk {
 public:
  HWY_INLINE RayWalk(const RayInMesh& ray, double limit, bool any, RayScratch& scratch)
      : ray_(ray),
        nodes_(ray.mesh->tree().nodes().data()),
        limit_(std::min(limit, ray.last)),
        limit_on_path_(limit_on_path(ray, limit_)),
        any_(any),
        scratch_(scratch) {}

  // Whether it found what `any` asks for.
  HWY_INLINE bool run() {
    uint32_t node = 0;
    size_t waiting = 0;
    for (;;) {
      if (scratch_.steps.size() < waiting + BoxTree::kChildren) {
        scratch_.steps.resize(2 * waiting + 8 * BoxTree::kChildren);
      }
      Step* const steps = scratch_.steps.data();
      Step* const end = expand(nodes_[node], steps + waiting);
      if (is_found_) return true;
      waiting = static_cast<size_t>(end - steps);
      do {
        if (waiting == 0) return false;
        --waiting;
      } while (steps[waiting].key > limit_on_path_);
      node = steps[waiting].child;
    }
  }

  double limit() const { return limit_; }

 private:
  // Tests triangles, and adds the nodes that the ray meets, the nearest last.
  HWY_INLINE Step* expand(const BoxTree::Node& node, Step* const begin) {
    const ChildTag tag;
    Step* end = begin;
    for (size_t i = 0; i < BoxTree::kChildren; i += kChildLanes) {
      Children entry = hn::Zero(tag), exit = child_splat(limit_on_path_);
      for (size_t axis = 0; axis < 3; ++axis) {
        const bool forwards = ray_.inverse[axis] >= 0;
        const float* const near = forwards ? node.lower[axis] : node.upper[axis];
        const float* const far = forwards ? node.upper[axis] : node.lower[axis];
        const Children inverse = child_splat(ray_.inverse[axis]);
        const Children from_near = child_splat(forwards ? ray_.upper[axis] : ray_.lower[axis]);
        const Children from_far = child_splat(forwards ? ray_.lower[axis] : ray_.upper[axis]);
        // Zero times infinity is NaN, and keeps the other value.
        entry = max(hn::Mul(hn::Sub(hn::Load(tag, near + i), from_near), inverse), entry);
        exit = min(hn::Mul(hn::Sub(hn::Load(tag, far + i), from_far), inverse), exit);
      }
      const Children key = hn::Mul(entry, child_splat(1 - kTimeRounding));
      const Children latest =
          hn::Add(hn::Mul(exit, child_splat(1 + kTimeRounding)), child_splat(kTinyTime));
      uint8_t mask[8] = {};
      hn::StoreMaskBits(tag, hn::Le(key, latest), mask);
      uint32_t bits = mask[0] & ((1u << kChildLanes) - 1);
      if (bits == 0) continue;
      alignas(64) float keys[kChildLanes];
      hn::Store(key, tag, keys);
      for (; bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<size_t>(std::countr_zero(bits));
        const uint32_t child = node.child[i + lane];
        if (child >= BoxTree::kItem) {
          test(child - BoxTree::kItem);
          if (is_found_) return end;
        } else {
          end = insert({keys[lane], child}, begin, end);
        }
      }
    }
    return end;
  }

  // Keeps steps sorted by falling keys, since the last step is taken next.
  static HWY_INLINE Step* insert(const Step& step, Step* begin, Step* end) {
    Step* hole = end;
    for (; hole > begin && hole[-1].key < step.key; --hole) *hole = hole[-1];
    *hole = step;
    return end + 1;
  }

  HWY_INLINE void test(uint32_t triangle) {
    RayWindow window;
    if (!window_of(ray_, triangle, window) || window.earliest > limit_) return;
    scratch_.candidates.push_back({triangle, window.earliest});
    if (!window.is_sure || window.latest > limit_) return;
    limit_ = window.latest;
    limit_on_path_ = limit_on_path(ray_, limit_);
    is_found_ = any_;
  }

  const RayInMesh& ray_;
  const BoxTree::Node* const nodes_;
  double limit_;
  float limit_on_path_;
  const bool any_;
  bool is_found_ = false;
  RayScratch& scratch_;
};

bool walk_ray(const RayInMesh& ray, double limit, bool any, RayScratch& scratch) {
  scratch.candidates.clear();
  RayWalk walk(ray, limit, any, scratch);
  if (walk.run()) return true;
  std::erase_if(scratch.candidates, [&](const RayCandidate& candidate) {
    return candidate.earliest > walk.limit();
  });
  return false;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <cfloat>
#include <cmath>

#include "base/outward.h"
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(walk_ray);

// Rays and tests are off by less than this share of all lengths.
constexpr double kPathSlack = 0x1p-33;
// What float32 makes of a path, as a share of the lengths on it.
constexpr double kFloatSlack = 0x1p-20;
// Longer paths are left to the search in double precision.
constexpr double kLongestPath = 0x1p100;
// The reciprocal of a smaller displacement would be near the end of the range of float32, or
// beyond.
constexpr double kLeastDisplacement = 0x1p-120;

}  // namespace

bool RayInMesh::set(const Double3& from, const Double3& displacement, double limit) {
  start = from;
  way = displacement;
  first = 0;
  last = limit;
  travel = greatest(way);
  lengths = greatest(start) + travel;
  double of_mesh = 0;
  for (int axis = 0; axis < 3; ++axis) {
    of_mesh = std::max({of_mesh, std::fabs(double{mesh->lower()[axis]}),
                        std::fabs(double{mesh->upper()[axis]})});
  }
  lengths += of_mesh;
  const double slack = kPathSlack * lengths + FLT_TRUE_MIN;
  Double3 inverse_way;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    const double to_lower = (double{mesh->lower()[i]} - slack) - start[axis];
    const double to_upper = (double{mesh->upper()[i]} + slack) - start[axis];
    if (way[axis] == 0) {
      if (to_lower > 0 || to_upper < 0) last = -1;
      continue;
    }
    inverse_way[axis] = 1 / way[axis];
    const bool forwards = way[axis] > 0;
    first = std::max(first, (forwards ? to_lower : to_upper) * inverse_way[axis]);
    last = std::min(last, (forwards ? to_upper : to_lower) * inverse_way[axis]);
  }
  if (is_empty()) return true;
  Double3 at_first, on_path;
  for (size_t axis = 0; axis < 3; ++axis) {
    at_first[axis] = start[axis] + way[axis] * first;
    on_path[axis] = way[axis] * (last - first);
  }
  const double length = greatest(at_first) + greatest(on_path);
  if (!(length + slack < kLongestPath && travel < kLongestPath)) return false;
  const double margin = slack + kFloatSlack * length;
  for (size_t axis = 0; axis < 3; ++axis) {
    const bool moves = std::fabs(way[axis]) >= kLeastDisplacement;
    const double along = moves ? 0 : on_path[axis];
    lower[axis] = round_downwards(at_first[axis] + std::min(along, 0.0) - margin);
    upper[axis] = -round_downwards(-(at_first[axis] + std::max(along, 0.0) + margin));
    inverse[axis] = moves ? static_cast<float>(inverse_way[axis]) : INFINITY;
  }
  return true;
}

bool find_candidates(const RayInMesh& ray, double limit, bool any, RayScratch& scratch) {
  return CAROM_DISPATCH(walk_ray)(ray, limit, any, scratch);
}

}  // namespace carom
#endif  // HWY_ONCE
