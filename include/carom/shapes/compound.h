/// @file
/// Compounds: the union of other shapes, each with a pose in the compound's frame.
#pragma once

#include <memory>

#include "carom/shapes/ladder.h"

namespace carom {

class CompoundGeometry;  // carom/shapes/compound_geometry.h: made by make_compound()

/// A union of shapes, which turns with its body. Without geometry it is not valid.
struct Compound {
  std::shared_ptr<const CompoundGeometry> geometry;  ///< made by make_compound(); may be shared
  LadderPtr ladder = nullptr;  ///< simpler models of it, for bodies with a tolerance
};

}  // namespace carom
