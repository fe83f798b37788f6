// Pairs with a cylinder, a cone or an ellipsoid that have no kernel of their own: as cores in lanes
// of doubles, and one at a time what those leave. These are depths, manifolds, and pairs with
// k-DOPs and special triangles.
#include <algorithm>
#include <limits>
#include <optional>

#include "narrowphase/batch/row_store.h"
#include "narrowphase/batch/stated_body.h"
#include "narrowphase/pairs/core_row.h"
#include "narrowphase/pairs/manifold_batch.h"

namespace carom {
namespace {

// Shapes that lanes of doubles take.
template <class S>
concept HasStatedCore = requires(S shape, OwnPoints own) {
  stated_core(shape, own);
};

// Nothing if lanes do not take the shape.
std::optional<StatedCore> stated_core_of(const Shape& shape, OwnPoints& own) {
  return std::visit(
      [&](const auto& stated) -> std::optional<StatedCore> {
        const auto s = scalar::shape_as<double>(stated);
        using S = std::remove_const_t<decltype(s)>;
        if constexpr (std::is_same_v<S, scalar::TriangleShape<double>>) {
          if (s.is_special()) return std::nullopt;
        }
        if constexpr (HasStatedCore<S>) return stated_core(s, own);
        return std::nullopt;
      },
      shape);
}

// Tests the rows of a batch. They wait until there are enough for the lanes.
class RoundRows {
 public:
  RoundRows(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b)
      : batch_(batch),
        kind_a_(kind_a),
        kind_b_(kind_b),
        view_a_(view_of(batch.a, batch.layout, kind_a)),
        view_b_(view_of(batch.b, batch.layout, kind_b)),
        store_(batch, kind_a, kind_b) {
    CoreRows& rows = waiting_.rows;
    rows.decides_only = !has_contacts(batch.detail);
    rows.decides_separate = rows.decides_only || (batch.pass == Pass::test && !batch.measures);
  }

  void run(size_t row) {
    fetch(row + kPairsAhead);
    const Pair pair = batch_.pairs[row];
    if (!a_.is_valid(pair.a) || !b_.is_valid(pair.b)) {
      std::array<float, 10> nothing;
      nothing.fill(std::numeric_limits<float>::quiet_NaN());
      store_.put(row, Status::invalid, nothing);
    } else if (!add(row, pair)) {
      put_exact(row);
    } else if (waiting_.are_full()) {
      finish();
    }
  }

  void finish() {
    waiting_.test(
        [this](size_t row, const std::array<float, CoreRows::kAnswers>& answer, bool is_unsure) {
          store_.put(row, Status::ok, answer);
          if (batch_.unsure && is_unsure) batch_.unsure[row] = 1;
        },
        [this](size_t row) { put_exact(row); });
  }

 private:
  static constexpr size_t kPairsAhead = 8;

  // Asks for the bodies of a row to come: they lie anywhere in memory.
  void fetch(size_t row) const {
    if (row >= batch_.count) return;
    fetch_body(batch_.a, kind_a_, batch_.pairs[row].a);
    fetch_body(batch_.b, kind_b_, batch_.pairs[row].b);
  }
  static void fetch_body(const BatchSide& side, ShapeKind kind, size_t body) {
    const auto ask = [](const void* base, size_t offset) {
      __builtin_prefetch(static_cast<const char*>(base) + offset);
    };
    ask(side.records, body * side.record_stride);
    ask(side.orientation.data, body * side.orientation.stride);
    const uint32_t rows = row_count(kind);
    if (rows == 0) return;
    const size_t first = side.rows.first ? side.rows.first[body] : body * rows;
    ask(side.rows.data, first * sizeof(Row));
  }

  // False if lanes do not take the row.
  bool add(size_t row, Pair pair) {
    CoreRowsWithPoints& rows = waiting_.rows;
    const auto a = stated_core_of(shape_of(a_, pair.a), rows.own_a[rows.count]);
    const auto b = stated_core_of(shape_of(b_, pair.b), rows.own_b[rows.count]);
    if (!a || !b) return false;
    waiting_.name_next(row);
    const Position<double> p = a_.position<double>(pair.a), q = b_.position<double>(pair.b);
    return add_stated_row(*a, *b,
                          {{q.x - p.x, q.y - p.y, q.z - p.z},
                           turn_of(a_, kind_a_, pair.a),
                           turn_of(b_, kind_b_, pair.b)},
                          rows);
  }

  static scalar::Quaternion<double> turn_of(const BodyReader& body, ShapeKind kind, size_t index) {
    if (kind == ShapeKind::sphere || kind == ShapeKind::aabb) return {Eigen::Vector3d::Zero(), 1};
    return orientation_of(body, index);
  }

  // Tests a row whose bodies are valid in double precision.
  void put_exact(size_t row) const {
    const std::array<float, 11> found = exact_answer(batch_, kind_a_, kind_b_, row);
    std::array<float, 10> answer;
    std::copy_n(found.begin(), answer.size(), answer.begin());
    store_.put(row, found[10] != 0 ? Status::degenerate : Status::ok, answer);
    if (batch_.unsure) batch_.unsure[row] = 1;
  }

  const Batch& batch_;
  const ShapeKind kind_a_, kind_b_;
  const Collidables view_a_, view_b_;
  const BodyReader a_{view_a_}, b_{view_b_};
  const RowStore store_;
  WaitingRows waiting_;
};

}  // namespace

void run_round_pair(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b) {
  if (batch.pass == Pass::manifold) {
    return run_manifolds_one_by_one(batch, kind_a, kind_b);
  }
  RoundRows rows(batch, kind_a, kind_b);
  for (size_t row = 0; row < batch.count; ++row) rows.run(row);
  rows.finish();
}

}  // namespace carom
