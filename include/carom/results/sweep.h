/// @file
/// The motion of bodies during one interval: t from 0 to 1.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace carom {

/// The motion of a body over the interval, with constant velocities. At time t its position has
/// moved by t * displacement, and the body has turned about its position by the angle
/// t * |rotation| around the axis of `rotation`. Spheres and aabbs do not turn.
struct Sweep {
  Eigen::Vector3f displacement = Eigen::Vector3f::Zero();  ///< world frame, metres
  Eigen::Vector3f rotation = Eigen::Vector3f::Zero();  ///< rotation vector, world frame, radians
};

/// Sweeps of the bodies of a view, one a body: records of x, y, z float32, strides in bytes. An
/// array that is nullptr is zero for all bodies.
struct SweepView {
  const float* displacement = nullptr;             ///< world frame, metres
  size_t displacement_stride = 3 * sizeof(float);  ///< bytes
  const float* rotation = nullptr;                 ///< rotation vectors, world frame, radians
  size_t rotation_stride = 3 * sizeof(float);      ///< bytes
};

}  // namespace carom
