#include "world/changes/pose_sample.h"

#include <algorithm>
#include <cstring>

namespace carom {

bool PoseSample::all_moved(const BodyStore& bodies) {
  const size_t step = std::max<size_t>(1, bodies.rows() / kPoses);
  const size_t samples = std::min(kPoses, bodies.rows() / step);
  bool moved = rows_ == bodies.rows() && samples > 0;
  rows_ = bodies.rows();
  for (size_t k = 0; k < samples; ++k) {
    // At a different place of each stretch, since bodies at regular indices may be of one kind.
    const size_t index = k * step + k * 2654435761u % step;
    const Eigen::Vector3d now = bodies.position(static_cast<uint32_t>(index));
    moved &= std::memcmp(now.data(), positions_[k].data(), sizeof now) != 0;
    positions_[k] = now;
  }
  return moved;
}

}  // namespace carom
