// Factors along the axes of a shape's frame.
#pragma once

#include <Eigen/Core>
#include <string>

#include "carom/base/result.h"

namespace carom {

// Fails if a factor is zero or not finite.
Result<void> check_scale(const Eigen::Vector3f& scale);

// "(1, 2, 0.5)"
std::string text_of_scale(const Eigen::Vector3f& scale);

// The factors of a scale after another one. Fails if they leave the range of float32.
Result<Eigen::Vector3f> scale_after(const Eigen::Vector3f& first, const Eigen::Vector3f& second);

inline bool is_mirroring(const Eigen::Vector3f& scale) {
  return (scale.array() < 0).count() % 2 != 0;
}

// Whether the factors are equal but for their signs.
inline bool is_uniform(const Eigen::Vector3f& scale) {
  const Eigen::Vector3f factors = scale.cwiseAbs();
  return factors.x() == factors.y() && factors.y() == factors.z();
}

}  // namespace carom
