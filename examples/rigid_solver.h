// A small rigid-body solver on Carom's public calls: sequential impulses with warm start, soft
// contacts and sub-steps. One collision step a frame finds the contacts; the sub-steps follow each
// contact point with the two bodies that it belongs to, so that its separation stays true while
// they move (M. Macklin et al., "Small Steps in Physics Simulation", 2019; E. Catto, "Solver2D",
// 2024). docs/solver.md explains it. Restitution, sleeping, and the gyroscopic torque are left out.
#pragma once

#include <carom/carom.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "rigid_body.h"
#include "rigid_joint.h"

namespace rigid {

using carom::BodyId;

struct SolverSettings {
  Vector3f gravity = {0, 0, -9.81f};
  float dt = 1.0f / 60;
  int substeps = 10;
  float friction = 0.6f;
  float damping = 0;  // the share of their velocities that bodies lose in a frame
  // Overlaps are pushed out by a spring of this frequency and damping, no faster than push_speed.
  float hertz = 120;
  float damping_ratio = 2;
  float push_speed = 3;
};

// Arms go from the bodies' positions to one point in the world, halfway between the surfaces.
struct ContactPoint {
  Vector3f arm_a = Vector3f::Zero(), arm_b = Vector3f::Zero();
  float separation = 0;
  float normal_mass = 0;
  std::array<float, 2> tangent_mass{};
  float normal_impulse = 0;
  Vector3f friction_impulse = Vector3f::Zero();
};

struct ContactConstraint {
  uint32_t a, b;  // body indices
  Vector3f normal = Vector3f::Zero();
  std::array<Vector3f, 2> tangents = {normal, normal};
  int count = 0;
  std::array<ContactPoint, 4> points = {};
};

class Solver {
 public:
  explicit Solver(const SolverSettings& settings = {}, carom::WorldSettings world = {})
      : settings_(settings), world_(with_contacts(world)) {}

  BodyId add(const carom::BodyDesc& desc, const Mass& mass = {}) {
    carom::BodyDesc described = desc;
    if (mass.mass == 0) described.motion = carom::Motion::fixed;
    const BodyId id = world_.add(described);
    bodies_.resize(std::max<size_t>(bodies_.size(), id.index + 1));
    Body& body = bodies_[id.index] = {};
    body.velocity = desc.linear_velocity;
    body.spin = desc.angular_velocity;
    if (mass.mass > 0) {
      body.inverse_mass = 1 / mass.mass;
      body.inverse_inertia = mass.inertia.inverse();
    }
    return id;
  }

  // Joins two bodies at a point of the world. They do not meet each other any more.
  void join(BodyId a, BodyId b, const Vector3f& point) {
    const auto local = [&](BodyId id) -> Vector3f {
      return world_.orientation(id).conjugate() * (point - world_.position(id).cast<float>());
    };
    world_.exclude(a, b);
    joints_.emplace_back(a.index, b.index, local(a), local(b));
  }

  const SolverSettings& settings() const { return settings_; }
  carom::World& world() { return world_; }
  const carom::World& world() const { return world_; }
  std::span<const Body> bodies() const { return bodies_; }
  std::span<const ContactConstraint> contacts() const { return contacts_; }
  std::span<const BallJoint> joints() const { return joints_; }

  // One frame: where bodies touch, how fast they go on, where that takes them.
  void step() {
    world_.step();
    start_bodies();
    make_contacts();
    for (BallJoint& joint : joints_) start(joint);
    const float h = settings_.dt / static_cast<float>(settings_.substeps);
    const Softness soft =
        Softness::of(std::min(settings_.hertz, 0.25f / h), settings_.damping_ratio, h);
    for (int i = 0; i < settings_.substeps; ++i) {
      accelerate(h);
      warm_start();
      solve(h, soft, true);
      move(h);
      solve(h, soft, false);  // takes back the speed that pushing out gave
    }
    store_poses();
  }

 private:
  // What this solver needs of a world: all planes in which bodies touch, a little before they do,
  // and which points those of the last step are.
  static carom::WorldSettings with_contacts(carom::WorldSettings world) {
    world.detail = carom::Detail::regions;
    world.identities = true;
    if (world.contact_distance == 0) world.contact_distance = 0.1f;  // 6 m/s in a frame of 1/60 s
    return world;
  }

  void start_bodies() {
    for (uint32_t i = 0; i < bodies_.size(); ++i) {
      Body& body = bodies_[i];
      if (body.inverse_mass == 0) continue;
      const Matrix3f turn = world_.orientation(world_.id_of(i)).toRotationMatrix();
      body.inverse_inertia_world = turn * body.inverse_inertia * turn.transpose();
      body.moved.setZero();
      body.turned.setIdentity();
      body.velocity *= 1 - settings_.damping;
      body.spin *= 1 - settings_.damping;
    }
  }

  // The contacts of the world in their order, with the impulses of the last step.
  void make_contacts() {
    last_.swap(contacts_);
    contacts_.clear();
    for (size_t i = 0; i < world_.contacts().size(); ++i) {
      contacts_.push_back(constraint(world_.contacts()[i], world_.manifolds()[i]));
      take_over_impulses(world_.identities()[i], contacts_.back());
    }
  }

  ContactConstraint constraint(const carom::Contact& contact,
                               const carom::ManifoldPoints& manifold) const {
    ContactConstraint made{.a = contact.a, .b = contact.b, .normal = contact.normal};
    const Vector3f& n = made.normal;
    made.tangents[0] = n.unitOrthogonal();
    made.tangents[1] = n.cross(made.tangents[0]);
    const Body &a = bodies_[made.a], &b = bodies_[made.b];
    const Vector3f from_b_to_a =
        (world_.position(world_.id_of(made.a)) - world_.position(world_.id_of(made.b)))
            .cast<float>();
    made.count = contact.manifold_count;
    for (int i = 0; i < made.count; ++i) {
      ContactPoint& point = made.points[i];
      point.separation = manifold.separation[i];
      point.arm_a = Vector3f(manifold.point[i].data()) + 0.5f * point.separation * n;
      point.arm_b = point.arm_a + from_b_to_a;
      const auto mass = [&](const Vector3f& direction) {
        return 1 / (a.give(point.arm_a, direction) + b.give(point.arm_b, direction));
      };
      point.normal_mass = mass(n);
      point.tangent_mass = {mass(made.tangents[0]), mass(made.tangents[1])};
    }
    return made;
  }

  // Warm start: points begin with the impulses of the points that they continue.
  void take_over_impulses(const carom::ContactIdentity& identity,
                          ContactConstraint& contact) const {
    for (int i = 0; i < contact.count; ++i) {
      const uint32_t place = identity.previous_point[i];
      if (place == carom::kNoPrevious) continue;
      const ContactPoint& old = last_[place / 4].points[place % 4];
      ContactPoint& point = contact.points[i];
      point.normal_impulse = old.normal_impulse;
      point.friction_impulse =
          old.friction_impulse - old.friction_impulse.dot(contact.normal) * contact.normal;
    }
  }

  void start(BallJoint& joint) const {
    const BodyId a = world_.id_of(joint.a), b = world_.id_of(joint.b);
    joint.start(bodies_[joint.a], bodies_[joint.b], world_.orientation(a), world_.orientation(b),
                (world_.position(b) - world_.position(a)).cast<float>());
  }

  void accelerate(float h) {
    for (Body& body : bodies_) {
      if (body.inverse_mass > 0) body.velocity += h * settings_.gravity;
    }
  }

  void push(uint32_t a, uint32_t b, const Vector3f& impulse, const Vector3f& arm_a,
            const Vector3f& arm_b) {
    bodies_[a].push(-impulse, arm_a);
    bodies_[b].push(impulse, arm_b);
  }

  void warm_start() {
    for (const BallJoint& joint : joints_) joint.warm_start(bodies_[joint.a], bodies_[joint.b]);
    for (const ContactConstraint& contact : contacts_) {
      for (int i = 0; i < contact.count; ++i) {
        const ContactPoint& point = contact.points[i];
        push(contact.a, contact.b, point.normal_impulse * contact.normal + point.friction_impulse,
             point.arm_a, point.arm_b);
      }
    }
  }

  void solve(float h, const Softness& soft, bool push_out) {
    for (BallJoint& joint : joints_) {
      joint.solve(bodies_[joint.a], bodies_[joint.b], push_out ? soft : Softness{});
    }
    for (ContactConstraint& contact : contacts_) {
      for (int i = 0; i < contact.count; ++i) {
        solve_normal(contact, contact.points[i], h, soft, push_out);
      }
      for (int i = 0; i < contact.count; ++i) solve_friction(contact, contact.points[i]);
    }
  }

  void solve_normal(const ContactConstraint& contact, ContactPoint& point, float h, Softness soft,
                    bool push_out) {
    const Body &a = bodies_[contact.a], &b = bodies_[contact.b];
    const float separation =
        point.separation + contact.normal.dot(b.motion_of(point.arm_b) - a.motion_of(point.arm_a));
    float bias = 0;
    if (separation > 0) {
      bias = separation / h;  // may use up the gap, no more
    } else if (push_out) {
      bias = std::max(soft.bias_rate * separation, -settings_.push_speed);
    }
    if (separation > 0 || !push_out) soft = {};
    const float velocity =
        contact.normal.dot(b.velocity_at(point.arm_b) - a.velocity_at(point.arm_a));
    const float change = -soft.mass_scale * point.normal_mass * (velocity + bias) -
                         soft.impulse_scale * point.normal_impulse;
    const float before = point.normal_impulse;
    if (before == 0 && change <= 0) return;
    point.normal_impulse = std::max(before + change, 0.0f);  // contacts push, they do not pull
    push(contact.a, contact.b, (point.normal_impulse - before) * contact.normal, point.arm_a,
         point.arm_b);
  }

  // Coulomb's law: the friction is at most a share of the normal impulse.
  void solve_friction(const ContactConstraint& contact, ContactPoint& point) {
    const float most = settings_.friction * point.normal_impulse;
    if (most == 0 && point.friction_impulse.isZero(0)) return;
    const Vector3f velocity =
        bodies_[contact.b].velocity_at(point.arm_b) - bodies_[contact.a].velocity_at(point.arm_a);
    const Vector3f before = point.friction_impulse;
    for (int i = 0; i < 2; ++i) {
      const Vector3f& tangent = contact.tangents[i];
      point.friction_impulse -= point.tangent_mass[i] * tangent.dot(velocity) * tangent;
    }
    const float length = point.friction_impulse.norm();
    if (length > most) point.friction_impulse *= most / length;
    push(contact.a, contact.b, point.friction_impulse - before, point.arm_a, point.arm_b);
  }

  void move(float h) {
    for (Body& body : bodies_) {
      if (body.inverse_mass == 0) continue;
      body.moved += h * body.velocity;
      const Vector3f half = 0.5f * h * body.spin;
      body.turned = Quaternionf(1, half.x(), half.y(), half.z()) * body.turned;
      body.turned.normalize();
    }
  }

  void store_poses() {
    for (uint32_t i = 0; i < bodies_.size(); ++i) {
      if (bodies_[i].inverse_mass == 0) continue;
      const BodyId id = world_.id_of(i);
      world_.set_position(id, world_.position(id) + bodies_[i].moved.cast<double>());
      world_.set_orientation(id, (bodies_[i].turned * world_.orientation(id)).normalized());
    }
  }

  SolverSettings settings_;
  carom::World world_;
  std::vector<Body> bodies_;  // indexed by BodyId::index
  std::vector<ContactConstraint> contacts_, last_;
  std::vector<BallJoint> joints_;
};

}  // namespace rigid
