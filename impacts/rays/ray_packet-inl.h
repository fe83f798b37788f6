// Walks the tree of a mesh along many rays at once: I. Wald, P. Slusallek, C. Benthin, M. Wagner,
// Interactive Rendering with Coherent Ray Tracing, 2001; the shaft as in S. Boulos, I. Wald, P.
// Shirley, Geometric and Arithmetic Culling Methods for Entire Ray Packets, 2006.
#if defined(CAROM_IMPACTS_RAYS_RAY_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_RAYS_RAY_PACKET_INL_H_
#undef CAROM_IMPACTS_RAYS_RAY_PACKET_INL_H_
#else
#define CAROM_IMPACTS_RAYS_RAY_PACKET_INL_H_
#endif

#include <bit>
#include <cfloat>
#include <cmath>
#include <span>

#include "geometries/mesh_memory.h"
#include "impacts/rays/ray_hits-inl.h"
#include "impacts/rays/ray_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Rays that follow one another and go nearly the same way. They share one walk: a node is visited
// once for all of them. Its boxes are tested against a shaft that holds the rays (intervals of
// starts and of reciprocals), then each box that the shaft meets against the rays in lanes.
class RayPacket {
 public:
  static constexpr size_t kMost = 16, kLeast = 4;

  // Takes at most kMost rays. False, and nothing is done, if they are not close to one another.
  bool set(std::span<RaySearch> searches) {
    if (searches.size() < kLeast) return false;
    const RayInMesh& first = searches[0].ray;
    for (const RaySearch& search : searches) {
      if (search.ray.mesh != first.mesh) return false;
    }
    count_ = searches.size();
    nodes_ = first.mesh->tree().nodes().data();
    mesh_ = first.mesh;
    if (!set_shaft(searches)) return false;
    for (size_t i = 0; i < kMost; ++i) set_ray(searches, i);
    set_shaft_limit();
    return true;
  }

  HWY_INLINE void run(bool any) {
    any_ = any;
    steps_.clear();
    uint32_t node = 0;
    do {
      visit(nodes_[node]);
    } while (steps_.take(shaft_limit_, node));
    for (size_t i = 0; i < count_; ++i) hits_[i].finish();
  }

 private:
  // A limit that no box meets.
  static constexpr float kDone = -1;
  // The shaft may be as wide as this share of its length.
  static constexpr double kWidest = 0.5;

  using Floats = std::array<float, kMost>;
  using Doubles = std::array<double, kMost>;

  bool set_shaft(std::span<const RaySearch> searches) {
    double width = 0, length = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      const RayInMesh& first = searches[0].ray;
      const bool forwards = first.inverse[axis] >= 0;
      float lower = first.lower[axis], upper = first.upper[axis];
      float least = std::abs(first.inverse[axis]), most = least;
      for (const RaySearch& search : searches) {
        const RayInMesh& ray = search.ray;
        if ((ray.inverse[axis] >= 0) != forwards) return false;
        lower = std::min(lower, ray.lower[axis]);
        upper = std::max(upper, ray.upper[axis]);
        least = std::min(least, std::abs(ray.inverse[axis]));
        most = std::max(most, std::abs(ray.inverse[axis]));
      }
      if (!(most <= FLT_MAX)) return false;
      shaft_.set(axis, lower, upper, first.inverse[axis]);
      sign_[axis] = forwards ? 1.0f : -1.0f;
      least_inverse_[axis] = least * (1 - BoxPath::kTimeRounding);
      most_inverse_[axis] = most * (1 + BoxPath::kTimeRounding);
      const double duration = first.last - first.first;
      width += (double{upper} - lower) + (1 / double{least} - 1 / double{most}) * duration;
      length += std::abs(first.way[axis]) * duration;
    }
    return width <= kWidest * length;
  }

  // Rows without a ray repeat the first one, but meet nothing.
  void set_ray(std::span<RaySearch> searches, size_t i) {
    const bool is_there = i < searches.size();
    const RayInMesh& ray = searches[is_there ? i : 0].ray;
    for (size_t axis = 0; axis < 3; ++axis) {
      start_[axis][i] = ray.start[axis];
      way_[axis][i] = ray.way[axis];
      const bool forwards = ray.inverse[axis] >= 0;
      ray_near_[axis][i] = forwards ? ray.upper[axis] : ray.lower[axis];
      ray_far_[axis][i] = forwards ? ray.lower[axis] : ray.upper[axis];
      inverse_near_[axis][i] = ray.inverse[axis] * (1 - BoxPath::kTimeRounding);
      inverse_far_[axis][i] = ray.inverse[axis] * (1 + BoxPath::kTimeRounding);
    }
    travel_[i] = ray.travel;
    lengths_[i] = ray.lengths;
    if (is_there) hits_[i].start(searches[i]);
    limit_[i] = is_there ? hits_[i].limit_on_path() : kDone;
  }

  HWY_INLINE void set_shaft_limit() {
    const ChildTag tag;
    Children most = hn::Load(tag, limit_.data());
    for (size_t i = kChildLanes; i < kMost; i += kChildLanes) {
      most = max(most, hn::Load(tag, limit_.data() + i));
    }
    shaft_limit_ = hn::GetLane(hn::MaxOfLanes(tag, most));
  }

  HWY_INLINE void visit(const BoxTree::Node& node) {
    RayStep* const begin = steps_.room();
    RayStep* end = begin;
    for (size_t i = 0; i < BoxTree::kChildren; i += kChildLanes) {
      alignas(64) float keys[kChildLanes];
      for (uint32_t met = meets_shaft(node, i, keys); met != 0; met &= met - 1) {
        const auto lane = static_cast<size_t>(std::countr_zero(met));
        const uint32_t child = node.child[i + lane];
        if (child >= BoxTree::kItem) prefetch_indices(*mesh_, child - BoxTree::kItem);
        const uint32_t rays = meet_rays(node, i + lane);
        if (rays == 0) continue;
        if (child >= BoxTree::kItem) {
          test(child - BoxTree::kItem, rays);
        } else {
          prefetch_node(nodes_[child]);
          end = RaySteps::insert({keys[lane], child}, begin, end);
        }
      }
    }
    steps_.keep(end);
  }

  // Which boxes of the children from `first` on the shaft meets, and lower bounds of the times.
  HWY_INLINE uint32_t meets_shaft(const BoxTree::Node& node, size_t first, float* keys) const {
    const ChildTag tag;
    const float* const ends = ends_of(node) + first;
    Children entry = hn::Zero(tag), exit = child_splat(shaft_limit_);
    for (size_t axis = 0; axis < 3; ++axis) {
      const Children sign = child_splat(sign_[axis]);
      const Children least = child_splat(least_inverse_[axis]);
      const Children most = child_splat(most_inverse_[axis]);
      const Children to_near = hn::Mul(sign, hn::Sub(hn::Load(tag, ends + shaft_.near_end[axis]),
                                                     child_splat(shaft_.from_near[axis])));
      const Children to_far = hn::Mul(sign, hn::Sub(hn::Load(tag, ends + shaft_.far_end[axis]),
                                                    child_splat(shaft_.from_far[axis])));
      entry = max(min(hn::Mul(to_near, least), hn::Mul(to_near, most)), entry);
      exit = min(max(hn::Mul(to_far, least), hn::Mul(to_far, most)), exit);
    }
    hn::Store(entry, tag, keys);
    return child_bits(hn::Le(entry, hn::Add(exit, child_splat(BoxPath::kTinyTime))));
  }

  // The rays that meet a box of a node, as bits.
  HWY_INLINE uint32_t meet_rays(const BoxTree::Node& node, size_t child) const {
    const ChildTag tag;
    const float* const ends = ends_of(node) + child;
    uint32_t rays = 0;
    for (size_t i = 0; i < kMost; i += kChildLanes) {
      const Children limit = hn::Load(tag, limit_.data() + i);
      Children entry = hn::Zero(tag), exit = limit;
      for (size_t axis = 0; axis < 3; ++axis) {
        const Children near_end = child_splat(ends[shaft_.near_end[axis]]);
        const Children far_end = child_splat(ends[shaft_.far_end[axis]]);
        entry = max(hn::Mul(hn::Sub(near_end, hn::Load(tag, ray_near_[axis].data() + i)),
                            hn::Load(tag, inverse_near_[axis].data() + i)),
                    entry);
        exit = min(hn::Mul(hn::Sub(far_end, hn::Load(tag, ray_far_[axis].data() + i)),
                           hn::Load(tag, inverse_far_[axis].data() + i)),
                   exit);
      }
      rays |= child_bits(hn::Le(entry, hn::Add(exit, child_splat(BoxPath::kTinyTime)))) << i;
    }
    return rays;
  }

  HWY_INLINE void test(uint32_t triangle, uint32_t rays) {
    const Double3 a = corner(*mesh_, triangle, 0), b = corner(*mesh_, triangle, 1),
                  c = corner(*mesh_, triangle, 2);
    bool has_changed = false;
    for (size_t i = 0; i < kMost; i += kDoubleLanes) {
      uint32_t of_vector = rays >> i & ((1u << kDoubleLanes) - 1);
      if (of_vector == 0) continue;
      windows_.find(vector(start_, i), vector(way_, i), load(travel_, i), load(lengths_, i),
                    splat3(a), splat3(b), splat3(c), i);
      for (; of_vector != 0; of_vector &= of_vector - 1) {
        const size_t ray = i + static_cast<size_t>(std::countr_zero(of_vector));
        if (!windows_.passes(ray) || !hits_[ray].take(triangle, windows_, ray)) continue;
        limit_[ray] = any_ ? kDone : hits_[ray].limit_on_path();
        has_changed = true;
      }
    }
    if (has_changed) set_shaft_limit();
  }

  static HWY_INLINE D load(const Doubles& numbers, size_t i) {
    return hn::LoadU(DoubleTag(), numbers.data() + i);
  }
  static HWY_INLINE D3 vector(const std::array<Doubles, 3>& columns, size_t i) {
    return {load(columns[0], i), load(columns[1], i), load(columns[2], i)};
  }

  size_t count_;
  const BoxTree::Node* nodes_;
  const MeshGeometry* mesh_;
  bool any_;

  // The shaft.
  BoxPath shaft_;  // but for the inverses
  std::array<float, 3> sign_, least_inverse_, most_inverse_;
  float shaft_limit_;

  // The rays.
  alignas(64) std::array<Floats, 3> ray_near_, ray_far_, inverse_near_, inverse_far_;
  alignas(64) Floats limit_;
  alignas(64) std::array<Doubles, 3> start_, way_;
  alignas(64) Doubles travel_, lengths_;
  std::array<RayHits, kMost> hits_;

  RaySteps steps_;
  RayWindows windows_;
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_RAYS_RAY_PACKET_INL_H_
