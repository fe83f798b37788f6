// Finds the triangles of a height field that a ball or a box may touch, straight from its cells.
#pragma once

#include <optional>

#include "geometries/near_cells.h"
#include "midphase/placed_part.h"

namespace carom {

// A ball or a box in the frame of a height field.
class SolidOverField {
 public:
  // Whether it is one: a sphere, a box or an aabb.
  static bool serves(const PlacedPart& part);

  // `middle`: of the part's frame, in that of the field.
  SolidOverField(const PlacedPart& field, const PlacedPart& part, const Double3& place);

  double radius() const { return radius_; }
  // All lengths that go into a test with a triangle.
  double lengths() const { return lengths_; }

  // An upper bound of the distance, up to kSearchSlack of the lengths: how far the solid is over or
  // under the surface at its middle. Less than 0: it crosses the surface. Nothing if there is no
  // triangle.
  std::optional<double> distance_along_z() const;

  // As find_near_cells(), without the radius. False, and it finds nothing, if cells may be too
  // many, or lengths are out of range.
  bool find_near(const GapsWanted& wanted, FunctionRef<void(const NearPoints& near)> found) const;

 private:
  const HeightFieldGeometry& field_;
  SeenSolid solid_;
  Double3 box_half_;  // along the axes of the field
  double radius_ = 0;
  double lengths_;
};

}  // namespace carom
