#include "accuracy/pairs/bodies.h"

#include <algorithm>
#include <variant>

namespace carom::accuracy {

BodyArrays::BodyArrays(std::span<const Placed> bodies, PositionType positions) {
  view_.count = bodies.size();
  store_kinds(bodies);
  if (positions == PositionType::float32) {
    store_records(bodies, records32_);
  } else {
    store_records(bodies, records64_);
  }
  view_.position.type = positions;
  store_boxes(bodies);
  store_rows(bodies);
}

void BodyArrays::store_kinds(std::span<const Placed> bodies) {
  for (const Placed& body : bodies) kinds_.push_back(kind_of(body.shape));
  if (kinds_.empty()) return;
  view_.uniform_kind = kinds_.front();
  const bool is_uniform = std::all_of(kinds_.begin(), kinds_.end(),
                                      [&](ShapeKind kind) { return kind == kinds_.front(); });
  if (!is_uniform) view_.kind = kinds_.data();
}

template <class T>
void BodyArrays::store_records(std::span<const Placed> bodies, std::vector<T>& records) {
  records.reserve(4 * bodies.size());
  for (const Placed& body : bodies) {
    for (int axis = 0; axis < 3; ++axis) {
      records.push_back(static_cast<T>(body.pose.position[axis]));
    }
    const auto* sphere = std::get_if<Sphere>(&body.shape);
    records.push_back(sphere ? sphere->radius : 0);
  }
  view_.position.data = records.data();
  view_.position.stride = 4 * sizeof(T);
}

void BodyArrays::store_boxes(std::span<const Placed> bodies) {
  if (std::count(kinds_.begin(), kinds_.end(), ShapeKind::aabb) == 0) return;
  boxes_.resize(6 * bodies.size());
  for (size_t axis = 0; axis < 3; ++axis) {
    float* lower = &boxes_[axis * bodies.size()];
    float* upper = &boxes_[(3 + axis) * bodies.size()];
    for (size_t i = 0; i < bodies.size(); ++i) {
      const auto* box = std::get_if<Aabb>(&bodies[i].shape);
      lower[i] = box ? box->lower[static_cast<int>(axis)] : 0;
      upper[i] = box ? box->upper[static_cast<int>(axis)] : 0;
    }
    view_.boxes.lower[axis] = lower;
    view_.boxes.upper[axis] = upper;
  }
}

void BodyArrays::store_rows(std::span<const Placed> bodies) {
  for (const Placed& body : bodies) {
    for (const float x : body.pose.orientation.coeffs()) orientations_.push_back(x);
    first_row_.push_back(static_cast<uint32_t>(rows_.size()));
    const auto rows = shape_rows(body.shape);
    rows_.insert(rows_.end(), rows.begin(), rows.begin() + row_count(kind_of(body.shape)));
  }
  if (rows_.empty()) return;
  view_.orientation.data = orientations_.data();
  view_.rows.data = rows_.front().data();
  if (view_.kind) view_.rows.first = first_row_.data();
}

}  // namespace carom::accuracy
