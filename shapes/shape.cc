#include "carom/shapes/shape.h"

#include <array>

namespace carom {

const char* name(ShapeKind kind) {
  static constexpr std::array<const char*, kShapeKindCount> kNames = {
      "sphere",       "capsule",  "aabb",        "box",         "dop",  "hull",
      "mesh",         "compound", "halfspace",   "cylinder",    "cone", "ellipsoid",
      "height_field", "triangle", "rounded_box", "rounded_hull"};
  const auto code = static_cast<size_t>(kind);
  return code < kNames.size() ? kNames[code] : "unknown";
}

ShapeKind kind_of(const Shape& shape) {
  // In the order of the variant.
  static constexpr std::array<ShapeKind, std::variant_size_v<Shape>> kKinds = {
      ShapeKind::sphere,    ShapeKind::aabb,        ShapeKind::capsule,  ShapeKind::box,
      ShapeKind::triangle,  ShapeKind::halfspace,   ShapeKind::dop,      ShapeKind::hull,
      ShapeKind::mesh,      ShapeKind::compound,    ShapeKind::cylinder, ShapeKind::cone,
      ShapeKind::ellipsoid, ShapeKind::height_field};
  // NaN is no rounding, and makes the shape invalid.
  if (const Box* box = std::get_if<Box>(&shape); box && !(box->rounding == 0)) {
    return ShapeKind::rounded_box;
  }
  if (const Hull* hull = std::get_if<Hull>(&shape); hull && !(hull->rounding == 0)) {
    return ShapeKind::rounded_hull;
  }
  return kKinds[shape.index()];
}

}  // namespace carom
