// Shapes under linear maps that are no shapes about the same place any more.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "carom/base/function_ref.h"
#include "carom/base/result.h"
#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/hull.h"
#include "carom/shapes/shape.h"

namespace carom {

using PointMap = FunctionRef<Eigen::Vector3f(const Eigen::Vector3f& point)>;

// A hull of the mapped points, with the same faces.
Result<std::shared_ptr<const HullGeometry>> mapped(const HullGeometry& hull, const PointMap& map,
                                                   bool mirrors);

// A shape under a scale along its own axes, and the pose in which it is the same set of points: the
// identity, but for those that scaled() makes a compound of one child.
Result<CompoundChild> scaled_in_place(const Shape& shape, const Eigen::Vector3f& scale);

}  // namespace carom
