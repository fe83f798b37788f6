// The triangles of a mesh on the path of a shape, when both move in straight lines.
#pragma once

#include <cstdint>
#include <optional>

#include "broadphase/tree_walk.h"
#include "impacts/part_sweep.h"

namespace carom {

// The path of a simple shape in the frame of the mesh, cut to where the shape may touch the mesh.
class MeshPath {
 public:
  // Whether there is a path at all: the mesh is a whole body, the shape is simple and has bounds,
  // and neither turns. The path may still end up empty, or be too long for float32 (is_in_range()).
  static bool serves(const PlacedPart& mesh, const BodySweep& mesh_sweep, const PlacedPart& shape,
                     const BodySweep& shape_sweep);

  // Only times up to `limit` count.
  MeshPath(const PlacedPart& mesh, const BodySweep& mesh_sweep, const PlacedPart& shape,
           const BodySweep& shape_sweep, double limit);

  bool is_in_range() const { return is_in_range_; }
  bool is_empty() const { return !box_; }

  // A search for triangles that the shape may touch, roughly in the order in which it gets there.
  // Those that it may touch after `limit` alone may be left out.
  MetSearch search(double limit, TreeWalk& walk, uint32_t* triangles) const;

 private:
  float limit_on_path(double limit) const;

  const MeshGeometry& mesh_;
  const Double3 start_, way_;  // of the shape's middle
  double lengths_;             // a bound on all coordinates
  double first_, last_;        // the times between which the path is cut
  std::optional<MovingBox> box_;
  bool is_in_range_ = true;
};

}  // namespace carom
