// Makes the stored bodies that the proofs of single pairs take.
#pragma once

#include "carom/shapes/body.h"
#include "narrowphase/batch/stated_body.h"

namespace carom::test {

inline StatedBody stated_body(const Shape& shape, const Pose& pose) {
  const Eigen::Vector3d& p = pose.position;
  const Eigen::Quaternionf& q = pose.orientation;
  return {shape, {p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

}  // namespace carom::test
