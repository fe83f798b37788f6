// Boxes that stand for hulls.
#pragma once

#include <optional>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/hull.h"

namespace carom::ladders {

// A box near a hull, and how far the two are from each other at most.
struct BoxModel {
  CompoundChild box;  // in the frame of the hull
  double error;       // metres, an upper bound of the Hausdorff distance
};

// Both have nothing for hulls without volume.
//
// A box about the origin along the axes of the hull's frame, as it lies in a body.
std::optional<BoxModel> box_of_body(const HullGeometry& hull);
// A box that may lie anywhere, for children of compounds, whose poses are free; the nearest of
// some.
std::optional<BoxModel> box_of_child(const HullGeometry& hull);

// The model of a hull that is itself a child: the box in the frame of the compound. The error grows
// by what the rounding of the pose takes.
BoxModel placed(const BoxModel& model, const CompoundChild& hull);

}  // namespace carom::ladders
