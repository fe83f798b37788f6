// Frames of generated scenes.
#pragma once

#include <string>
#include <vector>

#include "bench/support/bodies.h"

namespace carom::bench {

// Plays frames forwards and backwards, so that bodies always move as far per frame as the scene
// says.
class FrameCycle {
 public:
  explicit FrameCycle(size_t frames) : last_(frames - 1) {}

  size_t next();

 private:
  size_t last_;
  size_t frame_ = 0;
  bool forwards_ = true;
};

struct SceneSpec {
  std::string generator;  // "brownian", ...
  size_t bodies = 0;
  ShapeKind kind = ShapeKind::aabb;

  std::string name() const;  // brownian_10k
  friend bool operator==(const SceneSpec&, const SceneSpec&) = default;
};

// The first frames of a scene, in memory.
class Frames {
 public:
  static constexpr size_t kCount = 8;

  explicit Frames(const SceneSpec& spec);

  const SceneSpec& spec() const { return spec_; }
  // Positions in that frame, x, y, z for each body.
  const std::vector<float>& positions(size_t frame) const { return positions_[frame]; }
  std::vector<PlacedShape> bodies(size_t frame) const;

 private:
  SceneSpec spec_;
  std::vector<Shape> shapes_;
  std::vector<std::vector<float>> positions_;
};

// 1k, 10k, ... bodies, up to `most`.
std::vector<size_t> scene_sizes(size_t most);

}  // namespace carom::bench
