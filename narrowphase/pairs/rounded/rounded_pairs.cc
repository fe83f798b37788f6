// Pairs with a box or a hull that has a rounding: the kernel of their cores runs first, and its
// results grow.
#include <algorithm>
#include <array>
#include <limits>

#include "narrowphase/batch/column_memory.h"
#include "narrowphase/batch/row_selection.h"
#include "narrowphase/batch/row_store.h"
#include "narrowphase/batch/single_pair.h"
#include "narrowphase/batch/world_point.h"
#include "narrowphase/pairs/pair_kinds.h"
#include "narrowphase/pairs/rounded/grow_boxes.h"
#include "narrowphase/pairs/rounded/growth.h"
#include "narrowphase/scalar/length.h"

namespace carom {
namespace {

bool is_box(ShapeKind kind) { return core_kind(kind) == ShapeKind::box; }

// One side of a batch, read body by body.
class GrownSide {
 public:
  GrownSide(const BatchSide& side, PositionLayout layout, ShapeKind kind)
      : view_(view_of(side, layout, kind)), kind_(kind) {}

  BodyReader reader() const { return BodyReader{view_}; }

  const Row* rows(size_t body) const {
    return reinterpret_cast<const Row*>(view_.rows.data) + reader().first_row(body);
  }
  float rounding(size_t body) const { return is_rounded(kind_) ? (*rows(body))[3] : 0; }
  float core_size(size_t body) const {
    if (kind_ == ShapeKind::sphere) return reader().radius(body);
    if (kind_ == ShapeKind::aabb) {
      const BodyReader box = reader();
      return core_size_of_aabb({box.lower(0, body), box.lower(1, body), box.lower(2, body)},
                               {box.upper(0, body), box.upper(1, body), box.upper(2, body)});
    }
    return carom::core_size(kind_, rows(body));
  }
  bool is_special_triangle(size_t body) const {
    return kind_ == ShapeKind::triangle && carom::is_special_triangle(kind_, rows(body));
  }

 private:
  const Collidables view_;
  const ShapeKind kind_;
};

class RoundedBatch {
 public:
  RoundedBatch(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b)
      : batch_(batch),
        kind_a_(kind_a),
        kind_b_(kind_b),
        core_(kPairKinds[find_pair_kind(core_kind(kind_a), core_kind(kind_b)).index]),
        a_(batch.a, batch.layout, kind_a),
        b_(batch.b, batch.layout, kind_b) {}

  void run_tests() {
    Batch cores = core_batch(batch_);
    cores.out = has_contacts(batch_.detail) ? batch_.out : memory_.columns();
    cores.detail = Detail::contact;
    if (core_.measures_at_once()) cores.pass = Pass::distance;
    core_.run(cores);
    out_ = cores.out;
    grow_rows(cores, cores.pass == Pass::test && core_.has_distance_pass(), state_.data());
    measure_near(cores);
    find_open();
    if (has_contacts(batch_.detail)) return;
    std::copy_n(out_.overlap, batch_.count, batch_.out.overlap);
    std::copy_n(out_.status, batch_.count, batch_.out.status);
  }

  // The contacts shrink, and the points that the cores have for them grow.
  void run_manifolds() const {
    TestColumns memory;
    std::array<float, kPairsPerBlock> reach, rounding_a, rounding_b;
    const size_t count = batch_.count;
    for (size_t row = 0; row < count; ++row) {
      rounding_a[row] = a_.rounding(batch_.pairs[row].a);
      rounding_b[row] = b_.rounding(batch_.pairs[row].b);
    }
    Batch cores = core_batch(batch_);
    const ResultColumns shrunk = memory.columns();
    cores.tested.separation = shrunk.separation;
    cores.tested.point_a = shrunk.point_a;
    cores.reach = reach.data();
    for (size_t row = 0; row < count; ++row) {
      const float both = rounding_a[row] + rounding_b[row];
      shrunk.separation[row] = batch_.tested.separation[row] + both;
      reach[row] = (batch_.reach ? batch_.reach[row] : 0) + both;
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      const float* const n = batch_.tested.normal[axis];
      const float* const p = batch_.tested.point_a[axis];
      float* const to = shrunk.point_a[axis];
      for (size_t row = 0; row < count; ++row) to[row] = p[row] - n[row] * rounding_a[row];
    }
    // Kernels of cores may read whole vectors of these.
    const size_t end = (count + kMostLanes - 1) / kMostLanes * kMostLanes;
    for (float* const column : {shrunk.separation, shrunk.point_a[0], shrunk.point_a[1],
                                shrunk.point_a[2], reach.data()}) {
      std::fill(column + count, column + end, column[count - 1]);
    }
    core_.run(cores);
    const auto& n = batch_.tested.normal;
    const bool is_float64 = a_.reader().is_float64();
    for (size_t row = 0; row < count; ++row) {
      const size_t to = batch_.manifold_row[row];
      ManifoldPoints& points = batch_.out.manifold[to];
      const uint8_t of_row = batch_.out.manifold_count[to];
      grow_points(points, of_row, std::array{n[0][row], n[1][row], n[2][row]}, rounding_a[row],
                  rounding_b[row], batch_.tested.separation[row]);
      if (batch_.frame != WitnessFrame::world) continue;
      const uint32_t body = batch_.pairs[row].a;
      if (is_float64) {
        move_to(a_.reader().position<double>(body), of_row, points);
      } else {
        move_to(a_.reader().position<float>(body), of_row, points);
      }
    }
  }

 private:
  template <class T>
  static void move_to(const Position<T>& position, size_t count, ManifoldPoints& points) {
    for (size_t k = 0; k < count; ++k) points.point[k] = world_point(position, points.point[k]);
  }

  static Batch core_batch(const Batch& batch) {
    Batch cores = batch;
    cores.frame = WitnessFrame::body;
    cores.unsure = nullptr;
    cores.features = nullptr;
    cores.shells = nullptr;
    return cores;
  }

  Growth growth_of(Pair pair) const {
    const Eigen::Vector3f d =
        a_.reader().is_float64() ? relative_position<double>(pair) : relative_position<float>(pair);
    return {a_.rounding(pair.a), b_.rounding(pair.b), distance_along_axes(d), a_.core_size(pair.a),
            b_.core_size(pair.b)};
  }

  template <class T>
  Eigen::Vector3f relative_position(Pair pair) const {
    const Position<T> a = a_.reader().position<T>(pair.a), b = b_.reader().position<T>(pair.b);
    return scalar::relative_position(Eigen::Vector3<T>(a.x, a.y, a.z),
                                     Eigen::Vector3<T>(b.x, b.y, b.z));
  }

  // Grows rows of the cores in their columns, and writes the state of each. `is_bound`: of separate
  // cores the separation is only a bound.
  void grow_rows(const Batch& cores, bool is_bound, uint8_t* state) const {
    size_t row = 0;
    if (is_box(kind_a_) && is_box(kind_b_)) {
      row = grow_boxes({.cores = cores,
                        .frame = batch_.frame,
                        .is_rounded_a = is_rounded(kind_a_),
                        .is_rounded_b = is_rounded(kind_b_),
                        .is_bound = is_bound},
                       state);
    }
    for (; row < cores.count; ++row) {
      state[row] = static_cast<uint8_t>(grow(cores, row, is_bound));
    }
  }

  // The same for one row, of any kinds.
  GrownState grow(const Batch& cores, size_t row, bool is_bound) const {
    const ResultColumns& out = cores.out;
    if (out.status[row] == static_cast<uint8_t>(Status::invalid)) return GrownState::done;
    const Pair pair = cores.pairs[row];
    if (!is_valid_radius(a_.rounding(pair.a)) || !is_valid_radius(b_.rounding(pair.b))) {
      return GrownState::invalid;
    }
    const Growth growth = growth_of(pair);
    const float separation = out.separation[row] - growth.both();
    if (is_bound && out.separation[row] > 0 && (cores.measures || !(separation > growth.near))) {
      return GrownState::near;
    }
    if (growth.both() == 0 || !growth.is_sure(separation) || a_.is_special_triangle(pair.a) ||
        b_.is_special_triangle(pair.b)) {
      return GrownState::left;
    }
    // The tests of round cores search, and prove nothing.
    if (batch_.unsure && (is_round(kind_a_) || is_round(kind_b_))) batch_.unsure[row] = 1;
    out.separation[row] = separation;
    out.overlap[row] = separation <= 0;
    std::array<float, 3> arm_a, arm_b;
    for (size_t axis = 0; axis < 3; ++axis) {
      const float n = out.normal[axis][row];
      arm_a[axis] = out.point_a[axis][row] + n * growth.a;
      arm_b[axis] = out.point_b[axis][row] - n * growth.b;
    }
    put_points(out, row, pair, arm_a, arm_b);
    return GrownState::done;
  }

  void put_points(const ResultColumns& out, size_t row, Pair pair, std::array<float, 3> arm_a,
                  std::array<float, 3> arm_b) const {
    if (batch_.frame == WitnessFrame::world) {
      arm_a = world_point(a_.reader(), pair.a, arm_a);
      arm_b = world_point(b_.reader(), pair.b, arm_b);
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      out.point_a[axis][row] = arm_a[axis];
      out.point_b[axis][row] = arm_b[axis];
    }
  }

  // Measures separate cores that are not sure to be further apart than the roundings reach, or all
  // of them.
  void measure_near(const Batch& cores) {
    RowSelection near(cores);
    near.select([&](size_t row) { return state_[row] == static_cast<uint8_t>(GrownState::near); });
    if (near.count() == 0) return;
    TestColumns memory;
    std::array<uint8_t, kPairsPerBlock> state;
    Batch distances = near.batch(Pass::distance);
    distances.out = memory.columns();
    core_.run(distances);
    grow_rows(distances, false, state.data());
    near.scatter(distances.out, out_, Detail::contact);
    near.scatter(state.data(), state_.data());
  }

  // Answers the rows that are left, and those that are not valid.
  void find_open() const {
    Batch answers = batch_;
    answers.out = out_;
    answers.detail = Detail::contact;
    const RowStore store(answers, kind_a_, kind_b_);
    std::array<float, 10> answer;
    for (size_t row = 0; row < batch_.count; ++row) {
      const auto state = static_cast<GrownState>(state_[row]);
      if (state == GrownState::done) continue;
      if (state == GrownState::invalid) {
        answer.fill(std::numeric_limits<float>::quiet_NaN());
        store.put(row, Status::invalid, answer);
        continue;
      }
      const Growth growth = growth_of(batch_.pairs[row]);
      const bool is_unsure = growth.both() != 0 || !growth.is_sure(out_.separation[row]);
      if (batch_.unsure && is_unsure) batch_.unsure[row] = 1;
      if (growth.both() == 0) {
        keep_cores(row);
        continue;
      }
      const std::array<float, 11> found = exact_answer(batch_, kind_a_, kind_b_, row);
      std::copy_n(found.begin(), answer.size(), answer.begin());
      store.put(row, found[10] != 0 ? Status::degenerate : Status::ok, answer);
    }
  }

  // Without roundings the answer is that of the cores.
  void keep_cores(size_t row) const {
    const auto point = [row](const std::array<float*, 3>& columns) -> std::array<float, 3> {
      return {columns[0][row], columns[1][row], columns[2][row]};
    };
    out_.overlap[row] = out_.separation[row] <= 0;
    put_points(out_, row, batch_.pairs[row], point(out_.point_a), point(out_.point_b));
  }

  const Batch& batch_;
  const ShapeKind kind_a_, kind_b_;
  const PairKind& core_;
  const GrownSide a_, b_;
  ResultColumns out_;  // of the cores, then of the rounded shapes
  TestColumns memory_;
  std::array<uint8_t, kPairsPerBlock> state_;
};

}  // namespace

void run_rounded_pair(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b) {
  RoundedBatch rounded(batch, kind_a, kind_b);
  return batch.pass == Pass::manifold ? rounded.run_manifolds() : rounded.run_tests();
}

}  // namespace carom
