#include "carom/kernel/views.h"

namespace carom {
namespace {

using Row = std::array<float, 4>;
using Rows = std::array<Row, kMostRows>;
using Eigen::Vector3f;

Row row(const Vector3f& v, float fourth) { return {v.x(), v.y(), v.z(), fourth}; }
Vector3f vector(const Row& row) { return {row[0], row[1], row[2]}; }

Rows rows_of(const Sphere&) { return {}; }
Rows rows_of(const Aabb&) { return {}; }
Rows rows_of(const Capsule& c) { return {row(c.a, c.radius), row(c.b, 0)}; }
Rows rows_of(const Box& box) { return {row(box.half, 0)}; }
Rows rows_of(const Halfspace& h) { return {row(h.normal, h.offset)}; }
Rows rows_of(const Triangle& t) {
  return {row(t.corners[0], t.thickness), row(t.corners[1], t.one_sided ? 1.0f : 0.0f),
          row(t.corners[2], t.inner_edges)};
}

}  // namespace

Rows shape_rows(const Shape& shape) {
  return std::visit([](const auto& s) { return rows_of(s); }, shape);
}

Shape shape_from_rows(ShapeKind kind, const Row* rows) {
  switch (kind) {
    case ShapeKind::capsule:
      return Capsule{vector(rows[0]), vector(rows[1]), rows[0][3]};
    case ShapeKind::box:
      return Box{vector(rows[0])};
    case ShapeKind::halfspace:
      return Halfspace{vector(rows[0]), rows[0][3]};
    default:
      return Triangle{{vector(rows[0]), vector(rows[1]), vector(rows[2])},
                      rows[0][3],
                      rows[1][3] != 0,
                      static_cast<uint8_t>(rows[2][3])};
  }
}

}  // namespace carom
