#include "cli/page/motion_track.h"

#include <algorithm>

namespace carom::cli {

MotionTrack::MotionTrack(uint64_t bodies, uint64_t frames) : last_(frames - 1) {
  const uint64_t bytes_a_frame = std::max<uint64_t>(bodies, 1) * 7 * sizeof(float);
  const uint64_t most_frames = std::max<uint64_t>(kMostBytes / bytes_a_frame, 1);
  every_ = (frames + most_frames - 1) / most_frames;
}

void MotionTrack::note(const World& world, uint64_t frame) {
  if ((last_ - frame) % every_ != 0) return;
  if (frames_.empty()) start(world);
  frames_.push_back(frame);
  for (const uint32_t body : bodies_) {
    const BodyId id = world.id_of(body);
    for (const double x : world.position(id) - origin_) poses_.push_back(static_cast<float>(x));
    for (const float x : world.orientation(id).coeffs()) poses_.push_back(x);
  }
}

// Positions relative to the first body keep their precision far from the world's origin.
void MotionTrack::start(const World& world) {
  for (uint32_t i = 0; i < world.size(); ++i) {
    if (world.motion(world.id_of(i)) != Motion::fixed) bodies_.push_back(i);
  }
  for (const uint32_t body : bodies_) {
    const Eigen::Vector3d position = world.position(world.id_of(body));
    if (!position.allFinite()) continue;
    origin_ = position;
    return;
  }
}

}  // namespace carom::cli
