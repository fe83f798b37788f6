#include "queries/body_index.h"

#include <array>
#include <limits>

#include "broadphase/box_source.h"
#include "carom/bounds/bounds.h"
#include "queries/bounds_of.h"
#include "queries/grown_box.h"
#include "shapes/body_reader.h"

namespace carom {
namespace {

constexpr size_t kBodiesPerBlock = 4096;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TreeBox box_at(const BoundsView& bounds, size_t i) {
  TreeBox box;
  for (size_t axis = 0; axis < 3; ++axis) {
    box.lower[axis] = value_at(bounds, bounds.lower[axis], i);
    box.upper[axis] = value_at(bounds, bounds.upper[axis], i);
  }
  return box;
}

}  // namespace

BodyIndex index_bodies(const Collidables& bodies, const BoundsView& bounds,
                       std::span<const WorldHalfspace> halfspaces, Parallelism parallelism) {
  constexpr TreeBox kEmpty = {{kInfinity, kInfinity, kInfinity},
                              {-kInfinity, -kInfinity, -kInfinity}};
  const BodyReader reader{bodies};
  std::vector<TreeBox> boxes(bounds.count);
  for_each_block(bounds.count, kBodiesPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      boxes[i] =
          takes_part(bounds, i) ? grown(box_at(bounds, i), reader.position<double>(i)) : kEmpty;
    }
  });
  return {BoxTree::packed(boxes, parallelism), {halfspaces.begin(), halfspaces.end()}};
}

BodyIndex index_bodies(const Collidables& bodies, Parallelism parallelism) {
  BoundsOf bounds(bodies, parallelism);
  std::vector<WorldHalfspace> halfspaces;
  const BodyReader reader{bodies};
  if (!bodies.kind && bodies.uniform_kind != ShapeKind::halfspace) {
    return index_bodies(bodies, bounds.view(), halfspaces, parallelism);
  }
  for (uint32_t i = 0; i < bodies.count; ++i) {
    if (reader.kind(i) != ShapeKind::halfspace || !takes_part(bounds.view(), i)) continue;
    halfspaces.push_back(world_halfspace(bodies, i));
    bounds.empty(i);
  }
  return index_bodies(bodies, bounds.view(), halfspaces, parallelism);
}

}  // namespace carom
