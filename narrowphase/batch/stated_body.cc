#include "narrowphase/batch/stated_body.h"

#include <variant>

#include "narrowphase/scalar/shapes.h"
#include "shapes/dop_geometry.h"

namespace carom {

double size_of(const Shape& shape) {
  return std::visit([](const auto& s) { return scalar::shape_as<double>(s).size(); }, shape);
}

Shape shape_of(const BodyReader& body, size_t index) {
  switch (body.kind(index)) {
    case ShapeKind::sphere:
      return Sphere{body.radius(index)};
    case ShapeKind::aabb:
      return Aabb{{body.lower(0, index), body.lower(1, index), body.lower(2, index)},
                  {body.upper(0, index), body.upper(1, index), body.upper(2, index)}};
    case ShapeKind::dop:
      return read_dop(body, index);
    default:
      return shape_from_rows(body.kind(index), body.rows(index).data());
  }
}

StatedBody stated_body(const BodyReader& body, size_t index) {
  return {shape_of(body, index), body.position<double>(index), body.orientation(index)};
}

}  // namespace carom
