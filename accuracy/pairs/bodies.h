// Bodies in dense arrays, as the library reads them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "carom/shapes/body.h"
#include "carom/shapes/views.h"

namespace carom::accuracy {

struct Placed {
  Shape shape;
  Pose pose;
};

// All bodies of one kind, or of mixed kinds.
class BodyArrays {
 public:
  BodyArrays(std::span<const Placed> bodies, PositionType positions);
  BodyArrays(const BodyArrays&) = delete;
  BodyArrays& operator=(const BodyArrays&) = delete;

  const Collidables& view() const { return view_; }

 private:
  template <class T>
  void store_records(std::span<const Placed> bodies, std::vector<T>& records);
  void store_kinds(std::span<const Placed> bodies);
  void store_boxes(std::span<const Placed> bodies);
  void store_rows(std::span<const Placed> bodies);

  std::vector<float> records32_;
  std::vector<double> records64_;
  std::vector<ShapeKind> kinds_;
  std::vector<float> boxes_;  // six columns
  std::vector<float> orientations_;
  std::vector<std::array<float, 4>> rows_;
  std::vector<uint32_t> first_row_;
  Collidables view_;
};

}  // namespace carom::accuracy
