#include "narrowphase/pair_block.h"

#include <array>
#include <optional>

#include "kernel/body_reader.h"
#include "narrowphase/pair_kinds.h"

namespace carom {
namespace {

// Layouts that kernels read in place.
std::optional<PositionLayout> common_layout(const PositionView& a, const PositionView& b) {
  if (!a.data && !b.data) return PositionLayout::none;
  const bool records = a.data && b.data && a.type == b.type &&
                       a.radius_layout == RadiusLayout::fourth &&
                       b.radius_layout == RadiusLayout::fourth;
  if (!records) return std::nullopt;
  return a.type == PositionType::float64 ? PositionLayout::records64 : PositionLayout::records32;
}

BatchSide side_of(const Collidables& bodies) {
  return {bodies.position.data, bodies.position.stride, bodies.boxes, bodies.box_slot};
}

// The side as seen from body `first` on.
BatchSide from_body(BatchSide side, size_t first) {
  if (side.records) {
    side.records = static_cast<const char*>(side.records) + first * side.record_stride;
  }
  if (side.box_slot) {
    side.box_slot += first;
    return side;
  }
  for (auto* corner : {&side.boxes.lower, &side.boxes.upper}) {
    for (const float*& column : *corner) {
      const char* shifted = reinterpret_cast<const char*>(column) + first * side.boxes.stride;
      if (column) column = reinterpret_cast<const float*>(shifted);
    }
  }
  return side;
}

// (0, 0), (1, 1), ...: rows as a list of pairs.
constexpr auto kRowPairs = [] {
  std::array<Pair, kPairsPerBlock> pairs{};
  for (uint32_t i = 0; i < pairs.size(); ++i) pairs[i] = {i, i};
  return pairs;
}();

// Every column that the detail fills is there.
bool is_complete(const ResultColumns& out, Detail detail) {
  if (!out.overlap || !out.status) return false;
  if (detail == Detail::overlap) return true;
  bool complete = out.separation != nullptr;
  for (size_t axis = 0; axis < 3; ++axis) {
    complete = complete && out.normal[axis] && out.point_a[axis] && out.point_b[axis];
  }
  return complete;
}

// Results of a part of a block, in the order of the kernel's batch.
struct ScratchColumns {
  std::array<uint8_t, kPairsPerBlock> overlap, status;
  std::array<std::array<float, kPairsPerBlock>, 10> floats;

  ResultColumns columns() {
    const auto column3 = [this](size_t i) -> std::array<float*, 3> {
      return {floats[i].data(), floats[i + 1].data(), floats[i + 2].data()};
    };
    return {overlap.data(), status.data(), floats[0].data(), column3(1), column3(4), column3(7)};
  }
};

// Bodies copied out of a layout that kernels do not read.
template <class T>
struct PackedSide {
  std::array<std::array<T, 4>, kPairsPerBlock> records;
  std::array<uint32_t, kPairsPerBlock> box_slot;

  void put(size_t row, const Collidables& bodies, uint32_t index) {
    const BodyReader reader{bodies};
    const Position<T> p = reader.position<T>(index);
    const bool is_sphere = reader.kind(index) == ShapeKind::sphere;
    records[row] = {p.x, p.y, p.z, is_sphere ? T{reader.radius(index)} : T{0}};
    if (!is_sphere) box_slot[row] = static_cast<uint32_t>(reader.box(index));
  }

  BatchSide side(const Collidables& bodies) const {
    return {records.data(), sizeof(records[0]), bodies.boxes, box_slot.data()};
  }
};

// The pairs of a block, sorted into one batch a pair of kinds and flip.
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
    for (uint8_t kind = 0; kind < kPairKinds.size(); ++kind) {
      for (const bool flipped : {false, true}) {
        if (counts_[slot({kind, flipped})] > 0) run_part({kind, flipped});
      }
    }
  }

 private:
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
    batch.frame = block_.frame;
    return batch;
  }

  // All pairs of one kind, readable as they lie: no copies at all.
  void run_in_place(PairKindRef kind) const {
    Batch whole = batch(kind);
    whole.pairs = block_.pairs;
    if (!block_.pairs) {
      whole.a = from_body(whole.a, block_.first);
      whole.b = from_body(whole.b, block_.first);
      whole.pairs = kRowPairs.data();
      whole.pairs_are_rows = true;
    }
    whole.count = block_.count;
    whole.out = block_.out;
    kPairKinds[kind.index].run(whole);
  }

  void sort_by_kind() {
    const BodyReader a{block_.a};
    const BodyReader b{block_.b};
    for (size_t row = 0; row < block_.count; ++row) {
      const Pair p = pair(row);
      const PairKindRef kind = find_pair_kind(a.kind(p.a), b.kind(p.b));
      slots_[row] = static_cast<uint8_t>(slot(kind));
      ++counts_[slots_[row]];
    }
  }

  void run_part(PairKindRef kind) {
    size_t count = 0;
    for (size_t row = 0; row < block_.count; ++row) {
      if (slots_[row] != slot(kind)) continue;
      const Pair p = pair(row);
      pairs_[count] = kind.flipped ? Pair{p.b, p.a} : p;
      rows_[count++] = static_cast<uint16_t>(row);
    }
    Batch part = batch(kind);
    part.pairs = pairs_.data();
    part.count = count;
    part.out = scratch_.columns();
    if (layout_) {
      kPairKinds[kind.index].run(part);
    } else if (BodyReader{block_.a}.is_float64() || BodyReader{block_.b}.is_float64()) {
      run_packed<double>(kind, part, PositionLayout::records64);
    } else {
      run_packed<float>(kind, part, PositionLayout::records32);
    }
    scatter(kind, count);
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
    kPairKinds[kind.index].run(part);
  }

  // Back to the rows of the block; what was flipped is turned round.
  void scatter(PairKindRef kind, size_t count) {
    const ResultColumns from = scratch_.columns();
    const ResultColumns& to = block_.out;
    copy(from.overlap, to.overlap, count);
    copy(from.status, to.status, count);
    if (block_.detail != Detail::contact) return;
    copy(from.separation, to.separation, count);
    for (size_t axis = 0; axis < 3; ++axis) {
      if (kind.flipped) negate(from.normal[axis], count);
      copy(from.normal[axis], to.normal[axis], count);
      copy(from.point_a[axis], (kind.flipped ? to.point_b : to.point_a)[axis], count);
      copy(from.point_b[axis], (kind.flipped ? to.point_a : to.point_b)[axis], count);
    }
  }

  template <class T>
  void copy(const T* from, T* to, size_t count) const {
    if (!to) return;
    for (size_t i = 0; i < count; ++i) to[rows_[i]] = from[i];
  }

  // NaN (no answer) stays the one NaN it is.
  static void negate(float* column, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      if (column[i] == column[i]) column[i] = -column[i];
    }
  }

  const PairBlock& block_;
  const std::optional<PositionLayout> layout_;
  std::array<size_t, 2 * kPairKinds.size()> counts_{};
  std::array<uint8_t, kPairsPerBlock> slots_;
  std::array<uint16_t, kPairsPerBlock> rows_;
  std::array<Pair, kPairsPerBlock> pairs_;
  ScratchColumns scratch_;
};

}  // namespace

void run_pair_block(const PairBlock& block) { BlockRunner(block).run(); }

ResultColumns from_row(const ResultColumns& columns, size_t row) {
  const auto shift = [row](auto* column) { return column ? column + row : nullptr; };
  const auto shift3 = [&shift](const std::array<float*, 3>& c) -> std::array<float*, 3> {
    return {shift(c[0]), shift(c[1]), shift(c[2])};
  };
  return {shift(columns.overlap), shift(columns.status),   shift(columns.separation),
          shift3(columns.normal), shift3(columns.point_a), shift3(columns.point_b)};
}

}  // namespace carom
