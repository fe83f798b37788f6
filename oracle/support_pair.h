// The separation of any two placed convex shapes, round ones too, by support functions; a
// half-space may be one of them.
#pragma once

#include <functional>
#include <optional>

#include "carom/shapes/body.h"
#include "oracle/convex_shape.h"
#include "oracle/support_oracle.h"

namespace carom::oracle {

// Coordinates are relative to a point that the caller chooses. Half-spaces have no support points.
SupportShape support_shape(const Shape& shape, const Pose& pose,
                           const Eigen::Vector3d& relative_to = Eigen::Vector3d::Zero());

// Two stored bodies in coordinates relative to the position of A. Not two half-spaces.
class SupportPair {
 public:
  using Vec = Vec3<long double>;

  SupportPair(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b, const Pose& pose_b);

  // The same shapes, which need not be solved again.
  SupportPair with_b_moved(const Vec& by) const;

  // See separation_by_supports(). Exact with a half-space.
  SeparationBounds separation(long double tolerance, size_t most_triangles = 4'000'000) const;
  // The separation of separate shapes, between bounds that are nearer than `tolerance`. Of others
  // the upper bound is not positive.
  SeparationBounds distance(long double tolerance) const;
  // The gap between the projections on a unit vector from A to B; with a half-space the separation,
  // projected as by gap_along() of convex_oracle.h.
  long double gap_along(const Vec& n) const;
  // How far a point is from the surface, inside or outside.
  long double distance_from_a(const Vec& point) const { return a_.distance(point); }
  long double distance_from_b(const Vec& point) const { return b_.distance(point); }
  // Mean of the bounding radii about the bodies' positions; of a half-space, the distance of its
  // plane.
  long double scale() const { return (a_.bounding_radius + b_.bounding_radius) / 2; }
  bool has_halfspace() const { return a_.plane || b_.plane; }
  // The distance of a half-space's plane from its body.
  long double plane_distance() const;

 private:
  struct Plane {
    Vec normal;
    long double offset;
  };
  struct Side {
    SupportShape shape;
    std::function<long double(const Vec&)> distance;
    std::optional<Plane> plane;
    long double bounding_radius;
  };

  static Side side_of(const Shape& shape, const Pose& pose, const Eigen::Vector3d& relative_to);
  // The gap from the half-space up to the shape, along the plane's normal.
  static long double gap_over(const Plane& plane, const SupportShape& shape);

  Side a_, b_;
};

}  // namespace carom::oracle
