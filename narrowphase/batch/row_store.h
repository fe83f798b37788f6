// Stores results of pairs that are tested one at a time, as rows of the columns of a batch.
#pragma once

#include <array>

#include "narrowphase/batch/batch.h"
#include "narrowphase/batch/single_pair.h"
#include "narrowphase/batch/world_point.h"
#include "shapes/body_reader.h"

namespace carom {

class RowStore {
 public:
  RowStore(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b)
      : batch_(batch),
        a_(view_of(batch.a, batch.layout, kind_a)),
        b_(view_of(batch.b, batch.layout, kind_b)) {}

  // `answer`: separation, normal, arm_a, arm_b.
  void put(size_t row, Status status, const std::array<float, 10>& answer) const {
    const ResultColumns& out = batch_.out;
    out.overlap[row] = answer[0] <= 0;
    out.status[row] = static_cast<uint8_t>(status);
    if (!has_contacts(batch_.detail)) return;
    const Pair pair = batch_.pairs[row];
    const auto vector = [&](size_t i) -> Vector {
      return {answer[i], answer[i + 1], answer[i + 2]};
    };
    out.separation[row] = answer[0];
    store(vector(1), out.normal, row);
    store(witness(a_, pair.a, vector(4)), out.point_a, row);
    store(witness(b_, pair.b, vector(7)), out.point_b, row);
  }

 private:
  using Vector = std::array<float, 3>;

  static void store(const Vector& v, const std::array<float*, 3>& columns, size_t row) {
    for (size_t axis = 0; axis < 3; ++axis) columns[axis][row] = v[axis];
  }

  Vector witness(const Collidables& bodies, uint32_t body, const Vector& arm) const {
    return batch_.frame == WitnessFrame::body ? arm : world_point(BodyReader{bodies}, body, arm);
  }

  const Batch& batch_;
  const Collidables a_, b_;
};

}  // namespace carom
