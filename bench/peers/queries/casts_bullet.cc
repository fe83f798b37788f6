// Bullet: convexSweepTest() in a world of static objects, with a tree as broadphase. Each cast is a
// call, and each pair runs btContinuousConvexCollision.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include "bench/peers/queries/cast_peer.h"

namespace carom::bench {
namespace {

// Margins as in narrowphase/bullet.cc: small for boxes and triangles, none for hulls.
constexpr btScalar kMargin = 2.5e-4f;

btVector3 vector(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

btTransform pose(const CastBody& body) {
  const auto& q = body.orientation;
  return btTransform(btQuaternion(q[0], q[1], q[2], q[3]), vector(body.position));
}

std::unique_ptr<btCollisionShape> make_mesh(const CastScene& scene,
                                            btTriangleIndexVertexArray& triangles) {
  btIndexedMesh mesh;
  mesh.m_numTriangles = static_cast<int>(scene.triangles.size());
  mesh.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(scene.triangles.data());
  mesh.m_triangleIndexStride = sizeof(scene.triangles[0]);
  mesh.m_numVertices = static_cast<int>(scene.vertices.size());
  mesh.m_vertexBase = reinterpret_cast<const unsigned char*>(scene.vertices.data());
  mesh.m_vertexStride = sizeof(scene.vertices[0]);
  triangles.addIndexedMesh(mesh, PHY_INTEGER);
  return std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
}

std::unique_ptr<btConvexShape> make_convex(const CastBody& body, const CastScene& scene) {
  switch (body.shape) {
    case CastShape::sphere:
      return std::make_unique<btSphereShape>(body.size[0]);
    case CastShape::capsule:
      return std::make_unique<btCapsuleShapeZ>(body.size[0], 2 * body.size[1]);
    case CastShape::box: {
      auto box = std::make_unique<btBoxShape>(vector(body.size));
      box->setMargin(kMargin);
      return box;
    }
    default: {
      auto hull = std::make_unique<btConvexHullShape>();
      for (const auto& point : scene.hulls[body.hull].points) hull->addPoint(vector(point), false);
      hull->recalcLocalAabb();
      hull->setMargin(0);
      return hull;
    }
  }
}

class BulletCasts final : public CastPeer {
 public:
  explicit BulletCasts(const CastScene& scene) : scene_(scene) {
    for (const CastBody& body : scene.bodies) {
      if (body.shape == CastShape::mesh) {
        shapes_.push_back(make_mesh(scene_, triangles_));
        shapes_.back()->setMargin(kMargin);
      } else {
        shapes_.push_back(make_convex(body, scene_));
      }
      objects_.push_back(std::make_unique<btCollisionObject>());
      objects_.back()->setCollisionShape(shapes_.back().get());
      objects_.back()->setWorldTransform(pose(body));
      world_.addCollisionObject(objects_.back().get(), btBroadphaseProxy::StaticFilter,
                                btBroadphaseProxy::AllFilter);
    }
    broadphase_.optimize();
  }
  BulletCasts(const BulletCasts&) = delete;
  BulletCasts& operator=(const BulletCasts&) = delete;
  ~BulletCasts() override {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
  }

  void prepare(const CastList& list) override {
    list_ = &list;
    queries_.clear();
    for (const CastBody& query : list.queries) queries_.push_back(make_convex(query, scene_));
  }

  void run(std::span<float> times) override {
    for (size_t i = 0; i < times.size(); ++i) {
      const btTransform start = pose(list_->queries[i]);
      btTransform end = start;
      end.getOrigin() += vector(list_->displacements[i]);
      btCollisionWorld::ClosestConvexResultCallback closest(start.getOrigin(), end.getOrigin());
      world_.convexSweepTest(queries_[i].get(), start, end, closest);
      times[i] = closest.hasHit() ? closest.m_closestHitFraction : 2;
    }
  }

 private:
  const CastScene& scene_;
  const CastList* list_ = nullptr;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
  btTriangleIndexVertexArray triangles_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  std::vector<std::unique_ptr<btConvexShape>> queries_;
};

}  // namespace

std::unique_ptr<CastPeer> make_bullet_casts(const CastScene& scene) {
  return std::make_unique<BulletCasts>(scene);
}

}  // namespace carom::bench
