#include "midphase/field_search.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

bool is_in_range(double length) {
  return length == 0 || (length >= SeenSolid::kLeast && length <= SeenSolid::kMost);
}

}  // namespace

bool SolidOverField::serves(const PlacedPart& part) {
  const ShapeKind kind = part.kind();
  return kind == ShapeKind::sphere || kind == ShapeKind::box || kind == ShapeKind::aabb;
}

SolidOverField::SolidOverField(const PlacedPart& field, const PlacedPart& part,
                               const Double3& place)
    : field_(field.field()) {
  solid_.middle = place;
  if (part.kind() == ShapeKind::sphere) {
    radius_ = part.part->radius;
    box_half_ = {};
  } else {
    const PartBox box = box_of(*part.part);
    solid_.is_box = true;
    solid_.half = box.half;
    for (size_t i = 0; i < 3; ++i) {
      solid_.axis[i] = turned_back(field.turn, {part.turn[0][i], part.turn[1][i], part.turn[2][i]});
    }
    for (size_t k = 0; k < 3; ++k) {
      double middle = 0, half = 0;
      for (size_t i = 0; i < 3; ++i) {
        middle += solid_.axis[i][k] * box.middle[i];
        half += std::fabs(solid_.axis[i][k]) * box.half[i];
      }
      solid_.middle[k] += middle;
      box_half_[k] = half;
    }
  }
  lengths_ =
      field.size() + greatest(place) + greatest(solid_.middle) + greatest(box_half_) + radius_;
}

std::optional<double> SolidOverField::distance_along_z() const {
  const auto& [x, y, z] = solid_.middle;
  const double u = x / field_.dx() + field_.cells_x() / 2.0;
  const double v = y / field_.dy() + field_.cells_y() / 2.0;
  if (!(u >= 0 && u < field_.cells_x() && v >= 0 && v < field_.cells_y())) return std::nullopt;
  const auto i = static_cast<uint32_t>(u), j = static_cast<uint32_t>(v);
  const float h00 = field_.height(i, j), h10 = field_.height(i + 1, j);
  const float h01 = field_.height(i, j + 1), h11 = field_.height(i + 1, j + 1);
  if (!(field_.is_height(h00) && field_.is_height(h10) && field_.is_height(h01) &&
        field_.is_height(h11))) {
    return std::nullopt;
  }
  // Places of samples are rounded: the surface is no further from here than they are.
  const double along_x = u - i, along_y = v - j;
  const double beside = along_y <= along_x ? h10 : h01;
  const double far = std::max(along_x, along_y), near = std::min(along_x, along_y);
  const double surface = h00 + far * (beside - h00) + near * (h11 - beside);
  double own = radius_;
  if (solid_.is_box) {
    own = HUGE_VAL;
    for (size_t k = 0; k < 3; ++k) {
      const double rises = std::fabs(solid_.axis[k][2]);
      if (rises > 0) own = std::min(own, solid_.half[k] / rises);
    }
  }
  return std::fabs(z - surface) - own;
}

bool SolidOverField::find_near(const GapsWanted& wanted,
                               FunctionRef<void(const NearPoints& near)> found) const {
  const double most = wanted.most;
  Double3 lower, upper;
  for (size_t axis = 0; axis < 3; ++axis) {
    lower[axis] = solid_.middle[axis] - box_half_[axis] - most;
    upper[axis] = solid_.middle[axis] + box_half_[axis] + most;
  }
  const bool are_in_range = is_in_range(field_.dx()) && is_in_range(field_.dy()) &&
                            is_in_range(greatest(solid_.half)) && is_in_range(radius_) &&
                            lengths_ <= SeenSolid::kMost && std::fabs(most) <= SeenSolid::kMost;
  if (!are_in_range) return false;
  if (lower[2] > field_.upper().z() || upper[2] < field_.lower().z()) return true;
  const CellRange cells = cells_at(field_, lower, upper);
  if (cells.is_empty()) return true;
  if (cells.end_i - cells.first_i > kMostCellsOfWindow ||
      cells.end_j - cells.first_j > kMostCellsOfWindow) {
    return false;
  }
  find_near_cells(field_, cells, solid_, wanted, found);
  return true;
}

}  // namespace carom
