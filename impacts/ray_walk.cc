// Walks the trees of meshes along rays, eight boxes at once: C. Ericson, Real-Time Collision
// Detection, 2005, section 5.3.3.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "impacts/ray_walk.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <hwy/cache_control.h>
#include <bit>
#include <utility>

#include "impacts/ray_in_mesh.h"
#include "impacts/ray_windows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// A node that a search has still to visit, and a lower bound of the time, after ray.first, at which
// the ray meets it.
struct Step {
  float key;
  uint32_t node;
};

using Node = BoxTree::Node;
using ChildTag = hn::CappedTag<float, BoxTree::kChildren>;
using Children = hn::Vec<ChildTag>;
inline constexpr size_t kChildLanes = hn::MaxLanes(ChildTag());

HWY_INLINE Children child_splat(float value) { return hn::Set(ChildTag(), value); }

// A bound on the rounding of times: a difference, a reciprocal and two products.
inline constexpr float kTimeRounding = 0x1p-20f;
// A bound on what products lose by underflow.
inline constexpr float kTinyTime = 0x1p-100f;

// A time after ray.first, rounded upwards.
HWY_INLINE float limit_on_path(const RayInMesh& ray, double limit) {
  return static_cast<float>((limit - ray.first) * (1 + 2.0 * kTimeRounding) + kTinyTime);
}

template <class T>
HWY_INLINE void prefetch(const T& object) {
  constexpr size_t kLine = 64;
  const char* const bytes = reinterpret_cast<const char*>(&object);
  for (size_t i = 0; i < sizeof object; i += kLine) hwy::Prefetch(bytes + i);
}

class RayWalk;

// A triangle whose box a ray meets.
struct MetTriangle {
  RayWalk* walk;
  uint32_t triangle;
};

// The walk of one ray.
class RayWalk {
 public:
  void start(RaySearch& search) {
    search_ = &search;
    const RayInMesh& ray = search.ray;
    nodes_ = ray.mesh->tree().nodes().data();
    for (size_t axis = 0; axis < 3; ++axis) {
      forwards_[axis] = ray.inverse[axis] >= 0;
      from_near_[axis] = forwards_[axis] ? ray.upper[axis] : ray.lower[axis];
      from_far_[axis] = forwards_[axis] ? ray.lower[axis] : ray.upper[axis];
      // Rounds the times of a box outwards.
      inverse_near_[axis] = ray.inverse[axis] * (1 - kTimeRounding);
      inverse_far_[axis] = ray.inverse[axis] * (1 + kTimeRounding);
    }
    set_limit(std::min(search.limit, ray.last));
    search.candidates.clear();
    search.is_sure = false;
    waiting_ = 0;
    node_ = 0;
  }

  const RaySearch& search() const { return *search_; }

  // Adds the triangles whose boxes the ray meets to `met`, and waits for the nodes, the nearest
  // last. Returns the end of the triangles.
  HWY_INLINE MetTriangle* expand(MetTriangle* met) {
    const Node& node = nodes_[node_];
    if (steps_.size() < waiting_ + BoxTree::kChildren) {
      steps_.resize(2 * waiting_ + 8 * BoxTree::kChildren);
    }
    Step* const begin = steps_.data() + waiting_;
    Step* end = begin;
    const ChildTag tag;
    for (size_t i = 0; i < BoxTree::kChildren; i += kChildLanes) {
      Children entry = hn::Zero(tag), exit = child_splat(limit_on_path_);
      for (size_t axis = 0; axis < 3; ++axis) {
        const float* const near = forwards_[axis] ? node.lower[axis] : node.upper[axis];
        const float* const far = forwards_[axis] ? node.upper[axis] : node.lower[axis];
        // Zero times infinity is NaN, and keeps the other value.
        entry = max(hn::Mul(hn::Sub(hn::Load(tag, near + i), child_splat(from_near_[axis])),
                            child_splat(inverse_near_[axis])),
                    entry);
        exit = min(hn::Mul(hn::Sub(hn::Load(tag, far + i), child_splat(from_far_[axis])),
                           child_splat(inverse_far_[axis])),
                   exit);
      }
      uint8_t mask[8] = {};
      hn::StoreMaskBits(tag, hn::Le(entry, hn::Add(exit, child_splat(kTinyTime))), mask);
      alignas(64) float keys[kChildLanes];
      hn::Store(entry, tag, keys);
      for (uint32_t bits = mask[0] & ((1u << kChildLanes) - 1); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<size_t>(std::countr_zero(bits));
        const uint32_t child = node.child[i + lane];
        if (child >= BoxTree::kItem) {
          const uint32_t triangle = child - BoxTree::kItem;
          hwy::Prefetch(&search_->ray.mesh->triangles()[triangle]);
          *met++ = {this, triangle};
        } else {
          end = insert({keys[lane], child}, begin, end);
        }
      }
    }
    waiting_ += static_cast<size_t>(end - begin);
    return met;
  }

  HWY_INLINE void prefetch_corners(uint32_t triangle) const {
    const MeshGeometry& mesh = *search_->ray.mesh;
    for (const uint32_t vertex : mesh.triangles()[triangle]) {
      hwy::Prefetch(&mesh.vertices()[vertex]);
    }
  }

  HWY_INLINE void take(uint32_t triangle, const RayWindows& windows, size_t i) {
    if (windows.earliest(i) > limit_) return;
    search_->candidates.push_back({triangle, windows.earliest(i)});
    const bool counts = windows.is_from_front(i) || !search_->ray.one_sided;
    if (!windows.is_sure(i) || !counts || windows.latest(i) > limit_) return;
    set_limit(windows.latest(i));
    search_->is_sure = true;
  }

  // Goes to the next node. False at the end.
  HWY_INLINE bool take_node(bool any) {
    if (any && search_->is_sure) return false;
    do {
      if (waiting_ == 0) return false;
      --waiting_;
    } while (steps_[waiting_].key > limit_on_path_);
    node_ = steps_[waiting_].node;
    prefetch(nodes_[node_]);
    return true;
  }

  void finish() {
    std::erase_if(search_->candidates,
                  [&](const RayCandidate& candidate) { return candidate.earliest > limit_; });
  }

 private:
  void set_limit(double limit) {
    limit_ = limit;
    limit_on_path_ = limit_on_path(search_->ray, limit);
  }

  // Keeps steps sorted by falling keys, since the last step is taken next.
  static HWY_INLINE Step* insert(const Step& step, Step* begin, Step* end) {
    Step* hole = end;
    for (; hole > begin && hole[-1].key < step.key; --hole) *hole = hole[-1];
    *hole = step;
    return end + 1;
  }

  RaySearch* search_;
  const Node* nodes_;
  std::array<bool, 3> forwards_;
  std::array<float, 3> from_near_, from_far_, inverse_near_, inverse_far_;
  float limit_on_path_;
  uint32_t node_;
  double limit_;
  size_t waiting_;
  std::vector<Step> steps_;  // the first waiting_ are in use
};

constexpr size_t kWalks = RayWindows::kMost / BoxTree::kChildren;

// Walks rays side by side, a node of each at a time. Each asks for the memory of its next node, so
// that they wait together, and their triangles fill the lanes.
class RayWalks {
 public:
  void run(std::span<RaySearch> searches, bool any) {
    size_t started = 0, count = 0;
    for (; count < std::min(kWalks, searches.size()); ++count) {
      active_[count] = &walks_[count];
      active_[count]->start(searches[started++]);
    }
    while (count > 0) {
      for (size_t i = 0; i < count; ++i) met_end_ = active_[i]->expand(met_end_);
      test_triangles();
      for (size_t i = 0; i < count;) {
        if (active_[i]->take_node(any)) {
          ++i;
          continue;
        }
        active_[i]->finish();
        if (started < searches.size()) {
          active_[i++]->start(searches[started++]);
        } else {
          active_[i] = active_[--count];
        }
      }
    }
  }

 private:
  HWY_INLINE void test_triangles() {
    const std::span<const MetTriangle> met(met_.data(), met_end_);
    for (const MetTriangle& m : met) m.walk->prefetch_corners(m.triangle);
    windows_.clear();
    for (const MetTriangle& m : met) windows_.add(m.walk->search().ray, m.triangle);
    windows_.run();
    for (size_t i = 0; i < met.size(); ++i) {
      if (windows_.passes(i)) met[i].walk->take(met[i].triangle, windows_, i);
    }
    met_end_ = met_.data();
  }

  std::array<RayWalk, kWalks> walks_;
  std::array<RayWalk*, kWalks> active_;
  std::array<MetTriangle, RayWindows::kMost> met_;
  MetTriangle* met_end_ = met_.data();
  RayWindows windows_;
};

void walk_rays(std::span<RaySearch> searches, bool any) {
  static thread_local RayWalks walks;
  walks.run(searches, any);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(walk_rays);

}  // namespace

void find_candidates(std::span<RaySearch> searches, bool any) {
  CAROM_DISPATCH(walk_rays)(searches, any);
}

}  // namespace carom
#endif  // HWY_ONCE
