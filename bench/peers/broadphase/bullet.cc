// Bullet: the tree btDbvt alone, the broadphase of two such trees with a pair cache, and sweep and
// prune with a pair cache. All treat boxes as closed.
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include "bench/peers/broadphase/peer.h"

namespace carom::bench {
namespace {

btVector3 vector(const std::array<float, 4>& v) { return {v[0], v[1], v[2]}; }

void* to_pointer(size_t index) { return reinterpret_cast<void*>(index); }
uint32_t to_index(const void* pointer) {
  return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(pointer));
}

// One tree without margins; it gives exact pairs.
class TreePeer final : public Peer {
 public:
  TreePeer(const FrameBounds& first, const Box& /*world*/)
      : boxes_(first.boxes.begin(), first.boxes.end()) {
    for (const Box& box : boxes_) leaves_.push_back(tree_.insert(volume(box), index_pointer()));
    tree_.optimizeTopDown();
  }

  void update(const FrameBounds& frame) override {
    for (size_t i = 0; i < boxes_.size(); ++i) {
      if (boxes_[i] == frame.boxes[i]) continue;
      boxes_[i] = frame.boxes[i];
      btDbvtVolume moved = volume(boxes_[i]);
      tree_.update(leaves_[i], moved);
    }
  }

  void find(std::vector<Pair>& pairs) override {
    pairs.clear();
    Collector collector(pairs);
    tree_.collideTT(tree_.m_root, tree_.m_root, collector);
  }

 private:
  struct Collector final : btDbvt::ICollide {
    explicit Collector(std::vector<Pair>& target) : pairs(target) {}
    void Process(const btDbvtNode* a, const btDbvtNode* b) override {
      pairs.push_back({to_index(a->data), to_index(b->data)});
    }
    std::vector<Pair>& pairs;
  };

  static btDbvtVolume volume(const Box& box) {
    return btDbvtVolume::FromMM(vector(box.lower), vector(box.upper));
  }
  void* index_pointer() const { return to_pointer(leaves_.size()); }

  btDbvt tree_;
  std::vector<Box> boxes_;
  std::vector<btDbvtNode*> leaves_;
};

// A broadphase with a pair cache, which keeps pairs from frame to frame. find() tests them again
// for three reasons: margins, the quantised coordinates of btAxisSweep3, and btDbvtBroadphase,
// which removes old pairs over many frames.
class CachePeer final : public Peer {
 public:
  CachePeer(std::unique_ptr<btBroadphaseInterface> broadphase, const FrameBounds& first)
      : broadphase_(std::move(broadphase)), boxes_(first.boxes.begin(), first.boxes.end()) {
    for (const Box& box : boxes_) {
      proxies_.push_back(broadphase_->createProxy(
          vector(box.lower), vector(box.upper), BOX_SHAPE_PROXYTYPE, to_pointer(proxies_.size()),
          btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter, nullptr));
    }
  }

  void update(const FrameBounds& frame) override {
    for (size_t i = 0; i < boxes_.size(); ++i) {
      if (boxes_[i] == frame.boxes[i]) continue;
      boxes_[i] = frame.boxes[i];
      broadphase_->setAabb(proxies_[i], vector(boxes_[i].lower), vector(boxes_[i].upper), nullptr);
    }
  }

  void find(std::vector<Pair>& pairs) override {
    pairs.clear();
    broadphase_->calculateOverlappingPairs(nullptr);
    const btBroadphasePairArray& cached =
        broadphase_->getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < cached.size(); ++i) {
      const Pair pair = {to_index(cached[i].m_pProxy0->m_clientObject),
                         to_index(cached[i].m_pProxy1->m_clientObject)};
      if (overlap(boxes_[pair.a], boxes_[pair.b])) pairs.push_back(pair);
    }
  }

 private:
  std::unique_ptr<btBroadphaseInterface> broadphase_;
  std::vector<Box> boxes_;
  std::vector<btBroadphaseProxy*> proxies_;
};

std::unique_ptr<Peer> make_tree(const FrameBounds& first, const Box& world) {
  return std::make_unique<TreePeer>(first, world);
}

// Deferred: one search for each frame instead of one for every box that leaves its margin.
template <bool kDeferred>
std::unique_ptr<Peer> make_two_trees(const FrameBounds& first, const Box& /*world*/) {
  auto broadphase = std::make_unique<btDbvtBroadphase>();
  broadphase->m_deferedcollide = kDeferred;
  return std::make_unique<CachePeer>(std::move(broadphase), first);
}

std::unique_ptr<Peer> make_sweep(const FrameBounds& first, const Box& world) {
  constexpr size_t kMostShort = 16'000;  // its indices have 16 bits
  constexpr bool kNoRaycasts = true;     // otherwise Bullet also maintains a btDbvtBroadphase
  const btVector3 lower = vector(world.lower);
  const btVector3 upper = vector(world.upper);
  const size_t handles = first.boxes.size() + 1;  // one is a sentinel
  std::unique_ptr<btBroadphaseInterface> broadphase;
  if (handles <= kMostShort) {
    broadphase = std::make_unique<btAxisSweep3>(lower, upper, static_cast<unsigned short>(handles),
                                                nullptr, kNoRaycasts);
  } else {
    broadphase = std::make_unique<bt32BitAxisSweep3>(lower, upper, static_cast<unsigned>(handles),
                                                     nullptr, kNoRaycasts);
  }
  return std::make_unique<CachePeer>(std::move(broadphase), first);
}

}  // namespace

std::vector<PeerKind> bullet_kinds() {
  // btAxisSweep3 inserts a box by moving it along all three axes past those already there. For
  // 100,000 boxes that takes minutes.
  constexpr size_t kMostSwept = 20'000;
  return {{"bullet_dbvt", 1, kAnyNumber, make_tree},
          {"bullet_dbvt_broadphase", 1, kAnyNumber, make_two_trees<false>},
          {"bullet_dbvt_deferred", 1, kAnyNumber, make_two_trees<true>},
          {"bullet_axis_sweep", 1, kMostSwept, make_sweep}};
}

}  // namespace carom::bench
