// FCL: DynamicAABBTreeCollisionManager, a tree of boxes in double precision. Boxes are closed;
// pairs are exact.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/narrowphase/collision_object.h>

#include "bench/peers/broadphase/peer.h"

namespace carom::bench {
namespace {

// A geometry that has only bounds. With the identity as transform FCL adds no rounding.
class BoundsGeometry final : public fcl::CollisionGeometryd {
 public:
  explicit BoundsGeometry(const Box& box) { set(box); }

  void set(const Box& box) {
    aabb_local.min_ = {box.lower[0], box.lower[1], box.lower[2]};
    aabb_local.max_ = {box.upper[0], box.upper[1], box.upper[2]};
  }
  void computeLocalAABB() override {}
};

class FclPeer final : public Peer {
 public:
  explicit FclPeer(const FrameBounds& first) : boxes_(first.boxes.begin(), first.boxes.end()) {
    std::vector<fcl::CollisionObjectd*> all;
    objects_.reserve(boxes_.size());
    for (const Box& box : boxes_) {
      geometries_.push_back(std::make_shared<BoundsGeometry>(box));
      auto& object = objects_.emplace_back(geometries_.back());
      object.setUserData(reinterpret_cast<void*>(all.size()));
      all.push_back(&object);
    }
    manager_.registerObjects(all);
    manager_.setup();
  }

  // Inserts moved boxes again if they are few; for many, refitting the whole tree is faster.
  void update(const FrameBounds& frame) override {
    constexpr size_t kFew = 20;  // fewer than one in 20
    moved_.clear();
    for (size_t i = 0; i < boxes_.size(); ++i) {
      if (boxes_[i] == frame.boxes[i]) continue;
      boxes_[i] = frame.boxes[i];
      geometries_[i]->set(boxes_[i]);
      objects_[i].computeAABB();
      moved_.push_back(&objects_[i]);
    }
    if (moved_.empty()) return;
    if (moved_.size() < boxes_.size() / kFew) {
      manager_.update(moved_);
    } else {
      manager_.update();
    }
  }

  void find(std::vector<Pair>& pairs) override {
    pairs.clear();
    manager_.collide(&pairs, collect);
  }

 private:
  static bool collect(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* pairs) {
    static_cast<std::vector<Pair>*>(pairs)->push_back({index(*a), index(*b)});
    return false;  // go on
  }
  static uint32_t index(const fcl::CollisionObjectd& object) {
    return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(object.getUserData()));
  }

  std::vector<Box> boxes_;
  std::vector<std::shared_ptr<BoundsGeometry>> geometries_;
  std::vector<fcl::CollisionObjectd> objects_;
  std::vector<fcl::CollisionObjectd*> moved_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
};

}  // namespace

std::vector<PeerKind> fcl_kinds() {
  return {{"fcl_tree", 1, kAnyNumber,
           [](const FrameBounds& first, const Box& /*world*/) -> std::unique_ptr<Peer> {
             return std::make_unique<FclPeer>(first);
           }}};
}

}  // namespace carom::bench
