// A ball joint: two points, one of each body, that stay together.
#pragma once

#include <cstdint>

#include "rigid_body.h"

namespace rigid {

class BallJoint {
 public:
  // Body indices, and the point in the frames of both bodies.
  BallJoint(uint32_t body_a, uint32_t body_b, const Vector3f& point_a, const Vector3f& point_b)
      : a(body_a), b(body_b), local_a(point_a), local_b(point_b) {}

  // Begins a step: the turns of both bodies, and the way from the position of A to that of B.
  void start(const Body& body_a, const Body& body_b, const Quaternionf& turn_a,
             const Quaternionf& turn_b, const Vector3f& from_a_to_b) {
    arm_a_ = turn_a * local_a;
    arm_b_ = turn_b * local_b;
    gap_ = from_a_to_b + arm_b_ - arm_a_;
    mass_ = (body_a.give(arm_a_) + body_b.give(arm_b_)).inverse();
  }

  void warm_start(Body& body_a, Body& body_b) const { push(body_a, body_b, impulse_); }

  void solve(Body& body_a, Body& body_b, const Softness& soft) {
    const Vector3f gap = gap_ + body_b.motion_of(arm_b_) - body_a.motion_of(arm_a_);
    const Vector3f velocity = body_b.velocity_at(arm_b_) - body_a.velocity_at(arm_a_);
    const Vector3f change = -soft.mass_scale * (mass_ * (velocity + soft.bias_rate * gap)) -
                            soft.impulse_scale * impulse_;
    impulse_ += change;
    push(body_a, body_b, change);
  }

  // How far the two points were apart when the last step began, in metres.
  float gap() const { return gap_.norm(); }

  uint32_t a, b;
  Vector3f local_a, local_b;

 private:
  void push(Body& body_a, Body& body_b, const Vector3f& impulse) const {
    body_a.push(-impulse, arm_a_);
    body_b.push(impulse, arm_b_);
  }

  Vector3f arm_a_ = Vector3f::Zero(), arm_b_ = Vector3f::Zero();  // of this step
  Vector3f gap_ = Vector3f::Zero();  // from the point of A to that of B, at the collision step
  Matrix3f mass_ = Matrix3f::Zero();
  Vector3f impulse_ = Vector3f::Zero();
};

}  // namespace rigid
