#include "geometries/scaled_frame.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// More than the rounding of a scaled coordinate to float32, up to this magnitude.
double rounding_at(double magnitude) { return 0x1p-23 * magnitude + 0x1p-148; }

// The interval, each end times a factor, as a middle and half a size.
struct Interval {
  double middle, half;

  Interval(double lower, double upper, double grown, double factor) {
    const double first = (lower - grown) * factor, last = (upper + grown) * factor;
    middle = first / 2 + last / 2;
    half = std::fabs(last / 2 - first / 2) + 0x1p-50 * (std::fabs(first) + std::fabs(last));
  }
};

}  // namespace

ScaledFrame::ScaledFrame(const Eigen::Vector3f& scale, double thickness)
    : scale_{scale.x(), scale.y(), scale.z()}, thickness_(thickness) {}

TreeBox ScaledFrame::divided(const TreeBox& box) const { return divided(RoundedBox{box}).box; }

// Where the factors differ a ball would be an ellipsoid: a box is around it.
RoundedBox ScaledFrame::divided(const RoundedBox& box) const {
  const double factor = std::fabs(scale_[0]);
  const bool is_even = std::fabs(scale_[1]) == factor && std::fabs(scale_[2]) == factor;
  const double radius = std::sqrt(double{box.squared_radius}) * (1 + 0x1p-20) + thickness_;
  Double3 middle, half;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double lower = box.box.lower[axis], upper = box.box.upper[axis];
    const double furthest = std::max(std::fabs(lower), std::fabs(upper)) + radius;
    const double grown = rounding_at(furthest) + (is_even ? 0 : radius);
    const Interval interval(lower, upper, grown, 1 / scale_[axis]);
    middle[axis] = interval.middle;
    half[axis] = interval.half;
  }
  return is_even && radius > 0 ? rounded_outwards(middle, half, radius / factor)
                               : RoundedBox{rounded_outwards(middle, half)};
}

Double3 ScaledFrame::divided_normal(const Double3& normal) const {
  return {normal[0] * scale_[0], normal[1] * scale_[1], normal[2] * scale_[2]};
}

double ScaledFrame::limit_for(const Double3& normal, double limit) const {
  return limit + thickness_ * std::sqrt(dot(normal, normal));
}

TreeBox ScaledFrame::multiplied(const TreeBox& box) const {
  if (is_empty(box)) return box;
  Double3 middle, half;
  for (size_t axis = 0; axis < 3; ++axis) {
    const Interval interval(box.lower[axis], box.upper[axis], 0, scale_[axis]);
    middle[axis] = interval.middle;
    half[axis] =
        interval.half + thickness_ + rounding_at(std::fabs(interval.middle) + interval.half);
  }
  return rounded_outwards(middle, half);
}

}  // namespace carom
