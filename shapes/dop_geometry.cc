#include "shapes/dop_geometry.h"

#include <algorithm>
#include <memory>

#include "base/float_environment.h"

namespace carom {

DopGeometry::DopGeometry(const Dop& dop)
    : size_(DopSlabs(dop).with_tight_axes().size()), polytope_(DopSlabs(dop)) {
  const auto rows = shape_rows(dop);
  std::copy_n(rows.begin(), rows_.size(), rows_.begin());
}

std::shared_ptr<const DopGeometry> dop_geometry(const Dop& dop) {
  const FloatEnvironment environment;
  if (known_geometry(dop)) return dop.geometry;
  return is_valid_dop(dop) ? std::make_shared<const DopGeometry>(dop) : nullptr;
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
