// Walks the trees of meshes along rays, eight boxes at once: C. Ericson, Real-Time Collision
// Detection, 2005, section 5.3.3.
#if defined(CAROM_IMPACTS_RAYS_RAY_WALKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_RAYS_RAY_WALKS_INL_H_
#undef CAROM_IMPACTS_RAYS_RAY_WALKS_INL_H_
#else
#define CAROM_IMPACTS_RAYS_RAY_WALKS_INL_H_
#endif

#include <bit>
#include <span>

#include "geometries/mesh_memory.h"
#include "impacts/rays/ray_hits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The walk of one ray.
class RayWalk {
 public:
  void start(RaySearch& search) {
    hits_.start(search);
    const RayInMesh& ray = search.ray;
    nodes_ = ray.mesh->tree().nodes().data();
    for (size_t axis = 0; axis < 3; ++axis) {
      path_.set(axis, ray.lower[axis], ray.upper[axis], ray.inverse[axis]);
    }
    steps_.clear();
    node_ = 0;
  }

  const RayInMesh& ray() const { return hits_.search().ray; }
  RayHits& hits() { return hits_; }

  // Calls met(triangle) for the triangles whose boxes the ray meets, and keeps the nodes.
  template <class Met>
  HWY_INLINE void expand(const Met& met) {
    const BoxTree::Node& node = nodes_[node_];
    RayStep* const begin = steps_.room();
    RayStep* end = begin;
    for (size_t i = 0; i < BoxTree::kChildren; i += kChildLanes) {
      Children entry;
      uint32_t bits = child_bits(meets(path_, node, i, hits_.limit_on_path(), entry));
      alignas(64) float keys[kChildLanes];
      hn::Store(entry, ChildTag(), keys);
      for (; bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<size_t>(std::countr_zero(bits));
        const uint32_t child = node.child[i + lane];
        if (child >= BoxTree::kItem) {
          met(child - BoxTree::kItem);
        } else {
          end = RaySteps::insert({keys[lane], child}, begin, end);
        }
      }
    }
    steps_.keep(end);
  }

  // Goes to the next node. False at the end.
  HWY_INLINE bool take_node(bool any) {
    if (any && hits_.search().is_sure) return false;
    if (!steps_.take(hits_.limit_on_path(), node_)) return false;
    prefetch_node(nodes_[node_]);
    return true;
  }

 private:
  RayHits hits_;
  const BoxTree::Node* nodes_;
  uint32_t node_;
  BoxPath path_;
  RaySteps steps_;
};

// Walks rays side by side, a node of each at a time. Each asks for the memory of its next node, so
// that they wait together, and their triangles fill the lanes.
class RayWalks {
 public:
  void run(std::span<RaySearch* const> searches, bool any) {
    size_t started = 0, count = 0;
    for (; count < std::min(kWalks, searches.size()); ++count) {
      active_[count] = &walks_[count];
      active_[count]->start(*searches[started++]);
    }
    while (count > 0) {
      MetTriangle* met = met_.data();
      for (size_t i = 0; i < count; ++i) {
        RayWalk* const walk = active_[i];
        walk->expand([&](uint32_t triangle) {
          prefetch_indices(*walk->ray().mesh, triangle);
          *met++ = {walk, triangle};
        });
      }
      test({met_.data(), met});
      for (size_t i = 0; i < count;) {
        if (active_[i]->take_node(any)) {
          ++i;
          continue;
        }
        active_[i]->hits().finish();
        if (started < searches.size()) {
          active_[i++]->start(*searches[started++]);
        } else {
          active_[i] = active_[--count];
        }
      }
    }
  }

 private:
  static constexpr size_t kWalks = RayWindows::kMost / BoxTree::kChildren;

  // A triangle whose box a ray meets.
  struct MetTriangle {
    RayWalk* walk;
    uint32_t triangle;
  };

  HWY_INLINE void test(std::span<const MetTriangle> met) {
    for (const MetTriangle& m : met) prefetch_corners(*m.walk->ray().mesh, m.triangle);
    pairs_.clear();
    for (const MetTriangle& m : met) pairs_.add(m.walk->ray(), m.triangle);
    pairs_.find(windows_);
    for (size_t i = 0; i < met.size(); ++i) {
      if (windows_.passes(i)) met[i].walk->hits().take(met[i].triangle, windows_, i);
    }
  }

  std::array<RayWalk, kWalks> walks_;
  std::array<RayWalk*, kWalks> active_;
  std::array<MetTriangle, RayWindows::kMost> met_;
  RayPairs pairs_;
  RayWindows windows_;
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_RAYS_RAY_WALKS_INL_H_
