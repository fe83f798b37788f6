// The world bounds of a scene's bodies, frame by frame, as boxes of a recording.
#pragma once

#include <array>
#include <vector>

#include "carom/kernel/views.h"
#include "io/scene.h"

namespace carom::cli {

class SceneBounds {
 public:
  // Of a scene that is all spheres or all boxes. `info` has to live as long.
  explicit SceneBounds(const io::SceneInfo& info);

  // min x y z 0, max x y z 0 a body; valid until the next call.
  const std::vector<float>& boxes(const io::SceneFrame& frame);

 private:
  using Columns = std::array<std::vector<float>, 3>;
  Collidables view(const io::SceneFrame& frame) const;

  const io::SceneInfo& info_;
  Columns half_;
  Columns negative_half_;
  Columns lower_;
  Columns upper_;
  std::vector<float> boxes_;
};

}  // namespace carom::cli
