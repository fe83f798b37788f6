// Shapes for the built-in pairs of `carom verify`.
#pragma once

#include <array>
#include <vector>

#include "carom/shapes/body.h"
#include "io/generate/random.h"

namespace carom::cli {

// A shape whose numbers are all 0 or plus or minus `size`.
Shape even_shape(ShapeKind kind, float size);

// Random shapes, including degenerate ones, and poses.
class RandomShapes {
 public:
  explicit RandomShapes(io::Random& random) : random_(random) {}

  // About as large as `size`.
  Shape shape(ShapeKind kind, double size);
  // A quaternion, mostly far from unit length.
  Eigen::Quaternionf orientation();
  Eigen::Vector3d in_ball(double radius);
  bool one_of(uint32_t count) { return random_.below(count) == 0; }

 private:
  Eigen::Vector3f point(double radius) { return in_ball(radius).cast<float>(); }
  // Above 0.
  float some_rounding(double size) { return static_cast<float>(size * random_.between(0.01, 0.5)); }
  // Most shapes have none.
  float rounding(double size) { return one_of(4) ? some_rounding(size) : 0; }
  float up_to(double limit) { return static_cast<float>(random_.between(0, limit)); }
  std::vector<Eigen::Vector3f> some_points(size_t count, double size);
  Eigen::Vector3f half_extents(double size);
  Capsule capsule(double size);
  Dop dop(double size);
  Hull hull(double size);
  Mesh mesh(double size);
  Compound compound(double size);
  Triangle triangle(double size);
  Halfspace halfspace(double size);

  io::Random& random_;
  io::LogUniform lengths_{1e-15, 1e15};
};

}  // namespace carom::cli
