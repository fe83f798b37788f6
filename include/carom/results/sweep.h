// How bodies move during one interval: t from 0 to 1.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace carom {

// The motion of a body over the interval. At time t its position is moved by t * displacement, and
// it has turned about its position by the angle t * |rotation| around the axis of `rotation`, with
// constant velocities. Spheres and aabbs do not turn, whatever their rotation.
struct Sweep {
  Eigen::Vector3f displacement = Eigen::Vector3f::Zero();  // world frame, metres
  Eigen::Vector3f rotation = Eigen::Vector3f::Zero();      // rotation vector, world frame, radians
};

// Sweeps of the bodies of a view, one a body: x, y, z float32, `stride` bytes apart. An array that
// is not there (nullptr) is zero for all.
struct SweepView {
  const float* displacement = nullptr;
  size_t displacement_stride = 3 * sizeof(float);
  const float* rotation = nullptr;
  size_t rotation_stride = 3 * sizeof(float);
};

}  // namespace carom
