/// @file
/// The quaternions of the public interface.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace carom {

/// A quaternion that may lie at any address of a float. Eigen::Quaternionf converts to it and from
/// it; but how that one is aligned depends on macros of Eigen (EIGEN_DONT_ALIGN), so that a program
/// and a library compiled apart could disagree on where a Pose keeps it.
using Orientation = Eigen::Quaternion<float, Eigen::DontAlign>;
static_assert(sizeof(Orientation) == 4 * sizeof(float) && alignof(Orientation) == alignof(float));

}  // namespace carom
