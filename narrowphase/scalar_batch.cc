#include "narrowphase/scalar_batch.h"

#include <array>
#include <limits>

#include "narrowphase/single_pair.h"
#include "narrowphase/world_point.h"

namespace carom {
namespace {

using Vector = std::array<float, 3>;

void store(const Vector& v, const std::array<float*, 3>& columns, size_t row) {
  for (size_t axis = 0; axis < 3; ++axis) columns[axis][row] = v[axis];
}

class TestRows {
 public:
  TestRows(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b)
      : batch_(batch),
        kind_a_(kind_a),
        kind_b_(kind_b),
        a_(view_of(batch.a, batch.layout, kind_a)),
        b_(view_of(batch.b, batch.layout, kind_b)) {}

  void run() const {
    for (size_t row = 0; row < batch_.count; ++row) {
      if (is_valid_pair(batch_, kind_a_, kind_b_, row)) {
        const std::array<float, 11> answer = exact_answer(batch_, kind_a_, kind_b_, row);
        const Status status = answer[10] != 0 ? Status::degenerate : Status::ok;
        store_row(row, answer[0] <= 0, status, answer);
        if (batch_.unsure) batch_.unsure[row] = 1;  // there is no proof beside it
      } else {
        std::array<float, 11> nothing;
        nothing.fill(std::numeric_limits<float>::quiet_NaN());
        store_row(row, false, Status::invalid, nothing);
      }
    }
  }

 private:
  // The answer is that of exact_answer().
  void store_row(size_t row, bool overlap, Status status,
                 const std::array<float, 11>& answer) const {
    const ResultColumns& out = batch_.out;
    out.overlap[row] = overlap;
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

  Vector witness(const Collidables& bodies, uint32_t body, const Vector& arm) const {
    return batch_.frame == WitnessFrame::body ? arm : world_point(BodyReader{bodies}, body, arm);
  }

  const Batch& batch_;
  const ShapeKind kind_a_, kind_b_;
  const Collidables a_, b_;
};

}  // namespace

void run_scalar_batch(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b) {
  if (batch.pass != Pass::manifold) return TestRows(batch, kind_a, kind_b).run();
  for (size_t row = 0; row < batch.count; ++row) {
    const size_t to = batch.manifold_row[row];
    batch.out.manifold_count[to] =
        manifold_answer(batch, kind_a, kind_b, row, batch.out.manifold[to]);
  }
}

}  // namespace carom
