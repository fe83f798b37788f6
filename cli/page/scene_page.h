// Writes --page: a page that shows the last frame of a run in 3D, and plays those before it.
#pragma once

#include <cstdint>
#include <string>

#include "carom/world/world.h"
#include "cli/page/motion_track.h"
#include "io/files/atomic_file.h"

namespace carom::cli {

class ScenePage {
 public:
  static Result<ScenePage> create(const std::string& path);

  // Writes the world after its last step, and the poses before, `dt` seconds a frame. Call this
  // once.
  Result<void> add_frame(const World& world, const std::string& scene, uint64_t frame,
                         const MotionTrack& track, double dt);
  Result<void> finish() { return file_.commit(); }

 private:
  explicit ScenePage(io::AtomicFile file) : file_(std::move(file)) {}

  io::AtomicFile file_;
};

}  // namespace carom::cli
