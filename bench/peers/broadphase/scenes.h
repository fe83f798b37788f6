// The frames that all peers get.
#pragma once

#include <string>
#include <vector>

#include "bench/peers/broadphase/peer.h"
#include "bench/support/bounds_arrays.h"
#include "bench/support/frames.h"
#include "carom/base/result.h"

namespace carom::bench {

class PeerScene {
 public:
  explicit PeerScene(const SceneSpec& spec);
  // Reads the first frames of a recording of bounds.
  static Result<PeerScene> open(const std::string& path);

  const std::string& name() const { return name_; }
  size_t bodies() const { return boxes_.front().size(); }
  size_t frames() const { return boxes_.size(); }
  FrameBounds frame(size_t i) const;
  // The bounds of all frames.
  const Box& world() const { return world_; }

 private:
  explicit PeerScene(std::string name) : name_(std::move(name)) {}
  void add_frame(std::vector<Box> boxes);

  std::string name_;
  std::vector<std::vector<Box>> boxes_;  // frame by frame, like the columns
  std::vector<BoundsArrays> columns_;
  Box world_{};
};

}  // namespace carom::bench
