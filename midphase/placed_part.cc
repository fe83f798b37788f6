#include "midphase/placed_part.h"

#include <algorithm>

#include "geometries/height_search.h"

namespace carom {

bool PlacedPart::has_no_items() const {
  return kind() == ShapeKind::height_field ? is_empty(field()) : tree().is_empty();
}

double PlacedPart::size() const {
  const auto largest = [](const auto& parts) {
    return std::max(parts.lower().cwiseAbs().maxCoeff(), parts.upper().cwiseAbs().maxCoeff());
  };
  return is_surface(kind()) ? largest(surface()) : largest(compound());
}

void PlacedPart::find_touching(const RoundedBox& box, ItemsFound found) const {
  kind() == ShapeKind::height_field ? carom::find_touching(field(), box, found)
                                    : tree().find_touching(box, found);
}

void PlacedPart::find_below(const Double3& normal, double limit,
                            FunctionRef<void(uint32_t)> found) const {
  kind() == ShapeKind::height_field ? carom::find_below(field(), normal, limit, found)
                                    : tree().find_below(normal, limit, found);
}

uint32_t PlacedPart::near_item(const TreeBox& box) const {
  return kind() == ShapeKind::height_field ? near_triangle(field(), box) : tree().near_item(box);
}

uint32_t PlacedPart::low_item(const Double3& normal) const {
  return kind() == ShapeKind::height_field ? low_triangle(field(), normal)
                                           : tree().low_item(normal);
}

PlacedPart PlacedPart::item(uint32_t index) const {
  PlacedPart result = *this;
  if (is_surface(kind())) {
    result.triangle = index;
    return result;
  }
  const Part& child_part = compound().parts()[index];
  const PlacedChild child_pose = placed(child_part, position, turn, orientation);
  result.part = &child_part;
  result.child = index;
  result.arm = child_pose.arm;
  result.position = child_pose.position;
  result.orientation = child_pose.orientation;
  result.turn = child_part.is_turned() ? rotation_of(result.orientation) : kNotTurned;
  return result;
}

PlacedPart part_at(const PlacedPart& body, uint64_t order) {
  PlacedPart result = body;
  if (result.kind() == ShapeKind::compound) result = result.item(uint32_t(order >> 32));
  if (is_surface(result.kind())) result = result.item(uint32_t(order));
  return result;
}

Part body_part(const BodyReader& reader, size_t i) {
  Part part;
  part.kind = reader.kind(i);
  if (part.kind == ShapeKind::sphere) {
    part.radius = reader.radius(i);
  } else if (part.kind == ShapeKind::aabb) {
    for (size_t axis = 0; axis < 3; ++axis) {
      part.lower[axis] = reader.lower(axis, i);
      part.upper[axis] = reader.upper(axis, i);
    }
  } else {
    for (uint32_t k = 0; k < row_count(part.kind); ++k) part.rows[k] = reader.row(i, k);
    part.dop = reader.dop_geometry(i);
    part.orientation = reader.orientation(i);
  }
  return part;
}

}  // namespace carom
