// Bodies in flat arrays, as Carom's stateless calls read them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <set>
#include <vector>

#include "carom/shapes/views.h"

namespace carom::cli {

// Keeps the geometries of its bodies alive.
class BodyColumns {
 public:
  explicit BodyColumns(PositionType positions) : positions_(positions) {}

  void reserve(size_t count);
  void push(const Shape& shape, const Pose& pose);

  size_t size() const { return kind_.size(); }
  PositionType positions() const { return positions_; }
  // Whether any body is made of sub-shapes.
  bool has_composites() const;
  // The stored shape and pose: float32 positions are rounded, and kinds without rows may have lost
  // their orientation.
  Shape shape(size_t index) const;
  Pose pose(size_t index) const;

  // Has a kind and a first row per body only if there are several kinds; has orientations and rows
  // only if a kind has rows.
  Collidables view() const;

 private:
  using Row = std::array<float, 4>;

  void push_position(const Eigen::Vector3d& position, float radius);
  void push_box(const Aabb& box);
  void push_rows(const Shape& shape, const Eigen::Quaternionf& orientation);
  Eigen::Vector3d position(size_t index) const;

  PositionType positions_;
  std::vector<float> record32_;  // x y z w; one of these two is filled
  std::vector<double> record64_;
  std::vector<ShapeKind> kind_;
  std::array<std::vector<float>, 3> lower_;  // zero if the body is not an aabb
  std::array<std::vector<float>, 3> upper_;
  std::vector<Row> rows_;
  std::vector<uint32_t> first_row_;  // 0 if the kind has none
  std::vector<Row> orientation_;     // empty while no kind has rows
  std::set<std::shared_ptr<const void>> geometries_;
};

}  // namespace carom::cli
