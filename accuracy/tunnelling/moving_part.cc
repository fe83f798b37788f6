#include "accuracy/tunnelling/moving_part.h"

#include <cmath>
#include <limits>
#include <variant>

#include "reference/simple_parts.h"

namespace carom::accuracy {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Vec = oracle::Vec3<double>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Quaterniond turn_by(const Vector3d& rotation, double t) {
  const double angle = rotation.norm() * t;
  if (!(angle > 0)) return Quaterniond::Identity();
  return Quaterniond(Eigen::AngleAxisd(angle, rotation.normalized()));
}

oracle::Rotation<double> rotation_of(const Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

bool turns(const Shape& shape) {
  return !std::holds_alternative<Sphere>(shape) && !std::holds_alternative<Aabb>(shape);
}

Vec middle_of(const Shape& shape, const Solid& solid) {
  if (std::holds_alternative<Halfspace>(shape)) return {};
  if (const auto* hull = std::get_if<Hull>(&shape)) {
    return oracle::vec3_as<double>(hull->geometry->middle());
  }
  return solid.centroid();
}

}  // namespace

Pose pose_at(const MovingBody& body, double t) {
  Pose pose{body.desc.position, body.desc.orientation};
  pose.position += body.sweep.displacement.cast<double>() * t;
  const Vector3d rotation = body.sweep.rotation.cast<double>();
  if (t > 0 && !rotation.isZero(0)) {
    const Quaterniond start = body.desc.orientation.cast<double>().normalized();
    pose.orientation = (turn_by(rotation, t) * start).cast<float>();
  }
  return pose;
}

MovingPart::MovingPart(const Shape& shape, const Vector3d& arm,
                       const Eigen::Quaternionf& orientation, const Sweep& sweep)
    : own_(shape),
      arm_(oracle::vec3_as<double>(arm)),
      own_middle_(middle_of(shape, own_)),
      start_(orientation.cast<double>()),
      rotation_(sweep.rotation.cast<double>()),
      turns_(turns(shape)) {
  double reach = 0;
  for (const Vec& p : own_.points) reach = std::max(reach, turns_ ? length(p) : 0);
  if (own_.is_halfspace) reach = kInfinity;
  const double angle = rotation_.norm();
  if (angle > 0) turned_way_ = angle * (reach + length(arm_));
  if (const auto* triangle = std::get_if<Triangle>(&shape)) {
    is_one_sided_ = triangle->one_sided;
    thickness_ = triangle->thickness;
  }
  find_box(sweep.displacement.cast<double>());
}

void MovingPart::find_box(const Vector3d& displacement) {
  lower_.setConstant(kInfinity);
  upper_ = -lower_;
  if (own_.is_halfspace) lower_.swap(upper_);
  Solid start = own_;
  turn_to(0, start);
  for (const Vec& p : start.points) {
    const Vector3d corner(p.x, p.y, p.z);
    // A turning point stays within the ball about the body's position.
    const Vector3d reach = Vector3d::Constant(length(p));
    lower_ = lower_.cwiseMin(turned_way_ > 0 ? Vector3d(-reach) : corner);
    upper_ = upper_.cwiseMax(turned_way_ > 0 ? reach : corner);
  }
  lower_ -= Vector3d::Constant(own_.radius);
  upper_ += Vector3d::Constant(own_.radius);
  lower_ += displacement.cwiseMin(0);
  upper_ += displacement.cwiseMax(0);
}

Quaterniond MovingPart::orientation_at(double t) const {
  return turns_ ? turn_by(rotation_, t) * start_ : Quaterniond::Identity();
}

Vec MovingPart::arm_at(double t) const { return rotation_of(turn_by(rotation_, t))(arm_); }

Vec MovingPart::middle_at(double t) const {
  return rotation_of(orientation_at(t))(own_middle_) + arm_at(t);
}

void MovingPart::turn_to(double t, Solid& out) const {
  out = own_;
  if (turns_) out.rotate(rotation_of(orientation_at(t)));
  out.translate(arm_at(t));
}

std::vector<MovingPart> moving_parts(const MovingBody& body) {
  std::vector<MovingPart> parts;
  for (const reference::Simple& part :
       reference::parts_of(body.desc.shape, {}, body.desc.orientation)) {
    const Vector3d arm(part.arm[0], part.arm[1], part.arm[2]);
    parts.push_back(MovingPart(part.shape, arm, part.pose().orientation, body.sweep));
  }
  return parts;
}

}  // namespace carom::accuracy
