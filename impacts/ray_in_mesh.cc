// Walks the tree of a mesh along rays, eight boxes at once, and tests triangles in double
// precision: C. Ericson, Real-Time Collision Detection, 2005, sections 5.3.3 and 5.3.6, with bounds
// on the rounding of each number.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "impacts/ray_in_mesh.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <hwy/cache_control.h>
#include <bit>
#include <utility>

#include "impacts/ray_in_mesh.h"
#include "impacts/ray_window.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// A node that a search has still to visit, and a lower bound of the time, after ray.first, at which
// the ray meets it.
struct Step {
  float key;
  uint32_t node;
};

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

HWY_INLINE void prefetch(const BoxTree::Node& node) {
  constexpr size_t kLine = 64;
  const char* const bytes = reinterpret_cast<const char*>(&node);
  for (size_t i = 0; i < sizeof node; i += kLine) hwy::Prefetch(bytes + i);
}

// The walk of one ray. It does a little at a time, and asks for the memory of what comes next.
class RayWalk {
 public:
  void start(RaySearch& search, bool any) {
    search_ = &search;
    any_ = any;
    nodes_ = search.ray.mesh->tree().nodes().data();
    limit_ = std::min(search.limit, search.ray.last);
    limit_on_path_ = limit_on_path(search.ray, limit_);
    search.candidates.clear();
    search.is_sure = false;
    waiting_ = triangle_count_ = 0;
    node_ = 0;
    stage_ = Stage::node;
  }

  // False at the end.
  HWY_INLINE bool go_on() {
    switch (stage_) {
      case Stage::node:
        expand(nodes_[node_]);
        if (triangle_count_ == 0) return take_node();
        stage_ = Stage::indices;
        return true;
      case Stage::indices:
        for (size_t i = 0; i < triangle_count_; ++i) prefetch_corners(triangles_[i]);
        stage_ = Stage::corners;
        return true;
      case Stage::corners:
        for (size_t i = 0; i < triangle_count_; ++i) test(triangles_[i]);
        triangle_count_ = 0;
        return (any_ && search_->is_sure) ? false : take_node();
    }
    return false;
  }

 private:
  enum class Stage : uint8_t { node, indices, corners };  // what it waits for

  bool take_node() {
    do {
      if (waiting_ == 0) {
        std::erase_if(search_->candidates,
                      [&](const RayCandidate& candidate) { return candidate.earliest > limit_; });
        return false;
      }
      --waiting_;
    } while (steps_[waiting_].key > limit_on_path_);
    node_ = steps_[waiting_].node;
    prefetch(nodes_[node_]);
    stage_ = Stage::node;
    return true;
  }

  void prefetch_corners(uint32_t triangle) const {
    const MeshGeometry& mesh = *search_->ray.mesh;
    for (const uint32_t vertex : mesh.triangles()[triangle]) {
      hwy::Prefetch(&mesh.vertices()[vertex]);
    }
  }

  // Takes the triangles whose boxes the ray meets, and adds the nodes, the nearest last.
  HWY_INLINE void expand(const BoxTree::Node& node) {
    const RayInMesh& ray = search_->ray;
    if (steps_.size() < waiting_ + BoxTree::kChildren) {
      steps_.resize(2 * waiting_ + 8 * BoxTree::kChildren);
    }
    Step* const begin = steps_.data() + waiting_;
    Step* end = begin;
    const ChildTag tag;
    for (size_t i = 0; i < BoxTree::kChildren; i += kChildLanes) {
      Children entry = hn::Zero(tag), exit = child_splat(limit_on_path_);
      for (size_t axis = 0; axis < 3; ++axis) {
        const bool forwards = ray.inverse[axis] >= 0;
        const float* const near = forwards ? node.lower[axis] : node.upper[axis];
        const float* const far = forwards ? node.upper[axis] : node.lower[axis];
        const Children inverse = child_splat(ray.inverse[axis]);
        const Children from_near = child_splat(forwards ? ray.upper[axis] : ray.lower[axis]);
        const Children from_far = child_splat(forwards ? ray.lower[axis] : ray.upper[axis]);
        // Zero times infinity is NaN, and keeps the other value.
        entry = max(hn::Mul(hn::Sub(hn::Load(tag, near + i), from_near), inverse), entry);
        exit = min(hn::Mul(hn::Sub(hn::Load(tag, far + i), from_far), inverse), exit);
      }
      const Children key = hn::Mul(entry, child_splat(1 - kTimeRounding));
      const Children latest =
          hn::Add(hn::Mul(exit, child_splat(1 + kTimeRounding)), child_splat(kTinyTime));
      uint8_t mask[8] = {};
      hn::StoreMaskBits(tag, hn::Le(key, latest), mask);
      alignas(64) float keys[kChildLanes];
      hn::Store(key, tag, keys);
      for (uint32_t bits = mask[0] & ((1u << kChildLanes) - 1); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<size_t>(std::countr_zero(bits));
        const uint32_t child = node.child[i + lane];
        if (child >= BoxTree::kItem) {
          const uint32_t triangle = child - BoxTree::kItem;
          hwy::Prefetch(&ray.mesh->triangles()[triangle]);
          triangles_[triangle_count_++] = triangle;
        } else {
          end = insert({keys[lane], child}, begin, end);
        }
      }
    }
    waiting_ += static_cast<size_t>(end - begin);
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
    if (!window_of(search_->ray, triangle, window) || window.earliest > limit_) return;
    search_->candidates.push_back({triangle, window.earliest});
    if (!window.is_sure || window.latest > limit_) return;
    limit_ = window.latest;
    limit_on_path_ = limit_on_path(search_->ray, limit_);
    search_->is_sure = true;
  }

  RaySearch* search_;
  bool any_;
  Stage stage_;
  const BoxTree::Node* nodes_;
  double limit_;
  float limit_on_path_;
  uint32_t node_;
  size_t waiting_, triangle_count_;
  std::array<uint32_t, BoxTree::kChildren> triangles_;
  std::vector<Step> steps_;  // the first waiting_ are in use
};

constexpr size_t kWalks = 16;

void walk_rays(std::span<RaySearch> searches, bool any) {
  static thread_local std::array<RayWalk, kWalks> walks;
  size_t started = 0;
  std::array<RayWalk*, kWalks> active;
  size_t count = 0;
  for (; count < std::min(kWalks, searches.size()); ++count) {
    active[count] = &walks[count];
    active[count]->start(searches[started++], any);
  }
  while (count > 0) {
    for (size_t i = 0; i < count;) {
      if (active[i]->go_on()) {
        ++i;
      } else if (started < searches.size()) {
        active[i++]->start(searches[started++], any);
      } else {
        active[i] = active[--count];
      }
    }
  }
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

HWY_EXPORT(walk_rays);

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
    of_mesh = std::max(
        {of_mesh, std::fabs(double{mesh->lower()[axis]}), std::fabs(double{mesh->upper()[axis]})});
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

void find_candidates(std::span<RaySearch> searches, bool any) {
  CAROM_DISPATCH(walk_rays)(searches, any);
}

}  // namespace carom
#endif  // HWY_ONCE
