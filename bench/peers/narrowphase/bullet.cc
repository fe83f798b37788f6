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
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <cmath>

#include "bench/peers/narrowphase/bullet_bodies.h"

namespace carom::bench {
namespace {

// Tests new pairs like btCollisionDispatcher::defaultNearCallback(), but makes the algorithm and
// its manifold once for all pairs.
class AlgorithmPairs final : public PairPeer {
 public:
  AlgorithmPairs(const PeerBodies& a, const PeerBodies& b)
      : a_(a, false), b_(b, a.shape != PeerShape::mesh) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
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

  void run(PairAnswers& answers) override {
    for (size_t i = 0; i < a_.count(); ++i) {
      place(i);
      clear_manifolds();
      collide();
      answers.separations[i] = deepest_point();
      answers.overlaps[i] = answers.separations[i] <= 0 ? 1 : 0;
    }
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

  // Bullet also keeps points of bodies slightly separate.
  float deepest_point() {
    float deepest = kNotReported;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(i);
      for (int point = 0; point < manifold.getNumContacts(); ++point) {
        deepest = std::fmin(deepest, manifold.getContactPoint(point).getDistance());
      }
    }
    return deepest;
  }

  BulletBodies a_;
  BulletBodies b_;
  btCollisionObject object_a_;
  btCollisionObject object_b_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDispatcherInfo info_;
  btCollisionAlgorithm* algorithm_ = nullptr;
};

using Detector = btDiscreteCollisionDetectorInterface;

struct Deepest final : Detector::Result {
  void setShapeIdentifiersA(int /*part*/, int /*index*/) override {}
  void setShapeIdentifiersB(int /*part*/, int /*index*/) override {}
  void addContactPoint(const btVector3& /*normal*/, const btVector3& /*point*/,
                       btScalar distance) override {
    separation = std::fmin(separation, distance);
  }
  float separation = kNotReported;
};

// The detector of boxes without a manifold for its points.
class BoxBoxTest {
 public:
  void operator()(const btConvexShape* a, const btConvexShape* b,
                  const Detector::ClosestPointInput& input, Deepest& deepest) {
    btBoxBoxDetector detector(static_cast<const btBoxShape*>(a), static_cast<const btBoxShape*>(b));
    detector.getClosestPoints(input, deepest, nullptr);
  }
};

// GJK, and EPA for overlapping pairs.
class GjkTest {
 public:
  void operator()(const btConvexShape* a, const btConvexShape* b,
                  const Detector::ClosestPointInput& input, Deepest& deepest) {
    btGjkPairDetector detector(a, b, &simplex_, &depth_);
    detector.getClosestPoints(input, deepest, nullptr);
  }

 private:
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver depth_;
};

template <class Test>
class DetectorPairs final : public PairPeer {
 public:
  DetectorPairs(const PeerBodies& a, const PeerBodies& b) : a_(a), b_(b) {}

  void run(PairAnswers& answers) override {
    for (size_t i = 0; i < a_.count(); ++i) {
      Detector::ClosestPointInput input;
      input.m_transformA = a_.transform(i);
      input.m_transformB = b_.transform(i);
      Deepest deepest;
      test_(static_cast<btConvexShape*>(a_.shape(i)), static_cast<btConvexShape*>(b_.shape(i)),
            input, deepest);
      answers.separations[i] = deepest.separation;
      answers.overlaps[i] = deepest.separation <= 0 ? 1 : 0;
    }
  }

 private:
  BulletBodies a_;
  BulletBodies b_;
  Test test_;
};

}  // namespace

std::unique_ptr<PairPeer> make_bullet_pairs(const PeerBodies& a, const PeerBodies& b,
                                            PeerDetail detail) {
  if (detail == PeerDetail::overlap) return std::make_unique<DetectorPairs<BoxBoxTest>>(a, b);
  if (detail == PeerDetail::distance) return std::make_unique<DetectorPairs<GjkTest>>(a, b);
  return std::make_unique<AlgorithmPairs>(a, b);
}

}  // namespace carom::bench
