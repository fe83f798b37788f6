// The velocity of a point of a body.
#pragma once

#include <Eigen/Core>

namespace carom {

// The velocity of the point at `arm` from the position of a body that turns: linear + angular x
// arm, summed in one order for equal bits everywhere.
inline Eigen::Vector3f point_velocity(const Eigen::Vector3f& linear, const Eigen::Vector3f& angular,
                                      const Eigen::Vector3f& arm) {
  return {linear.x() + (angular.y() * arm.z() - angular.z() * arm.y()),
          linear.y() + (angular.z() * arm.x() - angular.x() * arm.z()),
          linear.z() + (angular.x() * arm.y() - angular.y() * arm.x())};
}

}  // namespace carom
