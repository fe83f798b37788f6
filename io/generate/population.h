// Where the bodies of a generated scene start, how large they are and how they move.
#pragma once

#include <cstdint>
#include <vector>

#include "io/generate/random.h"
#include "io/generate/spec.h"

namespace carom::io {

struct Population {
  Vec3 lower{};  // the world's walls
  Vec3 upper{};
  double speed = 0;           // the greatest, metres a second
  double spin = 0;            // the greatest, radians a second
  uint64_t mover_stride = 1;  // bodies 0, stride, 2 stride ... move, others never do
  std::vector<Vec3> half;     // half the extents along the world's axes in the first frame
  std::vector<Vec3> position;
  std::vector<Vec3> velocity;
  // For shapes that turn; otherwise empty.
  std::vector<Vec3> edges;  // a box's edges; others: length or diameter, three times
  std::vector<Quaternion> orientation;
  std::vector<Vec3> angular_velocity;

  uint64_t movers() const { return (position.size() + mover_stride - 1) / mover_stride; }
};

Population populate(const GeneratorSpec& spec);

}  // namespace carom::io
