// Convex parts of bodies on their way, for a reference that asks where they are at one time after
// the other.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "carom/results/sweep.h"
#include "carom/shapes/body.h"
#include "oracle/convex_shape.h"

namespace carom::accuracy {

using Solid = oracle::ConvexShape<double>;

// A body over the interval, t from 0 to 1.
struct MovingBody {
  BodyDesc desc;
  Sweep sweep;
};

// Where the body is at time t, the rotation rounded to float32.
Pose pose_at(const MovingBody& body, double t);

class MovingPart {
 public:
  const Solid& own() const { return own_; }  // in its own frame
  // What holds the part at all times: corners relative to the position of the body at the start.
  const Eigen::Vector3d& lower() const { return lower_; }
  const Eigen::Vector3d& upper() const { return upper_; }
  // The most that a point of its core moves by turning in the whole interval.
  double turned_way() const { return turned_way_; }
  // Some point inside of it, turned as at time t, relative to the position of the body then.
  oracle::Vec3<double> middle_at(double t) const;
  bool is_one_sided() const { return is_one_sided_; }
  double thickness() const { return thickness_; }

  // The part at time t about the position of the body then.
  void turn_to(double t, Solid& out) const;

 private:
  friend std::vector<MovingPart> moving_parts(const MovingBody& body);
  MovingPart(const Shape& shape, const Eigen::Vector3d& arm, const Eigen::Quaternionf& orientation,
             const Sweep& sweep);

  Eigen::Quaterniond orientation_at(double t) const;
  oracle::Vec3<double> arm_at(double t) const;
  void find_box(const Eigen::Vector3d& displacement);

  Solid own_;
  oracle::Vec3<double> arm_;  // from the body's position, at the start
  oracle::Vec3<double> own_middle_;
  Eigen::Quaterniond start_;
  Eigen::Vector3d rotation_;  // over the interval
  bool turns_;                // balls and aabbs are the same, however their bodies turn
  double turned_way_ = 0;
  bool is_one_sided_ = false;
  double thickness_ = 0;
  Eigen::Vector3d lower_, upper_;
};

// Of a body itself alone, unless it is a mesh or a compound.
std::vector<MovingPart> moving_parts(const MovingBody& body);

}  // namespace carom::accuracy
