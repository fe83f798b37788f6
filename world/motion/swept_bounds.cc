#include "world/motion/swept_bounds.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/outward.h"
#include "base/parallel.h"
#include "shapes/body_reader.h"
#include "world/motion/bounding_radii.h"
#include "world/store/columns.h"
#include "world/store/row_blocks.h"

namespace carom {
namespace {

struct Corners {
  std::array<float, 3> lower, upper;
};

// The smallest float32 >= x, for 0 <= x <= FLT_MAX.
float upwards(double x) { return -round_downwards(-x); }

// Grows the box of a body that turns. A point at r from the body's position stays on the ball
// of radius |r| about it, and moves along an arc no longer than angle x |r|, so its chord is at
// most min(angle, 2) |r|. With R >= |r| the bounding radius, the turning body stays in the box of
// that ball, and in the present box grown by min(angle, 2) R on all sides: so in their
// intersection.
void turn(Corners& box, const BodyReader& reader, size_t i, const Eigen::Vector3f& rotation) {
  const float radius = bounding_radius(reader, i);
  if (!(radius <= FLT_MAX / 2)) {
    box.lower.fill(-INFINITY);
    box.upper.fill(INFINITY);
    return;
  }
  // a generous bound on the rounding of root and products
  constexpr double kRounding = 1 + 0x1p-40;
  const double x = rotation.x(), y = rotation.y(), z = rotation.z();
  const double angle = std::sqrt((x * x + y * y) + z * z) * kRounding;
  const float way = upwards(std::min(angle, 2.0) * double{radius});
  const Position<double> p = reader.position<double>(i);
  const double position[] = {p.x, p.y, p.z};
  const double reach = radius;
  for (size_t axis = 0; axis < 3; ++axis) {
    box.lower[axis] =
        std::max(sum_downwards(box.lower[axis], -way), sum_downwards(position[axis], -reach));
    box.upper[axis] =
        std::min(sum_upwards(box.upper[axis], way), sum_upwards(position[axis], reach));
  }
}

// Grows the box along the displacement. At time t the turned body lies in the same box moved by t
// times the displacement, so along each axis between the box's places at the start and at the end.
void move(Corners& box, const Eigen::Vector3f& displacement) {
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = sum_downwards(box.lower[axis], std::min(displacement[axis], 0.0f));
    box.upper[axis] = sum_upwards(box.upper[axis], std::max(displacement[axis], 0.0f));
  }
}

}  // namespace

void SweptBounds::update(const Collidables& bodies, const Sweeps& sweeps, const BoundsView& bounds,
                         Parallelism parallelism) {
  for (LargeVector<float>& column : columns_) column.resize(bounds.count);
  const BodyReader reader{bodies};
  for_each_block(bounds.count, kRowsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const size_t size = (end - begin) * sizeof(float);
      std::memcpy(&columns_[axis][begin], bounds.lower[axis] + begin, size);
      std::memcpy(&columns_[3 + axis][begin], bounds.upper[axis] + begin, size);
    }
    for (size_t i = begin; i < end; ++i) {
      const Sweep sweep = sweeps.sweep(static_cast<uint32_t>(i));
      const bool turns = sweeps.turns(static_cast<uint32_t>(i));
      const bool is_empty = columns_[0][i] > columns_[3][i];
      if (is_empty || (!turns && sweep.displacement.isZero(0))) continue;
      Corners box;
      for (size_t axis = 0; axis < 3; ++axis) {
        box.lower[axis] = columns_[axis][i];
        box.upper[axis] = columns_[3 + axis][i];
      }
      if (turns) turn(box, reader, i, sweep.rotation);
      move(box, sweep.displacement);
      for (size_t axis = 0; axis < 3; ++axis) {
        columns_[axis][i] = box.lower[axis];
        columns_[3 + axis][i] = box.upper[axis];
      }
    }
  });
}

BoundsView SweptBounds::view() const {
  const auto& c = columns_;
  return {{c[0].data(), c[1].data(), c[2].data()},
          {c[3].data(), c[4].data(), c[5].data()},
          c[0].size()};
}

size_t SweptBounds::bytes() const {
  size_t sum = 0;
  for (const LargeVector<float>& column : columns_) sum += bytes_of(column);
  return sum;
}

}  // namespace carom
