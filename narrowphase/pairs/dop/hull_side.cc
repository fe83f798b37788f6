#include "narrowphase/pairs/dop/hull_side.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "narrowphase/batch/column_memory.h"
#include "narrowphase/batch/single_pair.h"
#include "shapes/dop_geometry.h"
#include "shapes/geometry_row.h"

namespace carom {
namespace {

// So many rows that the points of their hulls stay in L2 until the depths are found.
constexpr size_t kRowsAtOnce = 256;

// The k-DOPs of one side, in the order of the rows of a part of the batch, as hulls.
class HullSide {
 public:
  explicit HullSide(PositionLayout layout)
      : record_size_(layout == PositionLayout::records64 ? 4 * sizeof(double) : sizeof(Row)) {}

  // Asks for what put() reads of the k-DOP.
  [[gnu::always_inline]] static void fetch(const BodyReader& reader, uint32_t body) {
    if (const DopGeometry* known = reader.dop_geometry(body)) known->fetch();
  }

  // Row `row` is body `body` of the side that `reader` reads.
  void put(size_t row, const BatchSide& side, const BodyReader& reader, uint32_t body) {
    if (side.records) {
      const char* record = static_cast<const char*>(side.records) + body * side.record_stride;
      std::memcpy(records_.data() + row * record_size_, record, record_size_);
    }
    orientation_[row] = reader.orientation(body);
    hull_[row] = geometry_row(hull_at(reader, body));
  }

  BatchSide side(const BatchSide& dops) const {
    BatchSide hulls;
    hulls.records = dops.records ? records_.data() : nullptr;
    hulls.record_stride = record_size_;
    hulls.orientation = {orientation_[0].data(), sizeof(Row)};
    hulls.rows = {hull_[0].data(), nullptr};
    return hulls;
  }

 private:
  // nullptr if the k-DOP is not valid.
  const HullGeometry* hull_at(const BodyReader& reader, uint32_t body) {
    const DopGeometry* known = reader.dop_geometry(body);
    const float* rows = reader.bodies.rows.data + 4 * reader.first_row(body);
    if (known && known->is_of(rows)) return known->hull();
    const auto found = dop_geometry(read_dop(reader, body));
    if (!found) return nullptr;
    found_.push_back(found);
    return found->hull();
  }

  const size_t record_size_;
  alignas(double) std::array<char, 4 * sizeof(double) * kRowsAtOnce> records_;
  std::array<Row, kRowsAtOnce> orientation_;
  std::array<Row, kRowsAtOnce> hull_;
  std::vector<std::shared_ptr<const DopGeometry>> found_;
};

// The rows from `first` on, `count` of them.
Batch part_of(const Batch& batch, size_t first, size_t count) {
  const auto move = [first](auto*& column) {
    if (column) column += first;
  };
  Batch part = batch;
  part.count = count;
  move(part.pairs);
  for (ResultColumns* columns : {&part.out, &part.tested}) {
    // At Pass::manifold rows of `out` are those in `manifold_row`.
    if (columns == &part.out && batch.manifold_row) continue;
    for_each_column([&](const ColumnInfo&, auto*& column) { move(column); }, *columns);
  }
  move(part.unsure);
  move(part.direction);
  move(part.features);
  move(part.reach);
  move(part.manifold_row);
  return part;
}

void run_part(const Batch& batch, DopSides dops, const BodyReader& a, const BodyReader& b,
              void (*run)(const Batch&)) {
  HullSide hulls_a(batch.layout), hulls_b(batch.layout);
  std::array<Pair, kRowsAtOnce> pairs;
  constexpr uint32_t kAhead = 16;
  const auto last = static_cast<uint32_t>(batch.count - 1);
  for (uint32_t row = 0; row < batch.count; ++row) {
    const Pair pair = batch.pairs[row], later = batch.pairs[std::min(row + kAhead, last)];
    if (dops.a) HullSide::fetch(a, later.a);
    if (dops.b) HullSide::fetch(b, later.b);
    if (dops.a) hulls_a.put(row, batch.a, a, pair.a);
    if (dops.b) hulls_b.put(row, batch.b, b, pair.b);
    pairs[row] = {dops.a ? row : pair.a, dops.b ? row : pair.b};
  }
  // Kernels may read pairs up to the next whole vector.
  const size_t padded = (batch.count + kMostLanes - 1) / kMostLanes * kMostLanes;
  std::fill(pairs.begin() + batch.count, pairs.begin() + padded, pairs[batch.count - 1]);
  Batch hulls = batch;
  if (dops.a) hulls.a = hulls_a.side(batch.a);
  if (dops.b) hulls.b = hulls_b.side(batch.b);
  hulls.pairs = pairs.data();
  hulls.pairs_are_rows = false;
  hulls.has_rounded_points = true;
  run(hulls);
}

}  // namespace

void run_with_hulls(const Batch& batch, DopSides dops, void (*run)(const Batch&)) {
  const Collidables view_a = view_of(batch.a, batch.layout, ShapeKind::dop);
  const Collidables view_b = view_of(batch.b, batch.layout, ShapeKind::dop);
  const BodyReader a{view_a}, b{view_b};
  for (size_t first = 0; first < batch.count; first += kRowsAtOnce) {
    const size_t count = std::min(kRowsAtOnce, batch.count - first);
    run_part(part_of(batch, first, count), dops, a, b, run);
  }
}

}  // namespace carom
