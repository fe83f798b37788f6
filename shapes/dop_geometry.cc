#include "shapes/dop_geometry.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "base/float_environment.h"
#include "shapes/dop_memory.h"
#include "shapes/dop_solid.h"
#include "shapes/hull_features.h"

namespace carom {
namespace {

// A face with fewer than three corners only touches the polytope.
void make_hull_of_corners(const DopPolytope& polytope, DopKind kind, DopHull& hull) {
  if (polytope.is_empty()) return;
  std::vector<Eigen::Vector3f> points;
  for (size_t i = 0; i < polytope.point_count(); ++i) {
    const Double3 p = polytope.point(i);
    points.push_back(Eigen::Vector3d(p[0], p[1], p[2]).cast<float>());
  }
  std::vector<std::vector<uint32_t>> faces;
  std::vector<uint8_t> planes;
  for (const DopFace& face : polytope.faces()) {
    if (face.count < 3) continue;
    planes.push_back(common_plane(kind, face.plane));
    std::vector<uint32_t>& outline = faces.emplace_back();
    for (const DopCorner& corner : polytope.corners(face)) outline.push_back(corner.point);
  }
  hull.make(points, faces, planes);
}

// The k-DOP is valid.
std::shared_ptr<const DopGeometry> new_geometry(const Dop& dop) {
  return std::allocate_shared<DopGeometry>(SideBySide<DopGeometry>(), dop);
}

}  // namespace

DopGeometry::DopGeometry(const Dop& dop)
    : size_(DopSlabs(dop).with_tight_axes().size()), polytope_(DopSlabs(dop)) {
  make_hull_of_corners(polytope_, dop.kind, hull_);
  const auto rows = shape_rows(dop);
  std::copy_n(rows.begin(), rows_.size(), rows_.begin());
}

size_t DopGeometry::bytes() const {
  return sizeof(*this) - sizeof hull_.geometry + polytope_.bytes() + bytes_of(hull_.geometry);
}

Hull hull_of(const Dop& dop) {
  const auto geometry = known_geometry(dop) ? dop.geometry : new_geometry(dop);
  return {{geometry, geometry->hull()}};
}

std::shared_ptr<const DopGeometry> dop_geometry(const Dop& dop) {
  const FloatEnvironment environment;
  if (known_geometry(dop)) return dop.geometry;
  return is_valid_dop(dop) ? new_geometry(dop) : nullptr;
}

const DopGeometry* known_geometry(const Dop& dop) {
  return dop.geometry && dop.geometry->is_of(dop) ? dop.geometry.get() : nullptr;
}

Dop read_dop(const BodyReader& reader, size_t i) {
  const std::array<Row, kMostRows> rows = reader.rows(i);
  Dop dop = std::get<Dop>(shape_from_rows(ShapeKind::dop, rows.data()));
  const DopGeometry* geometry = reader.dop_geometry(i);
  if (geometry && geometry->is_of(rows.data())) {
    dop.geometry = {std::shared_ptr<const void>(), geometry};
  }
  return dop;
}

bool is_valid_dop(const Dop& dop) {
  if (!is_dop_kind(dop.kind)) return false;
  for (size_t i = 0; i < slab_count(dop.kind); ++i) {
    if (!is_valid_box_axis(dop.lower[i], dop.upper[i])) return false;
  }
  return known_geometry(dop) || has_points(DopSlabs(dop));
}

bool are_valid_dop_rows(const Row* rows, const DopGeometry* geometry) {
  return (geometry && geometry->is_of(rows)) ||
         is_valid_dop(std::get<Dop>(shape_from_rows(ShapeKind::dop, rows)));
}

}  // namespace carom
