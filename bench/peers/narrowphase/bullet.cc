// Bullet: the algorithm that its dispatcher chooses for two kinds, and the detectors inside these
// algorithms for the decision of boxes and for distances.
#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btTriangleMesh.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "bench/peers/narrowphase/pair_peer.h"

namespace carom::bench {
namespace {

// Bullet rounds the corners of boxes and thickens triangles by a margin. This margin, a thousandth
// of the smallest shape, makes its question nearly the same as Carom's.
constexpr btScalar kMargin = 2.5e-4f;

btVector3 vector(const float* v) { return {v[0], v[1], v[2]}; }

std::shared_ptr<btCollisionShape> with_margin(std::shared_ptr<btCollisionShape> shape,
                                              btScalar margin) {
  shape->setMargin(margin);
  return shape;
}

// The margin of spheres and capsules is the radius. Hulls have none, because Bullet would add it
// outside.
std::shared_ptr<btCollisionShape> make_shape(PeerShape shape, const std::array<float, 9>& size) {
  switch (shape) {
    case PeerShape::sphere:
      return std::make_shared<btSphereShape>(size[0]);
    case PeerShape::capsule:
      return std::make_shared<btCapsuleShape>(size[0], 2 * size[1]);
    case PeerShape::box:
      return with_margin(std::make_shared<btBoxShape>(vector(&size[0])), kMargin);
    case PeerShape::triangle:
      return with_margin(
          std::make_shared<btTriangleShape>(vector(&size[0]), vector(&size[3]), vector(&size[6])),
          kMargin);
    case PeerShape::hull:
    case PeerShape::mesh:
      break;
  }
  return nullptr;
}

std::shared_ptr<btCollisionShape> make_hull(const std::vector<std::array<float, 3>>& points) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (const auto& point : points) hull->addPoint(vector(point.data()), false);
  hull->recalcLocalAabb();
  return with_margin(hull, 0);
}

struct TriangleMesh {
  explicit TriangleMesh(const PeerBodies& source) {
    for (const auto& [a, b, c] : source.triangles) {
      triangles.addTriangle(vector(source.vertices[a].data()), vector(source.vertices[b].data()),
                            vector(source.vertices[c].data()));
    }
    shape = std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
    shape->setMargin(kMargin);
  }
  btTriangleMesh triangles;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
};

std::shared_ptr<btCollisionShape> make_mesh(const PeerBodies& source) {
  auto mesh = std::make_shared<TriangleMesh>(source);
  btCollisionShape* shape = mesh->shape.get();
  return {std::move(mesh), shape};
}

// One side of the pairs.
class Bodies {
 public:
  explicit Bodies(const PeerBodies& source) {
    std::vector<std::shared_ptr<btCollisionShape>> shared;
    for (const PeerHull& hull : source.hulls) shared.push_back(make_hull(hull.points));
    if (source.shape == PeerShape::mesh) shared.push_back(make_mesh(source));
    for (const PeerBody& body : source.bodies) {
      shapes_.push_back(shared.empty() ? make_shape(source.shape, body.size) : shared[body.hull]);
      const auto& q = body.orientation;
      transforms_.emplace_back(btQuaternion(q[0], q[1], q[2], q[3]), vector(body.position.data()));
    }
  }

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

// Tests new pairs like btCollisionDispatcher::defaultNearCallback(), but makes the algorithm and
// its manifold once for all pairs.
class AlgorithmPairs final : public PairPeer {
 public:
  AlgorithmPairs(const PeerBodies& a, const PeerBodies& b) : a_(a), b_(b) {
    place(0);
    const Wrapper wrapper_a(object_a_), wrapper_b(object_b_);
    algorithm_ = dispatcher_.findAlgorithm(&wrapper_a.all, &wrapper_b.all, nullptr,
                                           BT_CONTACT_POINT_ALGORITHMS);
  }
  AlgorithmPairs(const AlgorithmPairs&) = delete;
  AlgorithmPairs& operator=(const AlgorithmPairs&) = delete;
  ~AlgorithmPairs() override {
    algorithm_->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm_);
  }

  size_t run(std::span<uint8_t> overlaps) override {
    size_t points = 0;
    for (size_t i = 0; i < a_.count(); ++i) {
      place(i);
      clear_manifolds();
      collide();
      const int touching = touching_points();
      overlaps[i] = touching > 0 ? 1 : 0;
      points += static_cast<size_t>(touching);
    }
    return points;
  }

 private:
  struct Wrapper {
    explicit Wrapper(const btCollisionObject& object)
        : all(nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1) {}
    btCollisionObjectWrapper all;
  };

  void place(size_t i) {
    a_.put(i, object_a_);
    b_.put(i, object_b_);
  }

  void collide() {
    const Wrapper wrapper_a(object_a_), wrapper_b(object_b_);
    btManifoldResult result(&wrapper_a.all, &wrapper_b.all);
    algorithm_->processCollision(&wrapper_a.all, &wrapper_b.all, info_, &result);
  }

  void clear_manifolds() {
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      dispatcher_.getManifoldByIndexInternal(i)->clearManifold();
    }
  }

  // Counts touching points only; Bullet also keeps points of bodies slightly separate.
  int touching_points() {
    int touching = 0;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(i);
      for (int point = 0; point < manifold.getNumContacts(); ++point) {
        touching += manifold.getContactPoint(point).getDistance() <= 0 ? 1 : 0;
      }
    }
    return touching;
  }

  Bodies a_;
  Bodies b_;
  btCollisionObject object_a_;
  btCollisionObject object_b_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDispatcherInfo info_;
  btCollisionAlgorithm* algorithm_ = nullptr;
};

using Detector = btDiscreteCollisionDetectorInterface;

struct Decision final : Detector::Result {
  void setShapeIdentifiersA(int /*part*/, int /*index*/) override {}
  void setShapeIdentifiersB(int /*part*/, int /*index*/) override {}
  void addContactPoint(const btVector3& /*normal*/, const btVector3& /*point*/,
                       btScalar distance) override {
    touches = touches || distance <= 0;
  }
  bool touches = false;
};

// The detector of boxes without a manifold for its points.
class BoxBoxTest {
 public:
  void operator()(const btConvexShape* a, const btConvexShape* b,
                  const Detector::ClosestPointInput& input, Decision& decision) {
    btBoxBoxDetector detector(static_cast<const btBoxShape*>(a), static_cast<const btBoxShape*>(b));
    detector.getClosestPoints(input, decision, nullptr);
  }
};

// GJK, and EPA for overlapping pairs.
class GjkTest {
 public:
  void operator()(const btConvexShape* a, const btConvexShape* b,
                  const Detector::ClosestPointInput& input, Decision& decision) {
    btGjkPairDetector detector(a, b, &simplex_, &depth_);
    detector.getClosestPoints(input, decision, nullptr);
  }

 private:
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver depth_;
};

template <class Test>
class DetectorPairs final : public PairPeer {
 public:
  DetectorPairs(const PeerBodies& a, const PeerBodies& b) : a_(a), b_(b) {}

  size_t run(std::span<uint8_t> overlaps) override {
    size_t touching = 0;
    for (size_t i = 0; i < a_.count(); ++i) {
      Detector::ClosestPointInput input;
      input.m_transformA = a_.transform(i);
      input.m_transformB = b_.transform(i);
      Decision decision;
      test_(static_cast<btConvexShape*>(a_.shape(i)), static_cast<btConvexShape*>(b_.shape(i)),
            input, decision);
      overlaps[i] = decision.touches ? 1 : 0;
      touching += overlaps[i];
    }
    return touching;
  }

 private:
  Bodies a_;
  Bodies b_;
  Test test_;
};

// Bullet's casts, constructed for every pair, as in its world.
class ContinuousCast {
 public:
  btContinuousConvexCollision operator()(const btConvexShape* a, const btConvexShape* b) {
    return {a, b, &simplex_, &depth_};
  }

 private:
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver depth_;
};

class GjkCast {
 public:
  btGjkConvexCast operator()(const btConvexShape* a, const btConvexShape* b) {
    return {a, b, &simplex_};
  }

 private:
  btVoronoiSimplexSolver simplex_;
};

template <class MakeCast>
class CastPairs final : public PairPeer {
 public:
  CastPairs(const PeerBodies& a, const PeerBodies& b,
            std::vector<std::array<float, 3>> displacements)
      : a_(a), b_(b), displacements_(std::move(displacements)) {}

  size_t run(std::span<uint8_t> impacts) override {
    size_t found = 0;
    for (size_t i = 0; i < a_.count(); ++i) {
      btTransform end = b_.transform(i);
      end.setOrigin(end.getOrigin() + vector(displacements_[i].data()));
      auto cast =
          make_(static_cast<btConvexShape*>(a_.shape(i)), static_cast<btConvexShape*>(b_.shape(i)));
      btConvexCast::CastResult result;
      const bool meets =
          cast.calcTimeOfImpact(a_.transform(i), a_.transform(i), b_.transform(i), end, result);
      impacts[i] = meets && result.m_fraction <= 1 ? 1 : 0;
      found += impacts[i];
    }
    return found;
  }

 private:
  Bodies a_;
  Bodies b_;
  const std::vector<std::array<float, 3>> displacements_;
  MakeCast make_;
};

}  // namespace

std::unique_ptr<PairPeer> make_bullet_casts(const PeerBodies& a, const PeerBodies& b,
                                            std::vector<std::array<float, 3>> displacements,
                                            PeerCast cast) {
  if (cast == PeerCast::gjk) {
    return std::make_unique<CastPairs<GjkCast>>(a, b, std::move(displacements));
  }
  return std::make_unique<CastPairs<ContinuousCast>>(a, b, std::move(displacements));
}

std::unique_ptr<PairPeer> make_bullet_pairs(const PeerBodies& a, const PeerBodies& b,
                                            PeerDetail detail) {
  if (detail == PeerDetail::overlap) return std::make_unique<DetectorPairs<BoxBoxTest>>(a, b);
  if (detail == PeerDetail::distance) return std::make_unique<DetectorPairs<GjkTest>>(a, b);
  return std::make_unique<AlgorithmPairs>(a, b);
}

}  // namespace carom::bench
