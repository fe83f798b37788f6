#include "world/changes/pace_sample.h"

#include <algorithm>

#include "shapes/body_reader.h"
#include "world/motion/bounding_radii.h"

namespace carom {
namespace {

constexpr size_t kMost = 256;
// A way in a step, by the radius: bounds that grow by a share of it hold such a body for some
// steps.
constexpr double kSlow = 0.004;

}  // namespace

void PaceSample::take(const BodyStore& bodies) {
  poses_.clear();
  const size_t stride = std::max<size_t>(1, bodies.rows() / kMost);
  for (size_t i = 0; i < bodies.rows(); i += stride) {
    const auto body = static_cast<uint32_t>(i);
    poses_.push_back({body, bodies.position(body), bodies.orientation(body)});
  }
}

float PaceSample::slow_share(const BodyStore& bodies, float tolerance) const {
  const Collidables view = bodies.view();
  size_t slow = 0;
  for (const Pose& before : poses_) {
    if (before.body >= bodies.rows()) continue;
    const double radius = bounding_radius(BodyReader{view}, before.body);
    const Orientation now = bodies.orientation(before.body);
    const double turn = (now.coeffs() - before.orientation.coeffs()).cast<double>().norm();
    const double way = (bodies.position(before.body) - before.position).norm() + 2 * turn * radius;
    const double half = 0.5 * double{bodies.tolerance(before.body).value_or(tolerance)};
    slow += way <= std::max(half, kSlow * radius);
  }
  return static_cast<float>(slow) / static_cast<float>(std::max<size_t>(1, poses_.size()));
}

}  // namespace carom
