// A rigid body as a solver sees it, and the damped spring that its constraints are.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace rigid {

using Eigen::Matrix3f;
using Eigen::Quaternionf;
using Eigen::Vector3f;

// SI units. The body's position is its centre of mass.
struct Mass {
  float mass = 0;                       // 0: the body does not move
  Matrix3f inertia = Matrix3f::Zero();  // in the body's frame, about its position
};

struct Body {
  float inverse_mass = 0;
  Matrix3f inverse_inertia = Matrix3f::Zero();        // in the body's frame
  Matrix3f inverse_inertia_world = Matrix3f::Zero();  // of this step
  Vector3f velocity = Vector3f::Zero();
  Vector3f spin = Vector3f::Zero();              // angular velocity
  Vector3f moved = Vector3f::Zero();             // since the collision step
  Quaternionf turned = Quaternionf::Identity();  // since the collision step

  Vector3f velocity_at(const Vector3f& arm) const { return velocity + spin.cross(arm); }
  Vector3f motion_of(const Vector3f& arm) const { return moved + turned * arm - arm; }
  void push(const Vector3f& impulse, const Vector3f& arm) {
    velocity += inverse_mass * impulse;
    spin += inverse_inertia_world * arm.cross(impulse);
  }
  // How much an impulse of one along this direction changes the velocity there.
  float give(const Vector3f& arm, const Vector3f& direction) const {
    const Vector3f turn = arm.cross(direction);
    return inverse_mass + turn.dot(inverse_inertia_world * turn);
  }
  // The same for impulses along all axes.
  Matrix3f give(const Vector3f& arm) const {
    Matrix3f cross;
    cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
    return inverse_mass * Matrix3f::Identity() - cross * inverse_inertia_world * cross;
  }
};

// The soft constraint: a damped spring, integrated implicitly over h.
struct Softness {
  float bias_rate = 0, mass_scale = 1, impulse_scale = 0;

  static Softness of(float hertz, float damping_ratio, float h) {
    const float omega = 2 * 3.14159265f * hertz;
    const float damping = 2 * damping_ratio + h * omega, stiffness = h * omega * damping;
    return {omega / damping, stiffness / (1 + stiffness), 1 / (1 + stiffness)};
  }
};

}  // namespace rigid
