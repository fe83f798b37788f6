#include <algorithm>
#include <memory>

#include "carom/shapes/rungs.h"
#include "carom/shapes/views.h"
#include "shapes/geometry_row.h"

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
Rows rows_of(const Box& box) { return {row(box.half, box.rounding)}; }
Rows rows_of(const Cylinder& c) { return {Row{c.radius, c.half_length, 0, c.rounding}}; }
Rows rows_of(const Cone& c) { return {Row{c.radius, c.half_length, 0, c.rounding}}; }
Rows rows_of(const Ellipsoid& e) { return {row(e.semi_axes, e.rounding)}; }
Rows rows_of(const Halfspace& h) { return {row(h.normal, h.offset)}; }
Rows rows_of(const Triangle& t) {
  return {row(t.corners[0], t.thickness), row(t.corners[1], t.one_sided ? 1.0f : 0.0f),
          row(t.corners[2], t.inner_edges)};
}

// The rows of a k-DOP hold one list of numbers: the lower ends, the upper ends, k.
constexpr size_t kUpperEnds = kMostSlabs, kNumberOfPlanes = 2 * kMostSlabs;
static_assert(kNumberOfPlanes < 4 * row_count(ShapeKind::dop));

Rows rows_of(const Dop& dop) {
  Rows rows{};
  const auto number = [&](size_t i) -> float& { return rows[i / 4][i % 4]; };
  for (size_t i = 0; i < std::min(slab_count(dop.kind), kMostSlabs); ++i) {
    number(i) = dop.lower[i];
    number(kUpperEnds + i) = dop.upper[i];
  }
  number(kNumberOfPlanes) = static_cast<float>(dop.kind);
  return rows;
}

Rows rows_of(const Hull& hull) {
  Row row = geometry_row(hull.geometry.get());
  row[3] = hull.rounding;
  return {row};
}
Rows rows_of(const Mesh& mesh) { return {geometry_row(mesh.geometry.get())}; }
Rows rows_of(const HeightField& field) { return {geometry_row(field.geometry.get())}; }
Rows rows_of(const Compound& compound) { return {geometry_row(compound.geometry.get())}; }

template <class Geometry>
std::shared_ptr<const Geometry> not_owned(const Row& row) {
  return {std::shared_ptr<const void>(), geometry_at<Geometry>(row)};
}

// A number that is out of range becomes 255, which no triangle has either.
uint8_t inner_edges_from(float number) {
  return number >= 0 && number < 256 ? static_cast<uint8_t>(number) : 255;
}

// A number of planes that no k-DOP has becomes zero.
Dop dop_from(const Row* rows) {
  const auto number = [&](size_t i) { return rows[i / 4][i % 4]; };
  Dop dop{.kind = DopKind{}};
  for (const DopKind kind : {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26}) {
    if (number(kNumberOfPlanes) == static_cast<float>(kind)) dop.kind = kind;
  }
  for (size_t i = 0; i < slab_count(dop.kind); ++i) {
    dop.lower[i] = number(i);
    dop.upper[i] = number(kUpperEnds + i);
  }
  return dop;
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
    case ShapeKind::rounded_box:
      return Box{vector(rows[0]), rows[0][3]};
    case ShapeKind::cylinder:
      return Cylinder{rows[0][0], rows[0][1], rows[0][3]};
    case ShapeKind::cone:
      return Cone{rows[0][0], rows[0][1], rows[0][3]};
    case ShapeKind::ellipsoid:
      return Ellipsoid{vector(rows[0]), rows[0][3]};
    case ShapeKind::halfspace:
      return Halfspace{vector(rows[0]), rows[0][3]};
    case ShapeKind::dop:
      return dop_from(rows);
    case ShapeKind::hull:
      return Hull{not_owned<HullGeometry>(rows[0])};
    case ShapeKind::rounded_hull:
      return Hull{not_owned<HullGeometry>(rows[0]), nullptr, rows[0][3]};
    case ShapeKind::mesh:
      return Mesh{not_owned<MeshGeometry>(rows[0])};
    case ShapeKind::height_field:
      return HeightField{not_owned<HeightFieldGeometry>(rows[0])};
    case ShapeKind::compound:
      return Compound{not_owned<CompoundGeometry>(rows[0])};
    default:
      return Triangle{{vector(rows[0]), vector(rows[1]), vector(rows[2])},
                      rows[0][3],
                      rows[1][3] != 0,
                      inner_edges_from(rows[2][3])};
  }
}

LadderPtr ladder_of(const Shape& shape) {
  if (const auto* hull = std::get_if<Hull>(&shape)) {
    return hull->rounding == 0 ? hull->ladder : nullptr;
  }
  if (const auto* mesh = std::get_if<Mesh>(&shape)) return mesh->ladder;
  const auto* compound = std::get_if<Compound>(&shape);
  return compound ? compound->ladder : nullptr;
}

}  // namespace carom
