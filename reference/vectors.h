// Numbers of the reference, and sums of products in one order.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace carom::reference {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kLargest = std::numeric_limits<float>::max();

inline double inner_product(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

inline double norm(const Eigen::Vector3d& v) { return std::sqrt(inner_product(v, v)); }
inline double norm(const Eigen::Vector3f& v) { return norm(v.cast<double>().eval()); }

}  // namespace carom::reference
