// Computes the world bounds of a scene's bodies, frame by frame, as boxes of a recording.
#pragma once

#include <array>
#include <vector>

#include "carom/shapes/views.h"
#include "io/scene.h"

namespace carom::cli {

class SceneBounds {
 public:
  // All bodies must be of one kind, as in generated scenes. `info` must outlive this object.
  explicit SceneBounds(const io::SceneInfo& info);

  // min x y z 0, max x y z 0 a body; valid until the next call.
  const std::vector<float>& boxes(const io::SceneFrame& frame);

 private:
  using Columns = std::array<std::vector<float>, 3>;
  void add_rows();
  ShapeKind kind() const;
  Collidables view(const io::SceneFrame& frame) const;

  const io::SceneInfo& info_;
  Columns half_;
  Columns negative_half_;
  Columns lower_;
  Columns upper_;
  std::vector<Shape> shapes_;  // only for kinds that have rows
  std::vector<std::array<float, 4>> rows_;
  std::vector<float> boxes_;
};

}  // namespace carom::cli
