#include "midphase/placed_part.h"

#include <algorithm>

#include "geometries/height_search.h"
#include "geometries/scaled_frame.h"

namespace carom {
namespace {

// Searches of a part as if it had no scale.
void touching_without_scale(const PlacedPart& part, const RoundedBox& box, ItemsFound found) {
  part.kind() == ShapeKind::height_field ? find_touching(part.field(), box, found)
                                         : part.tree().find_touching(box, found);
}

void below_without_scale(const PlacedPart& part, const Double3& normal, double limit,
                         FunctionRef<void(uint32_t)> found) {
  part.kind() == ShapeKind::height_field ? find_below(part.field(), normal, limit, found)
                                         : part.tree().find_below(normal, limit, found);
}

void admitted_without_scale(const PlacedPart& part, FunctionRef<bool(const TreeBox& box)> admits,
                            ItemsFound found) {
  part.kind() == ShapeKind::height_field ? find_admitted(part.field(), admits, found)
                                         : part.tree().find_admitted(admits, found);
}

}  // namespace

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
  is_scaled() ? touching_without_scale(*this, ScaledFrame(surface()).divided(box), found)
              : touching_without_scale(*this, box, found);
}

void PlacedPart::find_below(const Double3& normal, double limit,
                            FunctionRef<void(uint32_t)> found) const {
  if (!is_scaled()) return below_without_scale(*this, normal, limit, found);
  const ScaledFrame frame(surface());
  below_without_scale(*this, frame.divided_normal(normal), frame.limit_for(normal, limit), found);
}

void PlacedPart::find_admitted(FunctionRef<bool(const TreeBox& box)> admits,
                               ItemsFound found) const {
  if (!is_scaled()) return admitted_without_scale(*this, admits, found);
  const ScaledFrame frame(surface());
  admitted_without_scale(
      *this, [&](const TreeBox& box) { return admits(frame.multiplied(box)); }, found);
}

// Only about the nearest and the lowest: the thickness does not matter.
uint32_t PlacedPart::near_item(const TreeBox& box) const {
  const TreeBox own = is_scaled() ? ScaledFrame(surface()).divided(box) : box;
  return kind() == ShapeKind::height_field ? near_triangle(field(), own) : tree().near_item(own);
}

uint32_t PlacedPart::low_item(const Double3& normal) const {
  const Double3 own = is_scaled() ? ScaledFrame(surface()).divided_normal(normal) : normal;
  return kind() == ShapeKind::height_field ? low_triangle(field(), own) : tree().low_item(own);
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
