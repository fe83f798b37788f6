// Convex parts of moving bodies, placed at any time of the interval for the tunnelling reference.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "carom/results/sweep.h"
#include "carom/shapes/body.h"
#include "oracle/convex_shape.h"

namespace carom::accuracy {

using Solid = oracle::ConvexShape<double>;

// A body and its movement over the interval, t from 0 to 1.
struct MovingBody {
  BodyDesc desc;
  Sweep sweep;
};

// The pose at time t; the rotation is rounded to float32.
Pose pose_at(const MovingBody& body, double t);

class MovingPart {
 public:
  const Solid& own() const { return own_; }  // in its own frame
  // Corners of a box that contains the part at all times, relative to the body's position at the
  // start.
  const Eigen::Vector3d& lower() const { return lower_; }
  const Eigen::Vector3d& upper() const { return upper_; }
  // A bound of how far rotation moves a point of its core in the whole interval.
  double turned_way() const { return turned_way_; }
  // A point inside the part at time t, relative to the body's position then.
  oracle::Vec3<double> middle_at(double t) const;
  bool is_one_sided() const { return is_one_sided_; }
  double thickness() const { return thickness_; }

  // The part at time t relative to the body's position then.
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
  bool turns_;                // false for spheres and aabbs, which do not turn with their bodies
  double turned_way_ = 0;
  bool is_one_sided_ = false;
  double thickness_ = 0;
  Eigen::Vector3d lower_, upper_;
};

// One part, unless the body is a mesh or a compound.
std::vector<MovingPart> moving_parts(const MovingBody& body);

}  // namespace carom::accuracy
