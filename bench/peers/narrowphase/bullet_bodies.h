// One side of the pairs as Bullet's shapes and poses.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include "bench/peers/narrowphase/pair_peer.h"

namespace carom::bench {

inline btVector3 bullet_vector(const float* v) { return {v[0], v[1], v[2]}; }

class BulletBodies {
 public:
  // A ground is a mesh that nothing but convex shapes meets; other meshes are those of GImpact.
  explicit BulletBodies(const PeerBodies& source, bool is_ground = true);

  size_t count() const { return shapes_.size(); }
  btCollisionShape* shape(size_t i) const { return shapes_[i].get(); }
  const btTransform& transform(size_t i) const { return transforms_[i]; }

  // Gives `object` the shape and pose of body i.
  void put(size_t i, btCollisionObject& object) const {
    object.setCollisionShape(shape(i));
    object.setWorldTransform(transform(i));
  }

 private:
  std::vector<std::shared_ptr<btCollisionShape>> shapes_;
  std::vector<btTransform> transforms_;
};

}  // namespace carom::bench
