// Bullet's contacts of one pair, by the algorithm that its dispatcher chooses for the two kinds.
// Compiled only if the program is built with Bullet.
#include "accuracy/tiers/bullet.h"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>

#include <limits>

namespace carom::accuracy {
namespace {

// Bullet rounds the corners of boxes and thickens triangles by a margin. This share of the shape's
// size is small enough for a comparison. Hulls need no margin.
constexpr float kMarginShare = 1e-3f;

btVector3 vector(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

std::unique_ptr<btConvexShape> with_margin(std::unique_ptr<btConvexShape> shape, float size) {
  shape->setMargin(size * kMarginShare);
  return shape;
}

std::unique_ptr<btConvexShape> make_shape(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    return std::make_unique<btSphereShape>(sphere->radius);
  }
  if (const auto* box = std::get_if<Box>(&shape)) {
    return with_margin(std::make_unique<btBoxShape>(vector(box->half)), box->half.minCoeff());
  }
  if (const auto* hull = std::get_if<Hull>(&shape)) {
    auto bullet = std::make_unique<btConvexHullShape>();
    for (const Eigen::Vector3f& point : hull->geometry->points()) {
      bullet->addPoint(vector(point), false);
    }
    bullet->recalcLocalAabb();
    bullet->setMargin(0);
    return bullet;
  }
  const auto& corners = std::get<Triangle>(shape).corners;
  return with_margin(
      std::make_unique<btTriangleShape>(vector(corners[0]), vector(corners[1]), vector(corners[2])),
      (corners[1] - corners[0]).norm());
}

// One side of the pairs.
class Bodies {
 public:
  void add(const Shape& shape, const Pose& pose) {
    shapes_.push_back(make_shape(shape));
    const Eigen::Quaternionf q = pose.orientation.normalized();
    transforms_.emplace_back(btQuaternion(q.x(), q.y(), q.z(), q.w()),
                             vector(pose.position.cast<float>()));
  }

  void put(size_t i, btCollisionObject& object) const {
    object.setCollisionShape(shapes_[i].get());
    object.setWorldTransform(transforms_[i]);
  }

 private:
  std::vector<std::unique_ptr<btConvexShape>> shapes_;
  std::vector<btTransform> transforms_;
};

struct Wrapper {
  explicit Wrapper(const btCollisionObject& object)
      : all(nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1) {}
  btCollisionObjectWrapper all;
};

class Bullet final : public Contender {
 public:
  Bullet() = default;
  Bullet(const Bullet&) = delete;
  Bullet& operator=(const Bullet&) = delete;
  ~Bullet() override { free_algorithm(); }

  const char* setting() const override { return "Bullet"; }
  const char* tier() const override { return "peer"; }
  Promise promise() const override { return Promise::none; }

  // Only kinds that both libraries define in the same way.
  bool serves(const KindPair& kinds) const override {
    const auto is_known = [](ShapeKind kind) {
      return kind == ShapeKind::sphere || kind == ShapeKind::box || kind == ShapeKind::triangle ||
             kind == ShapeKind::hull;
    };
    return is_known(kinds.a) && is_known(kinds.b);
  }

  void prepare(const PairSet& pairs) override {
    free_algorithm();
    a_ = {};
    b_ = {};
    for (size_t i = 0; i < pairs.size(); ++i) {
      a_.add(pairs[i].shape_a, pairs[i].pose_a);
      b_.add(pairs[i].shape_b, pairs[i].pose_b);
    }
    if (pairs.size() == 0) return;
    place(0);
    const Wrapper wrapper_a(object_a_), wrapper_b(object_b_);
    algorithm_ = dispatcher_.findAlgorithm(&wrapper_a.all, &wrapper_b.all, nullptr,
                                           BT_CONTACT_POINT_ALGORITHMS);
  }

  void run(const PairSet& pairs, Detail /*detail*/, Answers& out) override {
    for (size_t i = 0; i < pairs.size(); ++i) {
      place(i);
      clear_manifolds();
      const Wrapper wrapper_a(object_a_), wrapper_b(object_b_);
      btManifoldResult result(&wrapper_a.all, &wrapper_b.all);
      algorithm_->processCollision(&wrapper_a.all, &wrapper_b.all, info_, &result);
      read(i, out);
    }
  }

 private:
  void place(size_t i) {
    a_.put(i, object_a_);
    b_.put(i, object_b_);
  }

  void clear_manifolds() {
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      dispatcher_.getManifoldByIndexInternal(i)->clearManifold();
    }
  }

  // Reads the deepest point. Bullet's normal there is from B to A.
  void read(size_t row, Answers& out) {
    float deepest = std::numeric_limits<float>::max();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(i);
      for (int k = 0; k < manifold.getNumContacts(); ++k) {
        const btManifoldPoint& point = manifold.getContactPoint(k);
        if (!(point.getDistance() < deepest)) continue;
        deepest = point.getDistance();
        const btVector3& n = point.m_normalWorldOnB;
        normal = -Eigen::Vector3f(n.x(), n.y(), n.z());
        if (manifold.getBody0() != &object_a_) normal = -normal;
      }
    }
    out.overlap[row] = deepest <= 0 ? 1 : 0;
    out.status[row] = 0;
    out.separation[row] = deepest;
    Answers::set_row(out.normal, row, normal);
  }

  void free_algorithm() {
    if (!algorithm_) return;
    algorithm_->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm_);
    algorithm_ = nullptr;
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

}  // namespace

std::unique_ptr<Contender> make_bullet() { return std::make_unique<Bullet>(); }

}  // namespace carom::accuracy
