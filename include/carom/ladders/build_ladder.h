/// @file
/// Ladders of shapes (library carom_ladders, which needs Qhull and meshoptimizer).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/shapes/rungs.h"

namespace carom {

/// The outcome of build_ladder().
struct LadderReport {
  /// A rung, or one that was asked for and is not there.
  struct Entry {
    double wanted = 0;  ///< metres, as it was asked for
    double error = 0;   ///< metres, proved; 0: there is no such rung
    size_t pieces = 0;  ///< corners of a hull, triangles of a mesh, of a compound those of all
    bool is_capsule = false;  ///< the rung is a capsule, or a ball, which is one without length
    bool is_box = false;      ///< the rung is a box
    std::string refused;      ///< why there is none; empty if there is one
  };
  size_t pieces = 0;           ///< of the shape itself
  std::vector<Entry> entries;  ///< one for each error that was asked for
  double seconds = 0;          ///< that it took
};

/// A shape with its ladder.
struct LadderedShape {
  Shape shape;          ///< as it was given, with the ladder if that has a rung
  LadderReport report;  ///< what became of each rung
};

/// The rung that a tolerance allows: so far a body with it may be from its model (metres, of the
/// tolerance of a world or a body, likewise metres).
CAROM_EXPORT double error_within(double tolerance);

/// Gives a hull, a mesh or a compound a ladder, with a rung for each of these errors (metres, > 0,
/// finite, ascending): the simplest model that was found within it, if that is worth it. A capsule
/// or a ball, where one is within it; else of hulls a box, or some points, moved outwards by half
/// of what they lack; of meshes fewer triangles; of compounds those of its children. A box lies
/// about the origin along the axes of the hull's frame; in place of a child it may lie anywhere.
/// Other shapes stay as they are. A rung that cannot be proved is refused, and the report says so:
/// of meshes that are one-sided or thick, whose fronts must stay where they are, and of hulls
/// without volume. The same bits for the same shape. A mesh of 100,000 triangles takes some seconds
/// a rung. Fails if an error is not such a number, or the shape has no geometry.
CAROM_EXPORT Result<LadderedShape> build_ladder(const Shape& shape, std::span<const double> errors);

}  // namespace carom
