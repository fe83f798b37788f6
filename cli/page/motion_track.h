// The poses of a run's frames, for the page that plays them.
#pragma once

#include <cstdint>
#include <vector>

#include "carom/world/world.h"

namespace carom::cli {

class MotionTrack {
 public:
  // A run of `frames` frames with `bodies` bodies. Every frame is kept, or every second, third and
  // so on if the poses of all would take more than kMostBytes. The last frame is always kept.
  MotionTrack(uint64_t bodies, uint64_t frames);

  // Keeps this frame, if it is one of those: the poses of all bodies that are not fixed. Bodies
  // must be those of the first call.
  void note(const World& world, uint64_t frame);

  static constexpr uint64_t kMostBytes = 8'000'000;

  const std::vector<uint32_t>& bodies() const { return bodies_; }  // indices
  const std::vector<uint64_t>& frames() const { return frames_; }  // numbers of the kept frames
  // For each frame and body x, y, z relative to origin(), and a quaternion x, y, z, w.
  const std::vector<float>& poses() const { return poses_; }
  const Eigen::Vector3d& origin() const { return origin_; }

 private:
  void start(const World& world);

  uint64_t last_;
  uint64_t every_;
  std::vector<uint32_t> bodies_;
  std::vector<uint64_t> frames_;
  std::vector<float> poses_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
};

}  // namespace carom::cli
