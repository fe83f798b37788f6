// Boxes seen from the frame that a surface has without its scale.
#pragma once

#include "geometries/surface.h"
#include "trees/tree.h"

namespace carom {

// Searches of a surface with a scale go through the tree of the one without. A triangle touches a
// box only if its box there touches the box that these functions make, despite the rounding of
// scaled corners. Thick triangles may reach that far beyond their corners on any side.
class ScaledFrame {
 public:
  ScaledFrame(const Eigen::Vector3f& scale, double thickness);
  explicit ScaledFrame(const Surface& surface)
      : ScaledFrame(surface.scale(), surface.rules().thickness) {}

  // A box of the body's frame, in the frame without the scale.
  TreeBox divided(const TreeBox& box) const;
  RoundedBox divided(const RoundedBox& box) const;
  // normal . x <= limit in the body's frame is result . x <= limit_for(normal, limit).
  Double3 divided_normal(const Double3& normal) const;
  double limit_for(const Double3& normal, double limit) const;
  // A box of the frame without the scale, in that of the body. An empty one stays empty.
  TreeBox multiplied(const TreeBox& box) const;

 private:
  const Double3 scale_;
  const double thickness_;
};

}  // namespace carom
