// Bodies in flat arrays, as Carom's stateless calls read them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "carom/kernel/views.h"

namespace carom::cli {

class BodyColumns {
 public:
  explicit BodyColumns(PositionType positions) : positions_(positions) {}

  void reserve(size_t count);
  void push(const Shape& shape, const Eigen::Vector3d& position);

  size_t size() const { return kind_.size(); }
  PositionType positions() const { return positions_; }
  // As stored: float32 positions are rounded.
  Shape shape(size_t index) const;
  Eigen::Vector3d position(size_t index) const;

  // Kinds are given one by one only where there is more than one.
  Collidables view() const;

 private:
  PositionType positions_;
  std::vector<float> record32_;  // x y z w, one of the two
  std::vector<double> record64_;
  std::vector<ShapeKind> kind_;
  std::array<std::vector<float>, 3> lower_;  // all zero for spheres
  std::array<std::vector<float>, 3> upper_;
};

}  // namespace carom::cli
