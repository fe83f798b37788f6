#include "geometries/scale.h"

#include <cstdio>

namespace carom {

std::string text_of_scale(const Eigen::Vector3f& scale) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g)", double{scale.x()}, double{scale.y()},
                double{scale.z()});
  return text;
}

Result<void> check_scale(const Eigen::Vector3f& scale) {
  if (scale.allFinite() && (scale.array() != 0).all()) return {};
  return Error{"the scale " + text_of_scale(scale) + " has a factor that is 0 or not finite"};
}

Result<Eigen::Vector3f> scale_after(const Eigen::Vector3f& first, const Eigen::Vector3f& second) {
  if (Result<void> checked = check_scale(second); !checked) return checked.error();
  const Eigen::Vector3f both = first.cwiseProduct(second);
  if (check_scale(both)) return both;
  return Error{"the scale " + text_of_scale(second) + " after " + text_of_scale(first) +
               " leaves the range of float32"};
}

}  // namespace carom
