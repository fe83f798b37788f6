/// @file
/// The rungs of a ladder. build_ladder() (carom/ladders/build_ladder.h) makes them; callers who
/// know simpler models of their shapes may make their own.
#pragma once

#include <vector>

#include "carom/shapes/ladder.h"
#include "carom/shapes/shape.h"

namespace carom {

/// A model of a shape.
struct Rung {
  /// In the frame of the shape. A kind that turns with its body; not itself with a ladder.
  Shape shape;
  /// Metres, an upper bound of the Hausdorff distance: no point of the model is further from the
  /// shape, and none of the shape from the model.
  double error = 0;
};

/// The part of a body's half of a tolerance that its model may take up. The rest is for its motion.
inline constexpr double kShareOfRungs = 7.0 / 8;

/// The models of a shape, the finest first: errors ascend. A world tests a body by the last one
/// whose error its tolerance allows (Accuracy::tolerance).
struct Ladder {
  std::vector<Rung> rungs;  ///< empty: the shape itself is all there is
};

/// Reports count so many rungs of a ladder by themselves, the last one with all further ones.
inline constexpr int kCountedRungs = 4;

/// The ladder of a shape; nullptr: it has none.
CAROM_EXPORT LadderPtr ladder_of(const Shape& shape);

}  // namespace carom
