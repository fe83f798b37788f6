#include "tests/support/stated.h"

namespace carom::test {

StatedBody stated_body(const Shape& shape, const Pose& pose) {
  const Eigen::Vector3d& p = pose.position;
  const Eigen::Quaternionf& q = pose.orientation;
  return {shape, {p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

}  // namespace carom::test
