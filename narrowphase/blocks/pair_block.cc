#include "narrowphase/blocks/pair_block.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "narrowphase/batch/world_point.h"
#include "narrowphase/pairs/pair_kinds.h"
#include "shapes/body_reader.h"
#include "shapes/run_of_bodies.h"

namespace carom {
namespace {

// The layout of both sides, if kernels can read it in place.
std::optional<PositionLayout> common_layout(const PositionView& a, const PositionView& b) {
  if (!a.data && !b.data) return PositionLayout::none;
  const bool records = a.data && b.data && a.type == b.type &&
                       a.radius_layout == RadiusLayout::fourth &&
                       b.radius_layout == RadiusLayout::fourth;
  if (!records) return std::nullopt;
  return a.type == PositionType::float64 ? PositionLayout::records64 : PositionLayout::records32;
}

// The orientation of bodies that are not turned.
constexpr float kIdentity[4] = {0, 0, 0, 1};

OrientationView orientation_of(const Collidables& bodies) {
  return bodies.orientation.data ? bodies.orientation : OrientationView{kIdentity, 0};
}

BatchSide side_of(const Collidables& bodies) {
  return {bodies.position.data, bodies.position.stride, bodies.boxes,
          bodies.box_slot,      orientation_of(bodies), bodies.rows,
          bodies.dops};
}

// (0, 0), (1, 1), ...: the list of pairs for a batch whose row i is bodies i and i.
constexpr auto kRowPairs = [] {
  std::array<Pair, kPairsPerBlock> pairs{};
  for (uint32_t i = 0; i < pairs.size(); ++i) pairs[i] = {i, i};
  return pairs;
}();

// Bodies copied out of a layout that kernels cannot read.
template <class T>
struct PackedSide {
  std::array<std::array<T, 4>, kPairsPerBlock> records;
  std::array<uint32_t, kPairsPerBlock> box_slot;
  std::array<Row, kPairsPerBlock> orientation;
  std::array<uint32_t, kPairsPerBlock> first_row;
  std::array<const DopGeometry*, kPairsPerBlock> dop;

  void put(size_t row, const Collidables& bodies, uint32_t index) {
    const BodyReader reader{bodies};
    const Position<T> p = reader.position<T>(index);
    const ShapeKind kind = reader.kind(index);
    records[row] = {p.x, p.y, p.z, kind == ShapeKind::sphere ? T{reader.radius(index)} : T{0}};
    if (kind == ShapeKind::aabb) box_slot[row] = static_cast<uint32_t>(reader.box(index));
    if (row_count(kind) == 0) return;
    orientation[row] = reader.orientation(index);
    first_row[row] = static_cast<uint32_t>(reader.first_row(index));
    dop[row] = reader.dop_geometry(index);
  }

  BatchSide side(const Collidables& bodies) const {
    return {records.data(),
            sizeof(records[0]),
            bodies.boxes,
            box_slot.data(),
            {orientation[0].data(), sizeof(Row)},
            {bodies.rows.data, first_row.data()},
            dop.data()};
  }
};

// Sorts the pairs of a block into one batch for every pair of kinds and order of sides, and runs
// them.
class BlockRunner {
 public:
  explicit BlockRunner(const PairBlock& block)
      : block_(block), layout_(common_layout(block.a.position, block.b.position)) {}

  void run() {
    if (!block_.a.kind && !block_.b.kind) {
      const PairKindRef kind = find_pair_kind(block_.a.uniform_kind, block_.b.uniform_kind);
      if (layout_ && !kind.flipped && is_complete(block_.out, block_.detail)) {
        return run_in_place(kind);
      }
    }
    sort_by_kind();
    size_t begin = 0;
    for (uint8_t kind = 0; kind < kPairKinds.size(); ++kind) {
      for (const bool flipped : {false, true}) {
        const size_t end = ends_[slot({kind, flipped})];
        if (begin < end) run_part({kind, flipped}, rows_.data() + begin, end - begin);
        begin = end;
      }
    }
  }

 private:
  // Where the sides are exchanged, manifolds are found relative to the bodies, and moved to the
  // world afterwards.
  bool moves_points(PairKindRef kind) const {
    return has_manifolds(block_.detail) && block_.frame == WitnessFrame::world && kind.flipped;
  }

  static size_t slot(PairKindRef kind) { return size_t{kind.index} * 2 + kind.flipped; }

  Pair pair(size_t row) const {
    if (block_.pairs) return block_.pairs[row];
    const auto index = static_cast<uint32_t>(block_.first + row);
    return {index, index};
  }

  Batch batch(PairKindRef kind) const {
    const Collidables& a = kind.flipped ? block_.b : block_.a;
    const Collidables& b = kind.flipped ? block_.a : block_.b;
    Batch batch;
    batch.a = side_of(a);
    batch.b = side_of(b);
    if (layout_) batch.layout = *layout_;
    batch.detail = block_.detail;
    batch.frame = moves_points(kind) ? WitnessFrame::body : block_.frame;
    return batch;
  }

  // Runs a block of one pair of kinds without any copies.
  void run_in_place(PairKindRef kind) const {
    Batch whole = batch(kind);
    whole.pairs = block_.pairs;
    if (!block_.pairs) {
      whole.a = side_of(run_of_bodies(block_.a, block_.first, block_.count));
      whole.b = side_of(run_of_bodies(block_.b, block_.first, block_.count));
      whole.pairs = kRowPairs.data();
      whole.pairs_are_rows = true;
    }
    whole.count = block_.count;
    whole.reach = block_.reach;
    whole.out = block_.out;
    run_passes(kPairKinds[kind.index], whole, block_.measured, block_.memory, block_.accuracy);
  }

  // Sorts the rows by counting.
  void sort_by_kind() {
    const BodyReader a{block_.a};
    const BodyReader b{block_.b};
    for (size_t row = 0; row < block_.count; ++row) {
      const Pair p = pair(row);
      const PairKindRef kind = find_pair_kind(a.kind(p.a), b.kind(p.b));
      slots_[row] = static_cast<uint8_t>(slot(kind));
      ++ends_[slots_[row]];
    }
    // Here each kind begins. Its rows move that to where it ends.
    uint16_t begin = 0;
    for (uint16_t& end : ends_) begin += std::exchange(end, begin);
    for (size_t row = 0; row < block_.count; ++row) {
      rows_[ends_[slots_[row]]++] = static_cast<uint16_t>(row);
    }
  }

  // Runs the pairs of one kind, which are in these rows of the block.
  void run_part(PairKindRef kind, const uint16_t* rows, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      const Pair p = pair(rows[i]);
      pairs_[i] = kind.flipped ? Pair{p.b, p.a} : p;
    }
    Batch part = batch(kind);
    part.pairs = pairs_.data();
    part.count = count;
    part.out = as_asked(memory_.columns(), block_.out);
    for (size_t i = 0; block_.reach && i < count; ++i) reach_[i] = block_.reach[rows[i]];
    if (block_.reach) part.reach = reach_.data();
    uint32_t* const directions = block_.memory.direction;
    const PairMemory memory = {directions ? directions_.data() : nullptr, block_.memory.shells};
    for (size_t i = 0; directions && i < count; ++i) directions_[i] = directions[rows[i]];
    for (size_t i = 0; part.out.features && i < count; ++i) {
      part.out.features[i] = block_.out.features[rows[i]];
    }
    if (layout_) {
      run_passes(kPairKinds[kind.index], part, block_.measured, memory, block_.accuracy);
    } else if (BodyReader{block_.a}.is_float64() || BodyReader{block_.b}.is_float64()) {
      run_packed<double>(kind, part, PositionLayout::records64);
    } else {
      run_packed<float>(kind, part, PositionLayout::records32);
    }
    scatter(kind, part.out, rows, count);
    for (size_t i = 0; directions && i < count; ++i) directions[rows[i]] = directions_[i];
  }

  template <class T>
  void run_packed(PairKindRef kind, Batch part, PositionLayout layout) const {
    const Collidables& a = kind.flipped ? block_.b : block_.a;
    const Collidables& b = kind.flipped ? block_.a : block_.b;
    PackedSide<T> packed_a, packed_b;
    for (size_t i = 0; i < part.count; ++i) {
      packed_a.put(i, a, pairs_[i].a);
      packed_b.put(i, b, pairs_[i].b);
    }
    part.a = packed_a.side(a);
    part.b = packed_b.side(b);
    part.layout = layout;
    part.pairs = kRowPairs.data();
    run_passes(kPairKinds[kind.index], part, block_.measured, {}, block_.accuracy);
  }

  // Copies results to the rows of the block, and exchanges the sides of flipped pairs.
  void scatter(PairKindRef kind, ResultColumns from, const uint16_t* rows, size_t count) {
    if (has_contacts(block_.detail)) {
      if (kind.flipped) flip(from, rows, count);
      if (moves_points(kind)) move_points(from, rows, count);
    }
    copy_rows(from, block_.out, block_.detail, count, [&](size_t i) { return rows[i]; });
  }

  void flip(ResultColumns& columns, const uint16_t* rows, size_t count) const {
    for (size_t i = 0; has_manifolds(block_.detail) && i < count; ++i) {
      for (size_t k = 0; k < columns.manifold_count[i]; ++k)
        move_to_other_side(columns, pair(rows[i]), i, k);
    }
    for (float* column : columns.normal) negate(column, count);
    std::swap(columns.point_a, columns.point_b);
  }

  // A kernel's manifold point is on its A and relative to it. The caller's A is the kernel's B, so
  // this moves the point along the normal to that side and makes it relative to that body.
  void move_to_other_side(const ResultColumns& columns, Pair bodies, size_t i, size_t k) const {
    const std::array<float, 3> d =
        relative_position(bodies);  // of the kernel's A relative to its B
    std::array<float, 3>& point = columns.manifold[i].point[k];
    const float separation = columns.manifold[i].separation[k];
    for (size_t axis = 0; axis < 3; ++axis) {
      point[axis] = (point[axis] + columns.normal[axis][i] * separation) + d[axis];
    }
  }

  // The position of the caller's B relative to its A, in float32.
  std::array<float, 3> relative_position(Pair p) const {
    const BodyReader a{block_.a};
    const BodyReader b{block_.b};
    const bool is_float64 = a.is_float64() || b.is_float64();
    return is_float64 ? difference(a.position<double>(p.a), b.position<double>(p.b))
                      : difference(a.position<float>(p.a), b.position<float>(p.b));
  }

  template <class T>
  static std::array<float, 3> difference(const Position<T>& a, const Position<T>& b) {
    const auto finite = [](T x) { return std::clamp(static_cast<float>(x), -FLT_MAX, FLT_MAX); };
    return {finite(b.x - a.x), finite(b.y - a.y), finite(b.z - a.z)};
  }

  // Moves points from relative to the bodies to world coordinates.
  void move_points(const ResultColumns& columns, const uint16_t* rows, size_t count) const {
    const bool is_float64 = BodyReader{block_.a}.is_float64() || BodyReader{block_.b}.is_float64();
    for (size_t i = 0; i < count; ++i) {
      is_float64 ? move_points_of<double>(pair(rows[i]), columns, i)
                 : move_points_of<float>(pair(rows[i]), columns, i);
    }
  }

  template <class T>
  void move_points_of(Pair p, const ResultColumns& columns, size_t i) const {
    const Position<T> a = BodyReader{block_.a}.template position<T>(p.a);
    const Position<T> b = BodyReader{block_.b}.template position<T>(p.b);
    move(a, columns.point_a, i);
    move(b, columns.point_b, i);
    for (size_t k = 0; k < columns.manifold_count[i]; ++k) {
      std::array<float, 3>& point = columns.manifold[i].point[k];
      point = world_point(a, point);
    }
  }

  template <class T>
  static void move(const Position<T>& position, const std::array<float*, 3>& columns, size_t i) {
    const auto moved = world_point(position, {columns[0][i], columns[1][i], columns[2][i]});
    for (size_t axis = 0; axis < 3; ++axis) columns[axis][i] = moved[axis];
  }

  // A NaN (no answer) keeps its bits.
  static void negate(float* column, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      if (column[i] == column[i]) column[i] = -column[i];
    }
  }

  const PairBlock& block_;
  const std::optional<PositionLayout> layout_;
  std::array<uint16_t, 2 * kPairKinds.size()> ends_{};  // of the rows of each kind
  std::array<uint8_t, kPairsPerBlock> slots_;
  std::array<uint16_t, kPairsPerBlock> rows_;  // by kind
  std::array<Pair, kPairsPerBlock> pairs_;
  std::array<uint32_t, kPairsPerBlock> directions_;
  std::array<float, kPairsPerBlock> reach_;
  BlockColumns memory_;
};

}  // namespace

void run_pair_block(const PairBlock& block) { BlockRunner(block).run(); }

}  // namespace carom
