#include "midphase/placed_part.h"

namespace carom {

PlacedPart PlacedPart::item(uint32_t index) const {
  PlacedPart result = *this;
  if (kind() == ShapeKind::mesh) {
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
  if (result.kind() == ShapeKind::mesh) result = result.item(uint32_t(order));
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
