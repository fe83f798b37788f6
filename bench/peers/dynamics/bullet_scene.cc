#include "bench/peers/dynamics/bullet_scene.h"

#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <vector>

namespace carom::bench {
namespace {

btVector3 bullet(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

// Bullet's shapes with their default margins.
std::unique_ptr<btCollisionShape> make_shape(const Shape& shape, btTriangleMesh& triangles) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    return std::make_unique<btSphereShape>(sphere->radius);
  }
  if (const auto* box = std::get_if<Box>(&shape)) {
    return std::make_unique<btBoxShape>(bullet(box->half));
  }
  if (const auto* capsule = std::get_if<Capsule>(&shape)) {  // of these scenes: along x
    return std::make_unique<btCapsuleShapeX>(capsule->radius, (capsule->b - capsule->a).norm());
  }
  if (const auto* plane = std::get_if<Halfspace>(&shape)) {
    return std::make_unique<btStaticPlaneShape>(bullet(plane->normal.normalized()),
                                                plane->offset / plane->normal.norm());
  }
  if (const auto* hull = std::get_if<Hull>(&shape)) {
    auto made = std::make_unique<btConvexHullShape>();
    for (const Eigen::Vector3f& point : hull->geometry->points()) made->addPoint(bullet(point));
    return made;
  }
  const MeshGeometry& mesh = *std::get<Mesh>(shape).geometry;
  for (const auto& [i, j, k] : mesh.triangles()) {
    const auto& v = mesh.vertices();
    triangles.addTriangle(bullet(v[i]), bullet(v[j]), bullet(v[k]));
  }
  return std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
}

}  // namespace

struct BulletScene::State {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btTriangleMesh>> triangles;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;  // indexed by BodyId::index
  std::vector<std::unique_ptr<btTypedConstraint>> joints;
  int substeps = 1;

  ~State() {
    for (const auto& joint : joints) world.removeConstraint(joint.get());
    for (const auto& body : bodies) world.removeRigidBody(body.get());
  }

  void add(const World& from, uint32_t index, const rigid::Body& body, float friction) {
    const BodyId id = from.id_of(index);
    triangles.push_back(std::make_unique<btTriangleMesh>());
    shapes.push_back(make_shape(from.shape(id), *triangles.back()));
    const Eigen::Quaternionf turn = from.orientation(id).normalized();
    btDefaultMotionState* const no_state = nullptr;
    const bool moves = body.inverse_mass > 0;
    const float mass = moves ? 1 / body.inverse_mass : 0;
    // Bullet knows the inertia along three axes alone: that of the scenes' hulls has small others.
    Eigen::Vector3f inertia = Eigen::Vector3f::Zero();
    if (moves) inertia = body.inverse_inertia.inverse().diagonal();
    btRigidBody::btRigidBodyConstructionInfo info(mass, no_state, shapes.back().get(),
                                                  bullet(inertia));
    info.m_friction = std::sqrt(friction);  // Bullet multiplies those of the two bodies
    info.m_startWorldTransform = btTransform(btQuaternion(turn.x(), turn.y(), turn.z(), turn.w()),
                                             bullet(from.position(id).cast<float>()));
    bodies.push_back(std::make_unique<btRigidBody>(info));
    bodies.back()->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(bodies.back().get());
  }
};

BulletScene::BulletScene(const rigid::Scene& scene, int substeps) : state_(new State) {
  State& state = *state_;
  state.substeps = substeps;
  const rigid::SolverSettings& settings = scene.solver.settings();
  state.world.setGravity(bullet(settings.gravity));
  for (uint32_t i = 0; i < scene.solver.bodies().size(); ++i) {
    state.add(scene.solver.world(), i, scene.solver.bodies()[i], settings.friction);
  }
  for (const rigid::BallJoint& joint : scene.solver.joints()) {
    state.joints.push_back(
        std::make_unique<btPoint2PointConstraint>(*state.bodies[joint.a], *state.bodies[joint.b],
                                                  bullet(joint.local_a), bullet(joint.local_b)));
    state.world.addConstraint(state.joints.back().get(), true);
  }
}

BulletScene::~BulletScene() = default;

void BulletScene::step() {
  for (int i = 0; i < state_->substeps; ++i) {
    state_->world.stepSimulation(1.0f / 60 / static_cast<float>(state_->substeps), 0);
  }
}

Eigen::Vector3d BulletScene::position(BodyId id) const {
  const btVector3& at = state_->bodies[id.index]->getWorldTransform().getOrigin();
  return {at.x(), at.y(), at.z()};
}

double BulletScene::speed(BodyId id) const {
  return state_->bodies[id.index]->getLinearVelocity().length();
}

double BulletScene::deepest() const {
  double most = 0;
  for (int i = 0; i < state_->dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *state_->dispatcher.getManifoldByIndexInternal(i);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      most = std::max(most, -static_cast<double>(manifold.getContactPoint(k).getDistance()));
    }
  }
  return most;
}

}  // namespace carom::bench
